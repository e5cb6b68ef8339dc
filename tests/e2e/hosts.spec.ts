// One element over two hosts: a figure whose program runs in a worker is the figure that runs on the page.
import type { Page } from '@playwright/test'
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { openCourse } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

type FigureElement = HTMLElement & { state: string; universes: number; seek(step: number): void; step(): void }

/** A lap of our own page, which says of itself that it is heavy, or does not. */
async function openLap(page: Page, heavy: boolean, attributes = 'seed="9"'): Promise<Figure> {
  await page.unrouteAll()
  await page.goto('about:blank')
  const body = `<script type="module">
    import { FastslamLap } from './fastslam.js'
    FastslamLap.heavy = ${heavy}
    document.querySelector('main').innerHTML = '<fastslam-lap ${attributes}></fastslam-lap>'
  </script><main></main>`
  await openCourse(page, body)
  const lap = new Figure(page, 'fastslam-lap')
  await lap.live()
  expect(page.workers()).toHaveLength(heavy ? 1 : 0)
  return lap
}

/** What a reader does, and all there is to see after each of it. */
async function story(lap: Figure): Promise<unknown[]> {
  const seen: unknown[] = []
  const look = async (position: number) => {
    await expect.poll(() => lap.position()).toBe(position)
    await lap.settled()
    seen.push([await lap.readouts(), await lap.sentence.textContent(), await lap.picture(), await lap.element.evaluate(figure => (figure as FigureElement).state)])
  }
  await look(0)
  await lap.step.click()
  await look(1)
  await lap.scrubTo(12)
  await look(12)
  const box = (await lap.canvas.boundingBox())!
  await lap.canvas.click({ position: { x: box.width * 0.93, y: box.height * 0.2 } })
  await expect(lap.element.locator('select[name=universe]')).toHaveValue('3')
  await look(12)
  await lap.element.evaluate(figure => ((figure as FigureElement).universes = 6))
  await expect(lap.box('universes')).toHaveValue('6')
  await look(12)
  await lap.stepBack.click()
  await look(11)
  await lap.reset.click()
  await look(0)
  return seen
}

test('a heavy figure shows the numbers, words and pixels that it would show on the page', async ({ page }) => {
  const here = await story(await openLap(page, false))
  const there = await story(await openLap(page, true))
  expect(there).toEqual(here)
})

test('a heavy figure plays, keeps what is locked, refuses what is wrong, and is read as it was set', async ({ page }) => {
  const lap = await openLap(page, true, 'universes="4" lock="universes"')
  await lap.play.click()
  await expect.poll(() => lap.position()).toBeGreaterThan(3)
  await lap.pause.click()
  await expect(lap.play).toBeVisible()
  await page.evaluate(() => (location.hash = 'fastslam-lap?universes=9&step=5'))
  await expect.poll(() => lap.position()).toBe(5)
  await expect(lap.alert).toContainText('universes is fixed on this page')
  await expect(lap.box('universes')).toHaveValue('4')
  const read = await lap.element.evaluate(element => {
    const figure = element as FigureElement
    figure.universes = 7
    return figure.universes
  })
  expect(read).toBe(7)
  await expect(lap.box('universes')).toHaveValue('7')
  await lap.element.evaluate(figure => ((figure as FigureElement).universes = 700))
  await expect(lap.alert).toContainText(/universes.*1 to 256/)
  await expect(lap.box('universes')).toHaveValue('7')
})

test('a heavy figure that is moved, or taken out and put back, goes on as it was', async ({ page }) => {
  const lap = await openLap(page, true)
  await lap.scrubTo(8)
  await expect.poll(() => lap.position()).toBe(8)
  await lap.settled()
  const before = await lap.readouts()
  await lap.element.evaluate(async figure => {
    figure.remove()
    await new Promise(requestAnimationFrame)
    document.body.append(figure)
  })
  await lap.live()
  await expect.poll(() => lap.position()).toBe(8)
  await lap.settled()
  expect(await lap.readouts()).toEqual(before)
  expect(page.workers(), 'the worker before has ended').toHaveLength(1)
})

for (const heavy of [false, true]) {
  test(`when a ${heavy ? 'heavy ' : ''}figure says that it has settled, what was asked of it is shown`, async ({ page }) => {
    // So many that each step asked for takes a while.
    const lap = await openLap(page, heavy, 'universes="32"')
    for (const step of [30, 3, 12]) {
      const shown = await lap.element.evaluate(async (element, step) => {
        const figure = element as FigureElement & { settled(): Promise<void> }
        figure.seek(step)
        await figure.settled()
        const root = figure.shadowRoot!
        return [root.querySelector('.timeline .position')!.textContent, root.querySelector('.position.busy') === null, root.querySelector('.described')!.textContent]
      }, step)
      expect(shown.slice(0, 2)).toEqual([expect.stringMatching(new RegExp(`^${step} /`)), true])
      expect(shown[2]).toBe(await lap.sentence.textContent())
    }
  })
}

/** A drag is answered as soon as it is computed: neither its first slice nor its picture waits for the next frame. */
test('what is asked of a figure on the page is computed and shown though no frame comes', async ({ page }) => {
  const lap = await openLap(page, false)
  await lap.settled()
  const shown = await lap.element.evaluate(element => {
    const figure = element as FigureElement
    const told = new Promise<void>(done => figure.addEventListener('fastslam-step', () => done(), { once: true }))
    window.requestAnimationFrame = () => 1
    figure.seek(30)
    return told.then(() => figure.shadowRoot!.querySelector('.timeline .position')!.textContent)
  })
  expect(shown).toMatch(/^30 \//)
})
