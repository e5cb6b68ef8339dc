// What a paint never asks of tiny-skia is left out of programs, by the names of functions; all else stays.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import binaryen from 'binaryen'
import { withoutUnasked } from '../../scripts/unasked.mjs'

const kept = ['uniform_color', 'load_dst', 'load_dst_tail', 'store', 'store_tail', 'source_over', 'source_over_rgba', 'source_over_rgba_tail', 'scale_1_float', 'scale_u8', 'lerp_1_float', 'lerp_u8', 'start', 'just_return'].map(stage => `lowp::${stage}`)
const others = ['lowp::hue', 'lowp::load_dst_u8', 'highp::source_over', 'highp::gradient']

/** With their crate. */
const never = ['tiny_skia::shaders::radial_gradient::RadialGradient::push_stages::{{closure}}::h01', 'tiny_skia::scan::hairline::hair_line_rgn::h02', 'tiny_skia::scan::hairline::hair_cubic2::h03', 'tiny_skia_path::stroker::PathStroker::cubic_stroke::h04', 'tiny_skia::scan::hairline::hair_quad::h20', 'tiny_skia::scan::hairline::extend_pts::h21', 'tiny_skia_path::dash::ContourMeasure::compute_quad_segs::h22', 'tiny_skia_path::path_geometry::find_cubic_max_curvature::h23']
const always = ['tiny_skia::scan::hairline_aa::anti_hair_line_rgn::h05', 'tiny_skia_path::path_geometry::chop_cubic_at2::h06', 'tiny_skia::scan::hairline::stroke_path_impl::h07', 'fastslam::lowp::hue::h08', 'tiny_skia::edge_builder::BasicEdgeBuilder::push_quad::h24']

/** What the smoother's program never calls, and others do. */
const byLikelihood = 'fastslam::map::landmarks::association::Associated::by_likelihood::h25'

/** A program of functions of these names, and of those beside them; each answers 7, and is exported by its place. @param {string[]} stages */
function program(stages) {
  const module = new binaryen.Module()
  const names = [...stages.map((stage, at) => `tiny_skia::pipeline::${stage}::h${(at + 10).toString(16)}`), ...never, ...always, byLikelihood]
  for (const [at, name] of names.entries()) {
    module.addFunction(name, binaryen.none, binaryen.i32, [], module.i32.const(7))
    module.addFunctionExport(name, `f${at}`)
  }
  binaryen.setDebugInfo(true)
  return module.emitBinary()
}

/** What libm computes, by a function that does not, and the same of another crate. */
const computed = ['libm::math::sqrt::sqrt::h30', 'libm::math::floor::floorf::h31', 'libm::math::exp::exp::h32', 'other::math::sqrt::sqrt::h33']

/** What each of these functions makes of 6.25. @param {(bytes: Uint8Array) => Promise<Uint8Array> | Uint8Array} through */
async function roots(through) {
  const module = new binaryen.Module()
  for (const [at, name] of computed.entries()) {
    const single = name.includes('floorf')
    const type = single ? binaryen.f32 : binaryen.f64
    module.addFunction(name, type, type, [], single ? module.f32.const(7) : module.f64.const(7))
    module.addFunctionExport(name, `f${at}`)
  }
  binaryen.setDebugInfo(true)
  const { exports } = new WebAssembly.Instance(new WebAssembly.Module(/** @type {BufferSource} */ (await through(module.emitBinary()))))
  return computed.map((_, at) => /** @type {(x: number) => number} */ (exports[`f${at}`])(6.25))
}

test('of libm, what WebAssembly has an instruction for is that instruction, and all else stays', async () => {
  assert.deepEqual(await roots(bytes => bytes), [7, 7, 7, 7])
  assert.deepEqual(await roots(withoutUnasked), [2.5, 6, 7, 7])
})

/** Which functions still answer. @param {Uint8Array} bytes */
function answering(bytes) {
  const { exports } = new WebAssembly.Instance(new WebAssembly.Module(new Uint8Array(bytes)))
  return Object.entries(exports).map(([, answer]) => {
    try {
      return /** @type {() => number} */ (answer)() === 7
    } catch (error) {
      assert.match(String(error), /unreachable/)
      return false
    }
  })
}

/** Which of the functions beside the stages answer in every program. */
const answer = [...never.map(() => false), ...always.map(() => true)]

test('stages that no paint asks for stop the program, and what is not one of them answers', async () => {
  const none = [...answer, true]
  assert.deepEqual(answering(await withoutUnasked(program([...kept, ...others]))), [...kept.map(() => true), ...others.map(() => false), ...none])
  assert.deepEqual(answering(await withoutUnasked(program([]))), none)
})

test('a stage that is asked for and is not there any more stops the build', async () => {
  await assert.rejects(withoutUnasked(program(kept.slice(1))), /no stage named uniform_color any more/)
})

test('what the figure of one program never asks of a filter is left out of that program alone, and stops its build where it is not there', async () => {
  assert.deepEqual(answering(await withoutUnasked(program([]), 'smoothing')), [...answer, false])
  assert.deepEqual(answering(await withoutUnasked(program([]), 'doors')), [...answer, true])
  await assert.rejects(withoutUnasked(new binaryen.Module().emitBinary(), 'smoothing'), /smoothing has no function like .*by_likelihood/)
})
