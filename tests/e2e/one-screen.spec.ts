// One screen: picture, playback and the controls that matter are in sight together, on a small laptop, on PhET's screen, on a tablet, on a
// phone beside a thumb, and on a projector.
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import type { Locator, Page } from '@playwright/test'
import { root } from '../../scripts/lib.mjs'
import { programs } from '../../scripts/registry.mjs'
import { Figure, frames, holdPrograms } from './figure'
import { expect, test } from './fixtures'
import { breadth, breadthOf, openCourse } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

const LAPTOP = { width: 1366, height: 650 }
const TABLET = { width: 820, height: 1180 }
const HIGHEST = 630 // [px]
const SEEN = 0.9 // of what tells, whatever control is used

/** The figure, or before it is asked for anything what stands in its place. */
async function ready(page: Page, tag: string, selector = tag): Promise<Figure> {
  const figure = new Figure(page, selector)
  await figure.element.scrollIntoViewIfNeeded()
  await expect(figure.element.locator(tag === 'fastslam-log' ? '.idle' : '.stage.live')).toBeVisible()
  if (tag !== 'fastslam-log') await figure.settled()
  return figure
}

/** How much is seen, from 0 to 1, of the part of the picture that tells, or of as much of that as a phone has room for. */
const seen = (figure: Figure) =>
  figure.element.evaluate(element => {
    const root = element.shadowRoot!
    const [panes, stage] = ['.panes', '.stage'].map(part => root.querySelector<HTMLElement>(part)!)
    const { left, top, width, height } = stage!.getBoundingClientRect()
    const px = (name: string) => parseFloat(panes!.style.getPropertyValue(name) || String(height))
    const [low, tells] = [px('--_low'), px('--_tell')]
    const high = Math.min(0.62 * innerHeight, tells)
    const places = Array.from({ length: 20 }, (_, k) => top + low - high * ((k + 0.5) / 20))
    const shown = places.filter(y => y > 0 && y < innerHeight && stage!.contains(root.elementFromPoint(left + width / 2, y)))
    return shown.length / places.length
  })

/** Goes through all controls outside of the folds by Tab, and tells each control's name with the share of the picture that is seen then. */
async function byTab(page: Page, figure: Figure): Promise<[string, number][]> {
  await figure.element.evaluate(element => element.shadowRoot!.querySelector<HTMLElement>('.stage')!.focus({ preventScroll: true }))
  const shares: [string, number][] = []
  for (let i = 0; i < 60; i++) {
    const found = await figure.element.evaluate(element => {
      const focused = element.shadowRoot!.activeElement
      return focused?.closest('.panes') ? (focused.getAttribute('aria-label') ?? focused.getAttribute('name') ?? focused.className) : undefined
    })
    if (found === undefined) break
    shares.push([found, await seen(figure)])
    await page.keyboard.press('Tab')
  }
  return shares
}

/** What of a figure’s sentence is cut off, at the width that the chapter gives it [px]. */
function cutOff(figure: Locator): Promise<number> {
  return figure.evaluate(element => {
    const { scrollHeight, clientHeight } = element.shadowRoot!.querySelector('.sentence')!
    return scrollHeight - clientHeight
  })
}

/** The figure itself, on which there may be exercises that have copies. */
const own = (page: Page, tag: string) => new Figure(page, tag).element

const settleAll = (page: Page) =>
  page.locator('.column > *').evaluateAll(figures => Promise.all(figures.map(figure => (figure as HTMLElement & { settled(): Promise<void> }).settled())))

// In the chapter itself each figure takes three times as long. What it has to tell here is how wide they are in it.
test('every figure is whole on a small laptop, in columns and as wide as in the chapter, on a tablet picture and controls are, and what it takes was kept free before it lived', async ({ page }) => {
  const tags = [...programs.keys()]
  const widthsInChapter = async () => {
    const widths = await Promise.all(tags.map(tag => own(page, tag).evaluate(element => element.getBoundingClientRect().width)))
    for (const width of widths) expect(width).toBeGreaterThan(500)
    return widths
  }
  await page.setViewportSize(LAPTOP)
  await page.goto('./#fig-lap') // where it is unfolded
  const onLaptop = await widthsInChapter()
  await page.setViewportSize(TABLET)
  const onTablet = await widthsInChapter()

  // One above the other, so that all are seen; at first as narrow as on a phone, where all that a figure has adds to its height.
  await page.setViewportSize(LAPTOP)
  const open = await holdPrograms(page)
  await openCourse(page, tags.map(tag => `<div class="column" style="position: absolute; inset: 0 auto auto 0; width: 320px"><${tag}></${tag}></div>`).join(''))
  const heights = () => Promise.all(tags.map(tag => page.locator(tag).evaluate(element => Math.round(element.getBoundingClientRect().height))))
  await expect(page.locator('.column .reserved')).toHaveCount(tags.length - 1) // the figure of logs is whole without its program
  await frames(page, 2)
  const kept = await heights()
  open()
  for (const tag of tags) await expect(page.locator(tag).locator(tag === 'fastslam-log' ? '.idle' : '.stage.live')).toBeVisible()
  await expect(page.locator('.column .sentence:not(:empty)')).toHaveCount(tags.length)
  await settleAll(page)
  for (const [i, taken] of (await heights()).entries()) expect(Math.abs(kept[i]! - taken), `${tags[i]}: ${kept[i]} px kept, ${taken} px taken`).toBeLessThan(3)

  const widen = async (widths: number[]) => {
    await page.locator('.column').evaluateAll((columns, widths) => columns.forEach((column, i) => ((column as HTMLElement).style.width = `${widths[i]}px`)), widths)
    await settleAll(page)
  }
  const measured = JSON.parse(readFileSync(join(root, 'widgets', 'elements', 'heights.json'), 'utf8')) as { first: number; apart: number; heights: Record<string, number[]> }
  for (const widths of [onLaptop, ...[832, 1000, 1100].map(width => tags.map(() => width))]) {
    await widen(widths)
    for (const [i, tag] of tags.entries()) {
      const { height } = (await page.locator(tag).boundingBox())!
      expect(height, `${tag}, ${widths[i]} px wide`).toBeLessThanOrEqual(HIGHEST)
      if (widths === onLaptop) expect(await cutOff(page.locator(tag)), `the sentence of ${tag} is cut`).toBeLessThanOrEqual(1)
      if (widths[i] === 832) expect(Math.abs(measured.heights[tag]![(832 - measured.first) / measured.apart]! - height), `${tag} takes what is kept free in a column`).toBeLessThan(3)
    }
  }
  await page.setViewportSize(TABLET)
  await widen(onTablet)
  for (const tag of tags) expect((await page.locator(tag).locator('.panes').boundingBox())!.height, `${tag} on a tablet`).toBeLessThanOrEqual(1000)
})

test('every figure is whole in the chapter on a small laptop, and on a tablet picture and controls are', breadth, async ({ page }) => {
  await page.setViewportSize(LAPTOP)
  await page.goto('./#fig-lap') // where it is unfolded
  for (const tag of programs.keys()) {
    const { element } = await ready(page, tag)
    expect((await element.boundingBox())!.height, tag).toBeLessThanOrEqual(HIGHEST)
    expect(await cutOff(element), `the sentence of ${tag} is cut`).toBeLessThanOrEqual(1)
  }
  await page.setViewportSize(TABLET)
  for (const tag of programs.keys()) {
    const { element } = await ready(page, tag)
    expect((await element.locator('.panes').boundingBox())!.height, `${tag} on a tablet`).toBeLessThanOrEqual(1000)
  }
})

for (const tag of programs.keys()) {
  test(`${tag} never loses its picture to Tab on a small laptop, and takes all of a projector’s screen`, breadthOf(tag), async ({ page }) => {
    await page.setViewportSize(LAPTOP)
    await openCourse(page, `<p>Before.</p><div style="width: 900px"><${tag}></${tag}></div><p style="height: 900px">After.</p>`)
    const figure = await ready(page, tag)
    const shares = await byTab(page, figure)
    expect(shares.length).toBeGreaterThan(3)
    for (const [name, share] of shares) expect(share, name).toBeGreaterThan(0.99)

    await page.setViewportSize({ width: 1366, height: 768 })
    await figure.element.evaluate(element => element.requestFullscreen())
    await expect.poll(() => figure.element.evaluate(element => element.matches(':fullscreen'))).toBe(true)
    await expect.poll(async () => (await figure.element.boundingBox())!.width).toBe(1366)
    if (tag !== 'fastslam-log') await figure.settled()
    const { high, room, canvas, stage } = await figure.element.evaluate(element => {
      const root = element.shadowRoot!
      const [body, stage] = [root.querySelector('.figure')!, root.querySelector('.stage')!.getBoundingClientRect()]
      const picture = root.querySelector('.stage > :is(canvas, .idle):not(:empty), .stage > canvas')!.getBoundingClientRect()
      return { high: body.scrollHeight, room: body.clientHeight, canvas: [picture.width, picture.height], stage: [stage.width - 28, stage.height] }
    })
    expect(room).toBe(768)
    expect(high).toBeLessThanOrEqual(768)
    // In one direction at least, there is no room left.
    const [across, down] = [canvas[0]! / stage[0]!, canvas[1]! / stage[1]!]
    expect(Math.max(across, down)).toBeGreaterThan(0.97)
  })
}

for (const tag of programs.keys()) {
  test(`${tag} is whole in a frame of 1024 × 618`, breadthOf(tag), async ({ page }) => {
    await page.setViewportSize({ width: 1024, height: 618 })
    await page.goto(`./embed.html?figure=${tag.replace('fastslam-', '')}`)
    const figure = await ready(page, tag)
    const measure = () =>
      figure.element.evaluate(element => {
        const body = element.shadowRoot!.querySelector('.figure')!
        return [Math.max(body.scrollHeight, document.documentElement.scrollHeight), body.clientHeight]
      })
    const [high, room] = await measure()
    expect(room).toBeLessThanOrEqual(618)
    expect(high).toBeLessThanOrEqual(618)
  })
}

test.describe('on a phone', () => {
  test.use({ viewport: { width: 380, height: 760 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 })

  /** That the picture stays in sight whichever slider a thumb is on, and whatever has the focus. */
  async function expectInSight(page: Page, figure: Figure): Promise<void> {
    for (const slider of await figure.element.locator('.main input').filter({ visible: true }).all()) {
      await slider.scrollIntoViewIfNeeded()
      await expect(slider).toBeInViewport()
      expect(await seen(figure), (await slider.getAttribute('name')) ?? '').toBeGreaterThanOrEqual(SEEN)
    }
    // And what has the focus is not below the picture.
    for (const [name, share] of await byTab(page, figure)) expect(share, name).toBeGreaterThanOrEqual(SEEN)
  }

  for (const tag of programs.keys()) {
    test(`${tag} keeps its picture in sight beside a thumb, whatever is set`, breadthOf(tag), async ({ page }) => {
      await openCourse(page, `<p>Before.</p><${tag}></${tag}><p style="height: 900px">After.</p>`)
      const figure = await ready(page, tag)
      // Where the picture comes into sight, what plays it is there too.
      await figure.element.evaluate(element => scrollTo(0, element.getBoundingClientRect().top + scrollY))
      await frames(page, 2)
      const play = figure.element.locator('.transport .play')
      if (await play.isVisible()) await expect(play).toBeInViewport({ ratio: 1 })
      for (const fold of await figure.element.locator('.main details:not([open]) > summary').all()) await fold.click()
      await expectInSight(page, figure)
    })
  }
})
