// Builds the chapter: the widgets to WebAssembly (widgets/pkg), then the pages around them (dist).
import { createHash } from 'node:crypto'
import { copyFileSync, existsSync, mkdirSync, readFileSync, renameSync, rmSync, statSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import { fileURLToPath } from 'node:url'
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

// Functions that LLVM left apart stay apart, and lie beside their like: what Brotli sends is 3 KB less.
const optimiser = [...features, '-Oz', '--one-caller-inline-max-function-size=1', '--reorder-functions']

/** After functions have become traps: what only they reached goes, and the rest moves together. */
const sweep = ['--duplicate-function-elimination', '--remove-unused-module-elements', '--reorder-functions', '--strip-debug']

/**
 * tiny-skia-path strokes and dashes curves as well, and no linker can tell that the painter (widgets/src/paint) strokes polylines only.
 * @param {string} name a function's, in Rust
 */
const neverRun = name => /^<?tiny_skia_path\b.*(::PathStroker>?::(cubic|quad|conic)|ContourMeasure>?::compute_(cubic|quad|conic))/.test(name.replace(disambiguator, ''))

/** What Rust writes behind the name of a crate. */
const disambiguator = /\[[0-9a-f]{16}\]/g

/** All figures: their tags, and the modules of widgets/src that only they use. */
export const figures = [...readFileSync(join(root, 'widgets', 'src', 'registry.rs'), 'utf8').matchAll(/tag: "(fastslam-([a-z-]+))"/g)].map(
  ([, tag = '', name = '']) => ({ tag, module: name.replaceAll('-', '_') }),
)

/** The program with one figure only. @param {string} tag */
export const figureWasm = tag => join(root, 'widgets', 'pkg', `${tag}.wasm`)

/**
 * Makes traps of functions, by their names in Rust.
 * @param {Buffer} input @param {(name: string) => boolean} which @param {number} least how many there must be, or the names have changed
 */
async function withTraps(input, which, least) {
  const { default: binaryen } = await import('binaryen')
  binaryen.setDebugInfo(true)
  const module = binaryen.readBinary(input)
  const { SIMD128, BulkMemory, BulkMemoryOpt, NontrappingFPToInt, SignExt, MutableGlobals, Multivalue, ReferenceTypes } = binaryen.Features
  module.setFeatures(SIMD128 | BulkMemory | BulkMemoryOpt | NontrappingFPToInt | SignExt | MutableGlobals | Multivalue | ReferenceTypes)
  const functions = Array.from({ length: module.getNumFunctions() }, (_, i) => binaryen.getFunctionInfo(module.getFunctionByIndex(i)))
  const traps = functions.filter(({ name }) => which(name))
  if (traps.length < least) throw new StepError(`Only ${traps.length} functions that never run were found by name: have they been renamed?`)
  for (const { name, params, results } of traps) {
    module.removeFunction(name)
    module.addFunction(name, params, results, [], module.unreachable())
  }
  const output = Buffer.from(module.emitBinary())
  module.dispose()
  return output
}

/** Whether only another figure calls a function. @param {string} module */
const ofOthers = module => {
  const others = figures.map(figure => figure.module).filter(other => other !== module)
  const names = new RegExp(`\\bfastslam_widgets::(${others.join('|')})::`)
  return (/** @type {string} */ name) => names.test(name.replace(disambiguator, ''))
}

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

/**
 * The program, and for embeds one with each figure alone: what belongs to the others becomes traps, and what only they reached goes.
 * wasm-opt takes far longer than an incremental build: what it made of the same input is kept.
 */
async function optimise() {
  const input = readFileSync(wasm)
  const key = createHash('sha256')
  for (const file of [fileURLToPath(import.meta.url), join(root, 'node_modules', 'binaryen', 'package.json')]) key.update(readFileSync(file))
  const kept = cache('wasm-opt', key.update(input).digest('hex'))
  if (!existsSync(kept)) {
    const part = cache('wasm-opt', 'part')
    rmSync(cache('wasm-opt'), { recursive: true, force: true })
    mkdirSync(part, { recursive: true })
    const named = join(part, 'named')
    writeFileSync(named, await withTraps(input, neverRun, 5))
    await run(npmBin('wasm-opt'), [...optimiser, '--debuginfo', named, '-o', named])
    await run(npmBin('wasm-opt'), [...features, '--strip-debug', named, '-o', join(part, 'all')])
    for (const { tag, module } of figures) {
      writeFileSync(join(part, tag), await withTraps(readFileSync(named), ofOthers(module), 50))
      await run(npmBin('wasm-opt'), [...features, ...sweep, join(part, tag), '-o', join(part, tag)])
    }
    renameSync(part, kept)
  }
  copyFileSync(join(kept, 'all'), wasm)
  for (const { tag } of figures) copyFileSync(join(kept, tag), figureWasm(tag))
  return `${kilobytes(input.length)} → ${kilobytes(statSync(wasm).size)}`
}

/** @param {number} bytes */
export const kilobytes = bytes => `${(bytes / 1000).toFixed(1)} KB`

if (isMain(import.meta)) await main(build)
