// The first screen of the chapter: the figure beside the title.
import type { Page } from '@playwright/test'
import { Figure } from './figure'
import { expect, test } from './fixtures'

const LAPTOP = { width: 1366, height: 650 }
const PHONE = { width: 380, height: 760 }

/** The figure as it is found, its Lab closed. */
async function hero(page: Page, link = './'): Promise<Figure> {
  await page.goto(link)
  const lap = new Figure(page, 'fastslam-lap')
  await expect(lap.element.locator('.stage.live')).toBeVisible()
  return lap
}

const unfold = (page: Page) => page.getByRole('button', { name: 'Open this figure' })

for (const [name, viewport] of [['laptop', LAPTOP], ['phone', PHONE]] as const) {
  test(`on a ${name} the first screen has a picture that moves by itself, what happens in it, and one control besides what unfolds it`, async ({ page }) => {
    await page.setViewportSize(viewport)
    const lap = await hero(page)
    const { y, height, width } = (await lap.canvas.boundingBox())!
    expect(y).toBeGreaterThan(0)
    expect(y + height, 'all of the picture is in sight').toBeLessThanOrEqual(viewport.height)
    expect(height, 'it is no stamp').toBeGreaterThan(180)
    expect(width).toBeGreaterThan(240)
    await expect(lap.told).not.toBeEmpty()
    const shown = await lap.element.evaluate(element =>
      [...element.shadowRoot!.querySelectorAll('button, input, select, summary')].filter(one => one.checkVisibility({ visibilityProperty: true })).map(one => one.className),
    )
    expect(shown).toEqual(['play primary'])
    await expect(unfold(page)).toBeVisible()
    const before = await lap.position()
    await expect.poll(() => lap.position(), 'it plays').not.toBe(before)
    await page.keyboard.press('Escape')
    await expect.poll(() => lap.playing()).toBe(false)
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(viewport.width)
  })
}

test('its story is told twice, from new ground to after the closing, and then it rests where that is told', async ({ page }) => {
  await page.setViewportSize(LAPTOP)
  const lap = await hero(page)
  const { plays } = await page.locator('figure.hero').evaluate(figure => ({ plays: (figure as HTMLElement).dataset['plays']! }))
  const [from, to, rest] = plays.split(' ').map(Number) as [number, number, number]
  // As fast as the machine can, instead of half a minute.
  await lap.element.evaluate((element, to) => {
    const page = globalThis as typeof globalThis & { steps: number[] }
    page.steps = []
    element.addEventListener('fastslam-step', event => page.steps.push((event as CustomEvent<{ step: number }>).detail.step))
    const rate = element.shadowRoot!.querySelector<HTMLSelectElement>('.extras select')!
    rate.add(new Option('', '1000'))
    rate.value = '1000'
    rate.dispatchEvent(new Event('change'))
    return to
  }, to)
  await expect.poll(() => lap.playing(), { timeout: 60_000 }).toBe(false)
  await expect.poll(() => lap.position()).toBe(rest)
  const steps = await page.evaluate(() => (globalThis as typeof globalThis & { steps: number[] }).steps)
  expect(steps.filter(step => step === to), 'twice').toHaveLength(2)
  const back = steps.find((step, k) => step < steps[k - 1]!)!
  expect(back, 'from the same step').toBeGreaterThanOrEqual(from)
  expect(back).toBeLessThan(from + 5)
})

test('a click on the picture unfolds all of the figure in its place, and so do its button, a link to it, and a challenge of its caption', async ({ page }) => {
  await page.setViewportSize(LAPTOP)
  let lap = await hero(page)
  const { y } = (await lap.element.boundingBox())!
  await lap.canvas.click()
  await expect(lap.element.locator('[part=chips]')).toBeVisible()
  await expect(lap.box('universes')).toBeVisible()
  await expect(page.locator('#fig-lap figcaption')).toBeVisible()
  await expect(unfold(page)).toHaveCount(0)
  expect((await lap.element.boundingBox())!.width).toBeGreaterThan(800)
  expect(Math.abs((await lap.element.boundingBox())!.y - y), 'not far from where it was').toBeLessThan(500)

  lap = await hero(page, './?by-keyboard')
  await unfold(page).press('Enter')
  await expect(lap.box('universes')).toBeVisible()
  lap = await hero(page, './?by-link#fastslam-lap?v=13&universes=8&step=3')
  await expect(lap.box('universes')).toHaveValue('8')
  expect(await lap.position()).toBe(3)
})

test.describe('where nothing is to move', () => {
  test.use({ contextOptions: { reducedMotion: 'reduce' } })

  test('it shows the step that tells most, and stays there', async ({ page }) => {
    await page.setViewportSize(LAPTOP)
    const lap = await hero(page)
    await lap.settled()
    const rest = Number((await page.locator('figure.hero').getAttribute('data-plays'))!.split(' ')[2])
    expect(await lap.position()).toBe(rest)
    expect(await lap.playing()).toBe(false)
  })
})
