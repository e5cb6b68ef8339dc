// One screen: picture, playback and the controls that matter are in sight together, on a small laptop, on PhET's screen, on a tablet, on a
// phone beside a thumb, and on a projector.
import type { Page } from '@playwright/test'
import { programs } from '../../scripts/registry.mjs'
import { Figure } from './figure'
import { expect, test } from './fixtures'
import { openCourse } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

const LAPTOP = { width: 1366, height: 650 }
const HIGHEST = 630 // [px]
const SEEN = 0.6 // of the picture, whatever control is used

/** The figure, or before it is asked for anything what stands in its place. */
async function ready(page: Page, tag: string, selector = tag): Promise<Figure> {
  const figure = new Figure(page, selector)
  await figure.element.scrollIntoViewIfNeeded()
  await expect(figure.element.locator(tag === 'fastslam-log' ? '.idle' : '.stage.live')).toBeVisible()
  if (tag !== 'fastslam-log') await figure.settled()
  return figure
}

/** How much of the picture is in the window, from 0 to 1. */
const seen = (figure: Figure) =>
  figure.element.locator('.stage').evaluate(stage => {
    const { top, bottom, height } = stage.getBoundingClientRect()
    return Math.max(0, Math.min(bottom, innerHeight) - Math.max(top, 0)) / height
  })

/** Goes through all controls outside of the folds by Tab, and tells each control's name with the share of the picture that is seen then. */
async function byTab(page: Page, figure: Figure): Promise<[string, number][]> {
  await figure.element.evaluate(element => element.shadowRoot!.querySelector<HTMLElement>('.stage')!.focus({ preventScroll: true }))
  const shares: [string, number][] = []
  for (let i = 0; i < 60; i++) {
    const name = await figure.element.evaluate(element => {
      const focused = element.shadowRoot!.activeElement
      return focused?.closest('.panes') ? (focused.getAttribute('aria-label') ?? focused.getAttribute('name') ?? focused.className) : undefined
    })
    if (name === undefined) break
    shares.push([name, await seen(figure)])
    await page.keyboard.press('Tab')
  }
  return shares
}

for (const tag of programs.keys()) {
  test(`${tag} is whole on a small laptop, in the chapter and in a column of 832 px`, async ({ page }) => {
    await page.setViewportSize(LAPTOP)
    await page.goto('./')
    expect((await (await ready(page, tag)).element.boundingBox())!.height, 'in the chapter').toBeLessThanOrEqual(HIGHEST)
    const sentence = page.locator(`${tag} .sentence`).first()
    expect(await sentence.evaluate(({ scrollHeight, clientHeight }) => scrollHeight - clientHeight), 'the sentence is cut').toBeLessThanOrEqual(1)
    const widths = [832, 1000, 1100]
    await openCourse(page, widths.map(width => `<div style="width: ${width}px"><${tag} id="in${width}"></${tag}></div>`).join(''))
    for (const width of widths) {
      const { height } = (await (await ready(page, tag, `#in${width}`)).element.boundingBox())!
      expect(height, `${width} px wide`).toBeLessThanOrEqual(HIGHEST)
    }
  })

  test(`${tag} never loses its picture to Tab on a small laptop`, async ({ page }) => {
    await page.setViewportSize(LAPTOP)
    await openCourse(page, `<p>Before.</p><div style="width: 900px"><${tag}></${tag}></div><p style="height: 900px">After.</p>`)
    const shares = await byTab(page, await ready(page, tag))
    expect(shares.length).toBeGreaterThan(3)
    for (const [name, share] of shares) expect(share, name).toBeGreaterThan(0.99)
  })

  test(`${tag} is whole in a frame of 1024 × 618`, async ({ page }) => {
    await page.setViewportSize({ width: 1024, height: 618 })
    await page.goto(`./embed.html?figure=${tag.replace('fastslam-', '')}`)
    const figure = await ready(page, tag)
    const [high, room] = await figure.element.evaluate(element => {
      const body = element.shadowRoot!.querySelector('.figure')!
      return [Math.max(body.scrollHeight, document.documentElement.scrollHeight), body.clientHeight]
    })
    expect(room).toBeLessThanOrEqual(618)
    expect(high).toBeLessThanOrEqual(618)
  })

  test(`${tag} has picture and controls on a tablet’s screen`, async ({ page }) => {
    await page.setViewportSize({ width: 820, height: 1180 })
    await page.goto('./')
    const figure = await ready(page, tag)
    const { height } = (await figure.element.locator('.panes').boundingBox())!
    expect(height).toBeLessThanOrEqual(1000)
  })

  test(`${tag} takes all of a projector’s screen, and no more`, async ({ page }) => {
    await page.setViewportSize({ width: 1366, height: 768 })
    await openCourse(page, `<${tag}></${tag}>`)
    const figure = await ready(page, tag)
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

/** Figures whose runs can be compared. */
const COMPARED = ['lap', 'resampling', 'proposal', 'doors'].map(name => `fastslam-${name}`)

async function pin(figure: Figure): Promise<void> {
  await figure.button('Pin this run').click()
  await figure.settled()
  await expect(figure.element.locator('[part=pinned]')).toBeVisible()
}

for (const tag of COMPARED) {
  test(`${tag} with a pinned run is whole on a small laptop, and its picture as large as without`, async ({ page }) => {
    await page.setViewportSize(LAPTOP)
    for (const width of [832, 927, 1000, 1100]) {
      await openCourse(page, `<div style="width: ${width}px"><${tag} seed="7"></${tag}></div>`)
      const figure = await ready(page, tag)
      const area = async () => {
        const { width, height } = (await figure.canvas.first().boundingBox())!
        return width * height
      }
      const before = await area()
      await pin(figure)
      await figure.element.evaluate(element => element.setAttribute('seed', '8'))
      await figure.settled()
      expect((await figure.element.boundingBox())!.height, `${width} px wide`).toBeLessThanOrEqual(HIGHEST)
      expect(await area(), `${width} px wide`).toBe(before)
      for (const [name, share] of await byTab(page, figure)) expect(share, name).toBeGreaterThan(0.99)
    }
  })

  test(`${tag} with a pinned run is whole in a frame of 1024 × 618`, async ({ page }) => {
    await page.setViewportSize({ width: 1024, height: 618 })
    await page.goto(`./embed.html?figure=${tag.replace('fastslam-', '')}`)
    const figure = await ready(page, tag)
    await pin(figure)
    const high = await figure.element.evaluate(element => Math.max(element.shadowRoot!.querySelector('.figure')!.scrollHeight, document.documentElement.scrollHeight))
    expect(high).toBeLessThanOrEqual(618)
  })
}

test.describe('on a phone', () => {
  test.use({ viewport: { width: 380, height: 760 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 })

  for (const tag of programs.keys()) {
    test(`${tag} keeps its picture in sight beside a thumb, whatever is set`, async ({ page }) => {
      await openCourse(page, `<p>Before.</p><${tag}></${tag}><p style="height: 900px">After.</p>`)
      const figure = await ready(page, tag)
      for (const fold of await figure.element.locator('.main details:not([open]) > summary').all()) await fold.click()
      for (const slider of await figure.element.locator('.main input').filter({ visible: true }).all()) {
        await slider.scrollIntoViewIfNeeded()
        await expect(slider).toBeInViewport()
        expect(await seen(figure), (await slider.getAttribute('name')) ?? '').toBeGreaterThanOrEqual(SEEN)
      }
      // And what has the focus is not below the picture.
      for (const [name, share] of await byTab(page, figure)) expect(share, name).toBeGreaterThanOrEqual(SEEN)
    })

    if (!COMPARED.includes(tag)) continue
    test(`${tag} keeps its picture in sight beside a thumb with a pinned run too`, async ({ page }) => {
      await openCourse(page, `<p>Before.</p><${tag}></${tag}><p style="height: 900px">After.</p>`)
      const figure = await ready(page, tag)
      await pin(figure)
      for (const slider of await figure.element.locator('.main input').filter({ visible: true }).all()) {
        await slider.scrollIntoViewIfNeeded()
        await expect(slider).toBeInViewport()
        expect(await seen(figure), (await slider.getAttribute('name')) ?? '').toBeGreaterThanOrEqual(SEEN)
      }
      for (const [name, share] of await byTab(page, figure)) expect(share, name).toBeGreaterThanOrEqual(SEEN)
    })
  }
})
