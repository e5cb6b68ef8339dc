// What a reader does with the two proposals.
import type { Page } from '@playwright/test'
import { brokenRules } from './axe'
import { expect, test } from './fixtures'
import { Figure, frames } from './figure'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

const open = (page: Page, query?: string) => new Figure(page, 'fastslam-proposal').alone(query && `#fastslam-proposal?${query}`)

/** The middle of a handle [px of the window]. */
async function middle(figure: Figure, handle: string): Promise<{ x: number; y: number }> {
  await figure.handle(handle).scrollIntoViewIfNeeded()
  const box = (await figure.handle(handle).boundingBox())!
  return { x: box.x + box.width / 2, y: box.y + box.height / 2 }
}

test('it says what it shows before anyone touches it, and has no timeline; of a pair, 2.0 loses the one', async ({ page }) => {
  const figure = await open(page)
  await expect(figure.sentence).toContainText(/lie in the posterior's 90 % region/)
  await expect(figure.play).toBeHidden()
  await expect(figure.scrub).toBeHidden()
  await expect(figure.sentence).toContainText(/N_eff 1000 and \d\d\d of 1000/)
  // Of what the picture says, nothing is written again, though events and data have it.
  await figure.element.locator('.numbers > summary').click()
  const written = figure.element.locator('[part=readout]:visible')
  await expect(written).toHaveCount(3)
  for (const [i, name] of ['range', 'bearing', 'predicted'].entries()) await expect(written.nth(i)).toHaveAttribute('data-name', name)
  expect((await figure.readouts())['ess_aware']).toContain('1000.0 of 1000')
  await figure.openSettings()
  await figure.element.locator('select[name=landmarks]').selectOption('pair')
  await figure.settled()
  await expect(figure.sentence).toContainText(/^The hypothesis A is lost.* \(N_eff 1000 and /)
})

test('the landmark is dragged by the mouse, with a picture at every frame, and moved by keyboard, coarsely with Shift and finely with Alt', async ({ page }) => {
  const figure = await open(page)
  await figure.openSettings()
  const numbers = async () => [await figure.readouts(), await figure.element.evaluate(element => element.shadowRoot!.querySelector('.numbers')!.textContent)]
  const [before, picture] = [await numbers(), await figure.picture()]
  const { x, y } = await middle(figure, 'landmark')
  await page.mouse.move(x + 3, y - 2)
  await page.mouse.down()
  await page.mouse.move(x - 60, y + 25, { steps: 12 })
  await figure.settled()
  expect(await numbers()).not.toEqual(before)
  await page.mouse.up()
  expect(await figure.picture()).not.toBe(picture)
  expect(Number(await figure.box('landmark-x').inputValue())).toBeLessThan(2.4)
  expect(Number(await figure.box('landmark-y').inputValue())).toBeLessThan(-0.2)
  // Back by typing: the same numbers to the last digit.
  for (const [name, value] of [['landmark-x', '2.7'], ['landmark-y', '-0.1']] as const) {
    await figure.box(name).fill(value)
    await figure.box(name).press('Enter')
  }
  await figure.settled()
  expect(await numbers()).toEqual(before)

  await figure.grasp('landmark').focus()
  for (const [keys, x, y] of [
    ['ArrowLeft', '2.65', '-0.1'],
    ['ArrowUp', '2.65', '-0.05'],
    ['Shift+ArrowLeft', '2.15', '-0.05'],
    ['Alt+ArrowRight', '2.155', '-0.05'],
  ] as const) {
    await page.keyboard.press(keys)
    await figure.settled()
    await expect(figure.box('landmark-x')).toHaveValue(x)
    await expect(figure.box('landmark-y')).toHaveValue(y)
  }
  await expect(figure.grasp('landmark')).toBeFocused()
  await expect(figure.grasp('landmark')).toHaveAttribute('aria-valuetext', '2.155 m ahead of the start, −0.05 m to the left')

  const now = await middle(figure, 'landmark')
  await page.mouse.move(now.x, now.y)
  await page.mouse.down()
  // Frames, not milliseconds: how fast they come is the machine's, and `npm run bench` tells it.
  let last = await figure.picture()
  for (let i = 1; i <= 20; i++) {
    await page.mouse.move(now.x - 3 * i, now.y + 12 * Math.sin(i))
    await frames(page, 2)
    const next = await figure.picture()
    expect(next, `the picture after move ${i}`).not.toBe(last)
    last = next
  }
  await page.mouse.up()
})

test('each noise is dragged at the end of its ellipse, and set there by keys', async ({ page }) => {
  const figure = await open(page, 'samples=64')
  const start = await figure.state()
  for (const [name, right, up] of [['range-std', 40, 0], ['bearing-std', 0, 20], ['odometry', 40, 0]] as const) {
    const value = async () => Number(await figure.box(name).inputValue())
    const [before, sentence] = [await value(), await figure.sentence.textContent()]
    const { x, y } = await middle(figure, name)
    await page.mouse.move(x + 3, y - 2)
    await page.mouse.down()
    // Larger with every move, and the knob stays below the pointer.
    let last = before
    for (let i = 1; i <= 10; i++) {
      await page.mouse.move(x + 3 + (right * i) / 10, y - 2 - (up * i) / 10)
      await figure.settled()
      expect(await value(), `${name} after move ${i}`).toBeGreaterThan(last)
      last = await value()
    }
    const now = await middle(figure, name)
    expect(Math.hypot(now.x - x - right, now.y - y + up)).toBeLessThan(20)
    await page.mouse.up()
    expect(await figure.sentence.textContent()).not.toBe(sentence)
    // A slider of its own for those who cannot see it, with the name of what it sets.
    const grasp = figure.grasp(name)
    await expect(grasp).toHaveAttribute('data-parameter', name)
    await expect(grasp).toHaveAttribute('aria-label', /noise, (along|across) the/)
    await grasp.focus()
    const step = Number(await figure.slider(name).getAttribute('step'))
    for (const [keys, steps] of [['ArrowLeft', -1], ['ArrowUp', 1], ['Alt+ArrowRight', 0.1], ['Shift+ArrowDown', -10]] as const) {
      const from = await value()
      await page.keyboard.press(keys)
      await figure.settled()
      const min = Number(await figure.box(name).getAttribute('min'))
      expect(await value(), keys).toBeCloseTo(Math.max(from + steps * step, min), 4)
    }
    await expect(grasp).toBeFocused()
    await figure.goTo(start)
    expect(await value()).toBe(before)
  }
})

test.describe('on a phone', () => {
  test.use({ viewport: { width: 380, height: 740 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 })

  test('a finger drags the landmark and not the page, and elsewhere the page and not the landmark', async ({ page }) => {
    const figure = await open(page)
    await figure.openSettings()
    // Where nothing of the picture is scrolled over.
    await figure.element.evaluate(element => element.scrollIntoView({ block: 'start', behavior: 'instant' }))
    await figure.settled()
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(380)
    const client = await page.context().newCDPSession(page)
    const touch = (type: 'touchStart' | 'touchMove' | 'touchEnd', ...touchPoints: { x: number; y: number }[]) =>
      client.send('Input.dispatchTouchEvent', { type, touchPoints })
    const swipe = async (x: number, y: number, dx: number, dy: number) => {
      await touch('touchStart', { x, y })
      for (let i = 1; i <= 10; i++) {
        await touch('touchMove', { x: x + (dx * i) / 10, y: y + (dy * i) / 10 })
        await frames(page, 1)
      }
      await touch('touchEnd')
      await frames(page, 10) // a swipe may roll on
    }
    const grip = (await figure.handle('landmark').boundingBox())!
    const before = await page.evaluate(() => scrollY)
    await swipe(grip.x + grip.width / 2, grip.y + grip.height / 2, -45, -15)
    await figure.settled()
    expect(await page.evaluate(() => scrollY)).toBe(before)
    const x = await figure.box('landmark-x').inputValue()
    expect(Number(x)).toBeLessThan(2.2)
    const canvas = (await figure.canvas.boundingBox())!
    await swipe(canvas.x + 60, canvas.y + 260, 0, -200)
    await expect.poll(() => page.evaluate(() => scrollY)).toBeGreaterThan(before + 100)
    await expect(figure.box('landmark-x')).toHaveValue(x)
  })
})

test('axe finds nothing while a guess is asked for, of a link that asks too much and is told of it, on a page and on a dark phone', async ({ page }) => {
  const figure = await open(page, 'predict=on&landmarks=pair&range-std=7&landmark-x=1.5')
  await expect(figure.alert).toContainText('range-std')
  await expect(figure.alert).toContainText('from 0.005 to 0.5 m')
  await figure.openSettings()
  await expect(figure.box('landmark-x')).toHaveValue('1.5')
  expect(await brokenRules(page, { of: 'fastslam-proposal' })).toEqual([])
  await page.setViewportSize({ width: 380, height: 800 })
  await page.emulateMedia({ colorScheme: 'dark' })
  await figure.settled()
  expect(await brokenRules(page, { of: 'fastslam-proposal' })).toEqual([])
})
