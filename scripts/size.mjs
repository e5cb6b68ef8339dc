// npm run size: what a reader's first view of the page transfers, as our server sends it to Chromium (Brotli). Fails over 200 KB.
// And the programs with one figure each, which the page does not load.
import { existsSync, readdirSync, readFileSync } from 'node:fs'
import { join } from 'node:path'
import { brotliCompressSync } from 'node:zlib'
import { build, dist, kilobytes } from './build.mjs'
import { bold, isMain, main, say, step, StepError } from './lib.mjs'
import { startServer } from './serve.mjs'
import { launchChromium } from './browser.mjs'

const target = 150_000
const limit = 200_000

/** Loads the page, reads it to its end, and adds up the answers of the server. */
export async function checkSize() {
  /** @type {import('./serve.mjs').Served[]} */
  const answers = []
  const server = await startServer({ folder: dist, onServed: served => answers.push(served) })
  const browser = await launchChromium()
  try {
    const page = await browser.newPage({ viewport: { width: 1280, height: 800 } })
    const quiet = watchRequests(page)
    await page.goto(server.url)
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
  return report(answers)
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
  say(bold('\n  Programs with one figure each, for embeds'))
  for (const file of readdirSync(dist).filter(name => name.endsWith('.wasm') && !loaded.some(({ path }) => path.endsWith(name)))) {
    const program = readFileSync(join(dist, file))
    say(`${kilobytes(brotliCompressSync(program).length).padStart(12)}${kilobytes(program.length).padStart(12)}  /${file}`)
  }
  const result = `${kilobytes(sum('sent'))} of at most ${kilobytes(limit)}, the target being ${kilobytes(target)}`
  if (sum('sent') > limit) throw new StepError(`The page is too heavy: ${result}.`)
  return result
}

if (isMain(import.meta)) {
  await main(async () => {
    if (!existsSync(join(dist, 'index.html'))) await build()
    await step('Size of the page', checkSize)
  })
}
