// Keyboard, touch, screen reader, small and dark screens.
import { brokenRules, leaveOnly } from './axe'
import { expect, test } from './fixtures'
import { Figure, frames } from './figure'
import { FIGURES, openCourse } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

test('axe finds nothing in a figure with an alert and an open menu, in any theme, on a phone and off it', async ({ page }) => {
  const lap = await new Figure(page, 'fastslam-lap').open()
  await lap.openSettings()
  await lap.box('universes').fill('0')
  await lap.box('universes').press('Enter')
  await expect(lap.alert).not.toBeEmpty()
  // With its caption; the text around it has its own test.
  await leaveOnly(page, '#fig-lap')
  const usual = { colorScheme: 'light', contrast: 'no-preference', forcedColors: 'none' } as const
  const wide = { width: 1280, height: 800 }
  const phone = { width: 380, height: 800 }
  for (const [what, media, size] of [
    ['light', usual, wide],
    ['dark', { ...usual, colorScheme: 'dark' }, wide],
    ['high contrast', { ...usual, contrast: 'more' }, wide],
    ['forced colours', { ...usual, forcedColors: 'active' }, wide],
    ['a phone', usual, phone],
    ['a dark phone', { ...usual, colorScheme: 'dark' }, phone],
  ] as const) {
    await page.emulateMedia(media)
    await page.setViewportSize(size)
    await lap.settled()
    const menu = lap.element.getByRole('menu')
    if (!(await menu.isVisible())) await lap.element.locator('button[aria-label=Menu]').click()
    await expect(menu, what).toBeVisible()
    await expect(lap.alert, what).not.toBeEmpty()
    expect(await brokenRules(page, { of: '#fig-lap' }), what).toEqual([])
  }
})

test('the whole figure is worked by keyboard alone', async ({ page }) => {
  const lap = await new Figure(page, 'fastslam-lap').alone()
  await lap.element.evaluate(element => element.shadowRoot!.querySelectorAll('details').forEach(details => (details.open = true)))
  // What has the focus, under every shadow: its name, whether it lies in the figure, and its ring.
  const focus = () =>
    page.evaluate(() => {
      let element = document.activeElement!
      const inside = element === document.querySelector('fastslam-lap')
      while (element.shadowRoot?.activeElement) element = element.shadowRoot.activeElement
      const name = element === document.body ? 'body' : (element.getAttribute('aria-label') ?? element.getAttribute('name') ?? element.textContent.trim())
      return { inside, name, ring: getComputedStyle(element).outlineStyle }
    })
  const focused = async () => (await focus()).name

  // Every control is reached by Tab, each with a focus ring that can be seen, and the way out at the end is open.
  const order: string[] = []
  for (let i = 0; i < 300; i++) {
    await page.keyboard.press('Tab')
    const { inside, name, ring } = await focus()
    if (!inside) break
    order.push(name)
    expect(ring, name).not.toBe('none')
  }
  expect(order).toEqual(
    expect.arrayContaining([
      'Menu',
      'Reset',
      'Play',
      'Step',
      'Step shown',
      'Speed',
      'seed',
      'Re-roll the seed',
      'universe',
      'truth',
      'raw',
      'universes',
      'odometry',
      'range-std',
      'proposal',
      'matcher',
      'policy',
    ]),
  )
  expect((await focus()).inside).toBe(false)

  // Keys on the picture.
  await lap.element.locator('.stage').focus()
  await page.keyboard.press('ArrowRight')
  await page.keyboard.press('ArrowRight')
  await page.keyboard.press('ArrowLeft')
  await lap.settled()
  expect(await lap.position()).toBe(1)
  await page.keyboard.press('Space')
  await expect.poll(() => lap.position()).toBeGreaterThan(2)
  await page.keyboard.press('Space')
  await expect(lap.play).toBeVisible()
  await page.keyboard.press('End')
  await lap.settled()
  expect(await lap.position()).toBe(await lap.last())
  await page.keyboard.press('Home')
  await lap.settled()
  expect(await lap.position()).toBe(0)

  // Native keys on sliders, Space from there plays too, buttons by Enter and Space.
  await lap.scrub.focus()
  await page.keyboard.press('ArrowRight')
  await expect.poll(() => lap.position()).toBe(1)
  await page.keyboard.press('Space')
  await expect(lap.pause).toBeVisible()
  await page.keyboard.press('Space')
  await lap.step.focus()
  const at = await lap.position()
  await page.keyboard.press('Space')
  await page.keyboard.press('Enter')
  await lap.settled()
  expect(await lap.position()).toBe(at + 2)
  await lap.openSettings()
  await lap.slider('universes').focus()
  await page.keyboard.press('ArrowRight')
  await expect(lap.box('universes')).not.toHaveValue('16')
  await page.keyboard.press('Home')
  await expect(lap.box('universes')).toHaveValue('1')
  await page.keyboard.press('ArrowRight')
  await expect(lap.box('universes')).toHaveValue('2')

  // The menu opens at its first item, is walked through by arrow keys, closes by Escape, and gives the focus back.
  await lap.element.locator('button[aria-label=Menu]').focus()
  await page.keyboard.press('Enter')
  await expect(lap.element.getByRole('menu')).toBeVisible()
  await expect.poll(focused).toBe('Copy link')
  const items = await lap.element.getByRole('menuitem').allTextContents()
  expect(items.length).toBeGreaterThan(5)
  for (const [key, item] of [['ArrowDown', items[1]], ['ArrowUp', items[0]], ['ArrowUp', items.at(-1)], ['ArrowDown', items[0]], ['End', items.at(-1)], ['Home', items[0]]] as const) {
    await page.keyboard.press(key)
    expect(await focused(), key).toBe(item)
  }
  await page.keyboard.press('Escape')
  await expect(lap.element.getByRole('menu')).toBeHidden()
  expect(await focused()).toBe('Menu')
  await page.keyboard.press('ArrowUp')
  expect(await focused()).toBe(items.at(-1))
  await page.keyboard.press('Tab')
  await expect(lap.element.getByRole('menu')).toBeHidden()
})

test('a menu is whole in a window that is smaller than it, wherever its button is', async ({ page }) => {
  await openCourse(page, '<div style="padding-block: 150px 600px"><fastslam-lap universes="2" controls="play" show="n-eff"></fastslam-lap></div>')
  const lap = new Figure(page, 'fastslam-lap')
  await lap.live()
  const button = lap.element.locator('button[aria-label=Menu]')
  for (const [width, height, dir] of [[900, 560, 'ltr'], [320, 200, 'ltr'], [320, 200, 'rtl'], [1200, 240, 'rtl']] as const) {
    await page.setViewportSize({ width, height })
    await lap.element.evaluate((element, dir) => (element.parentElement!.dir = dir), dir)
    await lap.settled()
    for (const block of ['start', 'end'] as const) {
      await button.evaluate((element, at) => element.scrollIntoView({ block: at, behavior: 'instant' }), block)
      await button.click()
      const box = (await lap.element.getByRole('menu').boundingBox())!
      const what = `${width} × ${height}, ${dir}, at the ${block}`
      expect(box.x, what).toBeGreaterThanOrEqual(0)
      expect(box.y, what).toBeGreaterThanOrEqual(0)
      expect(box.x + box.width, what).toBeLessThanOrEqual(width)
      expect(box.y + box.height, what).toBeLessThanOrEqual(height)
      await page.keyboard.press('Escape')
    }
  }
})

test('a point that moves in two directions tells both of them and their limits, and takes either', async ({ page }) => {
  await openCourse(page, '<fastslam-proposal></fastslam-proposal><fastslam-conditioning></fastslam-conditioning>')
  const proposal = new Figure(page, 'fastslam-proposal')
  await proposal.live()
  const group = proposal.element.getByRole('group', { name: 'Landmark', exact: true })
  for (const [name, least, most, now, orientation] of [['Landmark x', '-0.1', '2.8', '2.7', null], ['Landmark y', '-0.75', '0.75', '-0.1', 'vertical']] as const) {
    const slider = group.getByRole('slider', { name })
    expect(await slider.evaluate((input: HTMLInputElement) => [input.min, input.max, input.value, input.getAttribute('aria-orientation')])).toEqual([least, most, now, orientation])
    await expect(slider).toHaveAttribute('aria-valuetext', '2.7 m ahead of the start, −0.1 m to the left')
    await expect(slider).toHaveAccessibleDescription(/Arrow keys/)
  }
  // As a screen reader sets it: by the value, of one direction alone.
  const place = () => proposal.element.evaluate((element: HTMLElement & { landmarkX?: number; landmarkY?: number }) => [element.landmarkX, element.landmarkY])
  await group.getByRole('slider', { name: 'Landmark y' }).fill('0.302')
  await proposal.settled()
  expect(await place()).toEqual([2.7, 0.3])
  await expect(group.getByRole('slider', { name: 'Landmark x' })).toHaveAttribute('aria-valuetext', '2.7 m ahead of the start, 0.3 m to the left')
  const conditioning = new Figure(page, 'fastslam-conditioning')
  await conditioning.element.scrollIntoViewIfNeeded()
  await conditioning.live()
  const entry = conditioning.element.getByRole('group', { name: 'Entry of the covariance' })
  const ranges = await entry.getByRole('slider').evaluateAll(inputs => (inputs as HTMLInputElement[]).map(({ ariaLabel, min, max }) => [ariaLabel, min, max]))
  const most = await conditioning.box('row').getAttribute('max')
  expect(ranges).toEqual([['Column', '1', most], ['Row', '1', most]])
})

test('what controls and numbers mean is found by keyboard and by touch, and read out with each control', async ({ page }) => {
  await openCourse(page, '<fastslam-lap></fastslam-lap>')
  const lap = new Figure(page, 'fastslam-lap')
  await lap.live()
  await lap.openSettings()
  const help = lap.element.getByRole('dialog', { name: 'What the controls and the numbers mean' })
  const ask = lap.element.getByRole('button', { name: 'What do these mean?' })
  await ask.focus()
  await page.keyboard.press('Enter')
  await expect(help).toBeVisible()
  // Every control and every number has its line, and the keys that scroll it do not step the figure.
  const titles = await lap.element.locator('[part=readout] dt').allTextContents()
  for (const title of [...titles, 'Seed', 'Range noise']) await expect(help.getByText(title).first()).toBeVisible()
  for (const key of ['ArrowDown', 'End', 'Space', 'ArrowRight']) await page.keyboard.press(key)
  await lap.settled()
  expect(await lap.position()).toBe(0)
  await page.keyboard.press('Escape')
  await expect(help).toBeHidden()
  await expect(ask).toBeFocused()
  await lap.menu('Explain controls and numbers')
  await expect(help).toBeVisible()
  await help.getByRole('button', { name: 'Close' }).click()
  await expect(help).toBeHidden()
  await ask.click()
  await expect(help).toBeVisible()
  await ask.click()
  await expect(help).toBeHidden()
  const described = async (name: string) => expect(lap.box(name), name).toHaveAccessibleDescription(await lap.box(name).evaluate(box => (box.closest('[part=control]') as HTMLElement).title))
  for (const name of ['universes', 'odometry', 'range-std']) await described(name)
})

/** Every text that comes into what a screen reader listens to, from now on. */
async function listenTo(figure: Figure): Promise<() => Promise<string[]>> {
  const said = await figure.element.evaluateHandle(element => {
    const said: string[] = []
    new MutationObserver(records => {
      for (const { target } of records) {
        const region = (target instanceof Element ? target : target.parentElement!).closest('[aria-live], [role=status], [role=alert], [role=log], output')
        if (region?.textContent && region.getAttribute('aria-live') !== 'off') said.push(region.textContent)
      }
    }).observe(element.shadowRoot!, { subtree: true, childList: true, characterData: true })
    return said
  })
  return () => said.evaluate(lines => lines)
}

test('the sentence is told to screen readers at rest, once after a few quick steps, and not at every step while it plays', async ({ page }) => {
  await openCourse(page, '<fastslam-lap universes="2"></fastslam-lap>')
  const lap = new Figure(page, 'fastslam-lap')
  await lap.live()
  await expect(lap.sentence).not.toBeEmpty()
  const quick = await listenTo(lap)
  await lap.element.evaluate(async element => {
    for (let i = 0; i < 4; i++) {
      ;(element as HTMLElement & { step(): void }).step()
      await new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))
    }
  })
  await expect.poll(async () => (await quick()).length).toBeGreaterThan(0)
  await expect.poll(() => lap.position()).toBe(4)
  // As one sentence, and nothing else.
  expect(await quick()).toEqual([await lap.sentence.textContent()])
  const before = await lap.sentence.textContent()
  const said = await listenTo(lap)
  await lap.step.click()
  await lap.settled()
  expect(await lap.sentence.textContent()).not.toBe(before)
  expect(await said()).toEqual([await lap.sentence.textContent()])
  await lap.play.click()
  await expect.poll(() => lap.position()).toBeGreaterThan(12)
  expect(await said()).toHaveLength(1)
  await lap.pause.click()
  await lap.settled()
  expect(await said()).toHaveLength(2)
  expect((await said()).at(-1)).toBe(await lap.sentence.textContent())
})

test('the words of a figure are in a language that they name, on a page in any other', async ({ page }) => {
  const names = [...FIGURES, 'log']
  await openCourse(page, names.map(name => `<fastslam-${name}></fastslam-${name}>`).join(''), { lang: 'fr' })
  for (const name of names) {
    const menu = page.locator(`fastslam-${name} button[aria-label=Menu]`)
    // `closest` ends at the shadow root: what is found is the figure's own.
    expect(await menu.evaluate(element => element.closest('[lang]')?.getAttribute('lang')), name).toBe('en')
    const loose = await page.locator(`fastslam-${name}`).evaluate(element => [...element.shadowRoot!.children].filter(child => !child.matches('[lang]')).length)
    expect(loose, name).toBe(0)
  }
})

test('the theme follows the system while the page is open, unless the attribute decides', async ({ page }) => {
  const lap = await new Figure(page, 'fastslam-lap').alone()
  const light = await lap.picture()
  await page.emulateMedia({ colorScheme: 'dark' })
  await lap.settled()
  const dark = await lap.picture()
  expect(dark).not.toBe(light)
  await lap.element.evaluate(element => element.setAttribute('theme', 'light'))
  await lap.settled()
  expect(await lap.picture()).toBe(light)
  await page.emulateMedia({ colorScheme: 'light', contrast: 'more' })
  await lap.settled()
  expect([light, dark]).not.toContain(await lap.picture())
})

test.describe('on a phone', () => {
  test.use({ viewport: { width: 380, height: 740 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 })

  test('nothing is wider than the screen, every target is large enough for a thumb, a tap plays, and a swipe over the picture scrolls the page', async ({ page }) => {
    await openCourse(page, '<main style="padding-block: 300px 800px"><fastslam-lap></fastslam-lap></main>')
    const lap = new Figure(page, 'fastslam-lap')
    await lap.live()
    await lap.openSettings()
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(380)
    const small = await lap.element.evaluate(element =>
      [...element.shadowRoot!.querySelectorAll('button, select, input, summary')]
        .filter(control => control.getClientRects().length > 0)
        .map(control => {
          const target = (control as HTMLInputElement).type === 'checkbox' ? control.closest('label')! : control
          const { width, height } = target.getBoundingClientRect()
          return { name: control.outerHTML.slice(0, 80), width, height }
        })
        .filter(({ width, height }) => width < 40 || height < 40),
    )
    expect(small).toEqual([])

    await lap.play.tap()
    await expect.poll(() => lap.position()).toBeGreaterThan(1)
    await lap.pause.tap()
    await lap.canvas.evaluate(canvas => canvas.scrollIntoView({ block: 'center', behavior: 'instant' }))
    await lap.settled()
    const box = (await lap.canvas.boundingBox())!
    const before = await page.evaluate(() => scrollY)
    const client = await page.context().newCDPSession(page)
    const touch = (type: 'touchStart' | 'touchMove' | 'touchEnd', ...touchPoints: { x: number; y: number }[]) =>
      client.send('Input.dispatchTouchEvent', { type, touchPoints })
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2]
    await touch('touchStart', { x, y })
    for (let i = 1; i <= 10; i++) {
      await touch('touchMove', { x, y: y - 20 * i })
      await frames(page, 1)
    }
    await touch('touchEnd')
    await expect.poll(() => page.evaluate(() => scrollY)).toBeGreaterThan(before + 100)
  })
})

test('a page that names a figure names its picture, and on paper without a picture of the page’s it is what it shows, without what can be done with it', async ({ page }) => {
  await openCourse(page, '<fastslam-lap aria-label="My lap"></fastslam-lap>')
  const lap = new Figure(page, 'fastslam-lap')
  await lap.live()
  await expect(lap.element.getByRole('img', { name: 'My lap', exact: true })).toBeVisible()
  await lap.element.evaluate(element => element.setAttribute('aria-label', 'The lap of our course'))
  await expect(lap.element.getByRole('img', { name: 'The lap of our course', exact: true })).toBeVisible()
  await lap.element.evaluate(element => element.removeAttribute('aria-label'))
  await expect(lap.element.getByRole('img', { name: /One lap/ })).toBeVisible()

  await page.emulateMedia({ media: 'print' })
  await expect(lap.canvas).toBeVisible()
  await expect(lap.told).toBeVisible()
  for (const part of ['transport', 'settings', 'view', 'menu']) await expect(lap.element.locator(`[part="${part}"]`)).toBeHidden()
})
