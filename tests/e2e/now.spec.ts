// One now: picture, transport, sentence and readouts tell of the same step, and what a reader throws away can be had back.
import type { Page } from '@playwright/test'
import { Figure } from './figure'
import { expect, test } from './fixtures'
import { openCourse } from './host'

type FigureElement = HTMLElement & { seek(step: number): void; play(): void; settled(): Promise<void> }

/** What the parts of a figure say at one moment; the picture by all of its pixels. */
interface Moment {
  transport: number
  sentence: number
  readout: number
  picture: number
  universes: number
}

/** A lap of which the large map alone is shown: with the paths of all, it is another one at every step. */
async function openLap(page: Page, attributes: string): Promise<Figure> {
  await openCourse(page, `<fastslam-lap show="map" ${attributes}></fastslam-lap>`)
  const lap = new Figure(page, 'fastslam-lap')
  await lap.live()
  await lap.element.evaluate(element => {
    const figure = element
    const root = figure.shadowRoot!
    const canvas = root.querySelector('canvas')!
    const number = (selector: string) => Number(/\d+/.exec(root.querySelector(selector)!.textContent)![0])
    const look = (): Moment => {
      const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d', { willReadFrequently: true })!
      copy.drawImage(canvas, 0, 0)
      const { data } = copy.getImageData(0, 0, canvas.width, canvas.height)
      const picture = new Uint32Array(data.buffer).reduce((hash, pixel) => Math.imul(hash ^ pixel, 16777619), 2166136261)
      return { transport: number('.timeline .position'), sentence: number('.described'), readout: number('[data-name=step] dd'), picture, universes: (figure as unknown as { universes: number }).universes }
    }
    Object.assign(window, { look })
  })
  return lap
}

/** The picture of each step, at rest. */
const picturesOf = (lap: Figure, steps: number[]) =>
  lap.element.evaluate(async (element, steps) => {
    const figure = element as FigureElement
    const look = (window as unknown as { look: () => Moment }).look
    const pictures: Record<number, number> = {}
    for (const step of steps) {
      figure.seek(step)
      await figure.settled()
      pictures[step] = look().picture
    }
    return pictures
  }, steps)

/** What is to be seen in every frame until `until` says so. */
function watch(lap: Figure): Promise<void> {
  return lap.element.evaluate(() => {
    const page = window as unknown as { look: () => Moment; seen: Moment[]; watching: boolean }
    page.seen = []
    page.watching = true
    const sample = () => {
      page.seen.push(page.look())
      if (page.watching) requestAnimationFrame(sample)
    }
    requestAnimationFrame(sample)
  })
}

const watched = (lap: Figure) =>
  lap.element.evaluate(() => {
    const page = window as unknown as { seen: Moment[]; watching: boolean }
    page.watching = false
    return page.seen
  })

function expectOneNow(seen: Moment[], pictures: (step: number) => number[]): void {
  for (const { transport, sentence, readout, picture } of seen) {
    expect([sentence, readout], `at ${transport}`).toEqual([transport, transport])
    expect(pictures(transport), `the picture at ${transport}`).toContain(picture)
  }
}

test('while it plays, picture, transport, sentence and readouts tell of one step', async ({ page }) => {
  const lap = await openLap(page, 'universes="2" step="0"')
  const pictures = await picturesOf(lap, Array.from({ length: 40 }, (_, step) => step))
  expect(new Set(Object.values(pictures)).size, 'every step has a picture of its own').toBe(40)
  await lap.scrubTo(0)
  await watch(lap)
  await lap.play.click()
  await expect.poll(() => lap.position()).toBeGreaterThan(12)
  await lap.pause.click()
  const seen = await watched(lap)
  expect(new Set(seen.map(({ transport }) => transport)).size).toBeGreaterThan(10)
  expectOneNow(seen, step => [pictures[step]!])
})

test('while a slider is dragged, the step stays, and the picture until the new one of the same step is there', async ({ page }) => {
  const lap = await openLap(page, 'universes="16" step="45"')
  const before = await lap.picture()
  const atEnd = Object.values(await picturesOf(lap, [45]))
  const slider = lap.slider('universes')
  await slider.scrollIntoViewIfNeeded()
  const { x, y, width, height } = (await slider.boundingBox())!
  await watch(lap)
  await page.mouse.move(x + 0.5 * width, y + 0.5 * height)
  await page.mouse.down()
  for (let to = 0.5; to < 0.62; to += 0.03) await page.mouse.move(x + to * width, y + 0.5 * height)
  await page.mouse.up()
  await lap.settled()
  const seen = await watched(lap)
  expect(seen.length).toBeGreaterThan(5)
  expect(await lap.picture()).not.toBe(before)
  // Every picture on the way was that of the same step, for one of the values that the slider went through.
  for (const universes of new Set(seen.map(({ universes }) => universes))) {
    await lap.element.evaluate((figure, value) => Object.assign(figure, { universes: value }), universes)
    await lap.settled()
    atEnd.push(...Object.values(await picturesOf(lap, [45])))
  }
  expectOneNow(seen, step => (step === 45 ? atEnd : []))
})

test('what is shown while it is on its way is dimmed', async ({ page }) => {
  const lap = await openLap(page, 'universes="64" step="0"')
  const dimmed = await lap.element.evaluate(async element => {
    const figure = element as FigureElement
    const stage = figure.shadowRoot!.querySelector('.stage')!
    figure.seek(90)
    await new Promise(requestAnimationFrame)
    await new Promise(requestAnimationFrame)
    const during = stage.matches('.busy')
    await figure.settled()
    return [during, stage.matches('.busy')]
  })
  expect(dimmed).toEqual([true, false])
  expect(await lap.position()).toBe(90)
})

test('Rewind goes to the first step and leaves what was set, and is taken back by Undo', async ({ page }) => {
  const lap = await new Figure(page, 'fastslam-lap').alone('#fastslam-lap?universes=4&step=9')
  const [before, state] = [await lap.picture(), await lap.state()]
  await lap.rewind.click()
  expect(await lap.position()).toBe(0)
  await expect(lap.rewind).toBeDisabled()
  await expect(lap.box('universes')).toHaveValue('4')
  await lap.button('Undo rewind').press('Enter')
  expect(await lap.position()).toBe(9)
  expect([await lap.picture(), await lap.state()]).toEqual([before, state])
  await expect(lap.button('Undo rewind')).toBeHidden()
  expect(await lap.element.evaluate(element => element.shadowRoot!.activeElement?.classList.contains('stage')), 'the keys go on').toBe(true)
})

test('Reset is taken back by Undo, until something else is done', async ({ page }) => {
  const lap = await new Figure(page, 'fastslam-lap').alone('#fastslam-lap?universes=4&seed=5&step=9')
  const state = await lap.state()
  await lap.reset.click()
  await lap.settled()
  expect(await lap.state()).not.toBe(state)
  await lap.button('Undo reset').click()
  await lap.settled()
  expect(await lap.state()).toBe(state)
  await lap.reset.click()
  await expect(lap.button('Undo reset')).toBeVisible()
  await lap.step.click()
  await expect(lap.button('Undo reset')).toBeHidden()
})

test('a step beyond the end is the end, in the row of playback too', async ({ page }) => {
  for (const link of ['v=2&wrong=on&step=60', 'v=2&repair=switchable&wrong=on&step=60', 'v=3&repair=mixture&step=60']) {
    const graph = await new Figure(page, 'fastslam-graph').alone(`#fastslam-graph?${link}`)
    await expect(graph.scrub).toHaveValue(String(await graph.last()))
    expect(await graph.position()).toBe(await graph.last())
  }
  const graph = await new Figure(page, 'fastslam-graph').alone()
  for (const chip of await graph.element.getByRole('group', { name: 'Challenges' }).getByRole('button').all()) {
    await chip.click()
    await graph.settled()
    await expect(graph.scrub).toHaveValue(String(await graph.position()))
  }
})

test('a setting that was made by hand comes back after Reset, in a figure without a run too', async ({ page }) => {
  const figure = await new Figure(page, 'fastslam-conditioning').alone()
  await figure.box('odometry').fill('2')
  await figure.box('odometry').press('Enter')
  await figure.settled()
  const state = await figure.state()
  await figure.reset.click()
  await figure.settled()
  expect(await figure.state()).not.toBe(state)
  await figure.button('Undo reset').click()
  await figure.settled()
  expect(await figure.state()).toBe(state)
  await expect(figure.box('odometry')).toHaveValue('2')
})

test('a tile that is picked takes the tick from Overlay all, which lets go of the tile', async ({ page }) => {
  const lap = await new Figure(page, 'fastslam-lap').alone('#fastslam-lap?v=13&universes=4&step=9')
  const overlay = lap.element.locator('input[name=overlay]')
  await expect(overlay).toBeChecked()
  const { width, height } = (await lap.canvas.boundingBox())!
  await lap.canvas.click({ position: { x: 0.65 * width, y: 0.2 * height } })
  await lap.settled()
  await expect(overlay).not.toBeChecked()
  await expect(lap.sentence).not.toContainText('overlaid')
  await overlay.check()
  await lap.settled()
  await expect(lap.sentence).toContainText('overlaid')
})

test('the slider of what a prediction is about moves with its run', async ({ page }) => {
  const figure = await new Figure(page, 'fastslam-proposal').alone('#fastslam-proposal?v=3&predict=on&guess=4')
  await expect(figure.box('range-std')).toHaveValue('0.05')
  await figure.toggle('run').click()
  await figure.settled()
  await expect(figure.box('range-std')).toHaveValue('0.025')
  await figure.toggle('predict').click()
  await figure.settled()
  await expect(figure.box('range-std')).toHaveValue('0.05')
})

test('what is on its way dims all that is old: picture, sentence, numbers and how near a goal is', async ({ page }) => {
  const lap = await openLap(page, 'universes="64" step="0"')
  await lap.openNumbers()
  const dimmed = (seek: boolean) =>
    lap.element.evaluate(async (element, seek) => {
      const figure = element as FigureElement
      const parts = ['canvas', '.sentence', '.readouts', '.verdict'].map(part => figure.shadowRoot!.querySelector(part)!)
      const most = parts.map(() => 1)
      let done = !seek
      if (seek) figure.seek(90)
      void figure.settled().then(() => (done = true))
      do {
        await new Promise(requestAnimationFrame)
        parts.forEach((part, k) => (most[k] = Math.min(most[k]!, Number(getComputedStyle(part).opacity))))
      } while (!done)
      return most.map(opacity => opacity < 1)
    }, seek)
  expect(await dimmed(true)).toEqual([true, true, true, true])
  await expect.poll(() => dimmed(false)).toEqual([false, false, false, false])
})
