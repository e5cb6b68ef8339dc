// Builds the chapter: the widgets to WebAssembly (widgets/pkg), then the pages around them (dist).
import { createHash } from 'node:crypto'
import { copyFileSync, existsSync, mkdirSync, readFileSync, renameSync, rmSync, statSync } from 'node:fs'
import { basename, join } from 'node:path'
import { fileURLToPath } from 'node:url'
import { writeNames } from './elements.mjs'
import { writeFrames } from './frames.mjs'
import { programNames } from './registry.mjs'
import { setUp } from './setup.mjs'
import { cache, isMain, main, npmBin, root, run, step, StepError } from './lib.mjs'

export const dist = join(root, 'dist')
const wasm = join(root, 'widgets', 'pkg', 'fastslam_widgets_bg.wasm')

/** The features Rust's target has by default, and SIMD of fixed width. Nothing that may change a bit: no fast-math, no relaxed SIMD. */
const features = [
  '--enable-simd',
  '--enable-bulk-memory',
  '--enable-bulk-memory-opt',
  '--enable-nontrapping-float-to-int',
  '--enable-sign-ext',
  '--enable-mutable-globals',
  '--enable-multivalue',
  '--enable-reference-types',
]

const optimiser = [...features, '-O3', '--strip-debug']

/** Where a program is. @param {string} program */
export const programFile = program => join(root, 'widgets', 'pkg', `fastslam-${program}.wasm`)

/** The program with all figures: for whatever carries it along, and to be asked what there is. */
export async function buildWasm() {
  await step('Widgets to WebAssembly', () => run('wasm-pack', ['build', 'widgets', '--target', 'web', '--profile', 'page', '--no-pack']))
  await step('Optimise WebAssembly', () => optimise(wasm))
  await step('Names of the figures', writeNames)
}

/** What pages load: the program of the figures that run on the page itself, that of the one that maps logs, in a worker, and that which reads bags for it. All use the same glue. */
export async function buildPrograms() {
  const folder = cache('programs')
  for (const program of programNames) {
    const wanted = ['--no-default-features', '--features', `single-threaded,${program}`]
    await step(basename(programFile(program)), async () => {
      await run('wasm-pack', ['build', 'widgets', '--target', 'web', '--profile', 'page', '--no-pack', '--no-typescript', '--out-dir', folder, ...wanted])
      copyFileSync(join(folder, basename(wasm)), programFile(program))
      return optimise(programFile(program))
    })
  }
}

/** A program that dies on request, for one test of the browser and never for a page. */
export const troubleWasm = cache('trouble', basename(wasm))

/** Nobody waits for it: without the last optimisations it is there in a third of the time. */
export async function buildTrouble() {
  const wanted = ['--no-default-features', '--features', 'single-threaded,page,log,bags,trouble']
  const args = ['build', 'widgets', '--target', 'web', '--profile', 'page', '--no-pack', '--no-typescript', '--out-dir', cache('trouble'), ...wanted]
  await step('A program that dies on request', () => run('wasm-pack', args, { env: { CARGO_PROFILE_PAGE_LTO: 'off', CARGO_PROFILE_PAGE_CODEGEN_UNITS: '16' } }))
}

export async function buildPages() {
  await step('Pages', async () => {
    await run(npmBin('vite'), ['build', '--config', join(root, 'scripts', 'vite.config.mjs'), '--logLevel', 'warn'])
    for (const file of ['index.html', 'embed.html', 'fastslam.js']) {
      if (!existsSync(join(dist, file))) throw new StepError(`The build did not write dist/${file}.`)
    }
    return 'in dist/'
  })
  await step('Frames, oEmbed and the files for other pages', writeFrames)
}

export async function build() {
  await setUp()
  await buildWasm()
  await buildPrograms()
  await buildPages()
}

/** wasm-opt takes far longer than an incremental build: what it made of the same input is kept, of each program once. @param {string} file */
async function optimise(file) {
  const input = readFileSync(file)
  const hash = createHash('sha256')
  for (const other of [fileURLToPath(import.meta.url), join(root, 'node_modules', 'binaryen', 'package.json')]) hash.update(readFileSync(other))
  const folder = cache('wasm-opt', basename(file))
  const kept = join(folder, hash.update(input).digest('hex'))
  if (!existsSync(kept)) {
    rmSync(folder, { recursive: true, force: true })
    mkdirSync(folder, { recursive: true })
    const part = `${kept}.part`
    await run(npmBin('wasm-opt'), [...optimiser, file, '-o', part])
    renameSync(part, kept)
  }
  copyFileSync(kept, file)
  return `${kilobytes(input.length)} → ${kilobytes(statSync(file).size)}`
}

/** @param {number} bytes */
export const kilobytes = bytes => `${(bytes / 1000).toFixed(1)} KB`

if (isMain(import.meta)) await main(build)
