// What a reader does with the three filters, and with the count over many seeds.
import type { Locator, Page } from '@playwright/test'
import { brokenRules } from './axe'
import { expect, test } from './fixtures'
import { Figure, openChapterOf } from './figure'
import { breadth } from './host'

/** Few particles, where it does not matter how many. */
const FEW = 'particles=6'

const open = (page: Page, query?: string) => new Figure(page, 'fastslam-resampling').alone(query && `#fastslam-resampling?v=4&${query}`)

/** The step that is read. */
async function cursor(figure: Figure): Promise<string> {
  return figure.element.locator('select[name=cursor]').inputValue()
}

/** A point of the page over the curves, by a share of the timeline: its ends come from the handle. */
async function overCurves(figure: Figure, share: number): Promise<{ x: number; y: number }> {
  await figure.openSettings()
  const middle = async (step: string) => {
    await figure.element.locator('select[name=cursor]').selectOption(step)
    await figure.settled()
    const box = (await figure.handle('cursor').boundingBox())!
    return [box.x + box.width / 2, box.y + box.height / 2] as const
  }
  await figure.handle('cursor').evaluate(handle => handle.scrollIntoView({ block: 'center', behavior: 'instant' }))
  const [x0, y] = await middle('0')
  const [x1] = await middle('10')
  return { x: x0 + ((x1 - x0) / 10) * share * (await figure.last()), y }
}

/** The count over seeds, folded away below the figure. */
function panel(figure: Figure): { start: Locator; stop: Locator; progress: Locator; shares: Locator; said: Locator; runs: Locator } {
  const element = figure.element.locator('[part=count]')
  return {
    start: element.getByRole('button', { name: /^Count over/ }),
    stop: element.getByRole('button', { name: 'Stop', exact: true }),
    progress: element.getByRole('progressbar', { name: 'Seeds counted' }),
    shares: element.locator('td.share'),
    said: element.locator('.said'),
    runs: element.getByRole('combobox', { name: 'Number of seeds' }),
  }
}

const counted = (figure: Figure) => panel(figure).progress.evaluate((bar: HTMLProgressElement) => bar.value)

test('it plays when it is seen, and stops at the end', async ({ page }) => {
  const figure = await open(page, 'particles=4&step=84')
  await figure.play.click()
  await expect.poll(() => figure.position()).toBe(await figure.last())
  await expect(figure.play).toBeVisible()
  expect((await figure.readouts())['always_lineage']).toBe('1 of 4')
})

test.describe('at rest', () => {
  test.use({ contextOptions: { reducedMotion: 'reduce' } })

  test('a step back shows the same as the way forward, and scrubbing goes anywhere', async ({ page }) => {
    const figure = await open(page)
    await expect(figure.sentence).toContainText('nothing has been weighed')
    await figure.scrubTo(30)
    const before = [await figure.readouts(), await figure.picture()]
    await figure.step.click()
    await figure.settled()
    expect(await figure.picture()).not.toBe(before[1])
    await figure.stepBack.click()
    await figure.settled()
    expect([await figure.readouts(), await figure.picture()]).toEqual(before)
    await figure.scrubTo(3)
    await figure.scrubTo(30)
    expect([await figure.readouts(), await figure.picture()]).toEqual(before)
  })

  test('the pointer over the curves reads a step until it leaves, a click keeps it, and time takes the cursor along', async ({ page }) => {
    const figure = await open(page, `${FEW}&step=60`)
    const at = await overCurves(figure, 1 / 3)
    await figure.element.locator('select[name=cursor]').selectOption('now')
    await page.mouse.move(5, 5)
    await page.mouse.move(at.x, at.y, { steps: 3 })
    await figure.settled()
    expect(await cursor(figure)).toBe('30')
    await expect(figure.sentence).toContainText('Step 30 of 90')
    expect((await figure.readouts())['always_resampled']).toBe('30 of 30steps')
    await page.mouse.move(5, 5)
    await figure.settled()
    expect(await cursor(figure), 'what is pointed at is let go').toBe('now')
    await expect(figure.sentence).toContainText('Step 60 of 90')
    await page.mouse.click(at.x, at.y)
    await page.mouse.move(at.x + 40, at.y)
    await page.mouse.move(5, 5)
    await figure.settled()
    expect(await cursor(figure), 'what was clicked stays').toBe('30')
    await figure.step.click()
    await figure.settled()
    expect(await cursor(figure)).toBe('now')
    await expect(figure.sentence).toContainText('Step 61 of 90')
  })

  test('the cursor takes the focus and moves by arrow keys', async ({ page }) => {
    const figure = await open(page, `${FEW}&step=40`)
    const [handle, picture] = [figure.grasp('cursor'), await figure.picture()]
    await handle.focus()
    await page.keyboard.press('ArrowLeft')
    await page.keyboard.press('Shift+ArrowLeft')
    await figure.settled()
    expect(await cursor(figure)).toBe('29')
    await expect(handle).toHaveAttribute('aria-valuetext', /^step 29: never N_eff \d/)
    expect(await figure.picture()).not.toBe(picture)
    await expect(handle).toBeFocused()
    await page.keyboard.press('Shift+ArrowRight')
    await page.keyboard.press('Alt+ArrowRight')
    await figure.settled()
    expect(await cursor(figure)).toBe('now')
    expect(await figure.picture()).toBe(picture)
  })

  test('the loop of ambiguity is another course, and the way back gives the same lap', async ({ page }) => {
    const figure = await open(page, 'step=50')
    const before = [await figure.readouts(), await figure.last()]
    await figure.toggle('wings').click()
    await figure.settled()
    expect(await figure.last()).toBeGreaterThan(90)
    await figure.scrubTo(100)
    expect((await figure.readouts())['selective_right']).toMatch(/^\d+ of 16$/)
    await expect(figure.sentence).toContainText('right wing')
    expect(Object.keys(await figure.readouts())).not.toContain('selective_resampled')
    await figure.toggle('wings').click()
    await figure.scrubTo(50)
    expect([await figure.readouts(), await figure.last()]).toEqual(before)
  })

  for (const [names, options] of [[['particles', 'threshold'], {}], [['odometry', 'range'], breadth]] as const) {
    test(`dragging ${names.join(' or ')} changes the filters, and back gives the same numbers`, options, async ({ page }) => {
      const figure = await open(page, 'step=25')
      for (const name of names) await figure.expectSliderAndBack(name)
    })
  }

  test('a click on a map shows the tree of its policy, and the list says which', async ({ page }) => {
    const figure = await open(page, `${FEW}&step=60`)
    const policy = figure.element.locator('select[name=policy]')
    await expect(policy).toHaveValue('selective')
    const [before, numbers] = [await figure.picture(), await figure.readouts()]
    const box = (await figure.canvas.boundingBox())!
    await page.mouse.click(box.x + 0.05 * box.width, box.y + 0.15 * box.height)
    await figure.settled()
    await expect(policy).toHaveValue('never')
    expect(await figure.picture()).not.toBe(before)
    expect(await figure.readouts()).toEqual(numbers)
    await policy.selectOption('selective')
    await figure.settled()
    expect(await figure.picture()).toBe(before)
  })

  test('the threshold is dragged by its line, and its arrow keys go up and down', async ({ page }) => {
    const figure = await open(page, `${FEW}&step=30`)
    const handle = figure.handle('threshold')
    await handle.evaluate(handle => handle.scrollIntoView({ block: 'center', behavior: 'instant' }))
    const { x, y, width, height } = (await handle.boundingBox())!
    await page.mouse.move(x + width / 2, y + height / 2)
    await page.mouse.down()
    await page.mouse.move(x + width / 2 + 40, y + height / 2 - 20, { steps: 3 })
    await page.mouse.up()
    await figure.settled()
    const dragged = Number(await figure.box('threshold').inputValue())
    expect(dragged).toBeGreaterThan(0.6)
    expect(Math.round(20 * dragged) / 20, 'by steps of its slider').toBeCloseTo(dragged)
    expect(await figure.position(), 'the step is the same').toBe(30)
    await figure.grasp('threshold').focus()
    await page.keyboard.press('ArrowDown')
    await figure.settled()
    expect(Number(await figure.box('threshold').inputValue())).toBeCloseTo(dragged - 0.05)
    await expect(figure.grasp('threshold')).toHaveAttribute('aria-valuetext', / M$/)
    await expect(figure.grasp('threshold')).toBeFocused()
  })

  test('what the picture says is not written a second time', async ({ page }) => {
    const figure = await open(page, `${FEW}&step=30`)
    await figure.openNumbers()
    const rows = await figure.element.locator('[part=readout]:visible').evaluateAll(rows => rows.map(row => (row as HTMLElement).dataset['name']))
    expect(rows).toEqual(['never_tree', 'always_tree', 'selective_tree'])
  })

  test('its link brings back the whole state', async ({ page }) => {
    const figure = await open(page)
    await figure.openSettings()
    await figure.toggle('wings').click()
    await figure.box('particles').fill('9')
    await figure.box('particles').press('Enter')
    await figure.box('back').fill('5')
    await figure.box('back').press('Enter')
    await figure.scrubTo(85)
    await figure.grasp('cursor').focus()
    await page.keyboard.press('Shift+ArrowLeft')
    await figure.menu('Compare with nothing') // what was set before is in no link
    await figure.settled()
    const before = [await figure.readouts(), await cursor(figure), await figure.picture()]
    const link = await figure.element.evaluate((element: HTMLElement & { link: string }) => element.link)
    expect(link).toContain('#fastslam-resampling?')
    await page.goto('about:blank')
    const again = await new Figure(page, 'fastslam-resampling').open(link)
    expect([await again.readouts(), await cursor(again), await again.picture()]).toEqual(before)
  })

  test('the count runs beside the page, to the end, and says its result once', async ({ page }) => {
    const figure = await open(page, 'particles=4')
    await figure.openCount()
    const { start, stop, shares, said, runs } = panel(figure)
    await runs.selectOption('50')
    await expect(stop).toBeDisabled()
    await start.click()
    await expect(stop).toBeEnabled()
    await expect.poll(() => counted(figure)).toBeGreaterThan(0)
    // The page goes on meanwhile.
    await figure.step.click()
    await figure.settled()
    await expect(said).toContainText('50 seeds counted.', { timeout: 45_000 })
    expect(await counted(figure)).toBe(50)
    for (const text of await shares.allTextContents()) expect(text).toMatch(/^\d+ % \(\d+–\d+\)$/)
    await expect(start).toBeEnabled()
    // The same numbers again: seeds are seeds.
    const first = await shares.allTextContents()
    await start.click()
    await expect.poll(() => shares.allTextContents(), { timeout: 45_000 }).toEqual(first)
    await expect(said).toContainText('50 seeds counted.', { timeout: 45_000 })
    expect(await shares.allTextContents()).toEqual(first)
  })

  test('the count can be stopped, and begins again when a setting changes', async ({ page }) => {
    const figure = await open(page)
    await figure.openCount()
    const { start, stop, said, runs } = panel(figure)
    const share = Math.min(2, await page.evaluate(() => navigator.hardwareConcurrency))
    let workers = 0
    page.on('worker', () => workers++)
    await runs.selectOption('1000')
    await start.click()
    await expect.poll(() => counted(figure)).toBeGreaterThan(5)
    await figure.openSettings()
    await figure.box('threshold').fill('0.9')
    await figure.box('threshold').press('Enter')
    await expect.poll(() => workers, 'as many once more').toBe(2 * share)
    await expect.poll(() => counted(figure)).toBeGreaterThan(2)
    // What only concerns the picture does not disturb it.
    await figure.step.click()
    await figure.settled()
    await stop.click()
    expect(workers).toBe(2 * share)
    await expect(said).toContainText(/^Stopped after \d+ of 1000 seeds/)
    const stopped = await counted(figure)
    expect(stopped).toBeGreaterThan(2)
    await expect.poll(() => page.workers().length).toBe(0)
    expect(await counted(figure)).toBe(stopped)
    await figure.box('threshold').fill('0.2')
    await figure.box('threshold').press('Enter')
    await expect(said).toContainText('count again')
    expect(await counted(figure)).toBe(0)
  })

  test('the program is not fetched again for the count, which ends when the figure leaves the page', async ({ page }) => {
    const fetched: string[] = []
    page.on('request', request => /wasm$/.test(request.url()) && fetched.push(request.url()))
    const figure = await open(page)
    await figure.openCount()
    await panel(figure).runs.selectOption('1000')
    await panel(figure).start.click()
    await expect.poll(() => counted(figure)).toBeGreaterThan(0)
    expect(page.workers()).toHaveLength(Math.min(2, await page.evaluate(() => navigator.hardwareConcurrency)))
    expect(fetched).toHaveLength(1)
    await figure.element.evaluate(element => element.remove())
    await expect.poll(() => page.workers().length).toBe(0)
  })

  test('axe finds nothing in it, counted and open, light and dark', async ({ page }) => {
    const figure = await open(page, 'wings=on&particles=4&step=80&cursor=70')
    await figure.openSettings()
    await figure.openNumbers()
    await figure.openCount()
    await panel(figure).runs.selectOption('50')
    await panel(figure).start.click()
    await expect(panel(figure).said).toContainText('50 seeds counted.', { timeout: 45_000 })
    for (const colorScheme of ['light', 'dark'] as const) {
      await page.emulateMedia({ colorScheme })
      await figure.settled()
      expect(await brokenRules(page, { of: 'fastslam-resampling' }), colorScheme).toEqual([])
    }
  })

  test('where workers are forbidden it says so, and the figure goes on', async ({ page, complaints }) => {
    await openChapterOf(page, ['fastslam-resampling'], sent => ({
      ...sent,
      'content-security-policy': sent['content-security-policy']!.replace("worker-src 'self'", "worker-src 'none'"),
    }))
    const figure = new Figure(page, 'fastslam-resampling')
    await figure.live()
    await figure.openCount()
    await panel(figure).start.click()
    await expect(panel(figure).said).toContainText('allows nothing to run in the background')
    await expect(panel(figure).start).toBeEnabled()
    const before = await figure.position()
    await figure.stepBack.click()
    await figure.settled()
    expect(await figure.position()).toBe(before - 1)
    complaints.splice(0, Infinity, ...complaints.filter(line => !/worker/i.test(line)))
  })
})

test.describe('on a phone', () => {
  test.use({ viewport: { width: 380, height: 800 }, hasTouch: true, isMobile: true, contextOptions: { reducedMotion: 'reduce' } })

  test('a tap on a curve reads its step, and nothing is wider than the screen', async ({ page }) => {
    const figure = await open(page, `${FEW}&step=60`)
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(380)
    const at = await overCurves(figure, 0.5)
    await page.touchscreen.tap(at.x, at.y)
    await figure.settled()
    expect(Math.abs(Number(await cursor(figure)) - 45)).toBeLessThanOrEqual(1)
    await figure.openCount()
    await panel(figure).start.tap()
    await expect.poll(() => counted(figure)).toBeGreaterThan(0)
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(380)
  })
  test('a tab shows the map and the tree of its policy', async ({ page }) => {
    const figure = await open(page, `${FEW}&step=60&wings=on`)
    const policy = figure.element.locator('select[name=policy]')
    const pictures = new Set([await figure.picture()])
    await figure.canvas.scrollIntoViewIfNeeded()
    for (const [name, share] of [['never', 1 / 6], ['always', 1 / 2]] as const) {
      const { x, y, width } = (await figure.canvas.boundingBox())!
      await page.touchscreen.tap(x + share * width, y + 20)
      await figure.settled()
      await expect(policy).toHaveValue(name)
      pictures.add(await figure.picture())
    }
    expect(pictures.size).toBe(3)
  })
})
