// Builds the chapter: the widgets to WebAssembly (widgets/pkg), then the pages around them (dist).
import { createHash } from 'node:crypto'
import { copyFileSync, existsSync, mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import { writeNames } from './elements.mjs'
import { writeFrames } from './frames.mjs'
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

/**
 * tiny-skia keeps the stages of every paint it knows in tables, so no linker can tell that gradients, blend modes, filters and masks are
 * never run: a fifth of the page. Our one painter (widgets/src/paint) fills paths with opaque colours, which takes these few.
 * The others become traps; tests/e2e/pixels.spec.ts holds what is left against every golden picture.
 */
const painted = new Set([
  'start',
  'just_return',
  'uniform_color',
  'seed_shader',
  'load_dst',
  'load_dst_tail',
  'store',
  'store_tail',
  'lerp_1_float',
  'lerp_u8',
  'scale_1_float',
  'scale_u8',
  'source_over',
  'source_over_rgba',
  'source_over_rgba_tail',
])

/** Is a function, by its name in Rust, one that no figure paints with? @param {string} name */
function neverPainted(name) {
  const stage = /^tiny_skia::pipeline::(lowp|highp)::(\w+)(::h[0-9a-f]{16})?$/.exec(name)
  if (stage) return stage[1] === 'highp' || !painted.has(stage[2] ?? '')
  // Shaders that are no plain colour; and strokes along curves, as only straight lines are stroked.
  return /^tiny_skia::shaders::\w*(gradient|pattern)|^tiny_skia_path::stroker::PathStroker::(cubic|quad|conic)/.test(name)
}

/** The module without the bodies of what is never painted. @param {Buffer} input */
async function withoutNeverPainted(input) {
  const { default: binaryen } = await import('binaryen')
  const module = binaryen.readBinary(input)
  const { SIMD128, BulkMemory, BulkMemoryOpt, NontrappingFPToInt, SignExt, MutableGlobals, Multivalue, ReferenceTypes } = binaryen.Features
  module.setFeatures(SIMD128 | BulkMemory | BulkMemoryOpt | NontrappingFPToInt | SignExt | MutableGlobals | Multivalue | ReferenceTypes)
  const functions = Array.from({ length: module.getNumFunctions() }, (_, i) => binaryen.getFunctionInfo(module.getFunctionByIndex(i)))
  const traps = functions.filter(({ name }) => neverPainted(name))
  if (traps.length < 50) throw new StepError(`Only ${traps.length} stages of tiny-skia were found by name: has it been renamed?`)
  for (const { name, params, results } of traps) {
    module.removeFunction(name)
    module.addFunction(name, params, results, [], module.unreachable())
  }
  const output = module.emitBinary()
  module.dispose()
  return output
}

export async function buildWasm() {
  await step('Widgets to WebAssembly', () => run('wasm-pack', ['build', 'widgets', '--target', 'web', '--release', '--no-pack']))
  await step('Optimise WebAssembly', optimise)
  await step('Names of the figures', writeNames)
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
  await buildPages()
}

/** wasm-opt takes far longer than an incremental build: what it made of the same input is kept. */
async function optimise() {
  const input = readFileSync(wasm)
  const binaryen = readFileSync(join(root, 'node_modules', 'binaryen', 'package.json'))
  const key = createHash('sha256').update(input).update(binaryen).update(optimiser.join()).update([...painted].join()).update(String(neverPainted)).digest('hex')
  const kept = cache('wasm-opt', `${key}.wasm`)
  if (!existsSync(kept)) {
    rmSync(cache('wasm-opt'), { recursive: true, force: true })
    mkdirSync(cache('wasm-opt'), { recursive: true })
    const part = `${kept}.part`
    writeFileSync(part, await withoutNeverPainted(input))
    await run(npmBin('wasm-opt'), [...optimiser, part, '-o', part])
    copyFileSync(part, kept)
    rmSync(part)
  }
  copyFileSync(kept, wasm)
  return `${kilobytes(input.length)} → ${kilobytes(statSync(wasm).size)}`
}

/** @param {number} bytes */
export const kilobytes = bytes => `${(bytes / 1000).toFixed(1)} KB`

if (isMain(import.meta)) await main(build)
