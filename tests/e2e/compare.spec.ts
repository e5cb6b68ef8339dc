// A run is pinned beside the next ones, and its setting is run at five seeds: by mouse, by keyboard and by touch. That the curves of every
// figure stay, and that a seed is the same whichever was run before, is held without a browser: widgets/tests/all/pinned.rs.
import type { Locator, Page } from '@playwright/test'
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { breadth, breadthOf, openCourse } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

/** A state that is pinned, what is set then, and what the card says of it. */
const RUNS: [string, string, [string, string], RegExp][] = [
  ['fastslam-lap', 'universes=8&step=12', ['universes', '4'], /^Pinned at step 12: Universes M 8 \(now 4\)$/],
  ['fastslam-resampling', 'particles=12&step=12', ['threshold', '0.9'], /^Pinned at step 12: Threshold 0.5 of M \(now 0.9 of M\)$/],
  ['fastslam-doors', 'particles=100&step=50', ['ride', '2'], /^Pinned at step 50: Ride σ 4 m \(now 2 m\)$/],
  ['fastslam-proposal', 'samples=200', ['range-std', '0.3'], /^Pinned: Range noise σ 0.05 m \(now 0.3 m\)$/],
  ['fastslam-smoothing', 'particles=4&step=3', ['odometry', '2'], /^Pinned at step 3: Odometry noise σ 1 × \(now 2 ×\)$/],
  ['fastslam-joint', 'particles=100', ['sensor', '2'], /^Pinned: Sensor noise σ 1 × \(now 2 ×\)$/],
  ['fastslam-em', 'particles=100&step=200', ['sensor', '15'], /^Pinned at step 200: Sensor errors 5 % \(now 15 %\)$/],
]

/** In `npm test`, the card is seen of a figure with steps and of one without, all else of the first alone. */
const breadthButLap = (tag: string) => (tag === 'fastslam-lap' ? {} : breadth)

const card = (figure: Figure): Locator => figure.element.locator('[part=pinned]')
const differs = (figure: Figure): Locator => card(figure).locator('.differs')
const overlay = (figure: Figure): Locator => figure.element.locator('.peek')

/** A fingerprint of a canvas of ours. */
const pixels = (canvas: Locator) =>
  canvas.evaluate((canvas: HTMLCanvasElement) => {
    const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d', { willReadFrequently: true })!
    copy.drawImage(canvas, 0, 0)
    let hash = 2166136261
    for (const byte of new Uint32Array(copy.getImageData(0, 0, canvas.width, canvas.height).data.buffer)) hash = Math.imul(hash ^ byte, 16777619)
    return hash
  })

async function open(page: Page, tag: string, link: string): Promise<Figure> {
  return new Figure(page, tag).alone(`#${tag}?${link}`)
}

async function give(figure: Figure, [name, value]: [string, string]): Promise<void> {
  await figure.element.evaluate((element, [name, value]) => element.setAttribute(name!, value!), [name, value])
  await figure.settled()
}

for (const [tag, link, change, says] of RUNS) {
  test(`${tag} keeps a pinned run behind and beside the next one, and goes back to it`, breadthOf(tag), async ({ page }) => {
    const figure = await open(page, tag, link)
    const before = await figure.state()
    await figure.button('Pin this run').click()
    await figure.settled()
    const itself = await figure.picture()
    await expect(card(figure)).toBeVisible()
    await expect(differs(figure)).toContainText('the settings are the same')
    expect(await figure.state(), 'a link has nothing of it').toBe(before)

    await give(figure, change)
    await expect(differs(figure)).toHaveText(says)
    await expect(card(figure)).toHaveAccessibleName(new RegExp(`^The pinned run. ${says.source.slice(1)}`))
    // The ghosts are not the curves: where they are, as of the run itself, the same state is another picture.
    const haunted = await figure.picture()
    await figure.button('Pin this run').click()
    await figure.settled()
    expect(await figure.picture()).not.toBe(haunted)
    await figure.button('Unpin').click()
    await figure.settled()
    await expect(card(figure)).toBeHidden()
    await expect(figure.button('Pin this run')).toBeFocused()

    // And back.
    await figure.element.evaluate((element, link) => ((element as HTMLElement & { state: string }).state = link), link)
    await figure.settled()
    await figure.button('Pin this run').click()
    await give(figure, change)
    const changed = await figure.state()
    await figure.button('Go back to it').click()
    await figure.settled()
    expect(await figure.state()).toBe(before)
    expect(await figure.picture()).toBe(itself)
    await figure.button('Undo going back').click()
    await figure.settled()
    expect(await figure.state()).toBe(changed)
    expect(await figure.picture()).toBe(haunted)
  })

  test(`${tag} shows the pinned picture in the place of its own, by mouse and by keyboard`, breadthButLap(tag), async ({ page }) => {
    const figure = await open(page, tag, link)
    await figure.button('Pin this run').focus()
    await page.keyboard.press('Enter')
    await figure.settled()
    const pinned = await figure.picture()
    await give(figure, change)
    const peek = figure.button('Show the pinned picture')
    await peek.hover()
    await expect(overlay(figure)).toBeVisible()
    expect(await pixels(overlay(figure).locator('canvas')), 'as it was when it was pinned').toBe(pinned)
    const [over, under] = [(await overlay(figure).boundingBox())!, (await figure.canvas.first().boundingBox())!]
    for (const side of ['x', 'y', 'width', 'height'] as const) expect(Math.abs(over[side] - under[side]), side).toBeLessThan(1.5)
    await page.mouse.move(0, 0)
    await expect(overlay(figure)).toBeHidden()
    await peek.focus()
    await page.keyboard.press('Enter')
    await expect(overlay(figure)).toBeVisible()
    await expect(peek).toHaveAttribute('aria-pressed', 'true')
    await page.keyboard.press('Escape')
    await expect(overlay(figure)).toBeHidden()
    // What is done next is seen at once.
    await peek.press(' ')
    await expect(overlay(figure)).toBeVisible()
    await figure.reroll.click()
    await expect(overlay(figure)).toBeHidden()
  })

  test(`${tag} runs five seeds, with exactly the readouts that it has at each of them`, breadthButLap(tag), async ({ page }) => {
    const figure = await open(page, tag, link)
    const first = Number(await figure.seed.inputValue())
    const told = figure.element.evaluate(element => new Promise<unknown>(done => element.addEventListener('fastslam-seeds', event => done((event as CustomEvent).detail), { once: true })))
    await figure.element.getByText('Five seeds', { exact: true }).click()
    await figure.button('Run five seeds').click()
    const { median, readout, runs } = (await told) as { median: number; readout: string; runs: { seed: number; state: string; readouts: { name: string; value: number }[] }[] }
    expect(runs.map(({ seed }) => seed)).toEqual([0, 1, 2, 3, 4].map(k => first + k))
    const values = runs.map(run => run.readouts.find(({ name }) => name === readout)!.value)
    expect(median).toBe([...values].sort((a, b) => a - b)[2])
    await expect(figure.element.locator('.seeds .said')).toContainText('Median over five seeds')
    const strip = figure.element.locator('.strip button')
    await expect(strip).toHaveCount(5)
    await expect(strip.first()).toHaveAttribute('aria-current', 'true')
    for (const [k, run] of runs.entries()) {
      await strip.nth(k).click()
      await figure.settled()
      expect(await figure.state()).toBe(run.state)
      await expect(figure.seed).toHaveValue(String(run.seed))
      await expect(strip.nth(k)).toHaveAttribute('aria-current', 'true')
      const shown = await figure.element.evaluate(
        element =>
          new Promise<unknown>(done => {
            element.addEventListener('fastslam-change', event => done((event as CustomEvent).detail.readouts), { once: true })
            const figure = element as HTMLElement & { state: string }
            figure.state = `${figure.state}`
          }),
      )
      expect(shown).toEqual(run.readouts)
    }
    await figure.button('Undo the seed').click()
    await figure.settled()
    await expect(figure.seed).toHaveValue(String(first + 3))
    // Another setting: they are not of it.
    await give(figure, change)
    await expect(figure.element.locator('.strip')).toHaveClass(/stale/)
    await expect(figure.element.locator('.seeds .said')).toHaveText('The settings have changed: run again.')
    await expect(figure.button('Run again')).toBeEnabled()
  })
}

test('five seeds can be stopped, and go to the end where that is asked for', async ({ page }) => {
  const lap = await open(page, 'fastslam-lap', 'universes=4&step=3')
  await lap.element.getByText('Five seeds', { exact: true }).click()
  await lap.element.getByRole('combobox', { name: 'Up to' }).selectOption('end')
  await lap.button('Run five seeds').press('Enter')
  await expect(lap.element.locator('.strip button').first()).toContainText('Seed 3, step 90')
  await lap.button('Stop').press('Enter')
  await expect(lap.element.locator('.seeds .said')).toContainText(/^(Stopped after \d of 5 seeds|Median)/)
  await expect(lap.button('Run again')).toBeEnabled()
  await expect(lap.button('Stop')).toBeDisabled()
  expect(await lap.position(), 'the figure stayed where it was').toBe(3)
})

test('a script runs seeds of its own, and ends them by a signal', async ({ page }) => {
  const lap = await open(page, 'fastslam-lap', 'universes=4&step=9')
  const seeds = await lap.element.evaluate(async element => {
    const figure = element as HTMLElement & { runSeeds(wish: object): Promise<{ seed: number; step: number }[]> }
    const runs = await figure.runSeeds({ seeds: [7, 2], step: 5 })
    const why = await figure.runSeeds({ signal: AbortSignal.abort() }).catch((error: Error) => error.name)
    return [runs.map(({ seed, step }) => [seed, step]), why]
  })
  expect(seeds).toEqual([[[7, 5], [2, 5]], 'AbortError'])
})

test('a pinned run stays through a reset, other seeds, other steps and a move in the page', async ({ page }) => {
  await openCourse(page, '<main><fastslam-lap universes="4" step="9"></fastslam-lap><aside></aside></main>')
  const lap = new Figure(page, 'fastslam-lap')
  await lap.live()
  await lap.button('Pin this run').click()
  await lap.settled()
  const pinned = await lap.picture()
  await lap.reroll.click()
  await lap.step.click()
  await lap.settled()
  await expect(differs(lap)).toContainText(/^Pinned at step 9 \(now 10\): Seed 9 \(now \d+\)$/)
  await lap.reset.click()
  await lap.settled()
  await expect(differs(lap)).toHaveText('Pinned at step 9: the settings are the same')
  expect(await lap.picture()).toBe(pinned)
  await lap.element.evaluate(element => document.querySelector('aside')!.append(element))
  await lap.live()
  await expect(card(lap)).toBeVisible()
  expect(await lap.picture()).toBe(pinned)
})

test('a pinned picture follows the page into the dark, and into another language', async ({ page }) => {
  await openCourse(page, '<fastslam-lap universes="4" step="9"></fastslam-lap>')
  const lap = new Figure(page, 'fastslam-lap')
  await lap.live()
  await lap.button('Pin this run').click()
  await give(lap, ['universes', '2'])
  await give(lap, ['theme', 'dark'])
  const paper = () =>
    lap.element.evaluate(element => {
      const canvas = element.shadowRoot!.querySelector<HTMLCanvasElement>('.peek canvas')!
      const copy = new OffscreenCanvas(1, 1).getContext('2d')!
      copy.drawImage(canvas, 0, 0)
      return [...copy.getImageData(0, 0, 1, 1).data].slice(0, 3)
    })
  await expect.poll(paper).toEqual([18, 22, 28])
  await give(lap, ['lang', 'de'])
  await expect(differs(lap)).toHaveText(/^Angeheftet bei Schritt 9: \D+ 4 \(jetzt 2\)$/)
  await expect(lap.button('Dorthin zurück')).toBeVisible()
  await expect(overlay(lap).locator('canvas')).toHaveAttribute('aria-label', /^Angeheftet bei Schritt 9\. Schritt 9 /)
})

test.describe('on a phone', () => {
  test.use({ viewport: { width: 380, height: 760 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 })

  for (const [tag, link, change, says] of RUNS) {
    test(`${tag} pins, peeks and goes back by touch`, breadthButLap(tag), async ({ page }) => {
      const figure = await open(page, tag, link)
      const before = await figure.state()
      await figure.button('Pin this run').tap()
      await figure.settled()
      await give(figure, change)
      await expect(differs(figure)).toHaveText(says)
      await figure.button('Show the pinned picture').tap()
      await expect(overlay(figure)).toBeVisible()
      await figure.button('Show the pinned picture').tap()
      await expect(overlay(figure)).toBeHidden()
      await figure.button('Go back to it').tap()
      await figure.settled()
      expect(await figure.state()).toBe(before)
      await figure.button('Unpin').tap()
      await expect(card(figure)).toBeHidden()
      expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(380)
    })
  }
})
