// What an author may fix about a figure: controls, locked parameters, seed, first step, decimal commas, size.
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { breadthOf, FIGURES, openCourse } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

const open = (page: ConstructorParameters<typeof Figure>[0], name: string, query: string) => new Figure(page, `fastslam-${name}`).open(`./embed.html?figure=${name}&${query}`)

test('controls are all there, those of playback, or none; the figure itself stays', async ({ page }) => {
  const lap = await open(page, 'lap', 'controls=playback')
  await expect(lap.play).toBeVisible()
  await expect(lap.element.locator('[part=settings]')).toBeHidden()
  await expect(lap.element.locator('[part=view]')).toBeHidden()
  await lap.element.evaluate(element => element.setAttribute('controls', 'none'))
  await expect(lap.play).toBeHidden()
  await expect(lap.element.locator('button[aria-label=Menu]')).toBeHidden()
  await expect(lap.canvas).toBeVisible()
  await expect(lap.sentence).not.toBeEmpty()
})

test('for a slide the picture alone has the whole width, with the row of playback below it where that is wanted', async ({ page }) => {
  await page.setViewportSize({ width: 900, height: 560 })
  for (const [controls, bare] of [['picture', true], ['picture playback', true], ['none', false]] as const) {
    const lap = await open(page, 'lap', `size=presentation&chips=off&controls=${controls}`)
    await lap.live()
    await lap.settled()
    if (bare) for (const part of ['.sentence', '.head']) await expect(lap.element.locator(part), controls).toBeHidden()
    else await expect(lap.element.locator('.sentence')).toBeVisible()
    await expect(lap.play).toBeVisible({ visible: controls === 'picture playback' })
    const [picture, figure] = [await lap.canvas.boundingBox(), await lap.element.boundingBox()]
    if (bare) expect(picture!.width, controls).toBeGreaterThan(0.9 * figure!.width)
    expect(picture!.y + picture!.height, controls).toBeLessThanOrEqual(figure!.y + figure!.height)
    expect(await lap.element.locator('.stage').evaluate(stage => getComputedStyle(stage).clipPath), `${controls}: nothing stands over the picture`).toBe('none')
    await expect(lap.alert).toBeEmpty()
  }
})

for (const name of FIGURES) {
  test(`on a projector the picture of ${name} grows with its letters until it meets an edge, and nothing is left to scroll`, breadthOf(name), async ({ page }) => {
    const figure = await open(page, name, 'size=presentation&controls=picture')
    await figure.live()
    // Beside 700 px a figure once swung by a pixel for ever: what it left for the row of playback was there without the row.
    for (const [width, height] of [[900, 560], [753, 700], [755, 700], [1920, 1080]] as const) {
      await page.setViewportSize({ width, height })
      for (const controls of ['picture', 'picture playback']) {
        await figure.element.evaluate((element, controls) => element.setAttribute('controls', controls), controls)
        await figure.settled()
        const which = `${controls}, ${width} × ${height}`
        const [picture, room, scrolled] = await figure.element.evaluate(element => {
          const root = element.shadowRoot!
          const [canvas, stage, body] = ['canvas', '.stage', '.figure'].map(inner => root.querySelector<HTMLElement>(inner)!) as [HTMLElement, HTMLElement, HTMLElement]
          return [[canvas.clientWidth, canvas.clientHeight], [stage.clientWidth, body.clientHeight], body.scrollHeight - body.clientHeight] as const
        })
        expect(scrolled, `${which}, scrolled`).toBe(0)
        expect(picture[0]! <= room[0]! && picture[1]! <= room[1]!, `${which}, in its window`).toBe(true)
        // With letters of one size for all screens em filled six tenths of it, and all of its width.
        if (width === 1920) expect(picture[1]!, `${which}, high`).toBeGreaterThan(0.86 * height)
        // The row of playback is no higher than this.
        expect(picture[0]! > 0.95 * room[0]! || room[1]! - picture[1]! < 64, `${which}: ${picture} in ${room}`).toBe(true)
      }
    }
  })
}

test('controls can be picked by their names, and a name that is none is answered with those there are', async ({ page }) => {
  const lap = await open(page, 'lap', 'show=n-eff&controls=odometry&step=20')
  const visible = () => lap.element.evaluate(element => [...element.shadowRoot!.querySelectorAll('button, input, select, summary')].filter(control => control.checkVisibility() && !control.closest('[part=notice]')).map(control => control.getAttribute('name') ?? control.getAttribute('aria-label')))
  expect(await visible()).toEqual(['Menu', 'odometry', 'odometry'])
  await lap.box('odometry').fill('2')
  await lap.box('odometry').press('Enter')
  await lap.settled()
  expect(await lap.element.evaluate(element => (element as HTMLElement & { odometry: number }).odometry)).toBe(2)
  const pick = async (names: string) => {
    await lap.element.evaluate((element, text) => element.setAttribute('controls', text), names)
    await lap.settled()
    return visible()
  }
  expect(await pick('play universe  truth')).toEqual(['Menu', 'Play', 'truth', 'universe'])
  expect(await pick('step seed')).toEqual(['Menu', 'Step shown', 'seed', 'Re-roll the seed'])
  expect(await pick('playback')).toEqual(['Menu', 'Rewind', 'Step back', 'Play', 'Step', 'Step shown', 'Speed', 'seed', 'Re-roll the seed', 'Reset'])
  await expect(lap.alert).toBeEmpty()
  const all = await pick('all')
  expect(all.length).toBeGreaterThan(15)
  expect(await pick('seed odometri')).toEqual(all)
  await expect(lap.alert).toContainText('controls names “odometri”, but this figure has none, picture, playback, play, numbers, chips, universes, ')
  expect(await pick('none')).toEqual([])
  await expect(lap.alert).toBeEmpty()
})

test('one slider stands by itself, without a panel to be opened, and a picked figure is a small one', async ({ page }) => {
  const body = ['', 'show="n-eff" controls="odometry"'].map(attributes => `<fastslam-lap ${attributes}></fastslam-lap>`).join('')
  await openCourse(page, body)
  const [whole, part] = [0, 1].map(i => new Figure(page, `fastslam-lap >> nth=${i}`)) as [Figure, Figure]
  await whole.live()
  await part.element.scrollIntoViewIfNeeded()
  await part.live()
  await expect(part.slider('odometry')).toBeVisible()
  const height = (figure: Figure) => figure.element.evaluate(element => (element as HTMLElement).offsetHeight)
  expect(await height(part)).toBeLessThan(0.6 * (await height(whole)))
})

test('a locked parameter yields to no control, no link and no hand, and others are free', async ({ page }) => {
  const lap = await open(page, 'lap', 'universes=8&lock=universes%20seed%20universe#fastslam-lap?universes=32&seed=7&step=5')
  expect(await lap.position()).toBe(5)
  await lap.element.evaluate(element => ((element as unknown as { fit: string }).fit, element.removeAttribute('fit')))
  await lap.openSettings()
  await expect(lap.box('universes')).toHaveValue('8')
  await expect(lap.box('universes')).toBeDisabled()
  await expect(lap.slider('universes')).toBeDisabled()
  await expect(lap.seed).toHaveValue('9')
  await expect(lap.reroll).toBeDisabled()
  await expect(lap.alert).toContainText('is fixed on this page')
  await expect(lap.box('odometry')).toBeEnabled()
  // A click on a tile would choose its universe.
  const box = (await lap.canvas.boundingBox())!
  await lap.canvas.click({ position: { x: box.width * 0.9, y: box.height * 0.3 } })
  await lap.settled()
  await expect(lap.element.locator('select[name=universe]')).toHaveValue('best')
  await lap.element.evaluate(element => element.setAttribute('lock', 'all'))
  await expect(lap.box('odometry')).toBeDisabled()
  await lap.element.evaluate(element => element.setAttribute('lock', 'univers'))
  await expect(lap.alert).toContainText('lock names “univers”')
  await expect(lap.box('universes')).toBeEnabled()
})

test('a handle moves what is free and leaves what is locked', async ({ page }) => {
  const figure = await open(page, 'proposal', 'lock=landmark-x')
  const before = await figure.element.evaluate(element => [(element as never as { landmarkX: number }).landmarkX, (element as never as { landmarkY: number }).landmarkY])
  const handle = figure.grasp('landmark')
  await handle.focus()
  for (const key of ['ArrowLeft', 'ArrowLeft', 'ArrowUp']) await page.keyboard.press(key)
  await figure.settled()
  const after = await figure.element.evaluate(element => [(element as never as { landmarkX: number }).landmarkX, (element as never as { landmarkY: number }).landmarkY])
  expect(after[0]).toBe(before[0])
  expect(after[1]).not.toBe(before[1])
})

test('decimal commas: in boxes, readouts, the sentence and the picture, and typed ones are understood', async ({ page }) => {
  const point = await open(page, 'proposal', '')
  const [written, picture] = [await point.readouts(), await point.picture()]
  const figure = await open(page, 'proposal', 'decimal=comma')
  await expect(figure.alert).toBeEmpty()
  const commas = await figure.readouts()
  expect(Object.values(commas)).toEqual(Object.values(written).map(text => text.replace(/(\d)\.(\d)/g, '$1,$2')))
  expect(Object.values(commas).filter(text => /\d,\d/.test(text)).length).toBeGreaterThan(3)
  expect(await figure.picture()).not.toBe(picture)
  await expect(figure.sentence).toContainText('0,05 m')
  await figure.element.evaluate(element => element.removeAttribute('fit'))
  await figure.openSettings()
  const box = figure.element.getByRole('spinbutton', { name: /Range noise/ })
  await expect(box).toHaveValue('0,05')
  await box.fill('0,12')
  await box.press('Enter')
  await expect(figure.sentence).toContainText('0,12 m')
  await expect(box).toHaveValue('0,12')
  await box.press('ArrowUp')
  await expect(box).toHaveValue(/^0,1[23]\d*$/)
  // Data and links keep the point.
  expect(await figure.element.evaluate(element => (element as never as { link: string }).link)).toMatch(/range-std=0\.1/)
  await figure.element.evaluate(element => element.setAttribute('decimal', 'point'))
  await expect(figure.box('range-std')).toHaveValue(/^0\.1/)
})

test('the presentation size is half as large again, in the picture and beside it, and pointers still hit', async ({ page }) => {
  const normal = await open(page, 'lap', 'step=20')
  const letters = (figure: Figure) => figure.told.evaluate(element => parseFloat(getComputedStyle(element).fontSize))
  const [before, handles] = [await letters(normal), await normal.play.evaluate(button => (button as HTMLElement).offsetHeight)]
  const figure = await open(page, 'lap', 'step=20&size=presentation')
  await figure.element.evaluate(element => element.removeAttribute('fit'))
  await figure.settled()
  expect(await letters(figure)).toBe(1.5 * before)
  expect(await figure.play.evaluate(button => (button as HTMLElement).offsetHeight)).toBeGreaterThan(1.4 * handles)
  const box = (await figure.canvas.boundingBox())!
  await figure.canvas.click({ position: { x: box.width * 0.93, y: box.height * 0.2 } })
  await figure.settled()
  await expect(figure.element.locator('select[name=universe]')).toHaveValue('3')
})

test('a start step waits there, and Reset returns to what the author gave', async ({ browser, baseURL }) => {
  const page = await (await browser.newContext({ baseURL: baseURL!, reducedMotion: 'no-preference' })).newPage()
  await page.clock.install()
  const lap = await open(page, 'lap', 'step=12&universes=4&lock=seed')
  await page.clock.runFor(1500)
  expect(await lap.playing()).toBe(false)
  expect(await lap.position()).toBe(12)
  await lap.scrubTo(30)
  await lap.reset.click()
  await lap.settled()
  expect(await lap.position()).toBe(12)
  await page.context().close()
})

test('a page can show some parts of a picture, and is told which there are', async ({ page }) => {
  const lap = await open(page, 'lap', 'show=n-eff&step=20')
  await lap.element.evaluate(element => element.removeAttribute('fit'))
  await lap.settled()
  const height = async () => (await lap.canvas.boundingBox())!.height
  const part = await height()
  await lap.element.evaluate(element => element.setAttribute('show', 'all'))
  await lap.settled()
  expect(await height()).toBeGreaterThan(2 * part)
  await lap.element.evaluate(element => element.setAttribute('show', 'tree'))
  await expect(lap.alert).toContainText('must be all, or some of map, mosaic, n-eff')
  await lap.element.evaluate(element => element.setAttribute('show', 'n-eff'))
  await lap.settled()
  await expect(lap.alert).toBeEmpty()
  expect(await height()).toBe(part)
})
