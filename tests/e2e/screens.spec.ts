// Every screen, direction and sheet: 400 % zoom, right to left, forced colours, small frames with a projector's letters, paper.
import type { Locator, Page } from '@playwright/test'
import { expect, test } from './fixtures'
import { Figure, frames } from './figure'
import { breadth, breadthOf, FIGURES, openCourse } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

const ALL = [...FIGURES, 'log']

/** A page of these figures with all there is of them open; that of logs has no picture before it has a log. */
async function openAllOf(page: Page, names: readonly string[], dir = 'ltr'): Promise<Figure[]> {
  await openCourse(page, `<div id="box" dir="${dir}">${names.map(name => `<fastslam-${name}></fastslam-${name}>`).join('')}</div>`)
  const figures = names.map(name => new Figure(page, `fastslam-${name}`))
  for (const [i, figure] of figures.entries()) {
    await figure.element.scrollIntoViewIfNeeded()
    if (names[i] === 'log') await expect(figure.sentence).not.toBeEmpty()
    else await figure.live()
    await figure.openSettings()
    if (names[i] === 'resampling' || names[i] === 'doors') await figure.openCount()
    await figure.settled()
  }
  return figures
}

const openWhole = async (page: Page, name: string, dir = 'ltr') => (await openAllOf(page, [name], dir))[0]!

/** What sticks out of the figure, or is cut off by what it stands in. */
const lost = (figure: Locator) =>
  figure.evaluate(element => {
    const { left, right } = element.getBoundingClientRect()
    const seen = [...element.shadowRoot!.querySelectorAll<HTMLElement>('*')].filter(inner => inner.checkVisibility() && !inner.matches('svg *, option, .hidden, .handles, .handles *'))
    const name = (inner: HTMLElement) => `${inner.localName}.${inner.className} ${inner.textContent?.slice(0, 30)}`
    const out = seen.filter(inner => {
      const box = inner.getBoundingClientRect()
      return box.width > 0 && (box.left < left - 0.5 || box.right > right + 0.5)
    })
    const cut = seen.filter(inner => !inner.matches('select, input, canvas') && getComputedStyle(inner).clipPath === 'none' && getComputedStyle(inner).overflowX !== 'visible' && inner.scrollWidth > inner.clientWidth + 1)
    // A list is as wide as what it shows, or shows the beginning of it.
    return { out: out.map(name), cut: cut.map(name) }
  })

/** At 400 % zoom, whatever the direction of the page. */
async function expectWhole(page: Page, names: readonly string[]): Promise<void> {
  await page.setViewportSize({ width: 320, height: 256 })
  const figures = await openAllOf(page, names)
  for (const dir of ['ltr', 'rtl']) {
    await page.locator('#box').evaluate((box, dir) => box.setAttribute('dir', dir), dir)
    await frames(page, 2)
    for (const [i, figure] of figures.entries()) {
      expect(await lost(figure.element), `${names[i]}, ${dir}`).toEqual({ out: [], cut: [] })
      expect(await figure.told.evaluate(sentence => sentence.scrollHeight - sentence.clientHeight), `the sentence of ${names[i]}`).toBeLessThanOrEqual(1)
    }
    expect(await page.evaluate(() => [document.documentElement.scrollWidth, document.documentElement.clientWidth]), dir).toEqual([320, 320])
  }
}

test('at 400 % nothing of any figure scrolls sideways and nothing is cut off, whatever the direction of the page', breadth, ({ page }) => expectWhole(page, ALL))

// Those that stand for the others, the one with most numbers and the one with most controls.
test('at 400 % nothing of five figures scrolls sideways and nothing is cut off, whatever the direction of the page', ({ page }) =>
  expectWhole(page, ['lap', 'proposal', 'log', 'worked-example', 'resampling']))

test('at 400 % the picture begins in the first screen, and chips unfold over it', async ({ page }) => {
  await page.setViewportSize({ width: 320, height: 256 })
  await openCourse(page, '<fastslam-lap></fastslam-lap>')
  const lap = new Figure(page, 'fastslam-lap')
  await lap.live()
  const above = () => lap.element.evaluate(element => element.shadowRoot!.querySelector('canvas')!.getBoundingClientRect().top - element.getBoundingClientRect().top)
  const folded = await above()
  expect(folded).toBeLessThan(160)
  const chip = lap.element.getByRole('button', { name: 'Only four' })
  await expect(chip).toBeHidden()
  const fold = lap.element.getByRole('button', { name: 'Challenges' })
  await fold.click()
  await expect(fold).toHaveAttribute('aria-expanded', 'true')
  await expect(chip).toBeVisible()
  expect(await above()).toBeGreaterThan(folded + 60)
  await chip.click()
  await lap.settled()
  await expect(chip).toHaveAttribute('aria-pressed', 'true')
  await fold.click()
  expect(await above()).toBe(folded)
})

test('on a page from right to left the controls change sides, and time and numbers do not', async ({ page }) => {
  await page.setViewportSize({ width: 1000, height: 800 })
  const lap = await openWhole(page, 'lap', 'rtl')
  for (const width of [1000, 380]) {
    await page.setViewportSize({ width, height: 800 })
    await lap.reset.click()
    await lap.settled()
    const x = async (locator: Locator) => (await locator.boundingBox())!.x
    const name = lap.element.locator('.slider:has([name=odometry]) .name')
    expect(await x(name)).toBeGreaterThan(await x(lap.box('odometry')))
    expect(await x(lap.element.locator('[part=title]'))).toBeGreaterThan(await x(lap.element.locator('button[aria-label=Menu]')))
    // Words begin at the right, and end with their own mark.
    const ends = await lap.element.locator('.sentence, .ask').evaluateAll(elements =>
      elements.map(element => {
        const range = document.createRange()
        range.selectNodeContents(element)
        const [box, lines] = [element.getBoundingClientRect(), [...range.getClientRects()]]
        const last = document.createRange()
        const text = element.firstChild as Text
        last.setStart(text, text.length - 1)
        last.setEnd(text, text.length)
        return { gap: box.right - Math.max(...lines.map(line => line.right)), mark: last.getBoundingClientRect().right - lines.at(-1)!.right }
      }),
    )
    expect(ends).toHaveLength(2)
    for (const { gap, mark } of ends) {
      expect(gap).toBeLessThan(20)
      expect(Math.abs(mark)).toBeLessThan(1)
    }
    await expect(lap.element.locator('select[aria-label=Speed]')).toHaveCSS('direction', 'ltr')
    // A slider of a parameter has its most at the left …
    const click = async (slider: Locator, share: number) => {
      const box = (await slider.boundingBox())!
      await slider.click({ position: { x: share * box.width, y: box.height / 2 } })
      await lap.settled()
    }
    const before = Number(await lap.box('odometry').inputValue())
    await click(lap.slider('odometry'), 0.05)
    expect(Number(await lap.box('odometry').inputValue())).toBeGreaterThan(before)
    // … and time goes to the right, as it does in the pictures: in the row of playback, and by keys.
    await click(lap.scrub, 0.9)
    expect(await lap.position()).toBeGreaterThan(0.8 * (await lap.last()))
    await lap.scrubTo(7)
    await lap.scrub.press('ArrowRight')
    await expect.poll(() => lap.position()).toBe(8)
    await lap.element.locator('.stage').press('ArrowRight')
    await expect.poll(() => lap.position()).toBe(9)
    expect(await x(lap.stepBack)).toBeLessThan(await x(lap.step))
    // Numbers as they are written: step before last, value before unit, and a minus before its number.
    const order = (inner: string, ...texts: string[]) =>
      lap.element.locator(inner).first().evaluate((element, parts) => {
        const walker = document.createTreeWalker(element, NodeFilter.SHOW_TEXT)
        const places: number[] = []
        for (let node = walker.nextNode(); node; node = walker.nextNode()) {
          for (const part of parts) {
            const at = node.textContent!.indexOf(part)
            if (at < 0) continue
            const range = document.createRange()
            range.setStart(node, at)
            range.setEnd(node, at + part.length)
            places.push(range.getBoundingClientRect().x)
          }
        }
        return places
      }, texts)
    const [step, last] = await order('.timeline .position', '9 ', String(await lap.last()))
    expect(step).toBeLessThan(last!)
    const number = await lap.element.locator('[part=readout] dd:has(.unit:not(:empty))').first().evaluate(dd => [...dd.children].map(child => child.getBoundingClientRect().x))
    expect(number[0]).toBeLessThan(number[1]!)
    await expect(lap.box('odometry')).toHaveCSS('direction', 'ltr')
  }
})

test('the bars of a count and their intervals begin at the same side, whatever the direction of the page', async ({ page }) => {
  const figure = await openWhole(page, 'resampling')
  await figure.element.getByRole('button', { name: /Count over/ }).click()
  await expect(figure.element.locator('.count .said')).toContainText('200 seeds counted', { timeout: 60_000 })
  for (const dir of ['ltr', 'rtl']) {
    await page.locator('#box').evaluate((box, dir) => box.setAttribute('dir', dir), dir)
    const bars = await figure.element.locator('.track').evaluateAll(tracks =>
      tracks.map(track => {
        const [fill, range] = [...track.children].map(child => child.getBoundingClientRect()) as [DOMRect, DOMRect]
        const { left, right } = track.getBoundingClientRect()
        const from = (x: number) => (getComputedStyle(track).direction === 'rtl' ? right - x : x - left)
        const end = getComputedStyle(track).direction === 'rtl' ? fill.left : fill.right
        return { fill: from(end), range: [from(range.left), from(range.right)].sort((a, b) => a - b) }
      }),
    )
    expect(bars).toHaveLength(3)
    for (const { fill, range } of bars) {
      expect(fill, dir).toBeGreaterThanOrEqual(range[0]! - 1)
      expect(fill, dir).toBeLessThanOrEqual(range[1]! + 1)
    }
  }
})

for (const name of ALL) {
  test(`in forced colours every control of ${name} can be seen, light and dark`, breadthOf(name), async ({ page }) => {
    await page.setViewportSize({ width: 1000, height: 2600 })
    await page.emulateMedia({ forcedColors: 'active', colorScheme: 'light', reducedMotion: 'reduce' })
    const figure = await openWhole(page, name)
    for (const colorScheme of ['light', 'dark'] as const) {
      await page.emulateMedia({ forcedColors: 'active', colorScheme, reducedMotion: 'reduce' })
      await figure.settled()
      const expectSeen = async (what: string, controls: string) => {
        const shot = (await page.screenshot()).toString('base64')
        const unseen = await figure.element.evaluate(async (element, [png, selector]) => {
          const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${png}`)).blob())
          const canvas = new OffscreenCanvas(image.width, image.height).getContext('2d', { willReadFrequently: true })!
          canvas.drawImage(image, 0, 0)
          const root = element.shadowRoot!
          const controls = [...root.querySelectorAll<HTMLElement>(selector)].filter(control => control.checkVisibility({ visibilityProperty: true, opacityProperty: true }) && !control.matches('.hidden, .handle input'))
          const linear = Array.from({ length: 256 }, (_, c) => ((c / 255 + 0.055) / 1.055) ** 2.4)
          const light = (i: number, data: Uint8ClampedArray) => 0.2126 * linear[data[i]!]! + 0.7152 * linear[data[i + 1]!]! + 0.0722 * linear[data[i + 2]!]!
          return controls
            .filter(control => {
              const { x, y, width, height } = control.getBoundingClientRect()
              const { data } = canvas.getImageData(Math.floor(x), Math.floor(y), Math.ceil(width), Math.ceil(height))
              let [least, most] = [1, 0]
              for (let i = 0; i < data.length; i += 4) [least, most] = [Math.min(least, light(i, data)), Math.max(most, light(i, data))]
              return (most + 0.05) / (least + 0.05) < 3
            })
            .map(control => control.outerHTML.slice(0, 100))
        }, [shot, controls] as const)
        expect(unseen, `${colorScheme}: ${what}`).toEqual([])
      }
      await expectSeen('at rest', 'button, summary, select, input, progress, .handle')
      await figure.element.locator('button[aria-label=Menu]').click()
      await expectSeen('its menu', '.items button')
      await page.keyboard.press('Escape')
    }
  })
}

for (const name of FIGURES) {
  // The worked example, all of numbers in matrices, is the widest and the highest.
  test(`a frame of 900 × 560 cuts nothing of ${name} off, with letters of the normal size and a projector’s`, name === 'worked-example' ? {} : breadth, async ({ page }) => {
    await page.setViewportSize({ width: 900, height: 560 })
    const figure = await new Figure(page, `fastslam-${name}`).open(`./embed.html?figure=${name}`)
    for (const size of ['normal', 'presentation']) {
      await figure.element.evaluate((element, size) => element.setAttribute('size', size), size)
      await figure.settled()
      await figure.element.evaluate(element => element.shadowRoot!.querySelector('.figure')!.scrollTo(0, 0))
      const [canvas, stage] = [(await figure.canvas.boundingBox())!, (await figure.element.locator('.stage').boundingBox())!]
      // All of the picture is in the window; the rest is, or is scrolled to.
      const { y, height } = (await figure.canvas.boundingBox())!
      expect(y + height, `${size}, picture`).toBeLessThanOrEqual(560)
      expect(canvas.width, `${size}, sideways`).toBeLessThanOrEqual(stage.width)
      const [shown, own] = await figure.canvas.evaluate((canvas: HTMLCanvasElement) => [canvas.clientWidth / canvas.clientHeight, canvas.width / canvas.height])
      expect(getShare(shown!, own!), `${size}, the picture keeps its shape`).toBeLessThan(0.01)
      const { wide, room } = await figure.element.evaluate(element => {
        const body = element.shadowRoot!.querySelector<HTMLElement>('.figure')!
        return { wide: body.scrollWidth, room: body.clientWidth }
      })
      expect(wide, size).toBe(room)
      const end = figure.element.locator('[part=numbers]')
      await end.scrollIntoViewIfNeeded()
      await expect(end).toBeInViewport()
    }
  })
}

test('on paper every figure is whole, seen or not yet, without what can be done with it', async ({ page }) => {
  await page.setViewportSize({ width: 1200, height: 500 })
  await openCourse(page, ALL.map(name => `<p style="height: 1500px">${name}</p><fastslam-${name}></fastslam-${name}>`).join(''))
  await page.evaluate(() => customElements.whenDefined('fastslam-log').then(() => undefined))
  const lap = new Figure(page, 'fastslam-lap')
  await lap.element.scrollIntoViewIfNeeded()
  await lap.live()
  await page.evaluate(() => scrollTo(0, 0))
  const pdf = (await page.pdf()).toString('latin1')
  expect(pdf.match(/\/Subtype \/Image/g)?.length, 'pictures on paper').toBe(ALL.length)
  await page.emulateMedia({ media: 'print' })
  for (const name of ALL) {
    const figure = page.locator(`fastslam-${name}`)
    await figure.scrollIntoViewIfNeeded()
    const picture = figure.locator('canvas, .fallback img').filter({ visible: true })
    await expect(picture, name).toHaveCount(1)
    const [shown, own] = await picture.evaluate(async element => {
      if (element instanceof HTMLImageElement) await element.decode()
      const { width, height } = element.getBoundingClientRect()
      const [w, h] = element instanceof HTMLImageElement ? [element.naturalWidth, element.naturalHeight] : [(element as HTMLCanvasElement).width, (element as HTMLCanvasElement).height]
      return [width / height, w / h]
    })
    expect(getShare(shown!, own!), `${name} keeps its shape`).toBeLessThan(0.02)
    await expect(figure.locator('button, input, select, summary').filter({ visible: true }), name).toHaveCount(0)
    await expect(figure.locator('[part=title]'), name).not.toBeEmpty()
  }
})

function getShare(a: number, b: number): number {
  return Math.abs(a - b) / b
}
