// What a reader does with the six identical doors: what the caption and exercise 6 ask for, in the page alone.
import type { Page } from '@playwright/test'
import { brokenRules } from './axe'
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { breadth } from './host'

const TAG = 'fastslam-doors'
const open = (page: Page, query?: string) => new Figure(page, TAG).alone(query && `#${TAG}?${query}`)

const value = async (figure: Figure, name: string) => (await figure.readouts())[name]

/** Drags a handle of the picture sideways. */
async function drag(page: Page, figure: Figure, name: string, by: number): Promise<void> {
  const box = (await figure.handle(name).boundingBox())!
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2)
  await page.mouse.down()
  await page.mouse.move(box.x + box.width / 2 + by, box.y + box.height / 2, { steps: 4 })
  await page.mouse.up()
  await figure.settled()
}

test.describe('at rest', () => {
  test.use({ contextOptions: { reducedMotion: 'reduce' } })

  test('it opens at the end, with EKF-SLAM sure and wrong, steps back to several explanations, and who is at the end stays there at another seed', async ({ page }) => {
    const figure = await open(page)
    expect(await figure.position()).toBe(await figure.last())
    await expect(figure.scrub).toHaveValue(String(await figure.last()))
    await expect(figure.sentence).toContainText(': right. EKF-SLAM')
    await expect(figure.sentence).toContainText('Its σ is 5 cm, and it is off by −1 doors: wrong')
    // Who is at the end stays there, and a link says so.
    for (const seed of ['8', '21']) {
      await figure.seed.fill(seed)
      await figure.seed.press('Enter')
      await figure.settled()
      expect(await figure.position(), seed).toBe(await figure.last())
      await expect(figure.scrub).toHaveValue(String(await figure.last()))
      expect(await figure.state()).toBe(`seed=${seed}`)
    }
    // Several explanations are alive, while EKF-SLAM has had one since the first door.
    await figure.goTo('')
    await figure.openNumbers()
    await figure.scrubTo(58)
    await expect(figure.sentence).toContainText('4 explanations hold')
    expect(await value(figure, 'ekf_off')).toContain('−1')
    await figure.stepBack.click()
    await figure.scrubTo(46)
    await expect(figure.sentence).toContainText('7 explanations hold')
    expect(await value(figure, 'ekf_off')).toContain('−1')
    await figure.scrubTo(42)
    await expect(figure.sentence).toContainText('both filters agree')
  })

  test('the end of the ride and a door follow the pointer and the arrow keys, and a seventh door is typed, and refused where none can be', async ({ page }) => {
    const figure = await open(page)
    await figure.openSettings()
    await drag(page, figure, 'end', 40)
    const end = Number(await figure.box('end').inputValue())
    expect(end).toBeGreaterThan(10.5)
    await figure.grasp('end').press('ArrowLeft')
    await figure.settled()
    expect(Number(await figure.box('end').inputValue())).toBe(end - 0.25)
    await drag(page, figure, 'door-5', 30)
    await expect(figure.box('door-5')).not.toHaveValue('15')
    expect(await figure.state()).toMatch(/^end=[\d.]+&door-5=[\d.]+$/)

    // A seventh door is typed, and refused where none can be.
    await figure.goTo('')
    await figure.box('door-7').fill('1.5')
    await figure.box('door-7').press('Enter')
    await figure.settled()
    await expect(figure.handle('door-7')).toBeVisible()
    await figure.element.evaluate(element => element.setAttribute('door-7', '40'))
    await expect(figure.alert).toContainText('door-7 = "40": must be')
  })

  test('EKF-SLAM is fooled by dragging the end of the ride, and ends right after a short one', async ({ page }) => {
    const figure = await open(page)
    await figure.element.getByRole('button', { name: /Fool EKF-SLAM/ }).click()
    await figure.settled()
    await expect(figure.sentence).toContainText('it is off by 0 doors: right')
    await drag(page, figure, 'end', 60)
    await expect(figure.told).toContainText('Particles: right? right → right, EKF-SLAM: right? right → wrong')
    await expect(figure.element.getByRole('button', { name: 'Fool EKF-SLAM (reached)' })).toBeVisible()
    await figure.goTo('ride=1')
    await expect(figure.sentence).toContainText('it is off by 0 doors: right')
  })

  test('nothing axe finds', async ({ page }) => {
    const figure = await open(page)
    await figure.openSettings()
    await figure.openCount()
    expect(await brokenRules(page, { of: TAG })).toEqual([])
  })

  // Two hundred seeds are those of the solution; whether the page counts right, fifty show as well.
  for (const [seeds, more, shares] of [
    ['50', {}, 'EKF-SLAM 30 % (19–44), predicted by hand 29 %, M = 25 44 % (31–58), M = 100 78 % (65–87), M = 400 96 % (87–99)'],
    ['200', breadth, 'EKF-SLAM 28 % (22–35), predicted by hand 29 %, M = 25 50 % (43–56), M = 100 81 % (75–86), M = 400 96 % (92–98)'],
  ] as const) {
    test(`the count of exercise 6 over ${seeds} seeds is what the filters come to there, against the pencil`, more, async ({ page }) => {
      test.setTimeout(120_000)
      const figure = await open(page)
      await figure.openCount()
      const panel = figure.element.locator('[part=count]')
      await panel.getByRole('combobox', { name: 'Number of seeds' }).selectOption(seeds)
      await panel.getByRole('button', { name: `Count over ${seeds} seeds` }).click()
      const said = panel.locator('.said')
      await expect(said).toContainText(`${seeds} seeds counted.`, { timeout: 90_000 })
      await expect(said).toContainText(shares)
    })
  }
})
