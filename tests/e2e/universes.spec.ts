// What a reader does with the figure of exercises 4 and 5: guesses first, another rule, other thresholds, and the laps themselves.
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { breadth } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

const open = (page: ConstructorParameters<typeof Figure>[0], query = '') => new Figure(page, 'fastslam-universes').alone(query && `#fastslam-universes?v=2&${query}`)

test('it opens with both answers of exercise 5, and another rule is another chance', async ({ page }) => {
  const figure = await open(page)
  await expect(figure.sentence).toContainText('the motion prior needs 12 universes, the measurement-aware proposal 1')
  const before = await figure.readouts()
  expect(before['share_motion']).toContain('64 (57–70)')
  expect(Number.parseFloat(before['passes_motion']!)).toBeGreaterThan(30)
  await figure.box('seeds').fill('50')
  await figure.box('seeds').press('Enter')
  await figure.settled()
  expect(Number.parseFloat((await figure.readouts())['passes_motion']!)).toBeLessThan(5)
})

test('laps are run into the charts, each by itself, and in the end the answer is the one of all', async ({ page }) => {
  const figure = await open(page)
  const before = [await figure.readouts(), await figure.picture()]
  await figure.element.getByRole('button', { name: 'Run the laps' }).click()
  await expect(figure.told).toContainText(/^\d laps? of each M\./)
  await figure.scrubTo(11)
  await expect(figure.told).toContainText('12 laps of each M. With M = 8, 8 ended well by the wheels, 12 by looking first.')
  await figure.step.click()
  await figure.settled()
  await expect(figure.told).toContainText('13 laps of each M.')
  expect(await figure.state()).toContain('step=12')
  await figure.scrubTo(199)
  await expect(figure.told).toContainText('takes 12 universes; looking first, 1.')
  expect(await figure.readouts()).toEqual(before[0])
})

test('nothing is shown before the guesses are placed, and then they stand beside the results; what the sharpest sensor leaves is guessed in the chart', async ({ page }) => {
  const figure = await open(page)
  const shown = await figure.picture()
  await figure.toggle('predict').click()
  await figure.settled()
  expect(await figure.picture()).not.toBe(shown)
  await expect(figure.sentence).toContainText('All curves are hidden')
  expect((await figure.readouts())['sufficient_motion']).toBe('–')
  await figure.grasp('guess').focus()
  await page.keyboard.press('ArrowRight')
  await page.keyboard.press('ArrowRight')
  await figure.grasp('guess-aware').focus()
  await page.keyboard.press('ArrowLeft')
  await figure.settled()
  await expect(figure.box('guess')).toHaveValue('10')
  await expect(figure.box('guess-aware')).toHaveValue('3')
  await figure.toggle('run').click()
  await figure.settled()
  await expect(figure.sentence).toContainText('The motion prior proposal needs 12; you guessed 10: 17 % too low.')
  await expect(figure.sentence).toContainText('The measurement-aware proposal needs 1; you guessed 3: 200 % too high.')
  // Another threshold is another question.
  await figure.box('threshold').fill('0.3')
  await figure.box('threshold').press('Enter')
  await figure.settled()
  await expect(figure.box('guess')).toHaveValue('')
  await expect(figure.box('guess-aware')).toHaveValue('')

  await figure.goTo('predict=on')
  const before = await figure.readouts()
  expect(before['floor']).toMatch(/^–/)
  const handle = figure.handle('guess-floor')
  await handle.scrollIntoViewIfNeeded()
  const box = (await handle.boundingBox())!
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2]
  await page.mouse.move(x, y)
  await page.mouse.down()
  await page.mouse.move(x, y + 20, { steps: 4 })
  await page.mouse.up()
  await figure.settled()
  const guess = Number(await figure.box('guess-floor').inputValue())
  expect(guess).toBeLessThan(50)
  await figure.toggle('run').click()
  await figure.settled()
  const floor = Number.parseFloat((await figure.readouts())['floor']!)
  await expect(figure.sentence).toContainText(new RegExp(`You guessed ${guess} %: (right|\\d+ % too (${guess < floor ? 'low' : 'high'}))`))
})

// One universe takes a third of the time of three, and is judged more leniently: a few of its laps shall end well, as of three.
for (const [universes, threshold, good, more] of [['1', '2', 16, {}], ['3', '0.5', 12, breadth]] as const) {
  test(`the laps of a point are run again to the same digits: ${universes}`, more, async ({ page }) => {
    test.setTimeout(120_000)
    const figure = await open(page, `threshold=${threshold}`)
    const again = figure.element.locator('[part=count]')
    await again.locator('summary').click()
    await again.getByLabel('Universes of the laps').selectOption(universes)
    await again.getByRole('button', { name: 'Run 200 laps' }).click()
    await expect(again.locator('.said')).toHaveText(`${good} of 200 laps end within ${threshold} m. All errors are those of the chart, to the last digit.`, { timeout: 100_000 })
  })
}
