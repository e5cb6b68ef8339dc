// The page on embedding: what is set in its editor is what the figure does and what the code says.
import { brokenRules } from './axe'
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { FIGURES } from './host'

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
  for (const name of FIGURES) {
    await editor.getByRole('combobox', { name: 'Figure' }).selectOption(`fastslam-${name}`)
    await new Figure(page, `#preview fastslam-${name}`).live()
  }
})

for (const [what, options] of Object.entries({ light: {}, dark: { colorScheme: 'dark' }, 'a phone': { viewport: { width: 380, height: 800 } } } as const)) {
  test(`axe finds nothing on the page on embedding, and nothing is wider than it: ${what}`, async ({ browser, baseURL }) => {
    const context = await browser.newContext({ baseURL: baseURL!, reducedMotion: 'reduce', ...options })
    const page = await context.newPage()
    await page.goto('./embed/')
    const lap = new Figure(page, '#preview fastslam-lap')
    await lap.element.scrollIntoViewIfNeeded()
    await lap.live()
    for (const summary of await page.locator('#reference summary').all()) await summary.click()
    expect(await brokenRules(page, { frames: true })).toEqual([])
    const { width, wide } = await page.evaluate(() => ({ width: innerWidth, wide: document.documentElement.scrollWidth }))
    expect(wide).toBe(width)
    await context.close()
  })
}
