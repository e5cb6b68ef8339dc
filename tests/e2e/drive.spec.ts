// A reader at the wheel of the lap: drives, builds and kidnaps, by mouse, keyboard and touch; all of it is in the link, and can be undone.
import type { Locator, Page } from '@playwright/test'
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { openCourse } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

const APARTMENT = 'course=apartment&universes=2'

/** The wheel of the figure, taken. */
class Wheel {
  readonly open: Locator
  readonly map: Locator
  readonly undo: Locator
  readonly done: Locator
  readonly clear: Locator

  constructor(readonly figure: Figure) {
    this.open = figure.button('Drive it yourself')
    this.map = figure.element.locator('.wheel-map')
    this.undo = figure.button('Undo')
    this.done = figure.button('Done')
    this.clear = figure.button('Clear my plan')
  }

  static async take(page: Page, query = APARTMENT): Promise<Wheel> {
    const wheel = new Wheel(await new Figure(page, 'fastslam-lap').alone(`#fastslam-lap?${query}`))
    await wheel.open.click()
    return wheel
  }

  /** What the link says of the reader's plan. */
  async plan(): Promise<{ plan: string | null; drive: string | null }> {
    const query = new URLSearchParams(await this.figure.state())
    return { plan: query.get('plan'), drive: query.get('drive') }
  }

  /** Where a place of the apartment [m] is in the window [px]. */
  async at(x: number, y: number): Promise<[number, number]> {
    await this.map.scrollIntoViewIfNeeded()
    const box = (await this.map.boundingBox())!
    return [box.x + ((x + 0.6) / 13.2) * box.width, box.y + ((9.6 - y) / 10.2) * box.height]
  }

  async draw(page: Page, ...places: [number, number][]): Promise<void> {
    const [first, ...rest] = places
    await page.mouse.move(...(await this.at(...first!)))
    await page.mouse.down()
    for (const place of rest) await page.mouse.move(...(await this.at(...place)), { steps: 8 })
    await page.mouse.up()
    await this.figure.settled()
  }
}

test('by keyboard: it drives, undoes, and the link brings it back', async ({ page, context }) => {
  const figure = await new Figure(page, 'fastslam-lap').alone(`#fastslam-lap?${APARTMENT}&step=8`)
  const wheel = new Wheel(figure)
  await wheel.open.focus()
  await page.keyboard.press('Enter')
  for (const key of ['ArrowUp', 'ArrowUp', 'ArrowLeft', 'ArrowUp', 'ArrowDown', 'ArrowRight']) await page.keyboard.press(key)
  await figure.settled()
  expect((await wheel.plan()).drive).toBe('1.8.M2nMzl')
  expect(await figure.position()).toBe(14)
  await expect(figure.sentence).toContainText('Step 14 of 14; the nearest universe is')
  await wheel.undo.click()
  await wheel.undo.click()
  await figure.settled()
  expect([(await wheel.plan()).drive, await figure.position()]).toEqual(['1.8.M2nM', 12])
  const [state, picture] = [await figure.state(), await figure.picture()]
  await figure.element.locator('.stage').focus()
  await page.keyboard.press('Escape')
  await expect(wheel.open).toBeFocused()
  expect(await figure.picture()).not.toBe(picture) // the truth is seen at the wheel alone
  const other = await context.newPage()
  const again = await new Figure(other, 'fastslam-lap').alone(`#fastslam-lap?${state}`)
  expect([await again.position(), await again.readouts()]).toEqual([12, await figure.readouts()])
})

test('by keyboard: walls are put up and taken away, and the robot is kidnapped', async ({ page }) => {
  const wheel = await Wheel.take(page, `${APARTMENT}&step=25`)
  const { figure } = wheel
  const stage = figure.element.locator('.stage')
  const keys = async (...all: string[]) => {
    await stage.focus()
    for (const key of all) await page.keyboard.press(key)
    await figure.settled()
  }
  await figure.button('Wall').click()
  await keys('Enter')
  await expect(figure.sentence).toContainText('not yet set')
  await keys('ArrowUp', 'ArrowUp', 'ArrowUp', 'Enter')
  expect((await wheel.plan()).plan).toMatch(/^1\.\.[0-9a-z]{8}$/)
  await figure.button('Erase').click()
  await keys('Enter')
  expect((await wheel.plan()).plan).toBe(null)
  await figure.button('Kidnap').click()
  await keys(...Array<string>(30).fill('ArrowUp'), 'Enter')
  expect((await wheel.plan()).drive).toMatch(/^1\.25\.~\d+_\d+_\d+$/)
  await expect(figure.sentence).toContainText('resampling can only choose among those there are')
})

test('by mouse: the pad, a path, a wall, an erased wall and a kidnapping, each undone', async ({ page }) => {
  const wheel = await Wheel.take(page, `${APARTMENT}&step=10`)
  const { figure } = wheel
  for (const name of ['Forward', 'Turn left', 'Turn right', 'Back up']) await figure.button(name).click()
  await figure.settled()
  expect((await wheel.plan()).drive).toBe('1.10.Mnlz')
  // The pad drives, whatever is in the hand.
  await figure.button('Wall').click()
  await figure.button('Forward').click()
  expect((await wheel.plan()).drive).toBe('1.10.MnlzM')
  await wheel.undo.click()
  await figure.button('Wheel').click()
  await wheel.draw(page, [3.8, 4.6], [6.0, 4.5], [7.0, 4.8])
  await expect.poll(() => figure.position()).toBe(await figure.last())
  expect(await figure.last()).toBeGreaterThan(18)
  await figure.button('Wall').click()
  await wheel.draw(page, [6, 3.9], [6, 5.4])
  expect((await wheel.plan()).plan).toBe('1..1o131o1i')
  await figure.button('Erase').click()
  await wheel.draw(page, [4.2, 2])
  expect((await wheel.plan()).plan).toBe('1.0c.1o131o1i')
  await figure.button('Kidnap').click()
  await wheel.draw(page, [9.6, 7.6])
  await expect(figure.sentence).toContainText('Kidnapped at step')
  await wheel.undo.click()
  expect((await wheel.plan()).drive).not.toContain('~')
  await wheel.undo.click()
  expect((await wheel.plan()).plan).toBe('1..1o131o1i')
  await wheel.undo.click()
  expect((await wheel.plan()).plan).toBe(null)
  await wheel.undo.click()
  expect((await wheel.plan()).drive).toBe('1.10.Mnlz')
  await wheel.clear.click()
  expect(await wheel.plan()).toEqual({ plan: null, drive: null })
  await wheel.undo.click()
  expect((await wheel.plan()).drive).toBe('1.10.Mnlz')
  await wheel.done.click()
  await expect(figure.element.locator('.main')).toBeVisible()
})

test('a wall stops the robot, and the sentence says so', async ({ page }) => {
  const wheel = await Wheel.take(page, `${APARTMENT}&step=10`)
  await wheel.draw(page, [4.5, 4.5], [4.5, 3])
  await expect.poll(() => wheel.figure.position()).toBe(await wheel.figure.last())
  await expect(wheel.figure.sentence).toContainText('A wall stopped the robot')
})

test.describe('by touch', () => {
  test.use({ hasTouch: true, viewport: { width: 380, height: 760 } })

  test('it drives, builds and kidnaps, with buttons that a thumb hits', async ({ page }) => {
    const figure = await new Figure(page, 'fastslam-lap').alone(`#fastslam-lap?${APARTMENT}&step=10`)
    const wheel = new Wheel(figure)
    await wheel.open.tap()
    for (const button of await figure.element.locator('.wheel button').all()) {
      const { width, height } = (await button.boundingBox())!
      expect(Math.min(width, height)).toBeGreaterThanOrEqual(44)
    }
    expect(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)).toBeLessThanOrEqual(0)
    await figure.button('Forward').tap()
    await figure.button('Turn left').tap()
    await figure.settled()
    expect((await wheel.plan()).drive).toBe('1.10.Mn')
    await figure.button('Wall').tap()
    await page.touchscreen.tap(...(await wheel.at(6, 3.9)))
    await page.touchscreen.tap(...(await wheel.at(6, 5.4)))
    await figure.settled()
    expect((await wheel.plan()).plan).toMatch(/^1\.\.[0-9a-z]{8}$/)
    await figure.button('Erase').tap()
    await page.touchscreen.tap(...(await wheel.at(6, 4.6)))
    expect((await wheel.plan()).plan).toBe(null)
    await figure.button('Kidnap').tap()
    await page.touchscreen.tap(...(await wheel.at(9.6, 7.6)))
    await figure.settled()
    await expect(figure.sentence).toContainText('Kidnapped at step 13')
    await wheel.undo.tap()
    expect((await wheel.plan()).drive).toBe('1.10.Mn')
  })
})

// Many more: widgets/tests/all/drive.rs.
test('a plan that nobody wrote is refused with a message, and the figure lives', async ({ page }) => {
  const figure = await new Figure(page, 'fastslam-lap').alone(`#fastslam-lap?${APARTMENT}&drive=1.0.~NaN_0_0&plan=%3Cscript%3E`)
  await expect(figure.alert).toContainText('as the figure writes it')
  await expect(figure.alert).toContainText('version 1')
  for (const name of ['drive', 'plan']) expect(await figure.state()).not.toContain(name)
  await figure.step.click()
  expect(await figure.position()).toBe(1)
})

test('a drive that is full takes no more, says so, and loses nothing', async ({ page }) => {
  const drive = `1.0.${'ml'.repeat(200)}`
  const wheel = await Wheel.take(page, `course=apartment&universes=1&proposal=motion&matcher=cell&drive=${drive}&step=400`)
  const { figure } = wheel
  await figure.button('Forward').click()
  await expect(figure.alert).toContainText('400 steps')
  expect((await wheel.plan()).drive).toBe(drive)
  const link = await figure.element.evaluate(element => (element as HTMLElement & { link: string }).link)
  expect(link.length).toBeLessThanOrEqual(2000)
  await figure.scrubTo(399)
  await figure.button('Turn left').click()
  await expect(figure.alert).toBeEmpty()
  expect((await wheel.plan()).drive).toBe(`1.0.${'ml'.repeat(199)}mn`)
})

test('what an author keeps from readers is kept at the wheel', async ({ page }) => {
  await openCourse(
    page,
    `<fastslam-lap id="a" course="apartment" universes="2" lock="drive"></fastslam-lap>
     <fastslam-lap id="b" universes="2" lock="drive plan"></fastslam-lap>
     <fastslam-lap id="c" universes="2" controls="playback universes"></fastslam-lap>`,
  )
  const [a, b, c] = ['a', 'b', 'c'].map(id => new Figure(page, `#${id}`))
  for (const figure of [b!, c!]) {
    await figure.element.scrollIntoViewIfNeeded()
    await figure.live()
    await expect(figure.button('Drive it yourself')).toBeHidden()
  }
  await a!.element.scrollIntoViewIfNeeded()
  await a!.live()
  await a!.button('Drive it yourself').click()
  for (const name of ['Wheel', 'Kidnap', 'Forward']) await expect(a!.button(name)).toBeDisabled()
  await expect(a!.button('Wall')).toBeEnabled()
  const before = await a!.state()
  await a!.element.locator('.stage').focus()
  await page.keyboard.press('Enter')
  await page.keyboard.press('ArrowUp')
  await page.keyboard.press('Enter')
  await a!.settled()
  expect(await a!.state()).not.toBe(before)
})
