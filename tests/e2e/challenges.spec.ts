// The challenges of every figure: chips that set its state, by mouse, keyboard and touch; what was reached is remembered on this
// device and nowhere else. What the states are, and when a goal is reached, is held without a browser: widgets/tests/all/challenges.rs.
import { programs } from '../../scripts/registry.mjs'
import { Figure, openChapterOf } from './figure'
import { expect, test } from './fixtures'
import { breadth, openAlone, openCourse } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

/** In `npm test`, one figure that has steps and the one beside a worker stand for all of them; for the layout, the longest title and the most chips. */
const [FEW, WORST] = [['fastslam-doors', 'fastslam-log'], ['fastslam-log', 'fastslam-em']]
const breadthBut = (few: string[], tag: string) => (few.includes(tag) ? {} : breadth)

const chips = (figure: Figure) => figure.element.getByRole('group', { name: 'Challenges' }).getByRole('button')
const group = (figure: Figure) => figure.element.getByRole('group', { name: 'Challenges' })

/** One figure alone on a page; that of logs has its program only when something is asked of it. */
async function alone(figure: Figure, tag: string, link = ''): Promise<Figure> {
  if (tag !== 'fastslam-log') return figure.alone(link)
  await openAlone(figure.page as import('@playwright/test').Page, tag, link)
  await expect(group(figure)).toBeVisible()
  return figure
}

/** That the strip says of a chip that is on what there is to reach, and how near that is: whole. */
async function expectVerdict(figure: Figure, i: number): Promise<void> {
  const verdict = figure.element.locator('.verdict')
  const title = (await chips(figure).nth(i).getAttribute('title')) ?? ''
  const texts = () => verdict.locator('span').evaluateAll(all => all.map(span => span.textContent!.replace(/ ✓$/, '')).filter(Boolean).join(': '))
  await expect.poll(texts).toBe(title)
  if (!title) return
  expect(await verdict.locator('progress').evaluate((bar: HTMLProgressElement) => bar.value)).toBeLessThan(1)
  const outside = await verdict.evaluate(strip => {
    const { left, right, bottom } = strip.getBoundingClientRect()
    const parts = [...strip.children].map(part => part.getBoundingClientRect())
    return parts.filter(part => part.left < left - 1 || part.right > right + 1 || part.bottom > bottom + 1).length
  })
  expect(outside, 'nothing of it is cut').toBe(0)
}

/** Which chips are on. */
const on = (figure: Figure) => chips(figure).evaluateAll(all => all.flatMap((chip, i) => (chip.ariaPressed === 'true' ? [i] : [])))

for (const tag of programs.keys()) {
  test(`every chip of ${tag} sets its state and is marked, by mouse and by keyboard, and can be undone`, breadthBut(FEW, tag), async ({ page }) => {
    const figure = await alone(new Figure(page, tag), tag)
    const before = await figure.state()
    const count = await chips(figure).count()
    expect(count).toBeGreaterThanOrEqual(3)
    expect(await on(figure)).toEqual([])
    const states: string[] = []
    for (let i = 0; i < count; i++) {
      await chips(figure).nth(i).click()
      await expect.poll(() => on(figure)).toEqual([i])
      await figure.settled()
      states.push(await figure.state())
      await expectVerdict(figure, i)
    }
    expect(new Set([before, ...states]).size).toBe(count + 1)
    // What was before the last one is offered back.
    await figure.button('Undo').click()
    await expect.poll(() => on(figure)).toEqual([count - 2])
    expect(await figure.state()).toBe(states[count - 2])

    // Tab comes to the one that is on, arrows go round, Enter takes.
    await figure.element.evaluate(element => element.shadowRoot!.querySelector<HTMLElement>('.chip[tabindex="0"]')!.focus())
    await page.keyboard.press('Home')
    for (let i = 0; i < count; i++) {
      await expect(chips(figure).nth(i)).toBeFocused()
      await page.keyboard.press(i % 2 ? ' ' : 'Enter')
      await expect.poll(() => on(figure)).toEqual([i])
      await figure.settled()
      expect(await figure.state()).toBe(states[i])
      await page.keyboard.press('ArrowRight')
    }
    await expect(chips(figure).first()).toBeFocused()
    expect(await chips(figure).evaluateAll(all => all.filter(chip => (chip as HTMLElement).tabIndex === 0).length)).toBe(1)
  })

  test(`the chips of ${tag} have their words where it is wide, and neither they nor what there is to reach moves anything`, breadthBut(WORST, tag), async ({ page }) => {
    await page.setViewportSize({ width: 1366, height: 650 })
    await openCourse(page, `<div style="width: 832px"><${tag}></${tag}></div>`)
    const figure = new Figure(page, tag)
    await expect(figure.element.locator('.sentence:not(:empty)')).toHaveCount(1)
    const words = await chips(figure).evaluateAll(all => all.map(chip => [chip.textContent, chip.ariaLabel, chip.scrollWidth - chip.clientWidth]))
    for (const [text, title, cut] of words) expect([text, cut]).toEqual([title, 0])
    for (const { width, height } of await chips(figure).evaluateAll(all => all.map(chip => chip.getBoundingClientRect()))) {
      expect(Math.min(width, height)).toBeGreaterThanOrEqual(24)
    }
    const top = () => figure.element.locator('.stage').evaluate(stage => stage.getBoundingClientRect().top)
    const before = await top()
    for (const chip of await chips(figure).all()) {
      await chip.click()
      expect(await top()).toBe(before)
    }
  })
}

test('a challenge that is reached is ticked and told, is remembered after a reload, and is forgotten when asked to', async ({ page }) => {
  const link = '#fastslam-worked-example'
  const figure = await new Figure(page, 'fastslam-worked-example').alone(link)
  await page.evaluate(() => {
    const told: unknown[] = ((window as unknown as { told: unknown[] }).told = [])
    addEventListener('fastslam-challenge', event => told.push((event as CustomEvent).detail))
  })
  const ten = chips(figure).nth(1)
  await ten.click()
  await figure.settled()
  await expect(ten).toHaveAccessibleName('Ten to one')
  await expect(ten).toHaveAccessibleDescription('move sighting 2 until particle 1 weighs ten times as much: 1 times')
  await figure.grasp('sighting-2').focus()
  for (let i = 0; i < 12; i++) await page.keyboard.press('Shift+ArrowUp')
  await figure.settled()
  await expect(ten).toHaveAccessibleName('Ten to one (reached)')
  await expect(ten).toHaveAttribute('aria-pressed', 'true')
  const told = await page.evaluate(() => (window as unknown as { told: unknown[] }).told)
  expect(told).toEqual([
    { name: 'ten', done: false },
    { name: 'ten', done: true },
  ])

  await page.reload()
  await figure.live()
  await expect(ten).toHaveAccessibleName('Ten to one (reached)')
  await expect(chips(figure).nth(2)).toHaveAccessibleName('Make it resample')
  await figure.menu('Forget the challenges reached')
  await expect(ten).toHaveAccessibleName('Ten to one')
  await page.reload()
  await figure.live()
  await expect(ten).toHaveAccessibleName('Ten to one')
})

test('a page that opens where a challenge is reached has reached nothing', async ({ page }) => {
  const figure = await new Figure(page, 'fastslam-worked-example').alone('#fastslam-worked-example?r2=4.1&phi2=0.3')
  await expect(chips(figure).nth(1)).toHaveAccessibleName('Ten to one')
  expect(await on(figure)).toEqual([])
})

test('where nothing may be stored, what was reached holds while the page is open', async ({ page }) => {
  await page.addInitScript(() =>
    Object.defineProperty(window, 'localStorage', {
      get() {
        throw new DOMException('refused', 'SecurityError')
      },
    }),
  )
  const figure = await new Figure(page, 'fastslam-worked-example').alone()
  await chips(figure).nth(2).click()
  await figure.box('threshold').fill('0.9')
  await figure.box('threshold').press('Enter')
  await expect(chips(figure).nth(2)).toHaveAccessibleName('Make it resample (reached)')
  await figure.menu('Forget the challenges reached')
  await expect(chips(figure).nth(2)).toHaveAccessibleName('Make it resample')
})

test('what is stored by somebody else is not believed', async ({ page }) => {
  await page.addInitScript(() => localStorage.setItem('fastslam-challenges', '{"x": [1, 2}'))
  const figure = await new Figure(page, 'fastslam-worked-example').alone()
  await expect(chips(figure).first()).toHaveAccessibleName('Half the bearing noise')
})

test('a chip that would move what is locked is not to be had, and says why', async ({ page }) => {
  await openCourse(page, '<fastslam-proposal lock="landmarks odometry" odometry="1.5"></fastslam-proposal>')
  const figure = new Figure(page, 'fastslam-proposal')
  await figure.live()
  const before = await figure.state()
  for (const i of [0, 1, 2, 3]) {
    await expect(chips(figure).nth(i)).toHaveAttribute('aria-disabled', 'true')
    await expect(chips(figure).nth(i)).toHaveAccessibleDescription(/(odometry|landmarks) is fixed on this page/)
  }
  await chips(figure).nth(3).click({ force: true })
  await figure.settled()
  expect(await figure.state()).toBe(before)
  await figure.element.evaluate(element => element.setAttribute('lock', 'seed'))
  await expect(chips(figure).nth(3)).toHaveAttribute('aria-disabled', 'false')
  await chips(figure).nth(3).click()
  await expect.poll(() => on(figure)).toEqual([3])
})

test('an author who shows some controls shows the chips only where they are named', async ({ page }) => {
  await openCourse(page, '<fastslam-proposal id="a" controls="range-std"></fastslam-proposal><fastslam-proposal id="b" controls="range-std chips"></fastslam-proposal>')
  for (const id of ['a', 'b']) await page.locator(`#${id}`).scrollIntoViewIfNeeded()
  await expect(page.locator('#b .chip').first()).toBeVisible()
  await expect(page.locator('#a .chip').first()).toBeHidden()
})

test('in German the chips speak German', async ({ page }) => {
  await openCourse(page, '<fastslam-lap lang="de"></fastslam-lap>')
  await expect(page.getByRole('group', { name: 'Aufgaben' }).getByRole('button').nth(2)).toBeVisible()
  await expect(page.getByRole('button', { name: 'Nur vier' })).toBeVisible()
})

test.describe('on a phone', () => {
  test.use({ viewport: { width: 380, height: 760 }, hasTouch: true, isMobile: true })

  for (const tag of programs.keys()) {
    test(`the chips of ${tag} have their words, are large enough for a finger, and are taken by it`, breadthBut(FEW, tag), async ({ page }) => {
      await openCourse(page, `<${tag}></${tag}><p style="height: 900px">After.</p>`)
      const figure = new Figure(page, tag)
      await expect(group(figure)).toBeVisible()
      for (const chip of await chips(figure).all()) {
        const { width, height } = (await chip.boundingBox())!
        expect(Math.min(width, height)).toBeGreaterThanOrEqual(44)
        await expect(chip).toContainText((await chip.getAttribute('aria-label'))!)
      }
      const last = (await chips(figure).count()) - 1
      await chips(figure).nth(last).tap()
      await expect.poll(() => on(figure)).toEqual([last])
      // The row scrolls; the page does not.
      expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(380)
    })
  }
})

test.describe('in the chapter', () => {
  for (const tag of programs.keys()) {
    test(`the list under ${tag} has its challenges in words, and they do the same`, breadthBut(FEW, tag), async ({ page }) => {
      await openChapterOf(page, [tag])
      const figure = new Figure(page, tag)
      const list = page.locator('figure', { has: page.locator(`> ${tag}`) }).locator('figcaption button.chip')
      await figure.element.scrollIntoViewIfNeeded()
      await expect(group(figure)).toBeVisible()
      await expect(list).toHaveCount(await chips(figure).count())
      const names = await chips(figure).evaluateAll(all => all.map(chip => (chip as HTMLElement).dataset['challenge']))
      expect(await list.evaluateAll(all => all.map(button => button.dataset['challenge']))).toEqual(names)
      for (const fold of await page.locator('figcaption summary').all()) await fold.click() // a list of things to try is folded
      await list.last().click()
      await expect.poll(() => on(figure)).toEqual([names.length - 1])
      await expect(figure.element).toBeInViewport()
    })
  }

  test('without script they are text', async ({ browser, baseURL }) => {
    const context = await browser.newContext({ javaScriptEnabled: false, baseURL: baseURL! })
    const page = await context.newPage()
    await page.goto('./')
    await page.locator('main figcaption summary').first().click()
    await expect(page.locator('main figcaption .chip').first()).toBeVisible()
    await expect(page.locator('figcaption button')).toHaveCount(0)
    await context.close()
  })
})
