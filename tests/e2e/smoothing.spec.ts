// What a reader does with the record of a filter and the sweeps of a smoother: every claim of the caption, in the page alone.
import type { Page } from '@playwright/test'
import { brokenRules } from './axe'
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { breadth } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

const TAG = 'fastslam-smoothing'
const open = (page: Page, query?: string) => new Figure(page, TAG).alone(query && `#${TAG}?v=3&${query}`)

const number = async (figure: Figure, name: string) => Number.parseFloat((await figure.readouts())[name]!)

test('as it opens, the record has one pose where the sweeps have many, and errs more; their common ancestor is found by dragging and by arrow keys', async ({ page }) => {
  const figure = await open(page)
  expect(await figure.position()).toBe(await figure.last())
  await expect(figure.sentence).toContainText('All 16 particles descend from one until step')
  await expect(figure.sentence).toContainText('After 24 sweeps the drawn paths have')
  expect(await number(figure, 'distinct_before')).toBe(1)
  expect(await number(figure, 'distinct_after')).toBeGreaterThan(8)
  expect(await number(figure, 'early_after')).toBeLessThan(await number(figure, 'early_before'))
  expect(await number(figure, 'cost')).toBeCloseTo(31.5, 5)
  expect(await brokenRules(page, { of: TAG })).toEqual([])

  const chip = figure.element.locator('[part~=chip]').first()
  await chip.click()
  await figure.settled()
  const step = await number(figure, 'coalescence')
  const box = (await figure.handle('at').boundingBox())!
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2]
  await page.mouse.move(x, y)
  await page.mouse.down()
  await page.mouse.move(x + 30, y, { steps: 4 })
  await page.mouse.up()
  await figure.settled()
  expect(Number(await figure.box('at').inputValue())).toBeGreaterThan(30)
  await figure.box('at').fill(String(step - 2))
  await figure.box('at').press('Enter')
  await figure.settled()
  expect(await number(figure, 'distinct_before')).toBe(1)
  await figure.grasp('at').focus()
  for (let key = 0; key < 3; key += 1) await page.keyboard.press('ArrowRight')
  await figure.settled()
  await expect(figure.box('at')).toHaveValue(String(step + 1))
  expect(await number(figure, 'distinct_before')).toBeGreaterThan(1)
  await page.keyboard.press('ArrowLeft')
  await figure.settled()
  await expect(chip).toHaveAccessibleName('Find the common ancestor (reached)')
})

test('sweeps are stepped, at none there is the filter alone, and without new ancestors they keep the past', async ({ page }) => {
  const figure = await open(page, 'particles=6&step=3')
  const [before, after] = [await number(figure, 'distinct_before'), await number(figure, 'distinct_after')]
  expect(after).toBeGreaterThanOrEqual(before)
  await figure.scrubTo(0)
  await expect(figure.sentence).toContainText('No sweep has been done yet.')
  await figure.step.click()
  await figure.settled()
  await expect(figure.sentence).toContainText('After 1 sweep the drawn paths have 1 different pose')
  await figure.scrubTo(3)
  expect(await number(figure, 'distinct_after')).toBe(after)

  await figure.goTo('particles=8&step=6')
  const renewed = await figure.readouts()
  await figure.element.getByRole('checkbox', { name: 'New ancestors' }).uncheck()
  await figure.settled()
  expect(await number(figure, 'distinct_after')).toBeLessThan(Number.parseFloat(renewed['distinct_after']!))
})

test('a link reopens the same numbers', breadth, async ({ page }) => {
  const figure = await open(page, 'particles=8&step=6')
  const [before, link] = [await figure.readouts(), await figure.state()]
  await page.goto('about:blank')
  expect(await (await open(page, link)).readouts()).toEqual(before)
})

test('exercise 10: how many pasts sweeps find is guessed in the chart, and without new ancestors it is one', async ({ page }) => {
  const figure = await open(page, 'predict=on')
  await expect(figure.play).toBeHidden()
  for (const name of ['distinct_after', 'first_after', 'early_after', 'spread']) expect((await figure.readouts())[name], name).toMatch(/^–/)
  await expect(figure.sentence).toContainText('How many different poses will 24 sweeps have at step 1?')
  const handle = figure.handle('guess')
  await handle.scrollIntoViewIfNeeded()
  const box = (await handle.boundingBox())!
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2]
  await page.mouse.move(x, y)
  await page.mouse.down()
  await page.mouse.move(x, y + 20, { steps: 5 })
  await page.mouse.up()
  await figure.settled()
  const dragged = Number(await figure.box('guess').inputValue())
  expect(dragged).toBeLessThan(12)
  await figure.grasp('guess').focus()
  await page.keyboard.press('ArrowUp')
  await figure.settled()
  await expect(figure.box('guess')).toHaveValue(String(dragged + 1))
  await figure.toggle('run').click()
  await figure.settled()
  await expect(figure.sentence).toContainText(`All 24 sweeps have 24 different poses at step 1; the guess was ${dragged + 1}`)
  expect(await number(figure, 'first_after')).toBe(24)
  // (b), waived.
  await figure.element.getByRole('checkbox', { name: 'New ancestors' }).uncheck()
  await figure.settled()
  expect((await figure.readouts())['first_after']).toMatch(/^–/)
  await figure.toggle('run').click()
  await figure.settled()
  await expect(figure.sentence).toContainText('All 24 sweeps have 1 different pose at step 1; no guess was made.')
})
