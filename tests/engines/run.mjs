// Units of breadth: in another engine every figure says, counts and paints what it does in Chromium, which other tests hold to the native build.
//   node tests/engines/run.mjs firefox      Firefox ESR, by geckodriver
//   node tests/engines/run.mjs webkit       WebKitGTK, by WebKitWebDriver
// Of the site as it was built last. The last line is the total, as that of npm test; where an engine cannot be installed it is skipped.
import { cpSync, existsSync, rmSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import { dist } from '../../scripts/build.mjs'
import { cache, main, step, StepError } from '../../scripts/lib.mjs'
import { startServer } from '../../scripts/serve.mjs'
import { differences, PARTS } from './differences.mjs'
import { CHROMIUM, ENGINES } from './engines.mjs'
import { find, focus, look, paintIn, show } from './page.mjs'
import { HANDLED, LOG, STATES } from './states.mjs'
import { Browser, KEYS } from './webdriver.mjs'

/** @typedef {import('./page.mjs').Seen} Seen @typedef {import('./states.mjs').Attributes} Attributes @typedef {import('./engines.mjs').Engine} Engine */

const VIEWPORT = { width: 1000, height: 900 } // [css px]

const total = { passed: 0, failed: 0, skipped: 0 }

/** A test, whose failure does not keep the next ones from running. @param {string} title @param {() => unknown} action */
async function test(title, action) {
  try {
    await step(title, action)
    total.passed++
  } catch {
    total.failed++ // the step has told why
  }
}

/** Puts a figure into the page of a browser, and looks at it. @param {Browser} browser @param {string} tag @param {Attributes} attributes */
async function showIn(browser, tag, attributes) {
  await browser.run(show, tag, attributes, tag === LOG)
  return browser.run(look)
}

/** @param {Seen} expected @param {Seen} found */
function expectSame(expected, found) {
  if (!expected.sentence || new Set(expected.rows).size < 2) throw new StepError('Chromium itself shows nothing that could be compared.')
  const told = differences(expected, found).map(({ told }) => told)
  if (told.length > 0) throw new StepError(told.join('\n'))
}

/** What a reader does, after each of which another number is shown. @type {((browser: Browser) => Promise<void>)[]} */
const HANDS = [
  async browser => browser.dragToEnd(await browser.run(find, HANDLED.slider)),
  async browser => browser.press(KEYS.left), // on the slider, which has the focus now
  async browser => {
    await browser.run(focus, '.stage')
    await browser.press(KEYS.right)
  },
]

/** All tests of an engine. @param {Browser} chromium @param {Browser} other */
async function compare(chromium, other) {
  /** @param {(browser: Browser) => Promise<Seen>} action */
  const inBoth = action => Promise.all([action(chromium), action(other)])

  for (const [tag, { attributes, changed }] of Object.entries(STATES)) {
    /** The light one in Chromium. @type {Seen | undefined} */
    let expected
    await test(`${tag} is the same as in Chromium, dark and light`, async () => {
      const dark = await inBoth(browser => showIn(browser, tag, { ...attributes, theme: 'dark' }))
      expectSame(...dark)
      const light = await inBoth(async browser => {
        await browser.run(paintIn, 'light')
        return browser.run(look)
      })
      expectSame(...light)
      if (differences(dark[0], light[0]).every(({ part }) => part !== 'picture')) throw new StepError('In both, the light picture is the dark one.')
      expected = light[0]
    })
    await test(`${tag} in another state is told apart`, async () => {
      if (!expected) throw new StepError('There is nothing to tell it apart from: see above.')
      const apart = differences(expected, await showIn(other, tag, { ...attributes, ...changed, theme: 'light' })).map(({ part }) => part)
      const alike = PARTS.filter(part => !apart.includes(part))
      if (alike.length > 0) throw new StepError(`Nothing is said of its ${alike.join(', ')}.`)
    })
  }
  await test(`${HANDLED.tag} follows a slider and keys as in Chromium`, async () => {
    const start = (/** @type {Browser} */ browser) => showIn(browser, HANDLED.tag, HANDLED.attributes)
    let [before] = await inBoth(start)
    for (const act of HANDS) {
      const [seen, found] = await inBoth(async browser => {
        await act(browser)
        return browser.run(look)
      })
      expectSame(seen, found)
      if (!differences(before, seen).some(({ part }) => part === 'readouts')) throw new StepError('In both, no readout has changed.')
      before = seen
    }
  })
}

/** Whether the engine is there, or could be installed. @param {Engine} engine */
async function installed({ title, install, takes }) {
  let there = true
  await step(`${title} and its driver`, () =>
    install().catch(() => {
      there = false
      return `skipped: ${title} cannot be installed here, so nothing is compared with it. It takes ${takes}.`
    }),
  )
  return there
}

/** The site with one page more: it has room for a figure as wide as the chapter’s text, and nothing else. @param {string} folder */
function layPage(folder) {
  if (!existsSync(join(dist, 'index.html'))) throw new StepError('There is no site to compare.', 'npm run build writes it.')
  rmSync(folder, { recursive: true, force: true })
  cpSync(dist, folder, { recursive: true })
  writeFileSync(join(folder, 'figure.css'), 'main { width: 832px; margin: auto }')
  const head = '<meta charset="utf-8"><title>A figure</title><link rel="stylesheet" href="figure.css"><script type="module" src="fastslam.js"></script>'
  writeFileSync(join(folder, 'figure.html'), `<!doctype html><html lang="en"><head>${head}</head><body><main></main></body></html>`)
}

/** @param {Engine} engine @param {string} folder */
async function compareIn(engine, folder) {
  layPage(folder)
  const server = await startServer({ folder })
  /** @type {Browser[]} */
  const browsers = []
  try {
    await step('Both browsers', async () => {
      for (const { title, driver } of [CHROMIUM, engine]) {
        const browser = await Browser.start(title, driver())
        browsers.push(browser)
        await browser.open(`${server.url}figure.html`, VIEWPORT)
      }
      return browsers.map(({ name }) => name).join(', ')
    })
    const [chromium, other] = browsers
    if (chromium && other) await compare(chromium, other)
  } finally {
    for (const browser of browsers) await browser.close()
    await server.close()
  }
}

await main(async () => {
  // What has been started ends with this process, also where that is ended.
  for (const signal of ['SIGINT', 'SIGTERM']) process.once(signal, () => process.exit(1))
  const name = process.argv[2] ?? ''
  const engine = ENGINES[name]
  if (!engine) throw new StepError('Which engine?', `node tests/engines/run.mjs ${Object.keys(ENGINES).join('|')}`)
  try {
    await step('Chromium and its driver', CHROMIUM.install)
    if (await installed(engine)) await compareIn(engine, cache('engines', name))
    else total.skipped++
  } catch (error) {
    total.failed++
    throw error
  } finally {
    if (total.failed > 0) process.exitCode = 1
    console.log(`${total.passed} passed, ${total.failed} failed, ${total.skipped} skipped`)
  }
})
