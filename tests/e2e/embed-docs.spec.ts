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
  await editor.getByText('All attributes').click()
  await editor.getByRole('textbox', { name: 'universes' }).fill('6')
  await editor.getByRole('combobox', { name: 'truth' }).selectOption('on')
  await editor.getByRole('textbox', { name: 'controls' }).fill('playback')
  await expect(lap.element.locator('[part=settings]')).toBeHidden()
  await expect(page.getByLabel('Code: HTML element', { exact: true })).toHaveText(`<script type="module" src="${baseURL}fastslam.js"></script>\n<fastslam-lap v="13" universes="6" step="82" truth="on" controls="playback"><p slot="no-script"><a href="${baseURL}embed-lap.html"><img src="${baseURL}embed-lap.png" alt="One lap, many maps" width="100%" loading="lazy"></a><br>This figure is not live here: its script has not arrived. The picture leads to it.</p></fastslam-lap>`)
  await page.getByRole('radio', { name: 'Notebook' }).check()
  await expect(page.getByLabel('Code: Python', { exact: true })).toContainText('FastslamLap(v=13, universes=6, step=82, truth=True, controls="playback")')
  expect(await lap.element.evaluate(element => (element as unknown as { universes: number }).universes)).toBe(6)
  await page.getByRole('radio', { name: 'Show' }).check()
  await editor.getByRole('combobox', { name: 'Into' }).selectOption('iframe')
  await page.getByRole('button', { name: 'Copy the code: iframe' }).click()
  expect(await page.evaluate(() => navigator.clipboard.readText())).toContain('embed.html?figure=lap&amp;v=13&amp;universes=6&amp;step=82&amp;truth=on&amp;controls=playback"')
  await editor.getByRole('textbox', { name: 'universes' }).fill('999')
  await expect(lap.alert).toContainText(/universes.*1 to 256/)
  await editor.getByRole('textbox', { name: 'universes' }).fill('')
  await expect(lap.alert).toBeEmpty()
  await page.getByRole('radio', { name: 'Notebook' }).check()
  await expect(page.getByLabel('Code: Python', { exact: true })).not.toContainText('universes')
  await expectChosen(page, ['graph'])
})

test('a figure’s menu leads to the editor with the figure as it stands, and there the code and the fields go with the figure’s own controls', async ({ page, baseURL }) => {
  await page.goto('./embed-proposal.html?odometry=1.3&lock=seed')
  const there = new Figure(page, 'fastslam-proposal')
  await there.live()
  const [opened] = await Promise.all([page.context().waitForEvent('page'), there.menu('Use this in class…')])
  await expect(opened).toHaveURL(`${baseURL}embed/?figure=proposal&v=3&odometry=1.3&lock=seed`)
  const figure = new Figure(opened, '#preview fastslam-proposal')
  await figure.element.scrollIntoViewIfNeeded()
  await figure.live()
  expect(await figure.state()).toBe(await there.state())
  const editor = opened.getByRole('form', { name: 'Attributes' })
  const code = opened.getByLabel('Code: HTML element', { exact: true })
  await editor.getByText('All attributes').click()
  await expect(editor.getByRole('textbox', { name: 'odometry' })).toHaveValue('1.3')
  await expect(editor.getByRole('textbox', { name: 'lock' })).toHaveValue('seed')
  await expect(code).toContainText('<fastslam-proposal v="3" odometry="1.3" lock="seed">')
  // By its own controls: a box, a handle in the picture, a chip.
  await figure.openSettings()
  await figure.box('samples').fill('37')
  await figure.box('samples').press('Enter')
  await expect(code).toContainText(' samples="37"')
  await expect(editor.getByRole('textbox', { name: 'samples' })).toHaveValue('37')
  await figure.grasp('landmark').focus()
  await opened.keyboard.press('ArrowRight')
  await figure.settled()
  const markup = await figure.element.evaluate(element => (element as HTMLElement & { embedCode(name: string): string }).embedCode('element'))
  await expect(code).toHaveText(markup)
  // And what the figure was moved to, the editor takes back.
  await editor.getByRole('textbox', { name: 'samples' }).fill('')
  await expect(code).not.toContainText('samples=')
  await expect(figure.box('samples')).not.toHaveValue('37')
  // A link that is copied here opens here.
  await editor.getByRole('combobox', { name: 'Figure' }).selectOption('fastslam-doors')
  await expect(opened).toHaveURL(`${baseURL}embed/?figure=doors`)
  await opened.close()
})

test('a figure that plays leaves the code at the step that was asked for, and an unknown one is said', async ({ page }) => {
  await page.goto('./embed/?figure=lap&step=2')
  const lap = new Figure(page, '#preview fastslam-lap')
  await lap.element.scrollIntoViewIfNeeded()
  await lap.live()
  await page.getByRole('radio', { name: 'Notebook' }).check()
  const code = page.getByLabel('Code: Python', { exact: true })
  await expect(code).toHaveText(/FastslamLap\(v=13, step=2\)$/)
  await lap.play.click()
  await expect.poll(() => lap.position()).toBeGreaterThan(4)
  await lap.pause.click()
  await expect(code).toHaveText(/FastslamLap\(v=13, step=2\)$/)
  await page.goto('./embed/?figure=psychic')
  await expect(page.getByRole('alert').filter({ hasText: 'There is no figure “psychic”' })).toBeVisible()
  await expect(page.locator('#preview > *')).toHaveCount(1)
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
