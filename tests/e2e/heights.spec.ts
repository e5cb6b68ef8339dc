// Nothing moves when a figure comes to life: before, it keeps the place free that it will take.
// UPDATE_GOLDENS=1 measures that anew, into widgets/elements/heights.json.
import { readFileSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import type { Page } from '@playwright/test'
import { programs } from '../../scripts/registry.mjs'
import { root } from '../../scripts/lib.mjs'
import type { FigureElement } from '../../widgets/elements'
import { Figure, initSync } from '../../widgets/pkg/fastslam_widgets.js'
import { holdPrograms } from './figure'
import { expect, test } from './fixtures'
import { breadth } from './host'

const LOG = 'fastslam-log'
// The program of the page's figures says how high their pictures are; that of logs has none before it has a log.
initSync({ module: readFileSync(join(root, 'widgets', 'pkg', 'fastslam-page.wasm')) })

const FILE = join(root, 'widgets', 'elements', 'heights.json')
const UPDATE = process.env.UPDATE_GOLDENS === '1'
// From the narrowest phone to the figures of the chapter on a large screen.
const [first, apart, last] = [288, 16, 1056]
const SAMPLES = Array.from({ length: (last - first) / apart + 1 }, (_, i) => first + apart * i)
const WIDTHS = [320, 343, 363, 470, 576, 720, 832, 836, 960]
// Between two samples, lines may break at another width than the middle: at most that much is at stake.
const ROW = 64

test.use({ contextOptions: { reducedMotion: 'reduce' } })

const updated: Record<string, number[]> = {}

/** What the figures of these tags take when they live [px], a list a tag, and before that keep free, as `expect` holds them to. */
async function measure(page: Page, widthsOf: Record<string, number[]>): Promise<Record<string, number[]>> {
  const tags = Object.keys(widthsOf)
  // One above the other, so that all are seen.
  const html = tags.flatMap(tag => widthsOf[tag]!.map(width => `<div style="position: absolute; inset: 0 auto auto 0; width: ${width}px"><${tag}></${tag}></div>`))
  await page.route('**/heights', route =>
    route.fulfill({
      contentType: 'text/html',
      body: `<!doctype html><html lang="en"><title>Heights</title><link rel="icon" href="data:," /><script type="module" src="fastslam.js"></script><body>${html.join('')}`,
    }),
  )
  const open = await holdPrograms(page)
  await page.goto('heights')
  const heights = async () => {
    const of = (tag: string) => page.locator(tag).evaluateAll(elements => elements.map(element => Math.round(element.getBoundingClientRect().height)))
    return Object.fromEntries(await Promise.all(tags.map(async tag => [tag, await of(tag)]))) as Record<string, number[]>
  }
  for (const tag of tags) await expect(page.locator(tag).locator('.reserved')).toHaveCount(tag === LOG ? 0 : widthsOf[tag]!.length)
  await page.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done))))
  const before = await heights()
  open()
  // Forty-nine figures that compute need a while on a busy machine.
  const patient = UPDATE ? { timeout: 200_000 } : {}
  for (const tag of tags) {
    const [all, count] = [page.locator(tag), widthsOf[tag]!.length]
    // The figure of logs has its program only when something is asked of it, and is whole without.
    await expect(all.locator(tag === LOG ? '.idle' : '.stage.live')).toHaveCount(count, patient)
    await expect(all.locator('.sentence:not(:empty)')).toHaveCount(count, patient)
    // What is said at first, of a run under way, may be shorter than what is said in the end.
    await all.evaluateAll(elements => Promise.all(elements.map(element => (element as FigureElement).settled())))
    if (tag === LOG) continue
    // And the picture is as high as what is painted there: nothing of it is cut off.
    const canvases = await all.locator('canvas').evaluateAll(elements => elements.map(element => element.getBoundingClientRect()).map(({ width, height }) => [width, height]))
    expect(canvases.length, tag).toBeGreaterThanOrEqual(count)
    const figure = new Figure(tag)
    for (const [width, height] of canvases) expect(height, `picture of ${tag}, ${width} px wide`).toBeCloseTo(figure.height(width!), 0)
    figure.free()
  }
  const after = await heights()
  if (UPDATE) return after
  for (const tag of tags) {
    for (const [i, width] of widthsOf[tag]!.entries()) {
      const [kept, taken] = [before[tag]![i]!, after[tag]![i]!]
      // Below 3 px, nothing counts as moved.
      const most = (width - first) % apart === 0 ? 3 : ROW
      expect(Math.abs(kept - taken), `${tag}: ${kept} px kept, ${taken} px taken, ${width} px wide`).toBeLessThan(most)
    }
  }
  return after
}

if (!UPDATE) {
  // On a phone, where all that a figure has stands below one another and adds to its height; of one that has all kinds of controls also
  // between two of the widths that were measured, and with the controls beside the picture.
  test('every figure keeps its place free before it lives', async ({ page }) => {
    await measure(page, { ...Object.fromEntries([...programs.keys()].map(tag => [tag, [320]])), 'fastslam-lap': [320, 470, 832] })
  })
}

for (const tag of programs.keys()) {
  test(`${tag} keeps its place free before it lives, at every width`, breadth, async ({ page }) => {
    if (UPDATE) test.setTimeout(240_000) // five times as many figures
    updated[tag] = (await measure(page, { [tag]: UPDATE ? SAMPLES : WIDTHS }))[tag]!
  })
}

test.afterAll(() => {
  if (!UPDATE) return
  const { heights } = JSON.parse(readFileSync(FILE, 'utf8'))
  const lines = [...programs.keys()].map(tag => `    "${tag}": [${(updated[tag] ?? heights[tag]).join(', ')}]`)
  writeFileSync(FILE, `{\n  "first": ${first},\n  "apart": ${apart},\n  "heights": {\n${lines.join(',\n')}\n  }\n}\n`)
})
