// What a reader does with the worked example: drags what is seen, types into matrices, and sees in the same screen what follows.
import { expect, test } from './fixtures'
import { Figure, frames } from './figure'
import { openCourse } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

const tag = 'fastslam-worked-example'

/** Where a handle is on the page. */
async function middle(figure: Figure, handle: string): Promise<{ x: number; y: number }> {
  const box = (await figure.handle(handle).boundingBox())!
  return { x: box.x + box.width / 2, y: box.y + box.height / 2 }
}

test('as given it says what the chapter says; a number is typed by keyboard or refused with its reason, and Reset takes it back', async ({ page }) => {
  const figure = await new Figure(page, tag).alone()
  const readouts = await figure.readouts()
  expect(readouts['w1']).toContain('2.753451')
  expect(readouts['w2']).toContain('0.863169')
  expect(readouts['ess']).toBe('1.570871 of 2')
  expect(readouts['verdict']).toBe('1.57 > 1: do not resample')
  await expect(figure.sentence).toContainText('1.57 > 1: do not resample')
  await expect(figure.play).toBeHidden()
  await expect(figure.scrub).toBeHidden()

  const picture = await figure.picture()
  await figure.box('threshold').focus()
  await page.keyboard.press('ControlOrMeta+a')
  await page.keyboard.type('0.9')
  await page.keyboard.press('Tab')
  await figure.settled()
  expect((await figure.readouts())['verdict']).toBe('1.57 < 1.8: resample')
  await figure.box('r1').focus()
  await page.keyboard.press('ArrowUp') // by the step of the parameter
  await figure.settled()
  await expect(figure.box('r1')).toHaveValue('4.2')
  expect((await figure.readouts())['w1']).not.toBe(readouts['w1'])
  expect((await figure.readouts())['w2']).toBe(readouts['w2'])
  expect(await figure.picture()).not.toBe(picture)
  await figure.reset.click()
  await figure.settled()
  await expect(figure.box('threshold')).toHaveValue('0.5')
  expect([await figure.readouts(), await figure.picture()]).toEqual([readouts, picture])

  for (const [name, value, reason] of [
    ['sigma-xy', '0.2', /sigma-xy = "0.2": must be between -0.1587 and 0.1587 m², so that Σ is positive definite/],
    ['bearing-std', '0', /bearing-std = "0": must be a number from 0.001 to 3 rad/],
    ['x2', '', /x2 = "": must be a number from -100 to 100 m/],
    ['r1', '1e300', /r1 = "1e300": must be a number from 0 to 200 m/],
  ] as const) {
    const before = await figure.box(name).inputValue()
    await figure.box(name).fill(value)
    await figure.box(name).press('Enter')
    await expect(figure.alert).toContainText(reason)
    await figure.settled()
    expect(await figure.readouts(), name).toEqual(readouts)
    await expect(figure.box(name)).toHaveValue(before)
  }
})

test.describe('by link', () => {
  test.use({ permissions: ['clipboard-read', 'clipboard-write'] })

  test('a copied link opens the very same numbers', async ({ page, context }) => {
    const figure = await new Figure(page, tag).alone()
    for (const [name, value] of [
      ['sigma-xy', '0.09'],
      ['x2', '-0.4'],
      ['phi2', '0.123456789'],
    ] as const) {
      await figure.box(name).fill(value)
      await figure.box(name).press('Enter')
    }
    await figure.settled()
    await figure.menu('Copy link')
    await expect(figure.element.getByText('Link copied')).toBeVisible()
    const link = await page.evaluate(() => navigator.clipboard.readText())
    expect(link).toContain(`#${tag}?x2=-0.4&phi2=0.123456789&sigma-xy=0.09`)
    const other = await new Figure(await context.newPage(), tag).open(link)
    await expect(other.alert).toBeEmpty()
    expect(await other.readouts()).toEqual(await figure.readouts())
    expect(await other.picture()).toBe(await figure.picture())
  })
})

test('each handle is dragged by the mouse, where its numbers follow and no others, and moved by keyboard, coarsely with Shift and finely with Alt', async ({ page }) => {
  const figure = await new Figure(page, tag).alone()
  for (const [handle, parameters] of [
    ['robot-1', ['x1', 'y1']],
    ['heading-2', ['theta2']],
    ['sighting-1', ['r1', 'phi1']],
    ['sighting-2', ['r2', 'phi2']],
    ['mean', ['mu-x', 'mu-y']],
    ['sigma', ['sigma-xx', 'sigma-xy']],
    ['sigma-yy', ['sigma-yy']],
    ['threshold', ['threshold']],
  ] as const) {
    const [picture, start] = [await figure.picture(), await middle(figure, handle)]
    const right = handle === 'robot-1' ? 30 : -30 // it stands at the left
    await page.mouse.move(start.x + 2, start.y - 1)
    await page.mouse.down()
    await page.mouse.move(start.x + 2 + right, start.y + 29, { steps: 8 })
    await figure.settled()
    await page.mouse.up()
    expect(await figure.picture(), handle).not.toBe(picture)
    const moved = [...(await figure.state()).matchAll(/([\w-]+)=/g)].map(([, name]) => name)
    expect(moved, handle).toEqual(parameters)
    // The hand is still on it.
    const end = await middle(figure, handle)
    if (!/heading|threshold|sigma-yy/.test(handle)) {
      expect(Math.abs(end.x - start.x - right), handle).toBeLessThan(3)
      expect(Math.abs(end.y - start.y - 30), handle).toBeLessThan(3)
    }
    await figure.reset.click()
    await figure.settled()
    expect(await figure.picture(), handle).toBe(picture)
  }
  await figure.grasp('sighting-1').focus()
  for (const [keys, r, phi] of [
    ['ArrowRight', '4.2', '0.05'],
    ['ArrowUp', '4.2', '0.1'],
    ['Shift+ArrowLeft', '3.2', '0.1'],
    ['Alt+ArrowDown', '3.2', '0.095'],
  ] as const) {
    await page.keyboard.press(keys)
    await figure.settled()
    await expect(figure.box('r1')).toHaveValue(r)
    await expect(figure.box('phi1')).toHaveValue(phi)
  }
  await expect(figure.grasp('sighting-1')).toHaveAttribute('aria-valuetext', '3.2 m away, at 0.095 rad')
})

test('pointing at S lights what enters it, until the pointer leaves; arrow keys go from step to step, and a tap stays', async ({ page }) => {
  const figure = await new Figure(page, tag).alone()
  const [picture, told] = [await figure.picture(), await figure.told.textContent()]
  const over = async (row: number) => {
    const rows = figure.handle('row')
    const box = (await rows.boundingBox())!
    return { x: box.x + box.width / 2, y: box.y + box.height / 2 + row }
  }
  // The handle stands in the first row, which is as high as the second.
  const { x, y } = await over(42)
  await page.mouse.move(x, y)
  await expect(figure.told).toHaveText('Covariance of ν: made of Σ, Q, x, μ.')
  expect(await figure.picture()).not.toBe(picture)
  await page.mouse.move(5, 5)
  await expect(figure.told).toHaveText(told!)
  await figure.settled()
  expect(await figure.picture(), 'what is pointed at is let go').toBe(picture)

  await figure.grasp('row').focus()
  await page.keyboard.press('ArrowDown')
  await page.keyboard.press('ArrowDown')
  await expect(figure.told).toHaveText('Covariance of ν: made of Σ, Q, x, μ.')
  await expect(figure.grasp('row')).toHaveAttribute('aria-valuetext', 'Covariance of ν: made of Σ, Q, x, μ.')
  await page.keyboard.press('ArrowUp')
  await page.keyboard.press('ArrowUp')
  await figure.settled()
  expect(await figure.picture()).toBe(picture)
})

test.describe('by touch', () => {
  test.use({ viewport: { width: 380, height: 760 }, hasTouch: true, isMobile: true })

  test('a tap on a step lights what enters it', async ({ page }) => {
    const figure = await new Figure(page, tag).alone()
    const rows = figure.handle('row')
    await rows.evaluate(handle => handle.scrollIntoView({ block: 'center', behavior: 'instant' }))
    const box = (await rows.boundingBox())!
    await page.touchscreen.tap(box.x + box.width / 2, box.y + box.height / 2 + 42)
    await expect(figure.told).toHaveText('Covariance of ν: made of Σ, Q, x, μ.')
    expect(await figure.state()).toContain('row=5')
  })
})

test('picture, rows and matrices are on one screen, and S is seen to change there', async ({ page }) => {
  await openCourse(page, `<main style="max-width: 960px; margin: auto"><${tag}></${tag}></main>`)
  const figure = new Figure(page, tag)
  await figure.live()
  for (const [width, height, noise] of [[1366, 650, '0.025'], [1024, 618, '0.03']] as const) {
    await page.setViewportSize({ width, height })
    await page.evaluate(() => scrollTo(0, 0))
    await figure.settled()
    const box = (await figure.element.boundingBox())!
    expect(box.height, `at ${width}`).toBeLessThanOrEqual(612)
    for (const name of ['mu-x', 'sigma-xy', 'range-std', 'theta2', 'phi1', 'threshold']) await expect(figure.box(name)).toBeInViewport({ ratio: 1 })
    const picture = await figure.picture()
    await figure.box('bearing-std').fill(noise)
    await figure.box('bearing-std').press('Enter')
    await figure.settled()
    expect(await figure.picture()).not.toBe(picture)
    await expect(figure.canvas).toBeInViewport({ ratio: 1 })
  }
})

test('a matrix has each entry once, with its name, and the one below the diagonal follows; every step is shown at a wish, whole and as large as the five', async ({ page }) => {
  const figure = await new Figure(page, tag).alone()
  const names = await figure.element.locator('.matrix input').evaluateAll(boxes => boxes.map(box => [(box as HTMLInputElement).name, box.getAttribute('aria-label')]))
  expect(names).toHaveLength(17)
  expect(new Set(names.map(([name]) => name)).size).toBe(17)
  expect(names.filter(([, label]) => !label)).toEqual([])
  await expect(figure.element.getByRole('spinbutton', { name: 'Σ, xy' })).toHaveValue('0')
  await figure.box('sigma-xy').fill('0.05')
  await figure.box('sigma-xy').press('Enter')
  await figure.settled()
  await expect(figure.element.locator('[aria-label=Σ] .fixed')).toHaveText('0.05')

  const before = (await figure.canvas.boundingBox())!
  await figure.element.getByRole('checkbox', { name: 'Every step' }).check()
  await figure.settled()
  const after = (await figure.canvas.boundingBox())!
  expect(after.width).toBe(before.width)
  expect(after.height).toBeGreaterThan(before.height + 250)
  expect(await figure.state()).toContain('all-steps=on')
  await figure.element.getByRole('checkbox', { name: 'Every step' }).uncheck()
  await figure.settled()
  expect(await figure.canvas.boundingBox()).toEqual(before)
})

test('what an author leaves out leaves no brackets, and nothing at all if nothing is left; in another language the boxes stand in their matrices again', async ({ page }) => {
  await openCourse(page, `<${tag} controls="sigma-xx sigma-yy"></${tag}>`, { lang: 'de' })
  const figure = new Figure(page, tag)
  await figure.live()
  await expect(figure.element.locator('.matrix').filter({ visible: true })).toHaveCount(1)
  // With a decimal comma a box is not of the type `number`.
  await expect(figure.element.locator('.matrix input[name=sigma-xx]')).toBeVisible()
  await expect(figure.element.locator('.matrix input[name=sigma-xy]')).toBeHidden()
  await figure.element.evaluate(element => element.setAttribute('controls', 'none'))
  await figure.settled()
  await expect(figure.element.locator('.main')).toBeHidden()

  await figure.element.evaluate(element => element.removeAttribute('controls'))
  await expect(figure.element.getByRole('spinbutton', { name: 'Entfernung 1' })).toHaveValue('4,1')
  await page.evaluate(() => (document.documentElement.lang = 'en'))
  await figure.element.evaluate(element => element.setAttribute('lang', 'en'))
  await expect(figure.element.getByRole('spinbutton', { name: 'Range 1' })).toHaveValue('4.1')
  await expect(figure.element.locator('.matrix input')).toHaveCount(17)
  await expect(figure.element.locator('[part=inputs]')).toHaveCount(1)
  await expect(figure.reset).toHaveCount(1)
})

test.describe('on a phone', () => {
  test.use({ viewport: { width: 380, height: 740 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 })

  test('the particles stand beside each other in a picture that leaves room, a finger drags a sighting and the page stays, and nothing is wider than the screen', async ({ page }) => {
    const figure = await new Figure(page, tag).alone()
    const client = await page.context().newCDPSession(page)
    const touch = (type: 'touchStart' | 'touchMove' | 'touchEnd', ...touchPoints: { x: number; y: number }[]) =>
      client.send('Input.dispatchTouchEvent', { type, touchPoints })
    const [{ x, y }, scrolled] = [await middle(figure, 'sighting-2'), await page.evaluate(() => scrollY)]
    await touch('touchStart', { x, y })
    for (let i = 1; i <= 10; i++) {
      await touch('touchMove', { x: x - 3 * i, y: y + 4 * i })
      await frames(page, 1)
    }
    await touch('touchEnd')
    await figure.settled()
    expect(await page.evaluate(() => scrollY)).toBe(scrolled)
    expect(await figure.state()).toMatch(/^r2=[\d.]+&phi2=-?[\d.]+$/)
    const end = await middle(figure, 'sighting-2')
    expect(Math.abs(end.x - x + 30)).toBeLessThan(3)
    expect(Math.abs(end.y - y - 40)).toBeLessThan(3)

    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(380)
    const { height } = (await figure.canvas.boundingBox())!
    expect(height).toBeLessThanOrEqual(450)
    const small = await figure.element.evaluate(element =>
      [...element.shadowRoot!.querySelectorAll('button, input:not(.handle input), summary')]
        .filter(control => control.checkVisibility() && control.getBoundingClientRect().height < 40 && !control.matches('[type=checkbox]'))
        .map(control => control.outerHTML.slice(0, 80)),
    )
    expect(small).toEqual([])
    // No readout is cut off or laid over its neighbour.
    await figure.openNumbers()
    const wide = await figure.element.evaluate(element =>
      [...element.shadowRoot!.querySelectorAll('dd')].filter(dd => dd.scrollWidth > dd.clientWidth).map(dd => dd.textContent),
    )
    expect(wide).toEqual([])
  })
})
