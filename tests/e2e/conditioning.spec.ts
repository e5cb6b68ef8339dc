// What a reader does with the graphical model.
import { brokenRules } from './axe'
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { breadth } from './host'

const open = (page: import('@playwright/test').Page) => new Figure(page, 'fastslam-conditioning').alone()

/** The row and the column of the entry that is named. */
async function entry(figure: Figure): Promise<[number, number]> {
  return [Number(await figure.box('row').inputValue()), Number(await figure.box('column').inputValue())]
}

/** A point of the page that lies in the matrix, by shares of its width and height: its corner and size come from two entries. */
async function inMatrix(figure: Figure, across: number, down: number): Promise<{ x: number; y: number }> {
  await figure.openSettings()
  const middle = async (row: number, column: number) => {
    await figure.box('row').fill(String(row))
    await figure.box('row').press('Enter')
    await figure.box('column').fill(String(column))
    await figure.box('column').press('Enter')
    await figure.settled()
    const [box, canvas] = [(await figure.handle('entry').boundingBox())!, (await figure.canvas.boundingBox())!]
    return [box.x + box.width / 2 - canvas.x, box.y + box.height / 2 - canvas.y] as const
  }
  const last = Number(await figure.box('row').getAttribute('max'))
  const [x0, y0] = await middle(1, 1)
  const [x1, y1] = await middle(last, last)
  // Where nothing of the picture is scrolled over.
  await figure.element.evaluate(element => element.scrollIntoView({ block: 'start', behavior: 'instant' }))
  await figure.settled()
  const canvas = (await figure.canvas.boundingBox())!
  return { x: canvas.x + x0 + across * (x1 - x0), y: canvas.y + y0 + down * (y1 - y0) }
}

test.describe('at rest', () => {
  test.use({ contextOptions: { reducedMotion: 'reduce' } })

  test('it says what it shows before anyone touches it, and the toggle makes every entry off the blocks 0, by mouse and by keyboard, and brings them back', async ({ page }) => {
    const figure = await open(page)
    await expect(figure.sentence).toContainText('no pose saw both')
    expect((await figure.readouts())['off_block']).toMatch(/^[1-9]\d* of \d+$/)
    const toggle = figure.toggle('condition')
    const [before, picture] = [await figure.readouts(), await figure.picture()]
    await toggle.click()
    await figure.settled()
    await expect(toggle).toHaveAttribute('aria-pressed', 'true')
    const given = await figure.readouts()
    expect(given['off_block']).toMatch(/^0 of [1-9]\d*$/)
    expect([given['largest'], given['mean'], given['rho']]).toEqual(['0', '0', '0'])
    expect(await figure.picture()).not.toBe(picture)
    await expect(figure.sentence).toContainText('stands alone')
    await toggle.focus()
    await page.keyboard.press('Enter')
    await figure.settled()
    await expect(toggle).toHaveAttribute('aria-pressed', 'false')
    expect([await figure.readouts(), await figure.picture()]).toEqual([before, picture])
    await page.keyboard.press('Space')
    await figure.settled()
    expect(await figure.readouts()).toEqual(given)
  })

  test('the pointer over the matrix names the entry below until it leaves, a click keeps it, and arrow keys move it', async ({ page }) => {
    const figure = await open(page)
    const handle = figure.grasp('entry')
    const at = await inMatrix(figure, 0, 0.5)
    const before = await entry(figure)
    await page.mouse.move(5, 5)
    await page.mouse.move(at.x, at.y, { steps: 3 })
    await figure.settled()
    expect((await entry(figure))[1]).toBe(1)
    const [row] = await entry(figure)
    expect(row).toBeGreaterThan(1)
    const pointed = (await handle.getAttribute('aria-valuetext'))!
    expect(pointed).toMatch(/^m\d+\.[xy] and m1\.x: ρ = −?\d/)
    await expect(figure.sentence).toContainText(pointed)
    await page.mouse.move(5, 5)
    await figure.settled()
    expect(await entry(figure), 'what is pointed at is let go').toEqual(before)
    await page.mouse.click(at.x, at.y)
    await page.mouse.move(5, 5)
    await figure.settled()
    expect(await entry(figure)).toEqual([row, 1])

    const [words, picture] = [await handle.getAttribute('aria-valuetext'), await figure.picture()]
    await handle.focus()
    await page.keyboard.press('ArrowRight')
    await page.keyboard.press('ArrowDown')
    await figure.settled()
    expect(await entry(figure)).toEqual([row + 1, 2])
    expect(await handle.getAttribute('aria-valuetext')).not.toBe(words)
    expect(await figure.picture()).not.toBe(picture)
    await expect(handle).toBeFocused()
    for (let i = 0; i < 9; i++) await page.keyboard.press('ArrowRight')
    await page.keyboard.press('Alt+ArrowUp')
    await page.keyboard.press('Shift+ArrowLeft')
    await figure.settled()
    expect(await entry(figure)).toEqual([row, 1])
  })

  test('axe finds nothing, with the path unknown and known, light and dark', async ({ page }) => {
    const figure = await open(page)
    await figure.openSettings()
    for (const _ of ['unknown', 'known']) {
      for (const colorScheme of ['light', 'dark'] as const) {
        await page.emulateMedia({ colorScheme })
        await figure.settled()
        expect(await brokenRules(page, { of: 'fastslam-conditioning' }), colorScheme).toEqual([])
      }
      await figure.toggle('condition').click()
      await figure.settled()
    }
  })

  test('dragging any slider changes what is known, and back gives the same numbers', async ({ page }) => {
    const figure = await open(page)
    for (const name of ['odometry', 'range-std', 'landmarks', 'poses']) await test.step(name, () => figure.expectSliderAndBack(name))
  })

  test('the buttons stand between graph and matrix, and one of path and last pose holds at a time', async ({ page }) => {
    const figure = await open(page)
    const { off_block } = await figure.readouts()
    const canvas = (await figure.canvas.boundingBox())!
    for (const name of ['condition', 'last-pose', 'pairs']) {
      const { x, y, width, height } = (await figure.toggle(name).boundingBox())!
      expect(x > canvas.x && x + width < canvas.x + canvas.width && y > canvas.y && y + height < canvas.y + canvas.height, name).toBe(true)
    }
    const press = async (name: string) => {
      await figure.toggle(name).click()
      await figure.settled()
      return Promise.all(['condition', 'last-pose', 'pairs'].map(name => figure.toggle(name).getAttribute('aria-pressed')))
    }
    expect(await press('last-pose')).toEqual(['false', 'true', 'false'])
    // The poses before it are open: as many entries as before.
    expect(await figure.readouts()).toMatchObject({ off_block })
    await expect(figure.sentence).toContainText('Given the last pose alone')
    expect(await press('condition')).toEqual(['true', 'false', 'false'])
    expect((await figure.readouts())['off_block']).toMatch(/^0 of /)
    expect(await press('pairs')).toEqual(['true', 'false', 'true'])
    expect((await figure.readouts())['off_block']).not.toMatch(/^0 of /)
    await expect(figure.sentence).toContainText('read together')
  })

  test('the drive is made pose by pose, and played from its start', async ({ page }) => {
    const figure = await open(page)
    const last = await figure.last()
    expect(await figure.position()).toBe(last)
    const end = await figure.picture()
    await figure.stepBack.click()
    await figure.settled()
    expect(await figure.position()).toBe(last - 1)
    expect(await figure.picture()).not.toBe(end)
    await figure.scrubTo(0)
    await expect(figure.sentence).toContainText('known start')
    await figure.play.click()
    await expect.poll(() => figure.position()).toBe(last)
    await figure.settled()
    expect(await figure.picture()).toBe(end)
  })

  test('its link brings back the whole state', breadth, async ({ page }) => {
    const figure = await open(page)
    await figure.openSettings()
    await figure.toggle('condition').click()
    await figure.box('landmarks').fill('11')
    await figure.box('landmarks').press('Enter')
    await figure.grasp('entry').focus()
    await page.keyboard.press('ArrowLeft')
    await figure.scrubTo(5)
    const before = [await figure.readouts(), await entry(figure), await figure.picture()]
    const link = await figure.element.evaluate((element: HTMLElement & { link: string }) => element.link)
    expect(link).toContain('#fastslam-conditioning?')
    await page.goto('about:blank')
    const again = await new Figure(page, 'fastslam-conditioning').open(link)
    expect([await again.readouts(), await entry(again), await again.picture()]).toEqual(before)
  })
})

test.describe('on a phone', () => {
  test.use({ viewport: { width: 380, height: 800 }, hasTouch: true, isMobile: true, contextOptions: { reducedMotion: 'reduce' } })

  test('a tap on the matrix names the entry, and nothing is wider than the screen', async ({ page }) => {
    const figure = await open(page)
    const width = await page.evaluate(() => document.documentElement.scrollWidth)
    expect(width).toBeLessThanOrEqual(380)
    const at = await inMatrix(figure, 1, 0.25)
    await page.touchscreen.tap(at.x, at.y)
    await figure.settled()
    const last = Number(await figure.box('row').getAttribute('max'))
    const [row, column] = await entry(figure)
    expect(column).toBe(last)
    expect(row).toBeLessThan(last / 2)
    await figure.toggle('condition').tap()
    await figure.settled()
    expect((await figure.readouts())['rho']).toBe('0')
  })
})
