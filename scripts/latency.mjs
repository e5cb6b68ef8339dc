// How long a reader waits: from one event of a slider, at the last step, until the picture differs (by then it is what the controls tell, if
// not yet of all repeats), until all is computed that belongs to it, and back at the value before. Each event sets a value that was not there
// yet. Part of `npm run bench`; by itself, of the pages as they were built last: node scripts/latency.mjs
import { join } from 'node:path'
import { withSite } from './browser.mjs'
import { dist } from './build.mjs'
import { isMain, main, root, say } from './lib.mjs'

/** @typedef {{ what: string, tag: string, attributes: Record<string, string>, slider: string, from: number, by: number, atMost: number, file?: string }} Drag */

/** Of each figure the slider that changes most of it; it is moved `from` a value by a notch or two each time, and `atMost` is in ms. @type {Drag[]} */
export const DRAGS = [
  { what: 'lap, M = 16', tag: 'fastslam-lap', attributes: { course: 'apartment', 'range-std': '0.02', overlay: 'off', universes: '16', step: '90' }, slider: 'odometry', from: 1, by: 0.05, atMost: 100 },
  { what: 'lap, M = 64', tag: 'fastslam-lap', attributes: { course: 'apartment', 'range-std': '0.02', overlay: 'off', universes: '64', step: '90' }, slider: 'odometry', from: 1, by: 0.05, atMost: 400 },
  { what: 'resampling, M = 64', tag: 'fastslam-resampling', attributes: { particles: '64', step: '90' }, slider: 'odometry', from: 1, by: 0.05, atMost: 1000 },
  { what: 'proposals', tag: 'fastslam-proposal', attributes: {}, slider: 'range-std', from: 0.1, by: 0.01, atMost: 32 },
  { what: 'graphical model', tag: 'fastslam-conditioning', attributes: { step: '999' }, slider: 'odometry', from: 1, by: 0.05, atMost: 32 },
  { what: 'worked example', tag: 'fastslam-worked-example', attributes: {}, slider: 'range-std', from: 0.1, by: 0.01, atMost: 32 },
  { what: 'doors', tag: 'fastslam-doors', attributes: {}, slider: 'ride', from: 4, by: 0.25, atMost: 32 },
  { what: 'sampled map, N', tag: 'fastslam-joint', attributes: {}, slider: 'landmarks', from: 4, by: 1, atMost: 32 },
  { what: 'sampled map, sensor', tag: 'fastslam-joint', attributes: {}, slider: 'sensor', from: 1, by: 0.05, atMost: 150 },
  { what: 'pose graph, another false edge', tag: 'fastslam-graph', attributes: { wrong: 'on', step: '60' }, slider: 'wrong-to', from: 52, by: -1, atMost: 150 },
  { what: 'pose graph, wheels', tag: 'fastslam-graph', attributes: { step: '60' }, slider: 'odometry', from: 0.5, by: 0.05, atMost: 200 },
  { what: 'EM mapping', tag: 'fastslam-em', attributes: {}, slider: 'odometry', from: 0.05, by: 0.01, atMost: 150 },
  { what: 'smoothing, step looked at', tag: 'fastslam-smoothing', attributes: {}, slider: 'at', from: 12, by: 1, atMost: 32 },
  { what: 'smoothing, M = 16', tag: 'fastslam-smoothing', attributes: {}, slider: 'odometry', from: 1, by: 0.05, atMost: 200 },
  { what: 'universes', tag: 'fastslam-universes', attributes: {}, slider: 'threshold', from: 0.4, by: 0.01, atMost: 32 },
  { what: 'log, before it is mapped', tag: 'fastslam-log', attributes: {}, slider: 'universes', from: 16, by: 1, atMost: 32, file: join(root, 'www', 'public', 'example.clf.gz') },
]
const WIDTH = 1366
const HEIGHT = 650
const EVENTS = 6 // after two that warm up the compiler

/** Runs in the page: the figure, alone. @param {Drag} drag */
async function show({ tag, attributes }) {
  const module = '/fastslam.js'
  await import(module)
  await customElements.whenDefined(tag)
  const figure = document.createElement(tag)
  for (const [name, value] of Object.entries(attributes)) figure.setAttribute(name, value)
  document.body.replaceChildren(figure)
}

/**
 * Runs in the page: the times of all events [ms]. @param {Drag & { events: number }} drag
 * @returns {Promise<{ first: number[], settled: number[], back: number, longest: number }>} `longest` task of the page, of over 50 ms; else 0
 */
async function timeDrag({ slider, from, by, events }) {
  const figure = /** @type {any} */ (document.body.firstElementChild)
  // A parameter without a slider has a box alone.
  const find = (/** @type {string} */ type) => figure.shadowRoot.querySelector(`input${type}[name=${slider}]`)
  while (!find('') || find('').disabled) await new Promise(done => setTimeout(done, 50))
  const range = /** @type {HTMLInputElement} */ (find('[type=range]') ?? find(''))
  const moves = range.type === 'range' ? 'input' : 'change'
  await figure.settled()
  const tasks = [0]
  new PerformanceObserver(list => tasks.push(...list.getEntries().map(({ duration }) => duration))).observe({ type: 'longtask' })
  // Nothing is painted on the way to what was asked for, but what is already of it: the first painting that differs.
  let painted = () => {}
  const { putImageData } = CanvasRenderingContext2D.prototype
  CanvasRenderingContext2D.prototype.putImageData = function (/** @type {any[]} */ ...all) {
    Reflect.apply(putImageData, this, all)
    painted()
  }
  const move = async (/** @type {number} */ value) => {
    let first = NaN
    const started = performance.now()
    const settled = new Promise(done => figure.addEventListener('fastslam-change', () => done(performance.now() - started), { once: true }))
    painted = () => {
      if (Number.isNaN(first)) first = performance.now() - started
    }
    range.value = String(value)
    range.dispatchEvent(new Event(moves, { bubbles: true, composed: true }))
    const time = await settled
    await figure.settled()
    return { first, settled: time }
  }
  const times = { first: /** @type {number[]} */ ([]), settled: /** @type {number[]} */ ([]), back: NaN, longest: 0 }
  for (let event = -2; event < events; event++) {
    const { first, settled } = await move(from + (event + 3) * by)
    if (event < 0) continue
    times.first.push(first)
    times.settled.push(settled)
  }
  times.back = (await move(from + (events + 1) * by)).settled
  times.longest = Math.max(...tasks)
  return times
}

/** The medians, the worst, and the way back of each [ms]. */
export async function latencies() {
  return withSite({ folder: dist }, async ({ server, browser }) => {
    const page = await browser.newPage({ viewport: { width: WIDTH, height: HEIGHT } })
    await page.route('**/bench', route => route.fulfill({ contentType: 'text/html', body: '<!doctype html><title>bench</title>' }))
    const found = []
    for (const drag of DRAGS) {
      await page.goto(`${server.url}bench`)
      await page.evaluate(show, drag)
      if (drag.file) await page.locator('input[type=file]').setInputFiles(drag.file)
      const { first, settled, back, longest } = await page.evaluate(timeDrag, { ...drag, events: EVENTS })
      const median = (/** @type {number[]} */ times) => times.sort((a, b) => a - b)[times.length >> 1] ?? NaN
      found.push({ what: drag.what, atMost: drag.atMost, first: median(first), median: median(settled), worst: Math.max(...settled), back, longest })
    }
    return found
  })
}

if (isMain(import.meta)) {
  await main(async () => {
    for (const { what, atMost, first, median, worst, back, longest } of await latencies()) {
      const [another, settled, most, again] = [first, median, worst, back].map(time => time.toFixed(0).padStart(5))
      say(`  ${another} ms to another picture, ${settled} ms until it is settled (at the worst ${most}, of ${atMost}), ${again} ms back${longest > 0 ? `, a task of ${longest.toFixed(0)} ms` : ''}: ${what}`)
    }
  })
}
