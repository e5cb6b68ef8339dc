// What a reader does with the sampled map beside the computed one: the caption and exercise 2, in the page alone.
import type { Page } from '@playwright/test'
import { brokenRules } from './axe'
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { breadth } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

const open = (page: Page, query?: string) => new Figure(page, 'fastslam-joint').alone(query && `#fastslam-joint?${query}`)


test('as it opens, the sampled map has run out of particles and the computed one has not; without odometry noise a thousand last to the seventh landmark, by the slider and by the handle', async ({ page }) => {
  const figure = await open(page)
  await expect(figure.play).toBeHidden()
  await expect(figure.sentence).toContainText('After 24 landmarks, 1000 particles with sampled maps are worth 1.2')
  expect(await figure.number('ess_computed')).toBeGreaterThan(500)
  expect(await figure.number('removed')).toBeGreaterThan(99.9)
  expect(await figure.number('repeats')).toBe(40)
  expect(await brokenRules(page, { of: 'fastslam-joint' })).toEqual([])

  // Exercise 2 (c).
  await figure.goTo('odometry=0&landmarks=5')
  expect(await figure.number('rho')).toBeCloseTo(2.79, 2)
  await figure.grasp('landmarks').focus()
  await page.keyboard.press('ArrowRight')
  await page.keyboard.press('ArrowRight')
  await figure.settled()
  await expect(figure.box('landmarks')).toHaveValue('7')
  expect(await figure.number('predicted_sampled')).toBeLessThan(1)
  expect(await figure.number('ess_computed')).toBe(1000)
  // Back by the box: the numbers are those of before, and nothing was run again.
  await figure.box('landmarks').fill('6')
  await figure.box('landmarks').press('Enter')
  await figure.settled()
  expect(await figure.number('predicted_sampled')).toBeGreaterThan(1)
})

test('exercise 2 (c): a guess is dragged, nothing tells the answer before, and the line stands beside it then', async ({ page }) => {
  const figure = await open(page, 'odometry=0&predict=on')
  const hidden = ['ess_sampled', 'predicted_sampled', 'rho', 'removed']
  const asked = await figure.readouts()
  for (const name of hidden) expect(asked[name], name).toMatch(/^–/)
  await expect(figure.sentence).toContainText('After how many landmarks are 1000 particles with sampled maps worth less than a single one?')
  await expect(figure.toggle('run')).toHaveText('Show me')
  const handle = figure.handle('guess')
  await handle.scrollIntoViewIfNeeded()
  const box = (await handle.boundingBox())!
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2]
  await page.mouse.move(x, y)
  await page.mouse.down()
  await page.mouse.move(x - 60, y, { steps: 5 })
  await page.mouse.up()
  await figure.settled()
  const guess = Number(await figure.box('guess').inputValue())
  expect(guess).toBeLessThan(12)
  await figure.grasp('guess').focus()
  await page.keyboard.press('ArrowLeft')
  await figure.settled()
  await expect(figure.box('guess')).toHaveValue(String(guess - 1))
  await expect(figure.toggle('run')).toHaveText('Show the sampled map')
  await figure.toggle('run').click()
  await figure.settled()
  await expect(figure.sentence).toContainText(`worth less than one from 7 landmarks on; the guess was ${guess - 1}`)
  expect(await figure.number('rho')).toBeCloseTo(2.79, 2)
})

// As many as a reader can ask for, and what `npm test` has time for.
for (const [particles, repeats, more] of [['5000', 12, {}], ['20000', 6, breadth]] as const) {
  test(`${particles} particles do not keep the page waiting, and are shown before all repeats are run`, more, async ({ page }) => {
    const figure = await open(page, 'particles=100')
    // However quick the machine, all are not run within a few frames.
    const client = await page.context().newCDPSession(page)
    await client.send('Emulation.setCPUThrottlingRate', { rate: 4 })
    await figure.element.evaluate((element, particles) => {
      const page = window as Window & { slices?: number; shown?: number[] }
      page.shown = []
      page.slices = 0
      const text = (part: string) => element.shadowRoot!.querySelector(part)!.textContent!
      const tick = () => {
        page.slices! += 1
        const repeats = Number(text('[data-name=repeats] dd'))
        if (text('.sentence').includes(`→ ${particles}.`) && page.shown!.at(-1) !== repeats) page.shown!.push(repeats)
        requestAnimationFrame(tick)
      }
      requestAnimationFrame(tick)
    }, particles)
    await figure.box('particles').fill(particles)
    await figure.box('particles').press('Enter')
    await figure.settled()
    expect(await figure.number('repeats')).toBe(repeats)
    const [frames, shown] = await page.evaluate(() => {
      const { slices, shown } = window as Window & { slices?: number; shown?: number[] }
      return [slices!, shown!]
    })
    expect(frames, 'the page went on').toBeGreaterThan(20)
    expect(shown.length, `repeats as they were shown: ${shown}`).toBeGreaterThan(2)
    expect(shown[0], 'of the repeats so far').toBeLessThan(repeats)
    expect(shown, 'none is lost').toEqual(shown.toSorted((a, b) => a - b))
  })
}

test('a link reopens the same numbers', breadth, async ({ page }) => {
  const figure = await open(page, 'particles=200&sensor=2&landmarks=6')
  const before = await figure.readouts()
  const link = await figure.state()
  await figure.box('sensor').fill('1')
  await figure.box('sensor').press('Enter')
  await figure.settled()
  expect(await figure.readouts()).not.toEqual(before)
  await page.goto('about:blank')
  const again = await open(page, link)
  expect(await again.readouts()).toEqual(before)
})
