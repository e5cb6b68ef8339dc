import { test } from './fixtures'
import { Figure } from './figure'
test.use({ contextOptions: { reducedMotion: 'reduce' } })
const cases: [string, string, string][] = [
  ['p-asked', 'proposal', 'v=3&predict=on'], ['p-placed', 'proposal', 'v=3&predict=on&guess=3'], ['p-run', 'proposal', 'v=3&predict=on&guess=3&run=on'],
  ['r-asked', 'resampling', 'predict=on'], ['r-placed', 'resampling', 'predict=on&guess=40'], ['r-run', 'resampling', 'predict=on&guess=40&run=on&policy=always'], ['r-waived', 'resampling', 'predict=on&run=on'],
]
for (const [w, h, scheme] of [[1366, 650, 'light'], [380, 760, 'dark']] as const)
  test.describe(`${w}`, () => {
    test.use({ viewport: { width: w, height: h }, colorScheme: scheme })
    test(`shots ${w}`, async ({ page }) => {
      test.setTimeout(300000)
      for (const [name, tag, q] of cases) {
        await page.goto('about:blank')
        const f = await new Figure(page, `fastslam-${tag}`).alone(`#fastslam-${tag}?${q}`)
        await f.settled()
        await f.element.screenshot({ path: `/tmp/predict-shots/${name}-${w}.png` })
      }
      await page.goto('./')
      for (const id of ['guess-ratio', 'guess-ancestor']) {
        const q = page.locator(`#${id}`)
        await q.scrollIntoViewIfNeeded()
        await page.waitForTimeout(2500)
        await q.screenshot({ path: `/tmp/predict-shots/${id}-${w}.png` })
        await q.locator('> label input').fill('3')
        await q.locator('> label input').press('Enter')
        await page.waitForTimeout(3000)
        await q.screenshot({ path: `/tmp/predict-shots/${id}-done-${w}.png` })
      }
    })
  })
