// What a page has on another page and fetches when it is unfolded (`::unfold`), put where it belongs: for files that carry all they need, and
// for paper, which cannot fetch anything.
import { readFileSync } from 'node:fs'
import { join } from 'node:path'

/**
 * A page with its folds filled, and the styles of what is in them.
 * @param {string} html @param {string} folder of the pages
 */
export function fillFolds(html, folder) {
  /** @type {Map<string, string>} */
  const pages = new Map()
  const read = (/** @type {string} */ file) => {
    const page = pages.get(file) ?? readFileSync(join(folder, file), 'utf8')
    pages.set(file, page)
    return page
  }
  const filled = html.replace(/(<details class="[a-z]+ elsewhere">.*?<div class="fold">)<p><a href="([^"#]+)#([^"]+)">.*?<\/a><\/p>(?=<\/div>)/gs, (_, before, file, id) => {
    const section = new RegExp(`<h2 id="${id}">.*?</h2>([^]*?)</section>`).exec(read(file))?.[1]
    if (section === undefined) throw new Error(`${file} has no section #${id}.`)
    return before + section.replace(/href="(?:\.\/)?index\.html#/g, 'href="#')
  })
  // What was on those pages is here now.
  const whole = filled.replace(/href="([\w-]+\.html)#([^"]+)"/g, (link, file, id) => (pages.has(file) && filled.includes(` id="${id}"`) ? `href="#${id}"` : link))
  const styles = [...pages.values()].flatMap(page => page.match(/<link[^>]*rel="stylesheet"[^>]*>/g) ?? []).filter(link => !html.includes(link))
  return whole.replace('</head>', () => `${[...new Set(styles)].join('')}</head>`)
}
