// What a reader does with the worked example: types numbers, and sees what follows.
import { expect, test } from './fixtures'
import { Figure } from './figure'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

const tag = 'fastslam-worked-example'

test('as given it says what the chapter says', async ({ page }) => {
  const figure = await new Figure(page, tag).alone()
  const readouts = await figure.readouts()
  expect(readouts['w1']).toContain('2.753451')
  expect(readouts['w2']).toContain('0.863169')
  expect(readouts['ess']).toBe('1.570871 of 2')
  expect(readouts['verdict']).toBe('1.57 > 1: do not resample')
  await expect(figure.sentence).toContainText('1.57 > 1: do not resample')
  await expect(figure.play).toBeHidden()
  await expect(figure.scrub).toBeHidden()
})

test('a number is typed by keyboard, and Reset takes it back', async ({ page }) => {
  const figure = await new Figure(page, tag).alone()
  await figure.openSettings()
  const [readouts, picture] = [await figure.readouts(), await figure.picture()]
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
})

for (const [name, value, reason] of [
  ['sigma-xy', '0.2', /sigma-xy = "0.2": must be between -0.1587 and 0.1587 m², so that Σ is positive definite/],
  ['bearing-std', '0', /bearing-std = "0": must be a number from 0.001 to 3 rad/],
  ['x2', '', /x2 = "": must be a number from -100 to 100 m/],
  ['r1', '1e300', /r1 = "1e300": must be a number from 0 to 200 m/],
] as const) {
  test(`${name} = "${value}" is refused with its reason, and nothing changes`, async ({ page }) => {
    const figure = await new Figure(page, tag).alone()
    await figure.openSettings()
    const [readouts, before] = [await figure.readouts(), await figure.box(name).inputValue()]
    await figure.box(name).fill(value)
    await figure.box(name).press('Enter')
    await expect(figure.alert).toContainText(reason)
    await figure.settled()
    expect(await figure.readouts()).toEqual(readouts)
    await expect(figure.box(name)).toHaveValue(before)
  })
}

test.describe('by link', () => {
  test.use({ permissions: ['clipboard-read', 'clipboard-write'] })

  test('a copied link opens the very same numbers', async ({ page, context }) => {
    const figure = await new Figure(page, tag).alone()
    await figure.openSettings()
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

test.describe('on a phone', () => {
  test.use({ viewport: { width: 380, height: 740 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 })

  test('the particles stand below each other, and nothing is wider than the screen', async ({ page }) => {
    const figure = await new Figure(page, tag).alone()
    await figure.openSettings()
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(380)
    const { width, height } = (await figure.canvas.boundingBox())!
    expect(height).toBeGreaterThan(4 * width)
    const small = await figure.element.evaluate(element =>
      [...element.shadowRoot!.querySelectorAll('button, input, summary')]
        .filter(control => control.getClientRects().length > 0 && control.getBoundingClientRect().height < 40)
        .map(control => control.outerHTML.slice(0, 80)),
    )
    expect(small).toEqual([])
    // No readout is cut off or laid over its neighbour.
    const wide = await figure.element.evaluate(element =>
      [...element.shadowRoot!.querySelectorAll('dd')].filter(dd => dd.scrollWidth > dd.clientWidth).map(dd => dd.textContent),
    )
    expect(wide).toEqual([])
  })
})
