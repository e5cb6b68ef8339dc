// What a reader sets is compared with the setting before, at the same step; and a script runs a setting at several seeds. What is told of
// each figure, and what is drawn, is held without a browser: widgets/tests/all/comparison.rs and pinned.rs.
import type { Page } from '@playwright/test'
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { breadth } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

/** A state, what a reader sets then, and what is said of it. */
const RUNS: [string, string, [string, string], RegExp][] = [
  ['fastslam-lap', 'v=13&universes=8&step=12', ['universes', '4'], /^Step 12: Universes M 8 → 4\. RMS error, best universe [\d.]+ → [\d.]+ m, /],
  ['fastslam-resampling', 'v=4&particles=12&step=12', ['threshold', '0.9'], /^Step 12: Threshold 0\.5 → 0\.9 of M\. .* → /],
  ['fastslam-doors', 'particles=100&step=50', ['ride', '2'], /^Step 50: Ride σ 4 → 2 m\. .* → /],
  ['fastslam-proposal', 'v=3&samples=200', ['range-std', '0.3'], /^Range noise σ 0\.05 → 0\.3 m\. .* → /],
  ['fastslam-joint', 'particles=100', ['sensor', '2'], /^Sensor noise σ 1 → 2 ×\. .* → /],
]

/** In `npm test`, a figure with steps and one without stand for the others. */
const breadthBut = (tag: string) => (['fastslam-lap', 'fastslam-proposal'].includes(tag) ? {} : breadth)

const open = (page: Page, tag: string, link: string): Promise<Figure> => new Figure(page, tag).alone(`#${tag}?${link}`)

async function give(figure: Figure, [name, value]: [string, string]): Promise<void> {
  await figure.box(name).fill(value)
  await figure.box(name).press('Enter')
  await figure.settled()
}

for (const [tag, link, change, says] of RUNS) {
  test(`${tag} tells what a reader’s setting has changed, with the one before behind it, until nobody wants to know`, breadthBut(tag), async ({ page }) => {
    const figure = await open(page, tag, link)
    const [opened, usual] = [await figure.state(), await figure.told.textContent()]
    await give(figure, change)
    await expect(figure.told).toHaveText(says)
    const [state, compared] = [await figure.state(), await figure.picture()]
    await figure.menu('Compare with nothing')
    await figure.settled()
    await expect(figure.told).not.toHaveText(says)
    const alone = await figure.picture()
    expect(alone, 'the setting before is drawn').not.toBe(compared)
    await figure.menu('Compare with the setting before')
    await figure.settled()
    await expect(figure.told).toHaveText(says)
    expect(await figure.picture()).toBe(compared)
    // A link has nothing of it, and the setting before has nothing to tell of itself.
    await figure.goTo(state)
    expect(await figure.picture()).toBe(alone)
    await figure.goTo(opened)
    await expect(figure.told).toHaveText(usual!)
  })
}

test('at another step nothing is compared, and what is read out is both', async ({ page }) => {
  const lap = await open(page, 'fastslam-lap', 'v=13&universes=4&step=9')
  const spoken = lap.element.locator('.spoken')
  await give(lap, ['odometry', '2'])
  await expect(spoken).toHaveText(/^Step 9: Odometry noise σ 1\.5 → 2 ×\. .*Step 9 of 110, 4 universes/)
  await lap.step.click()
  await lap.settled()
  await expect(lap.sentence).toHaveText(/^Step 10 of 110/)
  await lap.stepBack.click()
  await lap.settled()
  await expect(lap.told).toHaveText(/^Step 9: Odometry/)
})

test('a script runs seeds of its own, hears of them, and ends them by a signal; the figure stays as it is', async ({ page }) => {
  const lap = await open(page, 'fastslam-lap', 'v=13&universes=4&step=9&seed=3')
  const before = await lap.state()
  const { runs, why, told, first } = await lap.element.evaluate(async element => {
    type Run = { seed: number; step: number; state: string; readouts: { name: string; value: number }[] }
    const figure = element as HTMLElement & { runSeeds(wish?: object): Promise<Run[]> }
    const heard: { readout: string; median: number; runs: Run[] }[] = []
    element.addEventListener('fastslam-seeds', event => heard.push((event as CustomEvent).detail))
    const runs = await figure.runSeeds({ seeds: [7, 2, 5], step: 5 })
    const why = await figure.runSeeds({ signal: AbortSignal.abort() }).catch((error: Error) => error.name)
    return { runs, why, told: heard, first: (await figure.runSeeds()).map(({ seed }) => seed) }
  })
  expect(runs.map(({ seed, step }) => [seed, step])).toEqual([[7, 5], [2, 5], [5, 5]])
  expect([why, first]).toEqual(['AbortError', [3, 4, 5, 6, 7]])
  expect(told, 'each time').toHaveLength(2)
  const values = runs.map(run => run.readouts.find(({ name }) => name === told[0]!.readout)!.value)
  expect(told[0]).toEqual({ readout: 'rms_best', median: [...values].sort((a, b) => a - b)[1], runs })
  expect(await lap.state()).toBe(before)
  // They are what the figure has at these seeds.
  await lap.goTo(runs[1]!.state)
  const readouts = await lap.element.evaluate(
    element =>
      new Promise<unknown>(done => {
        element.addEventListener('fastslam-change', event => done((event as CustomEvent).detail.readouts), { once: true })
        const figure = element as HTMLElement & { state: string }
        figure.state = `${figure.state}`
      }),
  )
  expect(readouts).toEqual(runs[1]!.readouts)
})
