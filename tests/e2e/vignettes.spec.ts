// The small figures between the sentences of the chapter: each has a picture, one handle that works by mouse, touch and keyboard, one line
// that holds its number, and nothing else.
import type { Locator, Page } from '@playwright/test'
import { frames, holdPrograms } from './figure'
import { expect, test } from './fixtures'
import { breadth } from './host'

const MOST = { width: 560, height: 200 }

/** Those of the chapter, by their names there: some stand in it twice. */
const names = (page: Page): Promise<string[]> => page.locator('figure.vignette').evaluateAll(all => all.map(one => one.id))

async function shown(page: Page, which: string) {
  const element = page.locator(`#${which} fastslam-vignette`)
  await element.evaluate(one => {
    for (let at = one.closest('details'); at; at = at.parentElement!.closest('details')) at.open = true
    one.scrollIntoView({ block: 'center' })
  })
  const slider = element.getByRole('slider')
  await expect(slider, `${which} lives`).toBeVisible()
  return { element, slider, told: element.getByRole('status'), canvas: element.locator('canvas') }
}

/** The picture as it is, without reading it back more often than a page does. */
const pixels = (canvas: Locator): Promise<string> => canvas.evaluate(canvas => (canvas as HTMLCanvasElement).toDataURL())

/** The state of all that a reader sees of one. */
const state = async ({ slider, told, canvas }: Awaited<ReturnType<typeof shown>>) => ({
  value: await slider.getAttribute('aria-valuetext'),
  told: await told.textContent(),
  picture: await pixels(canvas),
})

for (const [name, viewport, each, more] of [
  ['laptop', { width: 1366, height: 650 }, 1, breadth],
  ['phone', { width: 380, height: 760 }, 1, breadth],
  ['phone', { width: 380, height: 760 }, 4, {}],
] as const) {
  /** One of so `each` stands for the others. */
  const some = async (page: Page) => (await names(page)).filter((_, k) => k % each === 0)

  test.describe(`on a ${name}, ${each === 1 ? 'every vignette' : 'some vignettes'}`, more, () => {
    test.use({ viewport, hasTouch: name === 'phone' })

    test('is small, fits the page, and its handle moves its picture, its value and its line by keyboard and pointer', async ({ page }) => {
      test.slow()
      await page.goto('./')
      const all = await some(page)
      expect(all.length).toBeGreaterThanOrEqual(3)
      for (const which of all) {
        const parts = await shown(page, which)
        const { element, slider, canvas } = parts
        const { width, height } = (await canvas.boundingBox())!
        expect(width, which).toBeLessThanOrEqual(MOST.width)
        expect(height, which).toBeLessThanOrEqual(MOST.height)
        expect(width, which).toBeGreaterThan(300)
        expect(await element.locator('input, button, select').count(), `${which}: one handle`).toBe(1)
        await expect(slider).toHaveAccessibleName(/\p{L}{3}/u)

        const first = await state(parts)
        await slider.focus()
        await page.keyboard.press('ArrowRight')
        await frames(page, 2)
        const second = await state(parts)
        expect(second.value, which).not.toBe(first.value)
        expect(second.picture, which).not.toBe(first.picture)
        await page.keyboard.press('ArrowLeft')
        await frames(page, 2)
        expect(await state(parts), `${which}: back`).toEqual(first)

        const box = (await slider.boundingBox())!
        const at: [number, number] = [box.x + 0.6 * box.width, box.y + box.height / 2]
        await (name === 'phone' ? page.touchscreen.tap(...at) : page.mouse.click(...at))
        await frames(page, 2)
        const third = await state(parts)
        expect(third.told, which).not.toBe(first.told)
        expect(third.picture, which).not.toBe(second.picture)
      }
      expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(viewport.width)
    })

    test('leaves what is below where it was when it comes to life', async ({ page }) => {
      const open = await holdPrograms(page)
      await page.goto('./')
      const heights = () => page.locator('fastslam-vignette').evaluateAll(all => all.map(one => (one.closest('details:not([open])') ? 0 : one.clientHeight)))
      const before = await heights()
      open()
      for (const which of await some(page)) await shown(page, which)
      const after = await heights()
      before.forEach((height, k) => height > 0 && expect(after[k], `number ${k}`).toBe(height))
    })
  })
}

test('it speaks the language around it, follows the theme, and has no handle on paper', async ({ page }) => {
  await page.goto('./')
  const [which] = await names(page)
  const parts = await shown(page, which!)
  const light = await state(parts)
  await parts.element.evaluate(one => one.setAttribute('lang', 'de'))
  await expect(parts.told).not.toHaveText(light.told!)
  await page.emulateMedia({ colorScheme: 'dark' })
  await frames(page, 3)
  expect(await pixels(parts.canvas)).not.toBe(light.picture)
  await page.emulateMedia({ media: 'print' })
  await expect(parts.slider).toBeHidden()
  await expect(parts.told).toBeVisible()
})

test('on paper one that has not come to life yet is its picture', async ({ page }) => {
  await holdPrograms(page)
  await page.goto('./')
  const element = page.locator('fastslam-vignette').first()
  await expect(element.locator('.stage')).toBeAttached()
  await expect(element.locator('img')).toBeHidden()
  await page.emulateMedia({ media: 'print' })
  await expect(element.locator('img')).toBeVisible()
  await expect(element.locator('.stage')).toBeHidden()
})

test.describe('without script', () => {
  test.use({ javaScriptEnabled: false })

  test('there is its picture', async ({ page }) => {
    await page.goto('./')
    const picture = page.locator('fastslam-vignette img').first()
    await picture.scrollIntoViewIfNeeded()
    await expect(picture).toBeVisible()
  })
})

test('on a laptop a picture is never far: there are at least 26, and no more than four screens of what is open are without one', async ({ page }) => {
  await page.setViewportSize({ width: 1366, height: 650 })
  await page.goto('./')
  const { count, far } = await page.evaluate(() => {
    const seen = [...document.querySelectorAll('main :is(figure.vignette, figure[id^=fig-])')].filter(figure => figure.checkVisibility()).map(figure => ({ name: figure.id, box: figure.getBoundingClientRect() }))
    const end = document.querySelector('#exercises')!.getBoundingClientRect().top
    const text = seen.filter(({ box }) => box.top < end)
    const far = text.map(({ name, box }, i) => ({ name, screens: (box.top - (text[i - 1]?.box.bottom ?? document.querySelector('h1')!.getBoundingClientRect().bottom)) / innerHeight }))
    return { count: seen.length, far: far.filter(({ screens }) => screens > 4) }
  })
  expect(far).toEqual([])
  expect(count).toBeGreaterThanOrEqual(26)
})
