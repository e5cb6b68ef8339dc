// A first visit to the chapter on a laptop, as pictures: node scripts/visit.mjs, of the pages as they were built last. From the title to the
// end of the first section, at the pace of somebody who reads all of it and stays with a picture as long as it moves, it takes a picture
// every second into .cache/visit, and sheets of thirty of them to be looked at. It says what moved while too little of it was in sight.
import { mkdirSync, rmSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import { launchChromium, withSite } from './browser.mjs'
import { dist } from './build.mjs'
import { cache, isMain, main, say, StepError } from './lib.mjs'

const LAPTOP = { width: 1366, height: 650 }
const WORDS = 4 // read in a second
const SEEN = 0.6 // share of a picture that is to be in sight while it moves
const STAYS = 60 // with a picture that moves, at most [s]
const TITLE = 10 // with the title; longer, as long as nothing lives, up to [s]:
const LOADS = 40
const SHEET = { columns: 5, rows: 6 }

/** @typedef {{ name: string, step: string, playing: boolean, share: number }} Seen */

/** Runs in the page: where the first section ends [px], and how far down it is read in a second. @param {number} words */
function measure(words) {
  const [first, second] = /** @type {[HTMLElement, HTMLElement]} */ (/** @type {unknown} */ (document.querySelectorAll('main h2')))
  const [from, to] = [first, second].map(one => one.getBoundingClientRect().top + scrollY)
  const range = new Range()
  range.setStartBefore(first)
  range.setEndBefore(second)
  const all = range.toString().split(/\s+/).length
  return { end: Number(to), pace: ((Number(to) - Number(from)) / all) * words }
}

/** Runs in the page: the figures that live, and how much of each picture is in sight. @returns {Seen[]} */
function look() {
  const figures = [.../** @type {NodeListOf<HTMLElement & { playing: boolean }>} */ (document.querySelectorAll(':defined'))].filter(({ localName }) => localName.startsWith('fastslam-'))
  return figures.flatMap(figure => {
    const stage = figure.shadowRoot?.querySelector('.stage.live')
    if (!stage) return []
    const { top, bottom, height } = stage.getBoundingClientRect()
    const share = Math.max(0, Math.min(bottom, innerHeight) - Math.max(top, 0)) / height
    return [{ name: figure.localName, step: figure.shadowRoot?.querySelector('.timeline .position')?.textContent ?? '', playing: figure.playing, share }]
  })
}

/** Takes the pictures into a folder; how many, and what was wrong. @param {string} folder */
async function visit(folder) {
  return withSite({ folder: dist }, async ({ server, browser }) => {
    const page = await browser.newPage({ viewport: LAPTOP })
    await page.goto(server.url)
    const { end, pace } = await page.evaluate(measure, WORDS)
    const unseen = []
    let [second, stayed, lives] = [0, 0, false]
    for (const begun = performance.now(); ; second++) {
      await page.waitForTimeout(Math.max(0, begun + 1000 * second - performance.now()))
      await page.screenshot({ path: join(folder, `${String(second).padStart(3, '0')}.png`) })
      const seen = await page.evaluate(look)
      if (!lives && seen.length > 0) say(`  ${second} s: the first figure lives`)
      lives ||= seen.length > 0
      const moving = seen.filter(({ playing }) => playing)
      for (const { name, step, share } of moving) {
        say(`  ${second} s: ${name} plays, at ${step}, ${(100 * share).toFixed(0)} % in sight`)
        if (share < SEEN) unseen.push(`${name} at ${second} s`)
      }
      stayed = moving.some(({ share }) => share > 0.9) ? stayed + 1 : 0
      if (second < TITLE || (second < LOADS && seen.length === 0)) continue
      if (stayed > 0 && stayed < STAYS) continue
      const bottom = await page.evaluate(pace => {
        scrollBy({ top: pace, behavior: 'instant' })
        return scrollY + innerHeight
      }, pace)
      if (bottom >= end) return { pictures: second + 1, unseen }
    }
  })
}

/** Sheets of small pictures. @param {string} folder @param {number} pictures */
async function sheets(folder, pictures) {
  const browser = await launchChromium()
  const each = SHEET.columns * SHEET.rows
  try {
    const page = await browser.newPage({ viewport: { width: 1600, height: 1000 } })
    for (let sheet = 0; sheet * each < pictures; sheet++) {
      const names = Array.from({ length: Math.min(each, pictures - sheet * each) }, (_, k) => String(sheet * each + k).padStart(3, '0'))
      const cells = names.map(name => `<figure><img src="${name}.png"><figcaption>${name} s</figcaption></figure>`).join('')
      const style = `body{margin:4px;display:grid;grid-template-columns:repeat(${SHEET.columns},1fr);gap:4px;font:12px sans-serif}figure{margin:0}img{width:100%}`
      const file = join(folder, `sheet-${sheet}.html`)
      writeFileSync(file, `<!doctype html><title>Visit</title><style>${style}</style>${cells}`)
      await page.goto(`file://${file}`)
      await page.screenshot({ path: join(folder, `sheet-${sheet}.png`), fullPage: true })
    }
  } finally {
    await browser.close()
  }
}

if (isMain(import.meta)) {
  await main(async () => {
    const folder = cache('visit')
    rmSync(folder, { recursive: true, force: true })
    mkdirSync(folder, { recursive: true })
    const { pictures, unseen } = await visit(folder)
    await sheets(folder, pictures)
    say(`  ${pictures} pictures in ${folder}`)
    if (unseen.length > 0) throw new StepError(`Something moved while less than ${100 * SEEN} % of it was in sight: ${unseen.join(', ')}`)
  })
}
