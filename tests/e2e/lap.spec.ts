// What a reader does with the lap.
import { readFile } from 'node:fs/promises'
import { expect, test } from './fixtures'
import { Figure, frames } from './figure'

test.describe('at rest', () => {
  test.use({ contextOptions: { reducedMotion: 'reduce' } })

  test('it says what it shows before anyone touches it, and does not play by itself', async ({ page }) => {
    await page.clock.install()
    const lap = await new Figure(page, 'fastslam-lap').alone()
    await expect(lap.sentence).toContainText(/\d/)
    expect(Object.keys(await lap.readouts())).toEqual(expect.arrayContaining(['step']))
    const before = await lap.position()
    await page.clock.runFor(1000)
    expect(await lap.position()).toBe(before)
    await expect(lap.play).toBeVisible()
  })

  test('it plays and pauses', async ({ page }) => {
    const lap = await new Figure(page, 'fastslam-lap').alone()
    await lap.play.click()
    await expect.poll(() => lap.position()).toBeGreaterThan(2)
    await lap.pause.click()
    await lap.settled()
    const [at, readouts] = [await lap.position(), await lap.readouts()]
    expect(await lap.playing()).toBe(false)
    await frames(page, 30)
    expect(await lap.position()).toBe(at)
    expect(await lap.readouts()).toEqual(readouts)
  })

  test('it stops at the last step, and plays from the first again', async ({ page }) => {
    const lap = await new Figure(page, 'fastslam-lap').alone('#fastslam-lap?universes=4')
    const last = await lap.last()
    await lap.scrubTo(last - 1)
    await lap.play.click()
    await expect.poll(() => lap.position()).toBe(last)
    await expect(lap.play).toBeVisible()
    await expect(lap.step).toBeDisabled()
    await lap.play.click()
    await expect.poll(() => lap.position()).toBeLessThan(last)
  })

  test('a step back shows the same numbers and the same pixels as before the step', async ({ page }) => {
    const lap = await new Figure(page, 'fastslam-lap').alone()
    await expect(lap.stepBack).toBeDisabled()
    await lap.scrubTo(7)
    const before = [await lap.readouts(), await lap.picture()]
    await lap.step.click()
    await lap.settled()
    expect(await lap.position()).toBe(8)
    const after = [await lap.readouts(), await lap.picture()]
    expect(after).not.toEqual(before)
    await lap.stepBack.click()
    await lap.settled()
    expect([await lap.readouts(), await lap.picture()]).toEqual(before)
    await lap.step.click()
    await lap.settled()
    expect([await lap.readouts(), await lap.picture()]).toEqual(after)
  })

  test('the timeline is scrubbed by a drag of the pointer', async ({ page }) => {
    const lap = await new Figure(page, 'fastslam-lap').alone()
    await lap.scrub.scrollIntoViewIfNeeded()
    const box = (await lap.scrub.boundingBox())!
    const y = box.y + box.height / 2
    await page.mouse.move(box.x + 8, y)
    await page.mouse.down()
    await page.mouse.move(box.x + box.width / 2, y, { steps: 8 })
    await page.mouse.up()
    await lap.settled()
    const last = await lap.last()
    expect(await lap.position()).toBeGreaterThan(last * 0.4)
    expect(await lap.position()).toBeLessThan(last * 0.6)
  })

  test('dragging a slider simulates anew up to the step shown, and back gives the same numbers', async ({ page }) => {
    const lap = await new Figure(page, 'fastslam-lap').alone('#fastslam-lap?universes=4')
    await lap.openSettings()
    await lap.scrubTo(12)
    const before = await lap.readouts()
    for (const name of ['odometry', 'range-std', 'universes']) {
      const value = await lap.box(name).inputValue()
      const slider = lap.slider(name)
      await slider.scrollIntoViewIfNeeded()
      const box = (await slider.boundingBox())!
      const y = box.y + box.height / 2
      const [min, max, at] = await slider.evaluate((range: HTMLInputElement) => [
        Number(range.min),
        Number(range.max),
        range.valueAsNumber,
      ])
      await page.mouse.move(box.x + 8 + ((at! - min!) / (max! - min!)) * (box.width - 16), y)
      await page.mouse.down()
      await page.mouse.move(box.x + box.width * 0.2, y, { steps: 6 })
      await page.mouse.up()
      await lap.settled()
      expect(await lap.box(name).inputValue()).not.toBe(value)
      expect(await lap.position()).toBe(12)
      expect(await lap.readouts(), name).not.toEqual(before)
      await lap.box(name).fill(value)
      await lap.box(name).press('Enter')
      await lap.settled()
      expect(await lap.readouts(), name).toEqual(before)
    }
  })

  test('every switch of the filter can be turned, and gives another lap or another picture', async ({ page }) => {
    const lap = await new Figure(page, 'fastslam-lap').alone('#fastslam-lap?universes=4')
    await lap.openSettings()
    await lap.scrubTo(25)
    const before = await lap.readouts()
    for (const [name, value] of [
      ['proposal', 'motion'],
      ['matcher', 'cell'],
      ['policy', 'never'],
    ] as const) {
      const choice = lap.element.locator(`select[name=${name}]`)
      const initial = await choice.inputValue()
      await choice.selectOption(value)
      await lap.settled()
      expect(await lap.readouts(), name).not.toEqual(before)
      await choice.selectOption(initial)
      await lap.settled()
      expect(await lap.readouts(), name).toEqual(before)
    }
    for (const name of ['truth', 'raw']) {
      const picture = await lap.picture()
      await lap.element.locator(`input[name=${name}]`).click()
      await lap.settled()
      expect(await lap.picture(), name).not.toBe(picture)
      expect(await lap.readouts(), name).toEqual(before)
    }
  })

  test('all universes are laid over each other until a tile is picked, and again when it is let go', async ({ page }) => {
    const lap = await new Figure(page, 'fastslam-lap').alone()
    await lap.scrubTo(84)
    const all = await lap.picture()
    await expect(lap.sentence).toContainText('16 universes, overlaid')
    const box = (await lap.canvas.boundingBox())!
    // The last column of the mosaic.
    const tile = { x: box.x + box.width - 20, y: box.y + 60 }
    await page.mouse.click(tile.x, tile.y)
    await lap.settled()
    await expect(lap.sentence).toContainText(/Shown large is universe \d/)
    expect(await lap.picture()).not.toBe(all)
    await page.mouse.click(tile.x, tile.y)
    await lap.settled()
    expect(await lap.picture()).toBe(all)
    await lap.element.locator('input[name=overlay]').click()
    await lap.settled()
    await expect(lap.sentence).toContainText(/Shown large is universe \d+, the best/)
  })

  test('the seed is re-rolled, shown and typed', async ({ page }) => {
    const lap = await new Figure(page, 'fastslam-lap').alone()
    await lap.scrubTo(10)
    const [seed, before] = [await lap.seed.inputValue(), await lap.readouts()]
    await lap.reroll.click()
    await lap.settled()
    expect(await lap.seed.inputValue()).not.toBe(seed)
    expect(await lap.readouts()).not.toEqual(before)
    await lap.seed.fill(seed)
    await lap.seed.press('Enter')
    await lap.settled()
    expect(await lap.readouts()).toEqual(before)
  })

  test('a universe is chosen by a click and by its list, and the best one again', async ({ page }) => {
    const lap = await new Figure(page, 'fastslam-lap').alone()
    await lap.scrubTo(20)
    await lap.openSettings()
    const list = lap.element.locator('select[name=universe]')
    await expect(list).toHaveValue('best')
    const best = await lap.picture()
    // Somewhere on the canvas there are tiles: the first point of a grid of points that chooses one will do.
    const { width, height } = (await lap.canvas.boundingBox())!
    for (let i = 0; i < 64 && (await list.inputValue()) === 'best'; i++) {
      await lap.canvas.click({ position: { x: (width * ((i % 8) + 0.5)) / 8, y: (height * (Math.floor(i / 8) + 0.5)) / 8 } })
      await lap.settled()
    }
    expect(Number(await list.inputValue())).toBeGreaterThanOrEqual(0)
    await list.selectOption('best')
    await lap.element.getByRole('checkbox', { name: 'Overlay all' }).click() // whoever picks one wants to see it alone
    await lap.settled()
    expect(await lap.picture()).toBe(best)
    await lap.openSettings()
    await lap.box('universes').fill('4')
    await lap.box('universes').press('Enter')
    await lap.settled()
    expect(await list.locator('option').count()).toBe(5)
  })

  test('Reset goes back to what the page gave', async ({ page }) => {
    const lap = await new Figure(page, 'fastslam-lap').alone()
    const before = [await lap.readouts(), await lap.seed.inputValue(), await lap.picture()]
    await lap.scrubTo(9)
    await lap.reroll.click()
    await lap.reset.click()
    await lap.settled()
    expect([await lap.readouts(), await lap.seed.inputValue(), await lap.picture()]).toEqual(before)
  })

  test('data and picture are saved as files', async ({ page }) => {
    const lap = await new Figure(page, 'fastslam-lap').alone()
    await lap.scrubTo(5)
    const save = async (item: string) => {
      const [file] = await Promise.all([page.waitForEvent('download'), lap.menu(item)])
      return { name: file.suggestedFilename(), body: await readFile(await file.path()) }
    }
    const csv = await save('Save data (CSV)')
    expect(csv.name).toBe('fastslam-lap-step-5.csv')
    const lines = csv.body.toString().trim().split('\n')
    expect(lines[0]).toContain('step')
    expect(lines.length).toBeGreaterThanOrEqual(1 + 6) // the heading, and steps 0 to 5
    for (const line of lines) expect(line.split(',').length).toBe(lines[0]!.split(',').length)
    const json = await save('Save data (JSON)')
    expect(json.name).toBe('fastslam-lap-step-5.json')
    expect(() => JSON.parse(json.body.toString())).not.toThrow()
    const png = await save('Save picture (PNG)')
    expect(png.name).toBe('fastslam-lap-step-5.png')
    expect(png.body.subarray(1, 4).toString()).toBe('PNG')
  })

  test('events bubble out of the figure with step, values and readouts', async ({ page }) => {
    const lap = await new Figure(page, 'fastslam-lap').alone()
    await page.evaluate(() => {
      const told: unknown[] = ((window as unknown as { told: unknown[] }).told = [])
      for (const type of ['fastslam-step', 'fastslam-change']) {
        document.addEventListener(type, event => {
          const { localName } = event.target as Element
          if (localName === 'fastslam-lap') told.push([type, localName, (event as CustomEvent).detail])
        })
      }
    })
    await lap.step.click()
    await lap.settled()
    await lap.element.locator('input[name=truth]').click()
    await lap.settled()
    const told = await page.evaluate(
      () =>
        (
          window as unknown as {
            told: [string, string, { step: number; values: Record<string, string>; readouts: { name: string; text: string }[] }][]
          }
        ).told,
    )
    expect(told.map(([type, target]) => `${type} ${target}`)).toEqual([
      'fastslam-step fastslam-lap',
      'fastslam-change fastslam-lap',
    ])
    expect(told[0]![2].step).toBe(1)
    expect(told[1]![2].values['truth']).toBe((await lap.element.locator('input[name=truth]').isChecked()) ? 'on' : 'off')
    expect(told[1]![2].readouts.length).toBe(Object.keys(await lap.readouts()).length)
  })
})

test.describe('where motion is welcome', () => {
  test.use({ contextOptions: { reducedMotion: 'no-preference' } })

  test('it plays when first seen, stops out of sight, and does nothing there', async ({ page }) => {
    await page.setViewportSize({ width: 1000, height: 700 })
    const lap = await new Figure(page, 'fastslam-lap').alone()
    await lap.canvas.evaluate(canvas => canvas.scrollIntoView({ block: 'center', behavior: 'instant' }))
    await expect.poll(() => lap.position()).toBeGreaterThan(3)
    // Away, just below the window and far: the page is lengthened so that the figure can leave it entirely.
    for (const distance of ['750px', '3000px']) {
      await page.evaluate(distance => {
        document.body.style.paddingTop = distance
        scrollTo({ top: 0, behavior: 'instant' })
      }, distance)
      await expect.poll(() => lap.playing(), 'it waits').toBe(false)
      const away = await lap.position()
      await frames(page, 60)
      expect(await lap.position(), distance).toBe(away)
      await lap.canvas.evaluate(canvas => canvas.scrollIntoView({ block: 'center', behavior: 'instant' }))
      await expect.poll(() => lap.position()).toBeGreaterThan(away)
    }
  })

  test('the first touch of a control ends the autoplay for good', async ({ page }) => {
    const lap = await new Figure(page, 'fastslam-lap').alone()
    await lap.canvas.evaluate(canvas => canvas.scrollIntoView({ block: 'center', behavior: 'instant' }))
    await lap.pause.click()
    await page.evaluate(() => scrollTo({ top: 0, behavior: 'instant' }))
    await lap.canvas.evaluate(canvas => canvas.scrollIntoView({ block: 'center', behavior: 'instant' }))
    await lap.settled()
    const at = await lap.position()
    expect(await lap.playing()).toBe(false)
    await frames(page, 30)
    expect(await lap.position()).toBe(at)
  })
})
