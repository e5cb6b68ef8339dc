// Whatever place a page gives a figure, the figure has a width there, and what a reader does in it happens where the pointer is.
import type { Page } from '@playwright/test'
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { openCourse } from './host'

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

/** Places of these kinds, each in a column of this width, with a figure in each that need not live. */
async function openPlaces(page: Page, kind: keyof typeof PLACES, room: number, dir: string): Promise<{ name: string; width: number; column: number }[]> {
  const body = Object.entries(PLACES[kind])
    .map(([name, html]) => `<div class="column" data-name="${name}" dir="${dir}" style="inline-size: ${room}px; display: flow-root">${html.replace('FIGURE', '<fastslam-proposal></fastslam-proposal>').replace('TEXT', TEXT)}</div>`)
    .join('')
  await openCourse(
    page,
    `<script>
      customElements.define('test-box', class extends HTMLElement {
        constructor() {
          super()
          this.attachShadow({ mode: 'open' }).innerHTML = '<slot></slot>'
        }
      })
    </script>${body}`,
  )
  await page.evaluate(() => customElements.whenDefined('fastslam-proposal'))
  return page.locator('.column').evaluateAll(columns =>
    columns.map(column => {
      const { width } = column.querySelector('fastslam-proposal')!.getBoundingClientRect()
      return { name: (column as HTMLElement).dataset['name']!, width: Math.round(width), column: column.scrollWidth }
    }),
  )
}

for (const dir of ['ltr', 'rtl']) {
  test(`a figure has a width in any parent, ${dir}`, async ({ page }) => {
    await page.setViewportSize({ width: 1366, height: 650 })
    const wrong: string[] = []
    for (const room of [1200, 600, 332, 200]) {
      // The least and the most that it may be wide in this column, and whether the column then holds it.
      const laws: Record<keyof typeof PLACES, [least: number, most: number, holds: boolean]> = {
        fills: [room, room, true],
        'up to usual': [Math.min(room, USUAL), Math.min(room, USUAL), true],
        shrinks: [Math.min(room, USUAL), Math.max(LEAST, Math.min(room, USUAL)), room >= LEAST],
        shares: [Math.min(LEAST, room / 2), Math.max(LEAST, room), false],
      }
      for (const [kind, [least, most, holds]] of Object.entries(laws) as [keyof typeof PLACES, [number, number, boolean]][]) {
        for (const { name, width, column } of await openPlaces(page, kind, room, dir)) {
          if (width < least || width > most || (holds && column > room)) wrong.push(`${name} in ${room} px: ${width} px wide, its column ${column}`)
        }
      }
    }
    expect(wrong).toEqual([])
  })
}

test('what a page gives the figure itself stands over that', async ({ page }) => {
  const cases: [style: string, width: number, around?: string][] = [
    ['width: 240px', 240],
    ['inline-size: 50%', 300],
    ['margin-inline: -40px', 680],
    ['margin-inline: 40px', 520],
    ['width: 760px', 760],
    ['display: inline-block', 600],
    ['position: absolute', 832],
    ['', 300, 'display: grid; grid-template-columns: 1fr 1fr'],
    ['flex: 1', 300, 'display: flex'],
  ]
  const figure = (style: string) => `<fastslam-proposal style="${style}"></fastslam-proposal>`
  await openCourse(page, cases.map(([style, , around]) => `<div style="width: 600px; ${around ?? ''}">${figure(style)}${around ? figure(style) : ''}</div>`).join(''))
  await page.evaluate(() => customElements.whenDefined('fastslam-proposal'))
  const widths = await page.locator('body > div').evaluateAll(boxes => boxes.map(box => Math.round(box.querySelector('fastslam-proposal')!.getBoundingClientRect().width)))
  expect(widths).toEqual(cases.map(([, width]) => width))
})
