// npm run size: what a reader's first view of the page transfers, as our server sends it to Chromium (Brotli). Fails over 200 KB.
import { existsSync, readdirSync } from 'node:fs'
import { join } from 'node:path'
import { build, dist, kilobytes } from './build.mjs'
import { isMain, main, say, step, StepError } from './lib.mjs'
import { startServer } from './serve.mjs'
import { launchChromium } from './browser.mjs'

const target = 150_000
const limit = 200_000
/** What one figure may cost that is embedded, nothing cached: its page for frames with all that it loads. */
const embedLimit = 110_000

/** The same for each figure's page for frames. */
export async function checkEmbedSizes() {
  const pages = readdirSync(dist).filter(file => /^embed-.*\.html$/.test(file))
  const sizes = []
  for (const page of pages) {
    const loaded = (await transferred(page)).filter(({ status }) => status === 200)
    if (!loaded.some(({ path }) => path.endsWith('.wasm'))) throw new StepError(`${page} did not load its WebAssembly.`)
    sizes.push({ page, sent: loaded.reduce((bytes, { sent }) => bytes + sent, 0) })
  }
  for (const { page, sent } of sizes) say(`${kilobytes(sent).padStart(12)}  ${page}`)
  const heaviest = Math.max(...sizes.map(({ sent }) => sent))
  const result = `${kilobytes(heaviest)} at most, of ${kilobytes(embedLimit)}`
  if (sizes.length === 0 || heaviest > embedLimit) throw new StepError(`A figure's page for frames is too heavy: ${result}.`)
  return result
}

/** Loads the page, reads it to its end, and adds up the answers of the server. */
export async function checkSize() {
  return report(await transferred(''))
}

/** What the server answers for a page that is read to its end. @param {string} path */
async function transferred(path) {
  /** @type {import('./serve.mjs').Served[]} */
  const answers = []
  const server = await startServer({ folder: dist, onServed: served => answers.push(served) })
  const browser = await launchChromium()
  try {
    const page = await browser.newPage({ viewport: { width: 1280, height: 800 } })
    const quiet = watchRequests(page)
    await page.goto(server.url + path)
    await quiet()
    // Figures and pictures further down are loaded when they are seen: a reader who reads on loads those too.
    const end = await page.evaluate(() => document.documentElement.scrollHeight)
    for (let y = 0; y < end; y += 400) {
      await page.evaluate(top => scrollTo({ top, behavior: 'instant' }), y)
      await quiet()
    }
  } finally {
    await browser.close()
    await server.close()
  }
  return answers
}

/** Waits until no request has been open for a while. @param {import('@playwright/test').Page} page */
function watchRequests(page) {
  const open = new Set()
  let last = performance.now()
  page.on('request', request => open.add(request))
  for (const event of /** @type {const} */ (['requestfinished', 'requestfailed'])) {
    page.on(/** @type {'requestfinished'} */ (event), request => {
      open.delete(request)
      last = performance.now()
    })
  }
  return async () => {
    const asked = performance.now()
    while (open.size > 0 || performance.now() - Math.max(last, asked) < 500) await page.waitForTimeout(50)
  }
}

/** @param {import('./serve.mjs').Served[]} answers */
function report(answers) {
  const loaded = answers.filter(({ status }) => status === 200).sort((a, b) => b.sent - a.sent)
  if (!loaded.some(({ path }) => path.endsWith('.wasm'))) throw new StepError('The page did not load its WebAssembly: what was measured is not the page.')
  const sum = (/** @type {'raw' | 'sent'} */ key) => loaded.reduce((bytes, answer) => bytes + answer[key], 0)
  const rows = [...loaded.map(({ path, raw, sent }) => [path, raw, sent]), ['all', sum('raw'), sum('sent')]]
  say(`${'transferred'.padStart(12)}${'raw'.padStart(12)}`)
  for (const [path, raw, sent] of rows) say(`${kilobytes(Number(sent)).padStart(12)}${kilobytes(Number(raw)).padStart(12)}  ${path}`)
  const result = `${kilobytes(sum('sent'))} of at most ${kilobytes(limit)}, the target being ${kilobytes(target)}`
  if (sum('sent') > limit) throw new StepError(`The page is too heavy: ${result}.`)
  return result
}

if (isMain(import.meta)) {
  await main(async () => {
    if (!existsSync(join(dist, 'index.html'))) await build()
    await step('Size of the page', checkSize)
    await step('Size of an embedded figure', checkEmbedSizes)
  })
}
