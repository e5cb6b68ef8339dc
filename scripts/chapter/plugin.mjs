// The chapter in Vite: its text goes into www/*.html, its fonts and the rules of its formulas to www/generated, for every way to build or serve.
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs'
import { basename, join } from 'node:path'
import { toBibtex, toCsl } from './bibliography.mjs'
import { readIfThere } from '../lib.mjs'
import { renderChapter } from './chapter.mjs'
import { Letters, writeFonts } from './fonts.mjs'
import { serialize } from './page.mjs'

/** @param {string} root @returns {import('vite').Plugin} */
export function chapter(root) {
  const generated = join(root, 'www', 'generated')
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
    async buildStart() {
      await (made ??= make())
    },
    async generateBundle() {
      const works = JSON.parse(readFileSync(join(root, 'www', 'references.json'), 'utf8'))
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
      const watched = join(root, 'www')
      const watch = async () => {
        const { files } = await (made ??= make())
        server.watcher.add([...files, join(watched, 'chapter')])
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
