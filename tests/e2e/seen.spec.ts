// Seen means looked at: when a figure begins by itself, when it waits, what it shows where nothing may move, and an end that nobody watched.
import type { Page } from '@playwright/test'
import { Figure, frames, openChapterOf } from './figure'
import { expect, test } from './fixtures'
import { openCourse } from './host'

const TELLING = 82 // of the lap, two steps after its loop closes
const CLOSING = 79 // the step before that

/** Quick, and of the present version: codes of before open as they did. */
const LAP = '<fastslam-lap v="latest" universes="2"></fastslam-lap>'

const below = (page: Page, body: string) => openCourse(page, `<div style="height: 3000px">Before.</div>${body}<div style="height: 3000px">After.</div>`)

/** Scrolls so far that this share of the picture is in the window, at its lower edge, or its upper one. */
async function show(figure: Figure, share: number, edge: 'lower' | 'upper' = 'lower'): Promise<void> {
  await figure.element.evaluate(
    async (element, [share, edge]) => {
      await customElements.whenDefined(element.localName)
      const { top, bottom, height } = element.shadowRoot!.querySelector('.stage')!.getBoundingClientRect()
      scrollBy(0, edge === 'lower' ? top + Number(share) * height - innerHeight : bottom - Number(share) * height)
    },
    [share, edge] as const,
  )
  await frames(figure.page, 4)
}

test('what is asked of a figure is waited for also where the browser tells late that the figure is about to be seen', async ({ page }) => {
  await page.addInitScript(() => {
    window.IntersectionObserver = class extends IntersectionObserver {
      constructor(told: IntersectionObserverCallback, options?: IntersectionObserverInit) {
        super((entries, observer) => setTimeout(() => told(entries, observer), 400), options)
      }
    }
  })
  await openCourse(page, '<fastslam-worked-example></fastslam-worked-example>')
  const figure = new Figure(page, 'fastslam-worked-example')
  await figure.settled()
  expect(await figure.element.locator('.stage.live').count()).toBe(1)
})

test.describe('where things move', () => {
  test('a figure begins when its picture is looked at, waits out of sight, and goes on when the reader comes back', async ({ page }) => {
    await below(page, LAP)
    const lap = new Figure(page, 'fastslam-lap')
    for (const share of [0.1, 0.5, 0.8]) {
      await show(lap, share)
      await lap.live()
      expect([await lap.playing(), await lap.position()], `${share} of it`).toEqual([false, 0])
    }
    await show(lap, 1)
    await expect.poll(() => lap.playing()).toBe(true)
    await expect.poll(() => lap.position()).toBeGreaterThan(2)
    await show(lap, 0.7, 'upper')
    expect(await lap.playing()).toBe(true)
    await show(lap, 0.5, 'upper')
    await expect(lap.play).toBeVisible()
    const left = await lap.position()
    await frames(page, 30)
    expect(await lap.position()).toBe(left)
    await show(lap, 1)
    await expect.poll(() => lap.position()).toBeGreaterThan(left)
    // What a reader has stopped, no scrolling starts.
    await lap.pause.click()
    const stopped = await lap.position()
    await show(lap, 0.3, 'upper')
    await show(lap, 1)
    await frames(page, 30)
    expect(await lap.position()).toBe(stopped)
  })

  test('a picture higher than the window is looked at when it fills that', async ({ page }) => {
    await page.setViewportSize({ width: 800, height: 300 })
    await below(page, LAP)
    const lap = new Figure(page, 'fastslam-lap')
    await show(lap, 0.2)
    await lap.live()
    expect(await lap.playing()).toBe(false)
    await show(lap, 0.7)
    await expect.poll(() => lap.playing()).toBe(true)
  })

  test('who presses Play on half of a picture sees it play', async ({ page }) => {
    await below(page, '<fastslam-lap v="latest" universes="2" step="3"></fastslam-lap>')
    const lap = new Figure(page, 'fastslam-lap')
    await show(lap, 0.45, 'upper')
    await lap.live()
    await lap.play.click()
    await expect.poll(() => lap.position()).toBeGreaterThan(5)
  })

  test('an end that was not watched is offered from the step before it', async ({ page }) => {
    await openCourse(page, LAP)
    const lap = new Figure(page, 'fastslam-lap')
    await lap.live()
    const offer = lap.button('▶ Watch the loop close')
    await lap.scrubTo(50)
    await expect(offer).toBeHidden()
    await lap.scrubTo(await lap.last())
    await expect(offer).toBeVisible()
    await lap.element.getByRole('combobox', { name: 'Speed' }).selectOption({ label: '4×' })
    await offer.click()
    await expect(offer).toBeHidden()
    expect(await lap.position()).toBeGreaterThanOrEqual(CLOSING)
    await expect.poll(() => lap.playing()).toBe(false)
    expect(await lap.position()).toBe(await lap.last())
    await expect(offer, 'it was watched').toBeHidden()
    await lap.scrubTo(60)
    await lap.scrubTo(await lap.last())
    await expect(offer).toBeHidden()
  })

  test('where the caption says to press Play, nothing plays before', async ({ page }) => {
    await openChapterOf(page, ['fastslam-graph'])
    const graph = new Figure(page, 'fastslam-graph')
    await expect(page.locator('figcaption')).toContainText('Press play')
    await show(graph, 1)
    await graph.live()
    await frames(page, 30)
    expect([await graph.playing(), await graph.position()]).toEqual([false, 0])
  })
})

test('a slider that is moved at the first step goes to the one that tells; the page’s author stays where he is', async ({ page }) => {
  await openCourse(page, '<fastslam-lap v="latest" universes="2" step="0"></fastslam-lap>')
  const lap = new Figure(page, 'fastslam-lap')
  await lap.live()
  await lap.element.evaluate(element => element.setAttribute('odometry', '0.8'))
  await lap.settled()
  expect(await lap.position()).toBe(0)
  await lap.box('odometry').fill('1.5')
  await lap.box('odometry').press('Enter')
  await lap.settled()
  expect(await lap.position()).toBe(TELLING)
  await expect(lap.sentence).toContainText(`tep ${TELLING}`)
})

test.describe('where nothing may move', () => {
  test.use({ contextOptions: { reducedMotion: 'reduce' } })

  test('a figure rests at the step that tells, codes of before at the first, and links where they say', async ({ page }) => {
    await openCourse(page, `${LAP}<fastslam-lap universes="2"></fastslam-lap><fastslam-lap v="8" universes="2"></fastslam-lap><fastslam-resampling v="latest"></fastslam-resampling><fastslam-graph v="latest"></fastslam-graph>`)
    const at = async (selector: string) => {
      const figure = new Figure(page, selector)
      await figure.element.scrollIntoViewIfNeeded()
      await figure.live()
      return figure.position()
    }
    expect(await at('fastslam-lap >> nth=0')).toBe(TELLING)
    expect(await at('fastslam-lap >> nth=1'), 'a code that says no version').toBe(0)
    expect(await at('fastslam-lap >> nth=2')).toBe(0)
    expect(await at('fastslam-resampling')).toBe(70)
    const graph = new Figure(page, 'fastslam-graph')
    expect(await at('fastslam-graph')).toBe(await graph.last())
    const lap = new Figure(page, 'fastslam-lap >> nth=0')
    await lap.element.scrollIntoViewIfNeeded()
    await lap.goTo('v=13&universes=2')
    expect(await lap.position(), 'a link without a step').toBe(0)
    await lap.reset.click()
    await lap.settled()
    expect(await lap.position()).toBe(TELLING)
  })
})

test('on paper a figure that nobody touched is at the step that tells, and after it where it was', async ({ page }) => {
  await below(page, LAP)
  const lap = new Figure(page, 'fastslam-lap')
  await show(lap, 0.3)
  await lap.live()
  await page.evaluate(() => dispatchEvent(new Event('beforeprint')))
  expect(await lap.element.locator('.timeline .position').textContent()).toBe(`${TELLING} / ${await lap.last()}`)
  await page.evaluate(() => dispatchEvent(new Event('afterprint')))
  await lap.settled()
  expect(await lap.position()).toBe(0)
})
