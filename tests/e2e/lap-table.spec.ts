// The lap table: plain for everybody, and run again by those who press a button.
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import type { Locator, Page } from '@playwright/test'
import { renderLapTable } from '../../scripts/chapter/lap-table.mjs'
import { root } from '../../scripts/lib.mjs'
import { brokenRules } from './axe'
import { expect, test } from './fixtures'

const data = (file: string) => JSON.parse(readFileSync(join(root, 'www', 'data', file), 'utf8'))
const numbers = data('numbers.json')
/** The one that takes least. */
const CHEAP = 'motion.cell.m4'
const SLOW = 'aware.subcell.m8'
const GRAPH = 'graph'

/** The chapter's page, in whose place of the text there is the table alone. */
async function open(page: Page, change = (html: string) => html): Promise<void> {
  const address = new URL('./', process.env.FASTSLAM_URL).href
  await page.route(address, async route => {
    const response = await route.fetch()
    const body = (await response.text()).replace(/(<main[^>]*>)[^]*<\/main>/, `$1<div class="wide">${change(renderLapTable(numbers))}</div></main>`)
    await route.fulfill({ response, body })
  })
  await page.goto('./')
}

const cell = (page: Page, name: string) => page.locator(`td[data-cell="${name}"]`)
const button = (page: Page, name: string): Locator => cell(page, name).getByRole('button', { name: /^Run it here: / })
const panel = (page: Page) => page.locator('fastslam-lap-table .panel')
const run = (page: Page) => panel(page).getByRole('progressbar', { name: 'Seeds run' }).evaluate((bar: HTMLProgressElement) => bar.value)

test.describe('without JavaScript', () => {
  test.use({ javaScriptEnabled: false })

  test('it is a table of every measured number, to the millimetre', async ({ page }) => {
    await open(page)
    await expect(page.locator('fastslam-lap-table td[data-cell]')).toHaveCount(21)
    for (const name of [CHEAP, SLOW, GRAPH]) {
      const value = (key: string) => numbers[`lap.${name}.${key}`].value.toFixed(3)
      await expect(cell(page, name)).toHaveText(`${value('median')} ${value('median_low')}–${value('median_high')} p90 ${value('p90')} worst ${value('worst')}`)
    }
    await expect(page.getByRole('columnheader', { name: 'Motion prior' })).toBeVisible()
    await expect(page.getByRole('rowheader', { name: 'M = 16' })).toBeVisible()
    await expect(page.getByRole('button')).toHaveCount(0)
  })
})

test('a cell computed here has the digits printed, seed by seed, says so once, and fits a phone; axe finds nothing against it, light and dark', async ({ page }) => {
  await open(page)
  await expect(panel(page)).toBeHidden()
  await expect(button(page, SLOW)).toHaveAccessibleName(/measurement-aware proposal, sub-cell score, M = 8\. About \d+ seconds\.$/)
  await button(page, CHEAP).focus()
  await page.keyboard.press('Enter')
  await expect(panel(page).getByRole('status')).toContainText('The first 5 laps end with the errors printed, to the last bit.', { timeout: 30_000 })
  await expect(panel(page)).toContainText('of 200 seeds, each error as printed. Median')
  await expect(panel(page).getByRole('status')).toContainText('The same digits as printed', { timeout: 45_000 })
  const value = (key: string) => numbers[`lap.${CHEAP}.${key}`].value.toFixed(3)
  await expect(panel(page).getByRole('status')).toContainText(`median ${value('median')} m (${value('median_low')}–${value('median_high')}), p90 ${value('p90')} m, worst ${value('worst')} m. All 200 errors agree to the last bit.`)
  await expect(cell(page, CHEAP)).toContainText('same digits')
  expect(await run(page)).toBe(200)
  await expect(panel(page).locator('circle.same')).toHaveCount(200)
  await expect(panel(page).getByRole('alert')).toBeEmpty()
  await expect(panel(page).getByRole('button', { name: 'Stop' })).toBeDisabled()

  await page.setViewportSize({ width: 380, height: 800 })
  for (const colorScheme of ['light', 'dark'] as const) {
    await page.emulateMedia({ colorScheme })
    expect(await brokenRules(page, { of: 'fastslam-lap-table' }), colorScheme).toEqual([])
  }
  expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(380)
  const cut = (cells: Element[]) => cells.filter(element => element.scrollWidth > element.clientWidth + 1).length
  expect(await page.locator('fastslam-lap-table td').evaluateAll(cut)).toBe(0)
})

test('the cell of the pose graph is computed here as well', async ({ page }) => {
  await open(page)
  await expect(button(page, GRAPH)).toHaveAccessibleName(/^Run it here: pose graph, sub-cell score\. About \d+ seconds\.$/)
  await button(page, GRAPH).click()
  await expect(panel(page)).toContainText('pose graph, sub-cell score')
  await expect(panel(page).getByRole('status')).toContainText('The first 5 laps end with the errors printed, to the last bit.', { timeout: 30_000 })
  // All of them are the same loop as for every cell, and take a while.
  await panel(page).getByRole('button', { name: 'Stop' }).click()
  await expect(panel(page)).toContainText('of 200 seeds, each error as printed. Median so far')
  expect(await panel(page).locator('circle.same').count()).toBeGreaterThanOrEqual(5)
  await expect(panel(page).locator('circle.differs')).toHaveCount(0)
})

test('it stops at once, and keeps what it has', async ({ page }) => {
  await open(page)
  await button(page, SLOW).click()
  await expect.poll(() => run(page), { timeout: 30_000 }).toBeGreaterThan(0)
  await panel(page).getByRole('button', { name: 'Stop' }).click()
  await expect(panel(page).getByRole('status')).toHaveText(/^Stopped after \d+ of 200 seeds\.$/)
  const stopped = await run(page)
  await expect.poll(() => page.workers().length).toBe(0)
  expect(await run(page)).toBe(stopped)
  await expect(panel(page)).toContainText('Median so far')
})

test('a cell takes the place of the one that runs, and digits that differ are said loudly', async ({ page }) => {
  const median = numbers[`lap.${CHEAP}.median`].value.toFixed(3)
  await open(page, html => html.replace(`<td data-cell="${CHEAP}"><b data-of="median">${median}<`, `<td data-cell="${CHEAP}"><b data-of="median">0.001<`))
  await expect(cell(page, CHEAP)).toContainText('0.001')
  await button(page, SLOW).click()
  await expect.poll(() => run(page), { timeout: 30_000 }).toBeGreaterThan(0)
  await button(page, CHEAP).click()
  await expect(panel(page)).toContainText('motion prior, cell score, M = 4')
  await expect(panel(page).getByRole('alert')).toContainText(`These are not the digits printed. Here: median ${median} m`, { timeout: 45_000 })
  await expect(panel(page).getByRole('alert')).toContainText('Printed: median 0.001 m')
  await expect(cell(page, CHEAP)).toContainText('differs')
  await expect(cell(page, SLOW)).not.toContainText(/same|differs/)
})

test('a run is shared by two workers where there are two processors, and ends with its table', async ({ page }) => {
  await open(page)
  await button(page, SLOW).click()
  const processors = await page.evaluate(() => navigator.hardwareConcurrency)
  await expect.poll(() => page.workers().length, { timeout: 30_000 }).toBe(Math.min(2, processors))
  await page.locator('fastslam-lap-table').evaluate(table => table.remove())
  await expect.poll(() => page.workers().length).toBe(0)
})
