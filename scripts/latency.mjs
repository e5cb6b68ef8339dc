// How long a reader waits: from one event of a slider, at the last step, until the figure shows that step by the new value. Part of `npm run
// bench`; by itself, of the pages as they were built last: node scripts/latency.mjs
import { join } from 'node:path'
import { launchChromium } from './browser.mjs'
import { dist } from './build.mjs'
import { isMain, main, root, say } from './lib.mjs'
import { startServer } from './serve.mjs'

/** @typedef {{ what: string, tag: string, attributes: Record<string, string>, slider: string, values: [string, string], atMost: number, file?: string }} Drag */

/** Of each figure the slider that changes most of it; `values` are moved between, and `atMost` is in ms. @type {Drag[]} */
const DRAGS = [
  { what: 'lap, M = 16', tag: 'fastslam-lap', attributes: { course: 'apartment', 'range-std': '0.02', overlay: 'off', universes: '16', step: '90' }, slider: 'odometry', values: ['1.05', '1'], atMost: 150 },
  { what: 'lap, M = 64', tag: 'fastslam-lap', attributes: { course: 'apartment', 'range-std': '0.02', overlay: 'off', universes: '64', step: '90' }, slider: 'odometry', values: ['1.05', '1'], atMost: 600 },
  { what: 'resampling, M = 64', tag: 'fastslam-resampling', attributes: { particles: '64', step: '90' }, slider: 'odometry', values: ['1.05', '1'], atMost: 1500 },
  { what: 'proposals', tag: 'fastslam-proposal', attributes: {}, slider: 'range-std', values: ['0.15', '0.1'], atMost: 32 },
  { what: 'graphical model', tag: 'fastslam-conditioning', attributes: { step: '999' }, slider: 'odometry', values: ['1.05', '1'], atMost: 32 },
  { what: 'worked example', tag: 'fastslam-worked-example', attributes: {}, slider: 'range-std', values: ['0.15', '0.1'], atMost: 32 },
  { what: 'doors', tag: 'fastslam-doors', attributes: {}, slider: 'ride', values: ['4.5', '4'], atMost: 32 },
  { what: 'sampled map, N', tag: 'fastslam-joint', attributes: {}, slider: 'landmarks', values: ['9', '10'], atMost: 32 },
  { what: 'sampled map, sensor', tag: 'fastslam-joint', attributes: {}, slider: 'sensor', values: ['1.05', '1'], atMost: 32 },
  { what: 'pose graph, another false edge', tag: 'fastslam-graph', attributes: { wrong: 'on', step: '60' }, slider: 'wrong-to', values: ['53', '52'], atMost: 150 },
  { what: 'pose graph, wheels', tag: 'fastslam-graph', attributes: { step: '60' }, slider: 'odometry', values: ['0.55', '0.5'], atMost: 1500 },
  { what: 'EM mapping', tag: 'fastslam-em', attributes: {}, slider: 'odometry', values: ['0.06', '0.05'], atMost: 150 },
  { what: 'smoothing, step looked at', tag: 'fastslam-smoothing', attributes: {}, slider: 'at', values: ['13', '12'], atMost: 32 },
  { what: 'smoothing, M = 16', tag: 'fastslam-smoothing', attributes: {}, slider: 'odometry', values: ['1.05', '1'], atMost: 600 },
  { what: 'universes', tag: 'fastslam-universes', attributes: {}, slider: 'threshold', values: ['0.3', '0.4'], atMost: 32 },
  { what: 'log, before it is mapped', tag: 'fastslam-log', attributes: {}, slider: 'universes', values: ['20', '16'], atMost: 32, file: join(root, 'www', 'public', 'example.clf.gz') },
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

/** Runs in the page: the times of all events [ms]. @param {Drag & { events: number }} drag */
async function timeDrag({ slider, values, events }) {
  const figure = /** @type {any} */ (document.body.firstElementChild)
  // A parameter without a slider has a box alone.
  const find = (/** @type {string} */ type) => figure.shadowRoot.querySelector(`input${type}[name=${slider}]`)
  while (!find('') || find('').disabled) await new Promise(done => setTimeout(done, 50))
  const range = /** @type {HTMLInputElement} */ (find('[type=range]') ?? find(''))
  const moves = range.type === 'range' ? 'input' : 'change'
  await figure.settled()
  const times = []
  for (let event = -2; event < events; event++) {
    const settled = new Promise(done => figure.addEventListener('fastslam-change', done, { once: true }))
    range.value = /** @type {string} */ (values[event & 1])
    const from = performance.now()
    range.dispatchEvent(new Event(moves, { bubbles: true, composed: true }))
    await settled
    if (event >= 0) times.push(performance.now() - from)
    await figure.settled()
  }
  return times
}

/** The median and the worst of each [ms]. */
export async function latencies() {
  const server = await startServer({ folder: dist })
  const browser = await launchChromium()
  try {
    const page = await browser.newPage({ viewport: { width: WIDTH, height: HEIGHT } })
    await page.route('**/bench', route => route.fulfill({ contentType: 'text/html', body: '<!doctype html><title>bench</title>' }))
    const found = []
    for (const drag of DRAGS) {
      await page.goto(`${server.url}bench`)
      await page.evaluate(show, drag)
      if (drag.file) await page.locator('input[type=file]').setInputFiles(drag.file)
      const times = (await page.evaluate(timeDrag, { ...drag, events: EVENTS })).sort((a, b) => a - b)
      found.push({ what: drag.what, atMost: drag.atMost, median: times[times.length >> 1] ?? NaN, worst: times[times.length - 1] ?? NaN })
    }
    return found
  } finally {
    await browser.close()
    await server.close()
  }
}

if (isMain(import.meta)) {
  await main(async () => {
    for (const { what, atMost, median, worst } of await latencies())
      say(`  ${median.toFixed(0).padStart(6)} ms, at the worst ${worst.toFixed(0)} ms, of ${atMost} ms: ${what}`)
  })
}
