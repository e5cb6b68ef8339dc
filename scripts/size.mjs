// npm run size: what a reader of the whole chapter transfers, and what one embedded figure costs, as our server sends it to Chromium (Brotli).
// `-- --singles lap,em`: with programs for these figures alone, as making all of them takes minutes.
import { readdirSync } from 'node:fs'
import { build, dist, singlesAsked } from './build.mjs'
import { isMain, kilobytes, main, say, step, StepError } from './lib.mjs'
import { singlePrograms } from './registry.mjs'
import { judge, judgeAll } from './sizes.mjs'
import { withSite } from './browser.mjs'

/** What each figure's page for frames loads, nothing cached. */
export const checkEmbedSizes = () => serving(embedSizes)

/** @param {Transferred} transferred */
async function embedSizes(transferred) {
  const names = readdirSync(dist).flatMap(file => /^embed-(.*)\.html$/.exec(file)?.[1] ?? [])
  if (names.length === 0) throw new StepError('There are no pages for frames in dist/.')
  const missed = []
  for (const name of names) {
    // The figure that maps logs loads its program when it is asked for something, as whoever opens its page will do.
    const { read, asked } = await transferred(`embed-${name}.html`, (page, read) => (read.some(isProgram) ? undefined : page.locator('.stage').click()))
    const loaded = [...read, ...asked].filter(({ status }) => status === 200)
    const program = loaded.find(isProgram)
    if (!program) throw new StepError(`embed-${name}.html did not load its WebAssembly.`)
    const sent = loaded.reduce((bytes, { sent }) => bytes + sent, 0)
    // Where its own was not built, its frame works with the chapter's, which is weighed with the chapter.
    const own = program.path.startsWith(`/fastslam-${name}-`)
    const judged = own ? await judge(`embed.${name}`, sent) : `  embed.${name} ${kilobytes(sent)}, with the program of the chapter`
    say(`  ${judged}`)
    if (judged.includes('✗')) missed.push(name)
  }
  return missed.length > 0 ? `over their targets: ${missed.join(', ')}` : 'all within their targets'
}

/** Loads the page, reads it to its end, and adds up the answers of the server. */
export const checkSize = () => serving(pageSize)

/** @param {Transferred} transferred */
async function pageSize(transferred) {
  // The figure that maps logs is there, and works; its program comes when something is asked of it.
  const { read, asked } = await transferred('', page => page.locator('fastslam-log .stage').click())
  if (!asked.some(isProgram)) throw new StepError('The figure that maps logs did not load its WebAssembly.')
  const sent = asked.reduce((bytes, answer) => bytes + answer.sent, 0)
  return `${await report(read)}; whoever maps a log loads ${kilobytes(sent)} more`
}

const isProgram = (/** @type {Served} */ { path }) => path.endsWith('.wasm')
const isPoster = (/** @type {Served} */ { path }) => /-poster-[^/]*\.png$/.test(path)

/**
 * What the server answers for a page that is read to its end, and what it answers then to something that is asked of the page.
 * @typedef {import('./serve.mjs').Served} Served
 * @typedef {(page: import('@playwright/test').Page, read: Served[]) => Promise<void> | undefined} Ask
 * @typedef {(path: string, ask: Ask) => Promise<{ read: Served[], asked: Served[] }>} Transferred
 */

/**
 * One server for all that is measured. It has compressed the programs before anybody asks: a figure whose program is long in coming shows a
 * picture meanwhile, which would be counted as well.
 * @template T @param {(transferred: Transferred) => Promise<T>} measure
 */
async function serving(measure) {
  /** @type {Served[]} */
  const answers = []
  const take = () => answers.splice(0)
  const programs = readdirSync(dist).filter(file => file.endsWith('.wasm'))
  return withSite({ folder: dist, onServed: served => answers.push(served) }, async ({ server, browser }) => {
    await server.prepare(programs)
    return await measure(async (path, ask) => {
      take()
      // Of a context of its own, whose cache is empty.
      const page = await browser.newPage({ viewport: { width: 1280, height: 800 } })
      try {
        const { answered, quiet } = watchRequests(page)
        await page.goto(server.url + path)
        await quiet()
        // Figures and pictures further down are loaded when they are seen: a reader who reads on loads those too.
        const end = await page.evaluate(() => document.documentElement.scrollHeight)
        for (let y = 0; y < end; y += 800) {
          await page.evaluate(top => scrollTo({ top, behavior: 'instant' }), y)
          await answered()
        }
        await quiet()
        const read = take()
        await ask(page, read)
        await quiet()
        return { read, asked: take() }
      } finally {
        await page.close()
      }
    })
  })
}

/** Waits: until what has come into sight by now has been asked for and answered, or until no request has been open for a while. @param {import('@playwright/test').Page} page */
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
  const answered = async () => {
    await page.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done)))))
    while (open.size > 0) await page.waitForTimeout(20)
  }
  const quiet = async () => {
    const asked = performance.now()
    while (open.size > 0 || performance.now() - Math.max(last, asked) < 500) await page.waitForTimeout(50)
  }
  return { answered, quiet }
}

/** @param {import('./serve.mjs').Served[]} answers */
async function report(answers) {
  const loaded = answers.filter(({ status }) => status === 200).sort((a, b) => b.sent - a.sent)
  if (!loaded.some(isProgram)) throw new StepError('The page did not load its WebAssembly: what was measured is not the page.')
  const [posters, page] = [loaded.filter(isPoster), loaded.filter(answer => !isPoster(answer))]
  if (posters.length !== 1) throw new StepError(`${posters.length} posters were loaded: the figure of logs shows one.`)
  const sum = (/** @type {'raw' | 'sent'} */ key) => page.reduce((bytes, answer) => bytes + answer[key], 0)
  const rows = [...loaded.map(({ path, raw, sent }) => [path, raw, sent]), ['all but the poster', sum('raw'), sum('sent')]]
  say(`${'transferred'.padStart(12)}${'raw'.padStart(12)}`)
  for (const [path, raw, sent] of rows) say(`${kilobytes(Number(sent)).padStart(12)}${kilobytes(Number(raw)).padStart(12)}  ${path}`)
  const text = loaded.filter(({ path }) => path === '/' || path.endsWith('.css')).reduce((bytes, { sent }) => bytes + sent, 0)
  const poster = posters.reduce((bytes, { sent }) => bytes + sent, 0)
  const judged = await judgeAll([['chapter', sum('sent')], ['poster', poster], ['text', text]])
  return judged.join('; ')
}

if (isMain(import.meta)) {
  await main(async () => {
    await build(singlesAsked(singlePrograms))
    await step('Size of the page', checkSize)
    await step('Size of an embedded figure', checkEmbedSizes)
  })
}
