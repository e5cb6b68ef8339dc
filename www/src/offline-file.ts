// A figure as one HTML file, which works from a stick or an e-mail without a network. It is made here in the browser: the script for notebooks
// carries all programs along, and the file is that script with the figure before it.
import { escape, type FigureMarkup } from '../../widgets/elements/embed-code'
import policy from './offline-policy.json'

/** The file as text: the policy of this page would keep a document that is made of it from having its styles. */
export async function offlineFile(home: string, { tag, attributes }: FigureMarkup, title: string, language: string): Promise<Blob> {
  const response = await fetch(`${home}fastslam-anywidget.js`)
  if (!response.ok) throw new Error(`${response.url}: the server answered ${response.status}`)
  const script = (await response.text()).replaceAll('</script', '<\\/script')
  const given = attributes.map(([name, value]) => ` ${name}="${escape(value)}"`).join('')
  const page = `<!doctype html>
<html lang="${escape(language)}">
  <head>
    <meta charset="utf-8" />
    <meta name="viewport" content="width=device-width, initial-scale=1" />
    <meta http-equiv="Content-Security-Policy" content="${escape(policy)}" />
    <title>${escape(title)}</title>
    <style>:root { color-scheme: light dark } body { margin: 1rem auto; max-width: 64rem; padding-inline: 1rem }</style>
  </head>
  <body>
    <main><${tag}${given}></${tag}></main>
    <script type="module">${script}</script>
  </body>
</html>
`
  return new Blob([page], { type: 'text/html' })
}
