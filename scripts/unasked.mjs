// What no paint of ours asks of tiny-skia, left out of programs. Its pipelines call one function for each stage (a blend mode, a gradient, a
// colour space …), by its number in a table, and its strokes take any kind of curve: no optimiser can tell what is never called, 110 KB of each.
// So it is with what the figure of a program never asks of a filter. And what the machine has an instruction for is no longer computed.
import { StepError } from './lib.mjs'

/**
 * Stages of a plain colour over what is there, without a mask: all that a paint of the kit is. Each is there in the pipeline of whole
 * numbers; the other one, of floats, is for gradients, pictures and other colour spaces.
 */
const asked = ['uniform_color', 'load_dst', 'load_dst_tail', 'store', 'store_tail', 'source_over', 'source_over_rgba', 'source_over_rgba_tail', 'scale_1_float', 'scale_u8', 'lerp_1_float', 'lerp_u8']

/** What walks over a picture, stage after stage, and the end of each walk. */
const walk = ['start', 'just_return']

/** What else is never reached. */
const unasked = [
  /^tiny_skia::shaders::.*gradient/i,
  // All strokes have smooth edges; those that are hairlines end where their lines end,
  /^tiny_skia::scan::hairline::(hair_line_rgn|extend_pts)\b/,
  // and all are of straight lines: discs and letters, which have curves, are filled.
  /^tiny_skia::scan::hairline::hair_(quad|cubic)/,
  /^tiny_skia_path::(stroker|dash)::.*(quad|cubic)_/,
  /^tiny_skia_path::path_geometry::find_cubic_max_curvature\b/,
]

/** What a program's figure never asks for: the landmarks of the smoother have names. @type {Record<string, RegExp[]>} */
const unaskedOf = { smoothing: [/^fastslam::map::landmarks::association::Associated::by_likelihood\b/] }

/**
 * What the crate libm computes bit by bit, as stable Rust gives it no access to the instruction that WebAssembly has. IEEE 754 leaves no bit of
 * it open. @type {Record<string, 'sqrt' | 'floor' | 'ceil' | 'trunc'>}
 */
const instructions = { sqrt: 'sqrt', sqrtf: 'sqrt', floor: 'floor', floorf: 'floor', ceil: 'ceil', ceilf: 'ceil', trunc: 'trunc', truncf: 'trunc' }

/**
 * A program with empty functions in the place of those: one that is called all the same stops it there, as a panic does. Its functions
 * still bear the names that Rust gave them; of what comes out they do not.
 * @param {Uint8Array} bytes @param {string} [program] its name
 */
export async function withoutUnasked(bytes, program = '') {
  const { default: binaryen } = await import('binaryen')
  const module = binaryen.readBinary(bytes)
  const functions = Array.from({ length: module.getNumFunctions() }, (_, at) => binaryen.getFunctionInfo(module.getFunctionByIndex(at)))
  const stages = functions.flatMap(of => {
    const [, pipeline, stage = ''] = /^tiny_skia::pipeline::(lowp|highp)::(\w+)::h[0-9a-f]+$/.exec(of.name) ?? []
    return pipeline && !walk.includes(stage) ? [{ ...of, stage, kept: pipeline === 'lowp' && asked.includes(stage) }] : []
  })
  const missing = asked.filter(name => !stages.some(({ stage, kept }) => kept && stage === name))
  if (stages.length > 0 && missing.length > 0) throw new StepError(`tiny-skia has no stage named ${missing.join(', ')} any more.`, 'scripts/unasked.mjs lists those that paints ask for.')
  const own = unaskedOf[program] ?? []
  const absent = own.filter(one => !functions.some(({ name }) => one.test(name)))
  if (absent.length > 0) throw new StepError(`The program ${program} has no function like ${absent.join(', ')} any more.`, 'scripts/unasked.mjs lists those that it never calls.')
  const left = functions.filter(({ name }) => [...unasked, ...own].some(one => one.test(name)))
  for (const { name, params, results } of [...stages.filter(({ kept }) => !kept), ...left]) {
    module.removeFunction(name)
    module.addFunction(name, params, results, [], module.unreachable())
  }
  for (const { name, params, results } of functions) {
    const instruction = instructions[/^libm::math::\w+::(\w+)::h[0-9a-f]+$/.exec(name)?.[1] ?? '']
    if (!instruction) continue
    const of = params === binaryen.f64 ? module.f64 : module.f32
    module.removeFunction(name)
    module.addFunction(name, params, results, [], of[instruction](module.local.get(0, params)))
  }
  const without = module.emitBinary()
  module.dispose()
  return without
}
