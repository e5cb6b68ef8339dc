// Pages in German for lecturers: their scripts and figures speak German as well.
import { brokenRules } from './axe'
import { expect, test } from './fixtures'
import { breadth } from './host'
import { Figure } from './figure'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

test('the bank is graded in German, takes decimal commas, and leads to the one in English and back', async ({ page }) => {
  await page.goto('./bank-de.html')
  await expect(page.locator('html')).toHaveAttribute('lang', 'de')
  const mean = page.locator('#bank-proposal-mean')
  const answer = mean.getByLabel('Ihre Antwort')
  await answer.fill('3,5')
  await answer.press('Enter')
  await expect(mean.getByRole('status')).toHaveText('3,5 ist zu groß.')
  await answer.fill('2,73')
  await answer.press('Enter')
  await expect(mean.getByRole('status')).toContainText('Ja. 2,73')
  await expect(mean.getByRole('button', { name: 'Meine Antwort vergessen' })).toBeVisible()
  // Its letters are those of the text.
  expect(await page.evaluate(async () => (await document.fonts.load('16px Text', 'ä')).map(face => face.unicodeRange.includes('U+E4')))).toContain(true)
  await page.getByRole('navigation', { name: 'Website' }).getByRole('link', { name: 'English' }).click()
  await expect(page.getByRole('heading', { level: 1 })).toHaveText('Question bank')
  await page.getByRole('navigation', { name: 'Site' }).getByRole('link', { name: 'Deutsch' }).click()
  await expect(page.getByRole('heading', { level: 1 })).toHaveText('Fragensammlung')
})

test('slides are turned in German, and their figures speak it', async ({ page }) => {
  await page.setViewportSize({ width: 1366, height: 768 })
  await page.goto('./deck-de.html')
  await page.getByRole('navigation', { name: 'Folien' }).getByRole('button', { name: 'Weiter' }).click()
  const lap = new Figure(page, 'fastslam-lap')
  await lap.live()
  await expect(lap.element.getByRole('button', { name: 'Abspielen' })).toBeVisible()
})

test('axe finds nothing in bank, deck and sheet, and they fit a phone', breadth, async ({ page }) => {
  for (const name of ['bank-de', 'deck-de', 'worksheet-90-de']) {
    for (const colorScheme of ['light', 'dark'] as const) {
      await page.emulateMedia({ colorScheme })
      await page.goto(`./${name}.html`)
      expect(await brokenRules(page, { but: 'figure > :defined' }), `${name}, ${colorScheme}`).toEqual([])
    }
    await page.setViewportSize({ width: 320, height: 700 })
    expect(await page.evaluate(() => document.documentElement.scrollWidth), name).toBe(320)
    await page.setViewportSize({ width: 1280, height: 720 })
  }
})
