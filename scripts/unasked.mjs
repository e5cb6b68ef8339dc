// What no paint of ours asks of tiny-skia, left out of programs. Its pipelines call one function for each stage (a blend mode, a gradient, a
// colour space …), by its number in a table, and its strokes take any kind of curve: no optimiser can tell what is never called, 100 KB of each.
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
  // All strokes have smooth edges,
  /^tiny_skia::scan::hairline::hair_line_rgn\b/,
  // and none is of a cubic curve: letters have these, which are filled.
  /^tiny_skia::scan::hairline::hair_cubic/,
  /^tiny_skia_path::(stroker|dash)::.*cubic_/,
]

/**
 * A program with empty functions in the place of those: one that is called all the same stops it there, as a panic does. Its functions
 * still bear the names that Rust gave them; of what comes out they do not.
 * @param {Uint8Array} program
 */
export async function withoutUnasked(program) {
  const { default: binaryen } = await import('binaryen')
  const module = binaryen.readBinary(program)
  const functions = Array.from({ length: module.getNumFunctions() }, (_, at) => binaryen.getFunctionInfo(module.getFunctionByIndex(at)))
  const stages = functions.flatMap(of => {
    const [, pipeline, stage = ''] = /^tiny_skia::pipeline::(lowp|highp)::(\w+)::h[0-9a-f]+$/.exec(of.name) ?? []
    return pipeline && !walk.includes(stage) ? [{ ...of, stage, kept: pipeline === 'lowp' && asked.includes(stage) }] : []
  })
  const missing = asked.filter(name => !stages.some(({ stage, kept }) => kept && stage === name))
  if (stages.length > 0 && missing.length > 0) throw new StepError(`tiny-skia has no stage named ${missing.join(', ')} any more.`, 'scripts/unasked.mjs lists those that paints ask for.')
  for (const { name, params, results } of [...stages.filter(({ kept }) => !kept), ...functions.filter(({ name }) => unasked.some(one => one.test(name)))]) {
    module.removeFunction(name)
    module.addFunction(name, params, results, [], module.unreachable())
  }
  const without = module.emitBinary()
  module.dispose()
  return without
}
