// The deck: a slide a screen, turned by keys, by buttons and by links, each on a page of its own on paper.
import { brokenRules } from './axe'
import { expect, test } from './fixtures'
import { breadth } from './host'
import { Figure, settled } from './figure'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

test('arrows and the keys of a remote turn the page; in a figure the arrows are its own, until Escape', async ({ page }) => {
  await page.setViewportSize({ width: 1366, height: 768 })
  await page.goto('./model.html#plans')
  await page.getByRole('link', { name: 'deck of twelve slides' }).click()
  const slides = page.getByRole('navigation', { name: 'Slides' })
  const title = (name: string) => page.getByRole('heading', { name })
  await expect(slides).toContainText('1 / 13')
  await page.keyboard.press('ArrowRight')
  await expect(title('One lap, many maps')).toBeFocused()
  await expect(page).toHaveURL(/#slide-lap$/)
  const lap = new Figure(page, 'fastslam-lap')
  await lap.live()
  await settled(lap.element)
  expect(await lap.position()).toBe(74)
  await lap.element.locator('.stage').focus()
  await page.keyboard.press('ArrowRight')
  await expect.poll(() => lap.position()).toBe(75)
  await expect(title('One lap, many maps')).toBeVisible()
  await page.keyboard.press('Escape')
  await expect(title('One lap, many maps')).toBeFocused()
  await page.keyboard.press('PageDown')
  await expect(title('If you knew the path')).toBeFocused()
  await expect(lap.element).toBeHidden()
  await page.keyboard.press('End')
  await expect(slides.getByRole('button', { name: 'Next' })).toBeDisabled()
  await slides.getByRole('button', { name: 'Previous' }).click()
  await expect(slides).toContainText('12 / 13')
  await page.keyboard.press('Home')
  await expect(title('Deck: FastSLAM in twelve figures')).toBeFocused()
  await expect(slides.getByRole('button', { name: 'Previous' })).toBeDisabled()
})

for (const [width, height, more] of [[1280, 720, {}], [1366, 768, breadth], [1920, 1080, breadth]] as const) {
  test(`each slide fits a projector’s screen of ${width} × ${height}, with its question and a live figure`, more, async ({ page }) => {
    await page.setViewportSize({ width, height })
    await page.goto('about:blank')
    await page.goto('./deck.html#slide-conditioning')
    for (let slide = 2; slide < 13; slide++) {
      const shown = page.locator('.slide:not([hidden])')
      const id = (await shown.getAttribute('id'))!
      // A log waits until its reader asks for it.
      if (id !== 'slide-log') {
        await expect(shown.locator('.stage.live')).toBeVisible()
        await settled(shown.locator('figure > :defined'))
        expect(await shown.locator('.stage').evaluate(stage => getComputedStyle(stage).clipPath), `${id} at ${width} is cut off`).toBe('none')
      }
      const [room, says, figure] = await shown.evaluate(shown => [document.documentElement, ...shown.querySelectorAll('.says, figure')].map(element => element.scrollHeight - element.clientHeight))
      expect([room, says, figure], `${id} at ${width}`).toEqual([0, 0, 0])
      await page.keyboard.press('PageDown')
    }
  })
}

test('a link to a state of a figure opens its slide; on paper every slide has a page, without the answers', async ({ page }) => {
  await page.goto('./deck.html#fastslam-doors?v=1&particles=100')
  const doors = new Figure(page, 'fastslam-doors')
  await doors.live()
  await expect(page.getByRole('navigation', { name: 'Slides' })).toContainText('8 / 13')
  expect(await doors.element.evaluate(element => (element as unknown as { values: Record<string, string> }).values['particles'])).toBe('100')
  await page.evaluate(() => document.querySelectorAll('fastslam-smoothing, fastslam-joint').forEach(figure => figure.setAttribute('particles', '4')))
  const pdf = (await page.pdf({ preferCSSPageSize: true })).toString('latin1')
  expect(pdf.match(/\/Type\s*\/Page\b(?!s)/g)).toHaveLength(13)
  await page.emulateMedia({ media: 'print' })
  await expect(page.locator('.slide .question').first()).toBeVisible()
  await expect(page.locator('.slide details').first()).toBeHidden()
})

test('axe finds nothing in a slide, and on a phone it fits the width', async ({ page }) => {
  for (const colorScheme of ['light', 'dark'] as const) {
    await page.emulateMedia({ colorScheme })
    await page.goto('about:blank')
    await page.goto('./deck.html#slide-em')
    expect(await brokenRules(page, { but: 'figure > :defined' }), colorScheme).toEqual([])
  }
  await page.setViewportSize({ width: 320, height: 700 })
  expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(320)
})

test.describe('without JavaScript', () => {
  test.use({ javaScriptEnabled: false })

  test('the slides stand below each other, with their answers folded', async ({ page }) => {
    await page.goto('./deck.html')
    await expect(page.locator('.slide:visible')).toHaveCount(12)
    await page.locator('.slide summary').first().click()
    await expect(page.locator('.slide .fold').first()).toBeVisible()
  })
})
