// A symbol is lit wherever it is written, by mouse, finger and keyboard: in formulas, in listings, and in the pictures in sight.
import type { Locator, Page } from '@playwright/test'
import { frames } from './figure'
import { expect, test } from './fixtures'

/** What listings have lit, each once. */
const inListings = (page: Page): Promise<string[]> =>
  page.evaluate(() => [...new Set([...(CSS.highlights.get('symbol') ?? [])].map(range => (range as Range).toString()))].sort())

/** What formulas have lit, each once, without exponents. */
const inFormulas = (page: Page): Promise<string[]> =>
  page.locator('math .lit').evaluateAll(all => {
    const named = (one: Element) => [...one.children].slice(0, { msup: 1, msubsup: 2 }[one.localName]).map(part => part.textContent).join('')
    return [...new Set(all.map(one => named(one) || one.textContent))].sort()
  })

const pixels = (canvas: Locator): Promise<string> => canvas.evaluate(canvas => (canvas as HTMLCanvasElement).toDataURL())

const S = (page: Page) => page.locator('#eq-weight-1 mi').getByText('S', { exact: true }).last()

test('pointing at a symbol lights it in all formulas and listings, and leaving puts it out', async ({ page }) => {
  await page.goto('./')
  await S(page).hover()
  await expect.poll(() => inFormulas(page)).toEqual(['S'])
  expect(await page.locator('math .lit').count()).toBeGreaterThan(12)
  expect(await inListings(page)).toEqual(['S', 'innovation.covariance'])
  await expect(S(page)).not.toHaveCSS('background-color', 'rgba(0, 0, 0, 0)')

  // An index that counts is none of the name; one that tells symbols apart is.
  await page.locator('#eq-weight-1 msub').filter({ hasText: /^Hm$/ }).first().hover()
  await expect.poll(() => inFormulas(page)).toEqual(['Hm'])
  expect(await inListings(page)).toEqual(['H_m', 'h_m'])
  await page.locator('#eq-weight-1 mi').getByText('Σ').hover()
  await expect.poll(() => inFormulas(page)).toContain('Σj')
  expect(await inFormulas(page)).not.toContain('Σx')

  await page.mouse.move(0, 0)
  await page.locator('h1').hover()
  await expect(page.locator('math .lit')).toHaveCount(0)
  expect(await inListings(page)).toEqual([])
})

test('a formula is a stop of the Tab key; arrow keys go from symbol to symbol, and Escape puts the light out', async ({ page }) => {
  await page.goto('./')
  const formula = page.locator('#eq-gain-form math, #eq-weight-2 math').last()
  await formula.evaluate(element => {
    for (let at = element.closest('details'); at; at = at.parentElement!.closest('details')) at.open = true
  })
  await formula.focus()
  const { x, y } = (await formula.boundingBox())!
  await page.mouse.move(x + 5, y - 20)
  const walk: string[] = []
  for (let i = 0; i < 4; i++) {
    await page.keyboard.press('ArrowRight')
    walk.push((await inFormulas(page)).join(' '))
    // A mouse that rests has not moved where the page does below it.
    await page.evaluate(by => scrollBy({ top: by, behavior: 'instant' }), i % 2 ? 200 : -200)
    await frames(page, 8)
    expect((await inFormulas(page)).join(' ')).toBe(walk[i])
  }
  expect(new Set(walk).size).toBeGreaterThanOrEqual(3)
  await page.keyboard.press('ArrowLeft')
  expect((await inFormulas(page)).join(' ')).toBe(walk[2])
  await page.keyboard.press('Escape')
  await expect(page.locator('math .lit')).toHaveCount(0)
  await page.keyboard.press('ArrowRight')
  await expect(page.locator('math .lit')).not.toHaveCount(0)
  await page.keyboard.press('Tab')
  await expect(page.locator('math .lit')).toHaveCount(0)
})

test.describe('by touch', () => {
  test.use({ hasTouch: true, viewport: { width: 380, height: 760 } })

  test('a tap lights a symbol, and a tap elsewhere puts it out', async ({ page }) => {
    await page.goto('./')
    // Where what is above takes its height as it is tapped, the finger meets another place.
    await expect(async () => {
      await S(page).tap()
      expect(await inFormulas(page)).toEqual(['S'])
    }).toPass()
    await page.locator('#weight').tap({ position: { x: 2, y: 2 } })
    await expect(page.locator('math .lit')).toHaveCount(0)
  })
})

test('a picture in sight lights the symbol where it writes it', async ({ page }) => {
  await page.setViewportSize({ width: 1366, height: 1800 })
  await page.goto('./')
  const figure = page.locator('fastslam-worked-example')
  const canvas = figure.locator('canvas')
  await canvas.scrollIntoViewIfNeeded()
  await expect(figure.locator('.stage')).toHaveClass(/live/, { timeout: 30_000 })
  await frames(page, 3)
  const before = await pixels(canvas)
  const surprise = page.locator('xpath=//h2[@id="by-hand"]/following::*[local-name()="mi"][text()="ν"]').first()
  await surprise.evaluate(symbol => symbol.dispatchEvent(new PointerEvent('pointermove', { bubbles: true, pointerType: 'mouse' })))
  await expect.poll(() => pixels(canvas)).not.toBe(before)
  await page.locator('#by-hand').evaluate(heading => heading.dispatchEvent(new PointerEvent('pointermove', { bubbles: true, pointerType: 'mouse' })))
  await expect.poll(() => pixels(canvas)).toBe(before)
})
