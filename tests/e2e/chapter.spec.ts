// The chapter as a text: to read, to print, to follow by keyboard, on every screen, with and without script.
import type { Locator, Page } from '@playwright/test'
import { brokenRules, leaveOneOfEachKind } from './axe'
import { expect, test } from './fixtures'
import { Figure, holdPrograms, settled } from './figure'
import { breadth, FIGURES } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

/** Opens what is folded, so that all of the text is there. */
const unfold = (page: Page) => page.evaluate(() => document.querySelectorAll('details').forEach(details => (details.open = true)))

// The figures have their own tests.
const but = FIGURES.map(name => `fastslam-${name}`)

test('axe finds nothing in the text, unfolded, nor in the colours of each kind of text, light and dark', async ({ page }) => {
  for (const address of ['./', './model.html', './solutions.html']) {
    await page.goto(address)
    await unfold(page)
    expect(await brokenRules(page, { but, contrast: false }), address).toEqual([])
    // Contrast takes five times as long as all other rules together, most of it in formulas, which have the colour of what they lie in.
    await page.evaluate(names => document.querySelectorAll(names).forEach(figure => figure.remove()), but.join())
    expect(await leaveOneOfEachKind(page)).toBeGreaterThan(address === './' ? 200 : 20)
    for (const colorScheme of ['light', 'dark'] as const) {
      await page.emulateMedia({ colorScheme })
      expect(await brokenRules(page, { contrast: 'only' }), `${address}, ${colorScheme}`).toEqual([])
    }
  }
})

for (const colorScheme of ['light', 'dark'] as const) {
  test(`axe finds nothing in the ${colorScheme} text, unfolded, with every text and formula of it`, breadth, async ({ page }) => {
    test.slow()
    await page.emulateMedia({ colorScheme })
    for (const address of ['./', './model.html', './solutions.html']) {
      await page.goto(address)
      await unfold(page)
      expect(await brokenRules(page, { but })).toEqual([])
    }
  })
}

test('nothing is wider than the window, with text at 200 % either, and lines are no longer than 75 letters', async ({ page }) => {
  const wide = () => page.evaluate(() => document.documentElement.scrollWidth)
  await page.setViewportSize({ width: 640, height: 800 })
  const lap = await new Figure(page, 'fastslam-lap').open()
  await page.evaluate(() => (document.documentElement.style.fontSize = '200%'))
  for (const width of [640, 320]) {
    await page.setViewportSize({ width, height: 640 })
    await lap.settled()
    expect(await wide(), 'text at 200 %').toBe(width)
  }
  await page.evaluate(() => (document.documentElement.style.fontSize = ''))
  await unfold(page)
  for (const width of [320, 380, 820, 1080, 1440, 2560, 3840]) {
    await page.setViewportSize({ width, height: 900 })
    expect(await wide()).toBe(width)
    const letters = await page.evaluate(() => {
      const lines = [...document.querySelectorAll('main > section > p')].flatMap(p => {
        const height = Number.parseFloat(getComputedStyle(p).lineHeight)
        const count = Math.round(p.getBoundingClientRect().height / height)
        return count > 4 ? [p.textContent!.length / (count - 0.4)] : []
      })
      return lines.reduce((sum, line) => sum + line, 0) / lines.length
    })
    expect(letters, `at ${width} px`).toBeLessThan(75)
    if (width > 700) expect(letters, `at ${width} px`).toBeGreaterThan(65)
  }
})

/**
 * What moved without the reader's doing, from the start on; asked when it is over. The thumb of a slider goes along while a figure plays, and
 * is no such thing: a square of a shadow tree, whose nodes are not told, that moves sideways.
 */
async function watchShifts(page: Page): Promise<() => Promise<string[]>> {
  await page.addInitScript(() => {
    type Moved = { node?: Node | null; previousRect: DOMRectReadOnly; currentRect: DOMRectReadOnly }
    const isThumb = ({ node, previousRect: from, currentRect: to }: Moved) => !node && to.width === to.height && from.y === to.y && from.width === to.width
    const seen = Object.assign(window, { shifts: [] as string[] }).shifts
    new PerformanceObserver(list => {
      for (const entry of list.getEntries() as (PerformanceEntry & { value: number; sources: Moved[] })[]) {
        if (entry.sources.every(isThumb)) continue
        seen.push(`${entry.value.toFixed(5)} at ${scrollY}: ${entry.sources.map(({ node }) => (node as Element)?.outerHTML?.slice(0, 60)).join(' ')}`)
      }
    }).observe({ type: 'layout-shift', buffered: true })
  })
  return () => page.evaluate(() => (window as unknown as { shifts: string[] }).shifts)
}

test('nothing moves while one reads from top to end', async ({ page }) => {
  test.slow()
  const shifts = await watchShifts(page)
  await page.goto('./')
  const end = await page.evaluate(() => document.documentElement.scrollHeight)
  for (let y = 0; y < end; y += 600) {
    await page.evaluate(top => scrollTo({ top, behavior: 'instant' }), y)
    // Faster than anybody reads.
    await page.evaluate(() => Promise.all([...document.querySelectorAll('figure *')].map(element => (element as Partial<{ settled(): Promise<void> }>).settled?.())))
  }
  expect(await shifts()).toEqual([])
  const told = await page.locator('main :defined').evaluateAll(all => all.map(figure => figure.shadowRoot?.querySelector('[role=alert]')?.textContent ?? ''))
  expect(told.filter(Boolean), 'no figure has anything to tell its author').toEqual([])
})

for (const width of [1280, 380]) {
  test(`nothing moves below a figure that comes to life under the reader's eyes, ${width} px`, async ({ page }) => {
    await page.setViewportSize({ width, height: 800 })
    const shifts = await watchShifts(page)
    const open = await holdPrograms(page)
    await page.goto('./')
    const figure = new Figure(page, 'fastslam-conditioning') // which has nothing to play at first
    await figure.element.evaluate(element => element.scrollIntoView({ block: 'end', behavior: 'instant' }))
    await expect(figure.element.locator('.title')).not.toBeEmpty()
    const height = () => figure.element.evaluate(element => element.getBoundingClientRect().height)
    const before = await height()
    // Also on a slow network, of which it tells.
    await expect(figure.element.getByRole('status')).toContainText('Still loading')
    open()
    await expect(figure.element.locator('.stage.live')).toBeVisible()
    await figure.settled()
    expect(Math.abs((await height()) - before)).toBeLessThan(width > 500 ? 3 : 64)
    if (width > 500) expect(await shifts()).toEqual([])
  })
}

for (const [width, most] of [[1280, 3], [380, 64]] as const) {
  test(`the figures of the exercises take what was kept free for them, ${width} px`, async ({ page }) => {
    await page.setViewportSize({ width, height: 800 })
    const open = await holdPrograms(page)
    await page.goto('./')
    const trials = page.locator('.trial > *')
    const heights = () => trials.evaluateAll(all => all.map(figure => figure.getBoundingClientRect().height))
    await expect(trials.locator('.reserved')).toHaveCount(3)
    const before = await heights()
    open()
    for (const trial of await trials.all()) {
      await trial.scrollIntoViewIfNeeded()
      await expect(trial.locator('.stage.live')).toBeVisible()
      await settled(trial)
      await expect(trial.getByRole('alert'), 'nothing in it is misspelt').toBeEmpty()
    }
    for (const [i, after] of (await heights()).entries()) expect(Math.abs(before[i]! - after), `the ${i + 1}th: ${before[i]} px kept, ${after} px taken`).toBeLessThan(most)
  })
}

test.describe('without JavaScript', () => {
  test.use({ javaScriptEnabled: false })

  test('text, formulas, tables and pictures are there, and terms lead to their entries', async ({ page }) => {
    await page.goto('./')
    await expect(page.locator('noscript .hint')).toBeVisible()
    // What is open is there, and what is folded is a click away.
    for (const what of ['.eq math', 'table', 'pre', '.algorithm li']) await expect(page.locator(`main > section ${what}:not(details *)`).first()).toBeVisible()
    const deeper = page.locator('.deeper').filter({ has: page.locator('table') }).first()
    await expect(deeper.locator('table')).toBeHidden()
    await deeper.locator('summary').click()
    await expect(deeper.locator('table')).toBeVisible()
    for (const picture of await page.locator('main figure picture img').all()) {
      await picture.scrollIntoViewIfNeeded()
      await expect(picture).toBeVisible()
    }
    const term = page.locator('main a.term').first()
    const entry = page.locator((await term.getAttribute('href'))!)
    await term.click()
    await expect(entry).toBeInViewport()
  })

  test('a side note unfolds on a phone, and stands in the margin where there is one', async ({ page }) => {
    await page.goto('./')
    const mark = page.locator('main > section .nref').first()
    test.skip((await mark.count()) === 0, 'the chapter has no footnotes')
    const note = page.locator('main > section .sidenote').first()
    await expect(note).toBeVisible()
    await page.setViewportSize({ width: 380, height: 800 })
    await expect(note).toBeHidden()
    await mark.locator('input').check()
    await expect(note).toBeVisible()
  })
})

test('a reader by keyboard gets past the head, is told where in the contents it is, and has cards on focus and on pointing, which Escape closes', async ({ page }) => {
  await page.goto('./')
  await page.keyboard.press('Tab')
  const skip = page.getByRole('link', { name: 'Skip to the chapter' })
  await expect(skip).toBeFocused()
  await page.keyboard.press('Enter')
  await expect(page.locator((await skip.getAttribute('href'))!)).toBeFocused()

  await page.goto('./#mathematics')
  await expect(page.locator('.contents [aria-current]')).toHaveText('The mathematics')
  await page.goto('./#references')
  await expect(page.locator('.contents [aria-current]')).toHaveText('References')

  const card = page.locator('#card')
  for (const kind of ['a.term', 'a.cite', 'a.eqref']) {
    const link = page.locator(`main > section > p ${kind}, main > section > section > p ${kind}`).first()
    await link.scrollIntoViewIfNeeded()
    await link.hover()
    await expect(card).toBeVisible()
    await expect(link).toHaveAttribute('aria-describedby', 'card')
    expect((await card.textContent())!.length).toBeGreaterThan(3)
    const box = (await card.boundingBox())!
    expect(box.x).toBeGreaterThanOrEqual(0)
    expect(box.x + box.width).toBeLessThanOrEqual(1280)
    await page.keyboard.press('Escape')
    await expect(card).toBeHidden()
    await page.mouse.move(0, 0)
    await page.keyboard.press('Tab') // from now on the keyboard is in use
    await link.focus()
    await expect(card).toBeVisible()
    await page.keyboard.press('Escape')
    await expect(card).toBeHidden()
  }
})

test.describe('by touch', () => {
  test.use({ hasTouch: true, isMobile: true, viewport: { width: 380, height: 740 } })

  test('the first tap on a term shows its card, the second follows the link', async ({ page }) => {
    await page.goto('./')
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(380)
    const term = page.locator('main a.term').first()
    await term.scrollIntoViewIfNeeded()
    const before = page.url()
    await term.tap()
    await expect(page.locator('#card')).toBeVisible()
    expect(page.url()).toBe(before)
    await term.tap()
    expect(page.url()).toContain('#gloss-')
  })
})

test('on paper a figure is what it shows, with the link to that, and everything is unfolded; on a screen a derivation is once a link leads into it, as is what goes deeper, and what follows a question once a guess is written', async ({ page }) => {
  await page.goto('./')
  const lap = page.locator('fastslam-lap')
  await lap.scrollIntoViewIfNeeded()
  await expect(lap.locator('.stage.live')).toBeVisible()
  const fold = page.locator('.derivation > .fold').first()
  await expect(fold).toBeHidden()
  await page.emulateMedia({ media: 'print' })
  await expect(lap.locator('img')).toBeHidden()
  await expect(lap.locator('canvas')).toBeVisible()
  await expect(lap.locator('.transport')).toBeHidden()
  await expect(fold).toBeVisible()
  for (const deeper of await page.locator('.deeper > .fold').all()) await expect(deeper).toBeVisible()
  await expect(page.locator('#fig-lap .address')).toBeHidden()

  await page.emulateMedia({ media: 'screen' })
  await expect(fold).toBeHidden()
  await page.goto(`./#${await fold.getAttribute('id')}`)
  await expect(fold).toBeVisible()
  // So it is with what goes deeper, whose line the keyboard opens and closes.
  const deeper = page.locator('.deeper').filter({ has: page.locator('.fold > .eq[id]') }).first()
  await expect(deeper.locator('.fold')).toBeHidden()
  await page.goto(`./#${await deeper.locator('.fold > .eq').first().getAttribute('id')}`)
  await expect(deeper.locator('.eq').first()).toBeInViewport()
  await deeper.locator('summary').press('Enter')
  await expect(deeper.locator('.fold')).toBeHidden()
  await unfold(page)
  const question = page.locator('.predict').first()
  await expect(question.locator('.fold')).toBeHidden()
  await question.getByRole('textbox').fill('about half')
  await expect(question.locator('.fold')).toBeVisible()
})

/** What a figure tells when it has run a step: the first named lines of the box, with a value each. */
async function tellTrace(page: Page): Promise<string[]> {
  return page.locator('.algorithm[data-figure]').first().evaluate(box => {
    const keys = [...box.querySelectorAll<HTMLElement>('[data-line]')].slice(0, 3).map(line => line.dataset['line']!)
    const figure = [...document.getElementById((box as HTMLElement).dataset['figure']!)!.children].find(child => child.localName.includes('-'))!
    const lines = keys.map((key, i) => ({ key, text: `value ${i}` }))
    figure.dispatchEvent(new CustomEvent('fastslam-trace', { bubbles: true, composed: true, detail: { lines } }))
    return keys
  })
}

test('an algorithm lights up line by line with the values that its figure tells', async ({ page }) => {
  await page.emulateMedia({ reducedMotion: 'no-preference' })
  await page.goto('./')
  const box = page.locator('.algorithm[data-figure]').first()
  await box.evaluate(element => {
    const seen = Object.assign(window, { seen: [] as string[] }).seen
    const look = () => {
      const lit = [...element.querySelectorAll<HTMLElement>('.lit')].map(line => `${line.dataset['line']}: ${line.querySelector('.value')?.textContent}`).join(' and ')
      if (lit && lit !== seen.at(-1)) seen.push(lit)
    }
    new MutationObserver(look).observe(element, { subtree: true, attributes: true, attributeFilter: ['class'] })
  })
  const keys = await tellTrace(page)
  expect(keys.length).toBeGreaterThan(1)
  await expect(box.locator('.value')).toHaveCount(keys.length, { timeout: 20_000 })
  expect(await page.evaluate(() => (window as unknown as { seen: string[] }).seen)).toEqual(keys.map((key, i) => `${key}: value ${i}`))
})

test('the button of an algorithm steps its figure, also one that nobody has seen yet, and the lines it ran light up, under reduced motion all at once', async ({ page }) => {
  await page.goto('./')
  const keys = await tellTrace(page)
  await expect(page.locator('.algorithm[data-figure]').first().locator('.lit')).toHaveCount(keys.length)
  await expect(page.locator('#fig-lap .stage.live')).toBeVisible() // it is on the first screen
  const stepOf = (figure: Locator) => figure.evaluate(element => (element as unknown as { currentStep?: number }).currentStep ?? 0)
  for (const [id, on, lines] of [
    ['fig-lap', 1, { ess: / of 16$/, draw: /^\(.*\)$/ }],
    ['fig-resampling', 1, { associate: / known, \d+ new; (all agree|\d+ different answers in all)$/, resample: /^N_eff .* of 16: / }],
    ['fig-worked-example', 0, { weigh: /^2\.753 \/ 0\.8632$/, resample: /^no$/ }],
  ] as const) {
    const box = page.locator(`.algorithm[data-figure=${id}]`)
    const figure = page.locator(`#${id} > *`).first()
    const before = await stepOf(figure)
    await box.getByRole('button', { name: 'Run one step' }).click()
    for (const [line, value] of Object.entries(lines)) await expect(box.locator(`[data-line=${line}] .value`).first()).toHaveText(value, { timeout: 20_000 })
    expect(await stepOf(figure)).toBe(before + on)
  }
})
