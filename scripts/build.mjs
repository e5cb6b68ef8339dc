// Builds the chapter: the widgets to WebAssembly (widgets/pkg), then the pages around them (dist).
import { createHash } from 'node:crypto'
import { copyFileSync, existsSync, mkdirSync, readFileSync, rmSync, statSync } from 'node:fs'
import { join } from 'node:path'
import { setUp } from './setup.mjs'
import { cache, isMain, main, npmBin, root, run, step, StepError } from './lib.mjs'

export const dist = join(root, 'dist')
const wasm = join(root, 'widgets', 'pkg', 'fastslam_widgets_bg.wasm')

/** The features Rust's target has by default, and SIMD of fixed width. Nothing that may change a bit: no fast-math, no relaxed SIMD. */
const optimiser = [
  '-Oz',
  // Functions that LLVM left apart stay apart, and lie beside their like: what Brotli sends is 3 KB less.
  '--one-caller-inline-max-function-size=1',
  '--reorder-functions',
  '--enable-simd',
  '--enable-bulk-memory',
  '--enable-bulk-memory-opt',
  '--enable-nontrapping-float-to-int',
  '--enable-sign-ext',
  '--enable-mutable-globals',
  '--enable-multivalue',
  '--enable-reference-types',
]

export async function buildWasm() {
  await step('Widgets to WebAssembly', () => run('wasm-pack', ['build', 'widgets', '--target', 'web', '--release', '--no-pack']))
  await step('Optimise WebAssembly', optimise)
}

export async function buildPages() {
  await step('Pages', async () => {
    await run(npmBin('vite'), ['build', '--config', join(root, 'scripts', 'vite.config.mjs'), '--logLevel', 'warn'])
    for (const file of ['index.html', 'fastslam.js']) {
      if (!existsSync(join(dist, file))) throw new StepError(`The build did not write dist/${file}.`)
    }
    return 'in dist/'
  })
}

export async function build() {
  await setUp()
  await buildWasm()
  await buildPages()
}

/** wasm-opt takes far longer than an incremental build: what it made of the same input is kept. */
async function optimise() {
  const input = readFileSync(wasm)
  const binaryen = readFileSync(join(root, 'node_modules', 'binaryen', 'package.json'))
  const key = createHash('sha256').update(input).update(binaryen).update(optimiser.join()).digest('hex')
  const kept = cache('wasm-opt', `${key}.wasm`)
  if (!existsSync(kept)) {
    rmSync(cache('wasm-opt'), { recursive: true, force: true })
    mkdirSync(cache('wasm-opt'), { recursive: true })
    const part = `${kept}.part`
    await run(npmBin('wasm-opt'), [...optimiser, wasm, '-o', part])
    copyFileSync(part, kept)
    rmSync(part)
  }
  copyFileSync(kept, wasm)
  return `${kilobytes(input.length)} → ${kilobytes(statSync(wasm).size)}`
}

/** @param {number} bytes */
export const kilobytes = bytes => `${(bytes / 1000).toFixed(1)} KB`

if (isMain(import.meta)) await main(build)
