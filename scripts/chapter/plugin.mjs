// The chapter in Vite: a page for each text of www/, its fonts and the rules of its formulas to www/generated, for every way to build or serve.
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs'
import { basename, join } from 'node:path'
import { toBibtex, toCsl } from './bibliography.mjs'
import { readIfThere } from '../lib.mjs'
import { pageFiles, renderChapter } from './chapter.mjs'
import { Letters, writeFonts } from './fonts.mjs'
import { serialize } from './page.mjs'

/** A page before its text is in it. @param {string} language */
const shell = language => `<!doctype html>
<html lang="${language}">
  <head>
    <!-- head -->
  </head>
  <body>
    <!-- body -->
  </body>
</html>
`

/** @param {string} root @returns {import('vite').Plugin} */
export function chapter(root) {
  const www = join(root, 'www')
  /** Of the file that a page would be. */
  const shells = new Map([...pageFiles(www)].map(([file, language]) => [join(www, file), shell(language)]))
  const generated = join(www, 'generated')
  /** @type {Promise<import('./chapter.mjs').Chapter> | undefined} */
  let made

  const make = async () => {
    const result = await renderChapter(root)
    const letters = new Letters()
    for (const { body, language } of Object.values(result.pages)) language === 'de' ? letters.collectGerman(body) : letters.collect(body)
    await writeFonts(root, generated, letters)
    mkdirSync(generated, { recursive: true })
    const css = join(generated, 'math.css')
    if (readIfThere(css) !== result.css) writeFileSync(css, result.css)
    return result
  }

  return {
    name: 'chapter',
    config: () => ({ build: { rollupOptions: { input: Object.fromEntries([...shells.keys()].map(file => [`page-${basename(file, '.html')}`, file])) } } }),
    resolveId: id => (shells.has(id) ? id : undefined),
    load: id => shells.get(id),
    async buildStart() {
      await (made ??= make())
    },
    async generateBundle() {
      const works = JSON.parse(readFileSync(join(www, 'references.json'), 'utf8'))
      const { downloads, packages } = await (made ??= make())
      for (const [fileName, source] of Object.entries({ 'references.bib': toBibtex(works), 'references.json': toCsl(works), ...downloads, ...packages })) this.emitFile({ type: 'asset', fileName, source })
    },
    transformIndexHtml: {
      order: 'pre',
      async handler(html, { path }) {
        const page = (await (made ??= make())).pages[basename(path) || 'index.html']
        return page ? html.replace('<!-- head -->', () => serialize(page.head)).replace('<!-- body -->', () => serialize(page.body)) : html
      },
    },
    async configureServer(server) {
      server.middlewares.use(async ({ url = '/' }, response, next) => {
        const path = url.replace(/[?#].*/, '')
        const html = shells.get(join(www, path === '/' ? 'index.html' : path))
        if (html === undefined) next()
        else response.setHeader('Content-Type', 'text/html').end(await server.transformIndexHtml(path, html))
      })
      const watch = async () => {
        const { files } = await (made ??= make())
        server.watcher.add([...files, join(www, 'chapter')])
      }
      await watch().catch(error => server.config.logger.error(error.message))
      server.watcher.on('all', (_, file) => {
        if (!/\.(md|json|rs)$/.test(file)) return
        made = undefined
        watch().then(
          () => server.ws.send({ type: 'full-reload' }),
          error => {
            server.config.logger.error(error.message)
            server.ws.send({ type: 'error', err: { message: error.message, stack: '' } })
          },
        )
      })
    },
  }
}
