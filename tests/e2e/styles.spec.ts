// Styles of the page around a figure end at its edge; those that a reader has set do not. Its colours are those that the page says it has.
import type { Page } from '@playwright/test'
import { expect, test } from './fixtures'
import { Figure, frames } from './figure'
import { breadth, FIGURES, openCourse } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

/** What is inherited, each as unlike its usual value as it can be. */
const HOSTILE = `
  border-collapse: collapse; border-spacing: 30px; caption-side: bottom; empty-cells: hide; list-style: upper-roman inside; quotes: "<" ">";
  color: red; cursor: wait; caret-color: red; accent-color: red; fill: red; stroke: red; stroke-width: 4px; paint-order: stroke; image-rendering: pixelated;
  font: italic small-caps 900 condensed 31px/3 monospace; font-feature-settings: "zero", "ss01"; font-kerning: none; font-palette: dark; font-size-adjust: 1.2;
  font-synthesis: none; font-variant-numeric: slashed-zero oldstyle-nums; font-variant-ligatures: none; font-variant-position: super; font-variation-settings: "wght" 900; font-optical-sizing: none;
  letter-spacing: .3em; word-spacing: 2em; line-height: 3; tab-size: 40; orphans: 9; widows: 9; ruby-position: under; ruby-align: start;
  text-align: end; text-align-last: justify; text-indent: 3em; text-transform: uppercase; text-shadow: 3px 3px red; text-rendering: geometricPrecision; text-size-adjust: 300%;
  text-decoration: underline wavy red 3px; text-decoration-skip-ink: none; text-underline-offset: 9px; text-underline-position: under; text-emphasis: "★" red; text-emphasis-position: under;
  text-orientation: upright; text-spacing-trim: space-all; text-autospace: no-autospace; text-wrap: balance; text-box-edge: ex alphabetic; hanging-punctuation: first; hyphens: auto; hyphenate-character: "+";
  white-space: nowrap; word-break: break-all; overflow-wrap: anywhere; line-break: anywhere; user-select: none; scrollbar-color: red blue; print-color-adjust: exact; forced-color-adjust: none;
  -webkit-text-fill-color: red; -webkit-text-stroke: 2px red; -webkit-text-security: disc; -webkit-font-smoothing: none; -webkit-tap-highlight-color: red;`

interface Look {
  styles: Record<string, string[]>
  shot: Buffer
}

/** What the styles of all parts of a figure come to, on a page with these styles, and a picture of it. */
async function look(page: Page, name: string, css: string): Promise<Look> {
  await page.mouse.move(0, 0)
  await openCourse(page, `<style>${css}</style><main style="width: 832px; margin: 0"><fastslam-${name}></fastslam-${name}></main>`)
  const figure = new Figure(page, `fastslam-${name}`)
  await figure.live()
  await figure.openSettings()
  await figure.settled()
  await page.mouse.move(0, 0)
  const styles = await figure.element.evaluate(element =>
    Object.fromEntries(
      [...element.shadowRoot!.querySelectorAll('*')].map((inner, i) => {
        const style = getComputedStyle(inner)
        return [`${i} ${inner.localName}.${inner.getAttribute('class')}`, [...style].map(property => `${property}: ${style.getPropertyValue(property)}`)]
      }),
    ),
  )
  return { styles, shot: await figure.element.screenshot() }
}

/** How many pixels two pictures differ in, by more than a browser rounds at the corners of a frame. */
const differing = (page: Page, ...shots: [Buffer, Buffer]): Promise<number> =>
  page.evaluate(async pngs => {
    const [a, b] = await Promise.all(
      pngs.map(async png => {
        const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${png}`)).blob())
        const canvas = new OffscreenCanvas(image.width, image.height).getContext('2d', { willReadFrequently: true })!
        canvas.drawImage(image, 0, 0)
        return canvas.getImageData(0, 0, image.width, image.height).data
      }),
    )
    return a!.length === b!.length ? a!.filter((value, i) => Math.abs(value - b![i]!) > 8).length : Infinity
  }, shots.map(shot => shot.toString('base64')))

for (const name of FIGURES) {
  test(`no style that the page gives its text reaches ${name}`, name === 'lap' ? {} : breadth, async ({ page }) => {
    const plain = await look(page, name, '')
    const hostile = await look(page, name, `main { ${HOSTILE} } main::first-letter { font-size: 70px; float: left } main::first-line { background: red; color: red } main { color-scheme: light }`)
    const wrong = Object.entries(hostile.styles).flatMap(([part, styles]) => {
      const own = new Set(plain.styles[part])
      return styles.filter(style => !own.has(style) && !/^color-scheme: /.test(style)).map(style => `${part} { ${style} }`)
    })
    expect(wrong).toEqual([])
    expect(await differing(page, hostile.shot, plain.shot), 'pixels that look another way').toBe(0)
  })
}

/** What sticks out of a figure sideways, is cut off, or lies over its neighbour. */
const lost = (figure: Figure) =>
  figure.element.evaluate(element => {
    const root = element.shadowRoot!
    const { left, right } = element.getBoundingClientRect()
    const seen = [...root.querySelectorAll<HTMLElement>('*')].filter(inner => inner.checkVisibility() && !inner.matches('svg *, option, .handles, .handles *') && getComputedStyle(inner).clipPath === 'none')
    const name = (inner: HTMLElement) => `${inner.localName}.${inner.className} ${inner.textContent?.slice(0, 40)}`
    // Chips are in a row that is scrolled sideways, where there is little room.
    const out = seen.filter(inner => {
      const box = inner.getBoundingClientRect()
      return box.width > 0 && !inner.closest('.chips') && (box.left < left - 0.5 || box.right > right + 0.5)
    })
    const cut = seen.filter(inner => {
      const { overflowX, overflowY } = getComputedStyle(inner)
      if (inner.matches('select, input, canvas, .wheel')) return false
      return (['hidden', 'clip'].includes(overflowX) && inner.scrollWidth > inner.clientWidth + 1) || (['hidden', 'clip'].includes(overflowY) && inner.scrollHeight > inner.clientHeight + 1)
    })
    return { out: out.map(name), cut: cut.map(name) }
  })

// As 1.4.12 of WCAG has it; what a reader's own style sheet says, the page's cannot stop.
const READER = '* { letter-spacing: .12em !important; line-height: 1.5 !important; word-spacing: .16em !important }'

for (const name of FIGURES) {
  test(`a reader’s own spacing reaches ${name}, and nothing of it is lost`, name === 'lap' ? {} : breadth, async ({ page }) => {
    await openCourse(page, `<style>${READER}</style><fastslam-${name}></fastslam-${name}>`)
    const figure = new Figure(page, `fastslam-${name}`)
    for (const width of [1366, 848, 380]) {
      await page.setViewportSize({ width, height: 800 })
      await figure.live()
      await frames(page, 3)
      expect(await figure.told.evaluate(sentence => [getComputedStyle(sentence).letterSpacing, getComputedStyle(sentence).wordSpacing])).toEqual(['1.92px', '2.56px'])
      expect(await lost(figure), `${width} px`).toEqual({ out: [], cut: [] })
      expect(await page.evaluate(() => document.documentElement.scrollWidth), 'nothing scrolls sideways').toBe(width)
    }
  })
}

/** Whether the picture is dark, and whether all that stands around it is. */
async function shades(figure: Figure): Promise<string> {
  await frames(figure.page, 3)
  await figure.settled()
  return figure.element.evaluate(element => {
    const body = element.shadowRoot!.querySelector<HTMLElement>('.figure')!
    const light = (colour: string) => Math.max(...(colour.match(/[\d.]+/g) ?? []).slice(0, 3).map(Number)) > 127
    const { backgroundColor, color } = getComputedStyle(body)
    const name = (isLight: boolean) => (isLight ? 'light' : 'dark')
    // The body takes the paper that was painted.
    return [name(light(body.style.getPropertyValue('--_paper'))), name(light(backgroundColor)), name(!light(color))].join(' ')
  })
}

test('of itself a figure has the colours that the page says it has, at once when it is switched; where it says nothing, the reader’s', async ({ page }) => {
  await openCourse(page, '<div id="switch"><main><fastslam-proposal></fastslam-proposal></main></div>')
  const figure = new Figure(page, 'fastslam-proposal')
  await figure.live()
  const set = (where: string, scheme: string) => page.locator(where).evaluate((element, scheme) => ((element as HTMLElement).style.colorScheme = scheme), scheme)
  for (const reader of ['light', 'dark'] as const) {
    const other = reader === 'light' ? 'dark' : 'light'
    await page.emulateMedia({ colorScheme: reader })
    for (const [scheme, seen] of [['', reader], [other, other], [reader, reader], ['light dark', reader], ['only dark', 'dark'], ['', reader]] as const) {
      await set('#switch', scheme)
      expect(await shades(figure), `${scheme || 'nothing'} on the page, ${reader} for the reader`).toBe(`${seen} ${seen} ${seen}`)
    }
    // An author's word stands over it.
    await figure.element.evaluate((element, theme) => element.setAttribute('theme', theme), other)
    expect(await shades(figure)).toBe(`${other} ${other} ${other}`)
    await set('#switch', reader)
    expect(await shades(figure)).toBe(`${other} ${other} ${other}`)
    await figure.element.evaluate(element => element.setAttribute('theme', 'auto'))
    expect(await shades(figure)).toBe(`${reader} ${reader} ${reader}`)
    await set('#switch', '')
  }
})

test('where colours are forced, the picture is as dark as they are, whatever was asked for', async ({ page }) => {
  await openCourse(page, '<main><fastslam-proposal></fastslam-proposal></main>')
  const figure = new Figure(page, 'fastslam-proposal')
  await figure.live()
  for (const colorScheme of ['dark', 'light'] as const) {
    await page.emulateMedia({ forcedColors: 'active', colorScheme })
    for (const theme of ['auto', 'light', 'dark']) {
      for (const scheme of ['', 'light', 'dark']) {
        await page.locator('main').evaluate((main, scheme) => (main.style.colorScheme = scheme), scheme)
        await figure.element.evaluate((element, theme) => element.setAttribute('theme', theme), theme)
        expect(await shades(figure), `${theme}, ${scheme || 'nothing'} on the page`).toBe(`${colorScheme} ${colorScheme} ${colorScheme}`)
      }
    }
  }
})
