// Nothing moves when a figure comes to life: before, it keeps the place free that it will take.
// UPDATE_GOLDENS=1 measures that anew, into widgets/elements/heights.json.
import { readFileSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import { programs } from '../../scripts/registry.mjs'
import { root } from '../../scripts/lib.mjs'
import type { FigureElement } from '../../widgets/elements'
import type { Action } from '../../widgets/elements/action'
import type { ProgramFrame } from '../../widgets/elements/shell'
import { Figure, initSync } from '../../widgets/pkg/fastslam_widgets.js'
import { holdPrograms } from './figure'
import { expect, test } from './fixtures'
import { breadth } from './host'

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

// At two of these widths, one-screen.spec.ts looks at every figure.
for (const tag of programs.keys()) {
  test(`${tag} keeps its place free before it lives`, breadth, async ({ page }) => {
    if (UPDATE) test.setTimeout(600_000) // five times as many figures
    const widths = UPDATE ? SAMPLES : WIDTHS
    // One above the other, so that all are seen.
    const html = widths.map(width => `<div style="position: absolute; inset: 0 auto auto 0; width: ${width}px"><${tag}></${tag}></div>`)
    await page.route('**/heights', route =>
      route.fulfill({
        contentType: 'text/html',
        body: `<!doctype html><html lang="en"><title>Heights</title><link rel="icon" href="data:," /><script type="module" src="fastslam.js"></script><body>${html.join('')}`,
      }),
    )
    const open = await holdPrograms(page)
    await page.goto('heights')
    const all = page.locator(tag)
    const heights = () => all.evaluateAll(elements => elements.map(element => Math.round(element.getBoundingClientRect().height)))
    await page.evaluate(async tag => void (await customElements.whenDefined(tag)), tag)
    await expect(all.locator('.reserved')).toHaveCount(tag === 'fastslam-log' ? 0 : widths.length)
    await page.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done))))
    const before = await heights()
    open()
    // The figure of logs has its program only when something is asked of it, and is whole without.
    // Forty-nine figures that compute need a while on a busy machine.
    const patient = UPDATE ? { timeout: 500_000 } : {}
    await expect(all.locator(tag === 'fastslam-log' ? '.idle' : '.stage.live')).toHaveCount(widths.length, patient)
    await expect(all.locator('.sentence:not(:empty)')).toHaveCount(widths.length, patient)
    // What is said at first, of a run under way, may be shorter than what is said in the end.
    await all.evaluateAll(elements => Promise.all(elements.map(element => (element as FigureElement).settled())))
    const after = await heights()
    // And the picture is as high as what is painted there: nothing of it is cut off.
    const canvases = await all.locator('canvas').evaluateAll(elements =>
      elements.map(element => {
        const { width, height } = element.getBoundingClientRect()
        return [width, height, parseFloat(getComputedStyle(element).getPropertyValue('--_highest')) || Infinity]
      }),
    )
    if (tag !== 'fastslam-log') {
      const figure = new Figure(tag)
      for (const [width, height, highest] of canvases) {
        // One that would be higher than it may be is made smaller as a whole.
        expect(height).toBeLessThanOrEqual(highest!)
        figure.act({ do: 'size', name: 'light', at: [width!, Infinity, 1, width!, 0, 0] } satisfies Action)
        const { natural } = (figure.frame(true) as ProgramFrame).layout!
        if (natural <= highest! - 20) expect(height, `picture ${width} px wide`).toBeCloseTo(natural, 0)
      }
      figure.free()
    }
    if (UPDATE) updated[tag] = after
    else {
      for (const [i, width] of widths.entries()) {
        // Below 3 px, nothing counts as moved.
        const most = (width - first) % apart === 0 ? 3 : ROW
        expect(Math.abs(before[i]! - after[i]!), `${before[i]} px kept, ${after[i]} px taken, ${width} px wide`).toBeLessThan(most)
      }
    }
  })
}

test.afterAll(() => {
  if (!UPDATE) return
  const { heights } = JSON.parse(readFileSync(FILE, 'utf8'))
  const lines = [...programs.keys()].map(tag => `    "${tag}": [${(updated[tag] ?? heights[tag]).join(', ')}]`)
  writeFileSync(FILE, `{\n  "first": ${first},\n  "apart": ${apart},\n  "heights": {\n${lines.join(',\n')}\n  }\n}\n`)
})
