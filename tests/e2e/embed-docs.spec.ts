// The page on embedding: what is set in its editor is what the figure does and what the code says.
import type { Page } from '@playwright/test'
import { brokenRules } from './axe'
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { breadth, FIGURES } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' }, permissions: ['clipboard-read', 'clipboard-write'] })

test('the editor changes the figure and prints the code for it', async ({ page, baseURL }) => {
  await page.goto('./embed/')
  const lap = new Figure(page, '#preview fastslam-lap')
  await lap.element.scrollIntoViewIfNeeded()
  await lap.live()
  const editor = page.getByRole('form', { name: 'Attributes' })
  await editor.getByRole('textbox', { name: 'universes' }).fill('6')
  await editor.getByRole('combobox', { name: 'truth' }).selectOption('on')
  await editor.getByRole('textbox', { name: 'controls' }).fill('playback')
  await expect(lap.element.locator('[part=settings]')).toBeHidden()
  await expect(page.getByLabel('Code: HTML element', { exact: true })).toHaveText(`<script type="module" src="${baseURL}fastslam.js"></script>\n<fastslam-lap universes="6" truth="on" controls="playback"></fastslam-lap>`)
  await expect(page.getByLabel('Code: Python', { exact: true })).toContainText('FastslamLap(universes=6, truth=True, controls="playback")')
  expect(await lap.element.evaluate(element => (element as unknown as { universes: number }).universes)).toBe(6)
  await page.getByRole('button', { name: 'Copy the code: iframe' }).click()
  expect(await page.evaluate(() => navigator.clipboard.readText())).toContain('embed.html?figure=lap&amp;universes=6&amp;truth=on&amp;controls=playback"')
  await editor.getByRole('textbox', { name: 'universes' }).fill('999')
  await expect(lap.alert).toContainText(/universes.*1 to 256/)
  await editor.getByRole('textbox', { name: 'universes' }).fill('')
  await expect(lap.alert).toBeEmpty()
  await expect(page.getByLabel('Code: Python', { exact: true })).not.toContainText('universes')
  await expectChosen(page, ['graph'])
})

test('every figure can be chosen in the editor', breadth, async ({ page }) => {
  await page.goto('./embed/')
  await expectChosen(page, FIGURES)
})

/** That these figures live in the page once they are chosen. */
async function expectChosen(page: Page, names: string[]): Promise<void> {
  for (const name of names) {
    await page.getByRole('combobox', { name: 'Figure' }).selectOption(`fastslam-${name}`)
    const figure = new Figure(page, `#preview fastslam-${name}`)
    await figure.element.scrollIntoViewIfNeeded()
    await figure.live()
  }
}

/** The page with all tables of its reference unfolded. */
async function openUnfolded(page: Page): Promise<void> {
  await page.goto('./embed/')
  const lap = new Figure(page, '#preview fastslam-lap')
  await lap.element.scrollIntoViewIfNeeded()
  await lap.live()
  for (const summary of await page.locator('#reference summary').all()) await summary.click()
}

async function expectNoWider(page: Page): Promise<void> {
  const { width, wide } = await page.evaluate(() => ({ width: innerWidth, wide: document.documentElement.scrollWidth }))
  expect(wide).toBe(width)
}

test('nothing is wider than the page on embedding, on a phone either, and axe finds nothing on it', async ({ page }) => {
  await openUnfolded(page)
  await expectNoWider(page)
  // Each table is like the others: axe looks at one of them.
  for (const summary of (await page.locator('#reference summary').all()).slice(1)) await summary.click()
  expect(await brokenRules(page, { frames: true })).toEqual([])
  for (const summary of (await page.locator('#reference summary').all()).slice(1)) await summary.click()
  await page.setViewportSize({ width: 380, height: 800 })
  await expectNoWider(page)
})

for (const [what, options] of Object.entries({ light: {}, dark: { colorScheme: 'dark' }, 'a phone': { viewport: { width: 380, height: 800 } } } as const)) {
  test(`axe finds nothing on all of the page on embedding, and nothing is wider than it: ${what}`, breadth, async ({ browser, baseURL }) => {
    const context = await browser.newContext({ baseURL: baseURL!, reducedMotion: 'reduce', ...options })
    const page = await context.newPage()
    await openUnfolded(page)
    expect(await brokenRules(page, { frames: true })).toEqual([])
    await expectNoWider(page)
    await context.close()
  })
}
