// The pages of www/ and the elements of widgets/elements, to dist/. Relative addresses, so that dist/ works in any folder of
// any site; hashed names, except for fastslam.js: the one line of a teacher's page names it.
import { createHash } from 'node:crypto'
import { mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs'
import { basename, dirname, join } from 'node:path'
import { defineConfig } from 'vite'
import { chapter } from './chapter/plugin.mjs'
import { dist } from './build.mjs'
import { catalogue, languages } from './elements.mjs'
import { cache, root, targets } from './lib.mjs'
import { policy } from './policy.mjs'
import { programs } from './registry.mjs'

const www = join(root, 'www')
const pages = readdirSync(www, { recursive: true, encoding: 'utf8' }).filter(
  file => file.endsWith('.html') && !/(^|[/\\])(public|node_modules|generated)[/\\]/.test(file),
)

/** @param {{ names: string[] }} asset */
const assetFileNames = asset => (asset.names.some(name => basename(name).endsWith('.wasm')) ? '[name]-[hash][extname]' : 'assets/[name]-[hash][extname]')

/** What only some figures have: code of their own, and what that stands on; widgets/elements/define.ts loads it where one of them is asked for. */
const apart = ['fastslam-[\\w-]+', 'mapping', 'drops', 'map-gestures', 'drive', 'count-study', 'universes-again', 'laps', 'matrix-inputs', 'index', 'generated[/\\\\](log|counted|elements)']
const shared = new RegExp(`widgets[/\\\\](pkg[/\\\\]|words[/\\\\]|elements[/\\\\](?!(${apart.join('|')})\\.))`)

/** In the head of every page, before all that it loads; vite's own server needs what the policy forbids. @type {import('vite').Plugin} */
const policyInHead = {
  name: 'policy-in-head',
  apply: 'build',
  transformIndexHtml: () => [{ tag: 'meta', attrs: { 'http-equiv': 'Content-Security-Policy', content: policy }, injectTo: 'head-prepend' }],
}

/** In styles of pages, the element `fastslam-figure` stands for that of any figure. @type {import('vite').Plugin} */
const anyFigure = {
  name: 'any-figure',
  enforce: 'pre',
  transform: (code, id) => (/\.css(\?|$)/.test(id) ? code.replaceAll('fastslam-figure', `:is(${[...programs.keys()].join()})`) : undefined),
}

/** A language is one file to a page, of what the kit says and of what its figures say. @type {import('vite').Plugin} */
const wholeLanguages = {
  name: 'whole-languages',
  enforce: 'pre',
  resolveId(source) {
    const [, language] = /^\.\.\/words\/(\w+)\.json\?url$/.exec(source) ?? []
    if (!language) return undefined
    const file = cache('widgets', 'words', `${language}.json`)
    mkdirSync(dirname(file), { recursive: true })
    writeFileSync(file, JSON.stringify(catalogue(language), null, 2))
    return `${file}?url`
  },
}

/** fastslam.js becomes what loads it, as it is kept in a file with a hash (loader.js). @type {import('vite').Plugin} */
const loader = {
  name: 'loader',
  apply: 'build',
  generateBundle: {
    order: 'post',
    handler(_, bundle) {
      const entry = bundle['fastslam.js']
      if (entry?.type !== 'chunk') throw new Error('There is no fastslam.js.')
      const code = entry.code.replaceAll(/(["'])\.\/(assets\/)?/g, (_, quote, assets) => `${quote}${assets ? './' : '../'}`)
      const fileName = `assets/figures-${createHash('sha256').update(code).digest('base64url').slice(0, 8)}.js`
      this.emitFile({ type: 'asset', fileName, source: code })
      const words = (/** @type {string} */ language) => catalogue(language)['elements']?.['no_script']
      entry.code = readFileSync(join(root, 'scripts', 'loader.js'), 'utf8')
        .replace('FIGURES', `./${fileName}`)
        .replace('SHARED', `./${entry.imports.find(file => file.startsWith('fastslam-'))}`)
        .replace('NAMES', entry.exports.join(', '))
        .replace('WORDS', JSON.stringify(Object.fromEntries(languages.map(language => [language, words(language)]))))
    },
  },
}

export default defineConfig({
  root: www,
  base: './',
  plugins: [anyFigure, wholeLanguages, chapter(root), policyInHead, loader],
  build: {
    outDir: dist,
    emptyOutDir: true,
    ...targets,
    // Under the content security policy neither a data: font nor an inline style is allowed.
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    reportCompressedSize: false,
    rollupOptions: {
      input: {
        ...Object.fromEntries(pages.map(file => [`page-${file.replace(/\.html$/, '').replaceAll(/[/\\]/g, '-')}`, join(www, file)])),
        fastslam: join(root, 'widgets', 'elements', 'index.ts'),
      },
      // A teacher's page may import from it, so all its exports stay.
      preserveEntrySignatures: 'allow-extension',
      output: {
        entryFileNames: chunk => (chunk.name === 'fastslam' ? '[name].js' : 'assets/[name]-[hash].js'),
        // What all figures share is one file, and what only one has is a file of its own: a page for frames loads no other's.
        codeSplitting: { groups: [{ name: 'shared', test: shared }] },
        // It lies beside fastslam.js, which only names them: figures find the site's other pages from there.
        chunkFileNames: chunk => (chunk.name === 'shared' ? 'fastslam-[hash].js' : 'assets/[name]-[hash].js'),
        assetFileNames,
      },
    },
  },
  worker: { format: 'es', rollupOptions: { output: { entryFileNames: 'assets/[name]-[hash].js', assetFileNames } } },
  // The elements, and what wasm-pack makes, are outside www/.
  server: { fs: { allow: [root] } },
})
