// Whatever place a page gives a figure, the figure has a width there, and what a reader does in it happens where the pointer is.
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import type { Locator, Page } from '@playwright/test'
import { root } from '../../scripts/lib.mjs'
import { expect, test } from './fixtures'
import { Figure, frames } from './figure'
import { openCourse } from './host'
import { LogFigure } from './log-figure'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

const USUAL = 832 // [px] that a figure wants
const LEAST = 320 // [px] that it takes where its parent shrinks to what is in it

/** Parents, by what they do with the width that there is: FIGURE stands for the figure in them. */
const PLACES: Record<'fills' | 'up to usual' | 'shrinks' | 'shares', Record<string, string>> = {
  // All of the width is the figure's.
  fills: {
    block: '<div>FIGURE</div>',
    'block in a line': '<p>FIGURE</p>',
    'flex column': '<div style="display: flex; flex-direction: column">FIGURE</div>',
    grid: '<div style="display: grid">FIGURE</div>',
    'grid of one part': '<div style="display: grid; grid-template-columns: 1fr">FIGURE</div>',
    'fixed table': '<table style="table-layout: fixed; inline-size: 100%; border-spacing: 0"><tr><td style="padding: 0">FIGURE</td></tr></table>',
    details: '<details open><summary>More</summary>FIGURE</details>',
    'shadow root': '<test-box>FIGURE</test-box>',
    columns: '<div style="columns: 1">FIGURE</div>',
    'a parent with a hidden overflow': '<div style="overflow: hidden">FIGURE</div>',
    'beside a cleared float': '<div><b style="float: left; inline-size: 50%">x</b><div style="clear: both">FIGURE</div></div>',
  },
  // The figure is as wide as it wants, or as there is room.
  'up to usual': {
    ...Object.fromEntries(
      ['stretch', 'flex-start', 'center', 'flex-end', 'baseline'].flatMap(align =>
        ['flex-start', 'center', 'flex-end', 'space-between', 'space-around'].map(justify => [`flex row, ${align}, ${justify}`, `<div style="display: flex; align-items: ${align}; justify-content: ${justify}">FIGURE</div>`]),
      ),
    ),
    ...Object.fromEntries(['flex-start', 'center', 'flex-end', 'baseline'].map(align => [`flex column, ${align}`, `<div style="display: flex; flex-direction: column; align-items: ${align}">FIGURE</div>`])),
    ...Object.fromEntries(['start', 'center', 'end', 'baseline'].map(place => [`grid, ${place}`, `<div style="display: grid; place-items: ${place}">FIGURE</div>`])),
    'shadow root of a flex row': '<test-box style="display: flex">FIGURE</test-box>',
    'vertical text': '<div style="writing-mode: vertical-rl; block-size: 100%">FIGURE</div>',
    'flex row that wraps': '<div style="display: flex; flex-wrap: wrap">FIGURE</div>',
    'centred in a grid of one part': '<div style="display: grid; grid-template-columns: 1fr; justify-items: center">FIGURE</div>',
    'Vite’s own template': '<div style="display: flex; place-items: center; min-block-size: 50vh">FIGURE</div>',
  },
  // So is its parent.
  shrinks: {
    'inline block': '<div style="display: inline-block">FIGURE</div>',
    'inline flex': '<div style="display: inline-flex">FIGURE</div>',
    'inline grid': '<div style="display: inline-grid">FIGURE</div>',
    float: '<div style="float: left">FIGURE</div>',
    'float at the end': '<div style="float: inline-end">FIGURE</div>',
    'fit-content': '<figure style="inline-size: fit-content; margin: 0">FIGURE<figcaption>Figure 1</figcaption></figure>',
    'centred fit-content': '<div style="inline-size: fit-content; margin: auto">FIGURE</div>',
    'table cell': '<table style="border-spacing: 0"><tr><td style="padding: 0">FIGURE</td></tr></table>',
    'table of styles': '<div style="display: table"><div style="display: table-cell">FIGURE</div></div>',
    dialog: '<dialog open style="position: static; border: 0; padding: 0; max-inline-size: 100%">FIGURE</dialog>',
    absolute: '<div style="position: relative; block-size: 900px"><div style="position: absolute; inset-block-start: 0">FIGURE</div></div>',
    'flex row in a flex row': '<div style="display: flex"><div>FIGURE</div></div>',
    'block in a centred grid': '<div style="display: grid; place-items: center"><section>FIGURE</section></div>',
    'shadow root of a line': '<test-box style="display: inline-block">FIGURE</test-box>',
  },
  // There is something else that wants room.
  shares: {
    'flex row beside a text': '<div style="display: flex">FIGURE<p>TEXT</p></div>',
    'table cell beside a text': '<table><tr><td>FIGURE</td><td>TEXT</td></tr></table>',
    'min-content': '<div style="inline-size: min-content">FIGURE</div>',
    'beside a float': '<div><b style="float: left; inline-size: 30%; block-size: 90px">x</b>FIGURE</div>',
  },
}

const TEXT = 'As long as a paragraph is, which would take all of the width for itself if it were let. '.repeat(30)

/** The least and the most that a figure may be wide in a column of this width, and whether the column then holds it. */
const LAWS: Record<keyof typeof PLACES, (room: number) => [least: number, most: number, holds: boolean]> = {
  fills: room => [room, room, true],
  'up to usual': room => [Math.min(room, USUAL), Math.min(room, USUAL), true],
  shrinks: room => [Math.min(room, USUAL), Math.max(LEAST, Math.min(room, USUAL)), room >= LEAST],
  shares: room => [Math.min(LEAST, room / 2), Math.max(LEAST, room), false],
}

test('a figure has a width in any parent, from left to right and from right to left', async ({ page }) => {
  await page.setViewportSize({ width: 1366, height: 650 })
  const places = Object.entries(PLACES).flatMap(([kind, all]) => Object.entries(all).map(([name, html]) => ({ kind: kind as keyof typeof PLACES, name, html })))
  const columns = places.map(({ name, html }) => `<div class="column" data-name="${name}">${html.replace('FIGURE', '<fastslam-proposal></fastslam-proposal>').replace('TEXT', TEXT)}</div>`)
  // So far down that none is about to be seen: it is widths that are looked at.
  await openCourse(
    page,
    `<style>#all { padding-block-start: 4000px } .column { display: flow-root }</style>
    <script>
      customElements.define('test-box', class extends HTMLElement {
        constructor() {
          super()
          this.attachShadow({ mode: 'open' }).innerHTML = '<slot></slot>'
        }
      })
    </script><div id="all">${columns.join('')}</div>`,
  )
  await page.evaluate(() => customElements.whenDefined('fastslam-proposal'))
  const wrong: string[] = []
  for (const dir of ['ltr', 'rtl']) {
    for (const room of [1200, 600, 332, 200]) {
      const widths = await page.locator('#all').evaluate(
        (all, [dir, room]) => {
          Object.assign(all, { dir })
          return [...all.children].map(column => {
            Object.assign((column as HTMLElement).style, { width: `${room}px` })
            return [Math.round(column.querySelector('fastslam-proposal')!.getBoundingClientRect().width), column.scrollWidth] as const
          })
        },
        [dir, room] as const,
      )
      places.forEach(({ kind, name }, i) => {
        const [[width, column], [least, most, holds]] = [widths[i]!, LAWS[kind](room)]
        if (width < least || width > most || (holds && column > room)) wrong.push(`${name} in ${room} px, ${dir}: ${width} px wide, its column ${column}`)
      })
    }
  }
  expect(wrong).toEqual([])
})

test('what a page gives the figure itself stands over that, and what floats is beside it', async ({ page }) => {
  const float = '<b style="float: left; inline-size: 200px; block-size: 90px">x</b>'
  const cases: [style: string, width: number, around?: string, within?: string][] = [
    ['width: 240px', 240],
    ['inline-size: 50%', 300],
    ['margin-inline: -40px', 680],
    ['margin-inline: 40px', 520],
    ['width: 760px', 760],
    ['display: inline-block', 600],
    ['position: absolute', 832],
    ['', 300, 'display: grid; grid-template-columns: 1fr 1fr', 'FIGUREFIGURE'],
    ['flex: 1', 300, 'display: flex', 'FIGUREFIGURE'],
    ['', 400, '', `${float}FIGURE`],
    ['display: block', 400, '', `${float}FIGURE`],
  ]
  const body = cases.map(([style, , around = '', within = 'FIGURE']) => `<div style="width: 600px; ${around}">${within.replaceAll('FIGURE', `<fastslam-proposal style="${style}"></fastslam-proposal>`)}</div>`)
  await openCourse(page, body.join(''))
  await page.evaluate(() => customElements.whenDefined('fastslam-proposal'))
  const widths = await page.locator('body > div').evaluateAll(boxes => boxes.map(box => Math.round(box.querySelector('fastslam-proposal')!.getBoundingClientRect().width)))
  expect(widths).toEqual(cases.map(([, width]) => width))
})

/** Boxes that pages scale, by the name that a figure in them has as its id. */
const SCALED: Record<string, string> = {
  whole: 'width: 832px',
  smaller: 'width: 832px; transform: scale(.8); transform-origin: 0 0',
  zoomed: 'width: 832px; zoom: 1.3',
  'zoomed-out': 'width: 832px; zoom: .8',
  // As reveal.js does it: a slide of 960 × 700 px in the middle of the window.
  slide: 'width: 960px; height: 900px; position: absolute; inset: 50% auto auto 50%; transform: translate(-50%, -50%) scale(.7)',
  'large-slide': 'width: 960px; height: 900px; position: absolute; inset: 50% auto auto 50%; transform: translate(-50%, -50%) scale(1.37)',
  stretched: 'width: 832px; transform: scale(1.1, .9); transform-origin: 0 0',
}

/** A page of one figure in one of those boxes. */
async function openScaled(page: Page, box: string, tag: string, attributes = ''): Promise<Figure> {
  await page.setViewportSize({ width: 1366, height: 1300 })
  await openCourse(page, `<div style="${SCALED[box]}"><${tag} ${attributes}></${tag}></div>`)
  const figure = new Figure(page, tag)
  await figure.live()
  return figure
}

async function middle(locator: Locator): Promise<{ x: number; y: number }> {
  const box = (await locator.boundingBox())!
  return { x: box.x + box.width / 2, y: box.y + box.height / 2 }
}

for (const box of Object.keys(SCALED)) {
  test(`handles, drawings and clicks are where the pointer is, ${box}`, async ({ page }) => {
    const proposal = await openScaled(page, box, 'fastslam-proposal')
    for (const [name, right, down] of [['landmark', -40, -20], ['odometry', 20, 0], ['landmark', -30, 30]] as const) {
      const handle = proposal.handle(name)
      const { x, y } = await middle(handle)
      await page.mouse.move(x + 3, y - 2)
      await page.mouse.down()
      await page.mouse.move(x + 3 + right, y - 2 + down, { steps: 5 })
      await proposal.settled()
      const now = await middle(handle)
      expect(Math.abs(now.x - x - right), `${name}, sideways`).toBeLessThan(3)
      expect(Math.abs(now.y - y - down), `${name}, up and down`).toBeLessThan(3)
      await page.mouse.up()
    }
  })
}

/** A place of a picture, from its upper left corner [share of its width and height]. */
async function at(picture: Locator, [across, down]: readonly [number, number]): Promise<[number, number]> {
  const box = (await picture.boundingBox())!
  return [box.x + across * box.width, box.y + down * box.height]
}

test('what is drawn, clicked and pointed at is what lies below the pointer, however the page scales the picture', async ({ page }) => {
  const done: Record<string, number[]> = {}
  for (const box of ['whole', 'smaller', 'zoomed', 'stretched']) {
    const lap = await openScaled(page, box, 'fastslam-lap', 'course="apartment" universes="4" step="3"')
    await page.mouse.click(...(await at(lap.canvas, [0.93, 0.2])))
    await lap.settled()
    const picked = await lap.element.locator('select[name=universe]').inputValue()
    await lap.button('Drive it yourself').click()
    await lap.button('Wall').click()
    const map = lap.element.locator('.wheel-map')
    await page.mouse.move(...(await at(map, [0.3, 0.55])))
    await page.mouse.down()
    const end = await at(map, [0.5, 0.75])
    await page.mouse.move(...end, { steps: 8 })
    // The line that is being drawn ends at the pointer.
    const tip = await lap.element.locator('polyline').evaluate((line: SVGPolylineElement) => {
      const { x, y } = line.points.getItem(line.points.numberOfItems - 1).matrixTransform(line.getScreenCTM()!)
      return [x, y]
    })
    expect(Math.hypot(tip[0]! - end[0], tip[1]! - end[1]), `the line, ${box}`).toBeLessThan(3)
    await page.mouse.up()
    await lap.settled()
    const plan = new URLSearchParams(await lap.state()).get('plan')
    const matrix = await openScaled(page, box, 'fastslam-conditioning')
    const to = await at(matrix.canvas, [0.8, 0.6])
    await page.mouse.move(...to, { steps: 3 })
    await matrix.settled()
    const cell = await middle(matrix.handle('entry'))
    // Where the wall is, two digits each, on the grid of walls.
    done[box] = [Number(picked), ...plan!.slice('1..'.length).match(/../g)!.map(digits => Number.parseInt(digits, 36))]
    // The entry below it: they are about 14 px wide.
    expect(Math.hypot(to[0] - cell.x, to[1] - cell.y), `the entry, ${box}`).toBeLessThan(12)

  }
  const { whole, ...scaled } = done
  expect(whole).toHaveLength(5)
  // A pointer between two of its points goes to either.
  for (const [box, same] of Object.entries(scaled)) same.forEach((number, i) => expect(Math.abs(number - whole![i]!), `${box}, ${i}`).toBeLessThanOrEqual(i === 0 ? 0 : 1))
})

/** The picture in greys, a quarter as large. */
const greys = (canvas: Locator): Promise<number[]> =>
  canvas.evaluate((canvas: HTMLCanvasElement) => {
    const [width, height] = [canvas.width >> 2, canvas.height >> 2]
    const small = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true })!
    small.drawImage(canvas, 0, 0, width, height)
    return [...small.getImageData(0, 0, width, height).data].filter((_, i) => i % 4 === 1)
  })

/** The share of two pictures that is not the same. */
const differs = (a: number[], b: number[]) => a.filter((grey, i) => Math.abs(grey - b[i]!) > 24).length / a.length

test('a map goes with the pointer, and is magnified at it, however the page scales the picture', async ({ page }) => {
  const seen: number[][] = []
  for (const [box, scale] of [['whole', 1], ['smaller', 0.8]] as const) {
    await page.setViewportSize({ width: 1366, height: 1300 })
    await openCourse(page, `<div style="${SCALED[box]}"><fastslam-log universes="2" cell="0.2"></fastslam-log></div>`)
    const log = new LogFigure(page)
    const canvas = log.element.locator('canvas')
    await log.choose('tiny.clf', readFileSync(join(root, 'tests', 'figures', 'golden', 'tiny.clf')))
    await log.button('Map this building').click()
    await log.done()
    await log.settled()
    const whole = await greys(canvas)
    // A wheel is heard later than it is turned.
    const changed = async () => {
      await expect.poll(async () => differs(whole, await greys(canvas))).toBeGreaterThan(0.02)
      await frames(page, 10)
      await log.settled()
      return greys(canvas)
    }
    const [x, y] = await at(canvas, [0.5, 0.5])
    await page.mouse.move(x, y)
    await page.mouse.down()
    await page.mouse.move(x + 50 * scale, y + 30 * scale, { steps: 2 })
    await page.mouse.up()
    seen.push(await changed())
    await log.stage.press('0')
    await expect.poll(async () => differs(whole, await greys(canvas))).toBe(0)
    await page.keyboard.down('Control')
    await page.mouse.wheel(0, -100)
    await page.keyboard.up('Control')
    seen.push(await changed())
  }
  const [moved, magnified, movedScaled, magnifiedScaled] = seen as [number[], number[], number[], number[]]
  expect(differs(moved, magnified)).toBeGreaterThan(0.04)
  expect(differs(moved, movedScaled)).toBeLessThan(0.005)
  expect(differs(magnified, magnifiedScaled)).toBeLessThan(0.02)
})
