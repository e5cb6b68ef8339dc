// What a reader does with EM mapping beside the particles: every claim of the caption, in the page alone, by mouse and by keyboard.
import type { Page } from '@playwright/test'
import { brokenRules } from './axe'
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { breadth } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

const open = (page: Page, query?: string) => new Figure(page, 'fastslam-em').alone(query && `#fastslam-em?${query}`)


const chip = async (figure: Figure, name: RegExp) => {
  await figure.element.getByRole('button', { name }).first().click()
  await figure.settled()
}

test('as it opens, the map has every door and the particles hold both answers; both passes fill from their ends, step by step, and nothing falls', async ({ page }) => {
  const figure = await open(page)
  await expect(figure.sentence).toContainText('After iteration 20 nothing changes any more: the map has 3 doors')
  await expect(figure.sentence).toContainText('The particles keep both answers')
  expect(await figure.number('put_down')).toBeCloseTo(3.9, 1)
  expect(await figure.number('again_em')).toBe(0)
  expect(await figure.number('again')).toBeGreaterThan(5)
  expect(await figure.number('log_posterior')).toBeGreaterThanOrEqual(await figure.number('best'))
  expect(await brokenRules(page, { of: 'fastslam-em' })).toEqual([])

  // How much future: without any there are several places, and with more of it fewer.
  const [whole, picture] = [await figure.told.textContent(), await figure.picture()]
  await figure.box('future').fill('0')
  await figure.box('future').press('Enter')
  await expect(figure.told).toContainText('63 % for the old ones')
  expect(await figure.picture()).not.toBe(picture)
  await figure.box('future').fill('20')
  await figure.box('future').press('Enter')
  await expect(figure.told).toContainText('8 % for the old ones')
  await figure.box('future').fill('157')
  await figure.box('future').press('Enter')
  await expect(figure.told).toHaveText(whole!)

  await chip(figure, /From the first guess/)
  await expect(figure.sentence).toContainText('The first guess: a map with 3 doors')
  let before = await figure.number('log_posterior')
  for (const [steps, what] of [[1, 'forward'], [4, 'backward'], [4, 'forward times backward'], [1, 'After iteration 1']] as const) {
    for (let i = 0; i < steps; i++) await figure.step.click()
    await figure.settled()
    await expect(figure.sentence).toContainText(what)
    const now = await figure.number('log_posterior')
    expect(now).toBeGreaterThanOrEqual(before)
    before = now
  }
  expect(await figure.number('iteration')).toBe(1)
})

test('a folding guess ends lower, and one mark unfolds it, by keyboard and by mouse; with wheels twice as bad, EM mapping is sure of what the particles are not', async ({ page }) => {
  const figure = await open(page)
  const right = await figure.number('log_posterior')
  await chip(figure, /A guess that folds the corridor/)
  await expect(figure.sentence).toContainText('the map has 2 doors')
  await expect(figure.sentence).toContainText('passed the same two doors again')
  expect(await figure.number('again_em')).toBe(100)
  expect(await figure.number('log_posterior')).toBeLessThan(right - 5)
  await figure.openSettings()
  await figure.grasp('mark-3').focus()
  for (let i = 0; i < 3; i++) await page.keyboard.press('Shift+ArrowUp')
  await figure.settled()
  await expect(figure.box('mark-3')).toHaveValue('8.2')
  expect(await figure.number('log_posterior')).toBe(right)
  await expect(figure.element.getByRole('button', { name: 'A guess that folds the corridor (reached)' })).toBeVisible()
  // And back by the mouse, onto the second mark.
  const [third, second] = [await figure.handle('mark-3').boundingBox(), await figure.handle('mark-2').boundingBox()]
  const middle = (box: typeof third) => [box!.x + box!.width / 2, box!.y + box!.height / 2] as const
  await page.mouse.move(...middle(third))
  await page.mouse.down()
  await page.mouse.move(middle(third)[0], middle(second)[1], { steps: 4 })
  await page.mouse.up()
  await figure.settled()
  expect(await figure.number('doors')).toBe(2)

  await chip(figure, /Wheels twice as bad/)
  expect(await figure.number('again_em')).toBe(100)
  const again = await figure.number('again')
  expect(again).toBeGreaterThan(5)
  expect(again).toBeLessThan(95)
  await chip(figure, /Begin with a blank map/)
  expect(await figure.number('doors')).toBe(3)
  await figure.element.evaluate(element => element.setAttribute('mark-1', '11'))
  await expect(figure.alert).toContainText('mark-1 = "11": must be')
})

test('a link reopens the same numbers', breadth, async ({ page }) => {
  const figure = await open(page, 'mark-3=5.2&step=57&particles=200')
  const before = await figure.readouts()
  const link = await figure.state()
  await page.goto('about:blank')
  const again = await open(page, link)
  expect(await again.readouts()).toEqual(before)
})

test('exercise 9: where EM mapping has the robot put down is guessed in its strip, and then told', async ({ page }) => {
  const figure = await open(page, 'mark-3=5.2&predict=on')
  await expect(figure.play).toBeHidden()
  for (const name of ['put_down', 'again_em', 'entropy']) expect((await figure.readouts())[name], name).toMatch(/^–/)
  await expect(figure.sentence).toContainText('where will EM mapping have the robot put down')
  const handle = figure.handle('guess')
  await handle.scrollIntoViewIfNeeded()
  const box = (await handle.boundingBox())!
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2]
  await page.mouse.move(x, y)
  await page.mouse.down()
  await page.mouse.move(x, y + 24, { steps: 5 })
  await page.mouse.up()
  await figure.settled()
  const dragged = Number(await figure.box('guess').inputValue())
  expect(dragged).toBeLessThan(5)
  await figure.grasp('guess').focus()
  await page.keyboard.press('ArrowUp')
  await figure.settled()
  await expect(figure.box('guess')).toHaveValue(String(Math.round(10 * dragged + 1) / 10))
  expect((await figure.readouts())['put_down']).toMatch(/^–/)
  await expect(figure.toggle('run')).toHaveText('Run EM mapping')
  await figure.toggle('run').click()
  await figure.settled()
  await expect(figure.sentence).toContainText('was the other answer')
  expect(await figure.number('again_em')).toBe(100)
  expect(await figure.number('put_down')).toBeLessThan(2.7)
  // (b): the others, and what no peak tells.
  expect((await figure.readouts())['again_others']).toMatch(/^\d+ of 20/)
  expect(await figure.number('best')).toBeGreaterThan((await figure.number('log_posterior')) + 5)
  expect(await figure.number('again')).toBeGreaterThan(5)
})
