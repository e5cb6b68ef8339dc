// The figures as one script that carries its program along: for notebooks, and for pages that are opened from a file.
import { readdirSync, readFileSync } from 'node:fs'
import { join } from 'node:path'
import { gzipSync } from 'node:zlib'
import { root, StepError } from './lib.mjs'

const elements = join(root, 'widgets', 'elements')

/** The script, as text. @returns {Promise<string>} */
export async function singleFile() {
  const { build } = await import('vite')
  const assets = join(root, 'dist', 'assets')
  const worker = readdirSync(assets).find(file => /^worker-[\w-]{8}\.js$/.test(file))
  if (!worker) throw new StepError('The build did not write dist/assets/worker-*.js.')
  const program = gzipSync(readFileSync(join(root, 'widgets', 'pkg', 'fastslam_widgets_bg.wasm')), { level: 9 }).toString('base64')
  const carried = `export const program = ${JSON.stringify(program)}; export const worker = ${JSON.stringify(readFileSync(join(assets, worker), 'utf8'))}`
  const built = await build({
    configFile: false,
    root: elements,
    base: './',
    logLevel: 'warn',
    build: {
      write: false,
      target: 'es2022',
      assetsInlineLimit: 0,
      reportCompressedSize: false,
      rollupOptions: { input: join(elements, 'notebook.ts'), preserveEntrySignatures: 'strict', output: { entryFileNames: '[name].js', codeSplitting: false } },
    },
    plugins: [
      {
        name: 'fastslam-files',
        enforce: 'pre',
        resolveId(/** @type {string} */ source, /** @type {string | undefined} */ importer) {
          if (source === 'virtual:fastslam-files') return `\0${source}`
          return source === './files' && importer?.startsWith(elements) ? join(elements, 'files-inline.ts') : undefined
        },
        load: (/** @type {string} */ id) => (id === '\0virtual:fastslam-files' ? carried : undefined),
      },
    ],
  })
  const output = [built].flat().flatMap(result => ('output' in result ? result.output : []))
  const scripts = output.filter(file => file.type === 'chunk')
  if (scripts.length !== 1 || !scripts[0]) throw new StepError(`The script of one file came out as ${scripts.length}: ${scripts.map(({ fileName }) => fileName).join(', ')}`)
  return scripts[0].code
}
