// Real traps: a program that dies on request (the feature `trouble`, which no program that is shipped has) is served in place of the
// page's. One figure among six dies of a panic, a full stack or a full memory: the others go on, and nothing is lost.
import type { Page } from '@playwright/test'
import { existsSync, readFileSync } from 'node:fs'
import { join } from 'node:path'
import { buildTrouble, troubleWasm } from '../../scripts/build.mjs'
import { root } from '../../scripts/lib.mjs'
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { openCourse } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

// npm test builds it anew; for a run of the browser's tests alone it is built if there is none.
test.beforeAll(async () => {
  test.setTimeout(600_000)
  if (!existsSync(troubleWasm)) await buildTrouble()
})

const TINY = join(root, 'tests', 'figures', 'golden', 'tiny.clf')

type FigureElement = HTMLElement & { state: string; seek(step: number): void; currentStep: number }

/** A state of each figure that is not the one it opens in. */
const STATES: Record<string, string> = {
  lap: 'universes=4&seed=9&step=11',
  conditioning: 'step=3',
  proposal: 'samples=32',
  'worked-example': 'step=2',
  resampling: 'particles=20&step=7',
  universes: 'threshold=0.1&universes=16',
}
const SIX = Object.keys(STATES)
const THREE = ['lap', 'proposal', 'resampling']

/** What a trap of each kind is said to be, and who dies of it; engines differ in which of a program's two stacks is full first. */
const KINDS: [string, RegExp, string][] = [
  ['panic', /trouble was asked for/, 'lap'],
  ['stack', /its stack was full|memory access out of bounds/, 'resampling'],
  ['memory', /its memory was full/, 'conditioning'],
]

/** Counts instances, and writes down what is called of one after it has trapped. */
async function watchInstances(page: Page): Promise<void> {
  await page.addInitScript(() => {
    const seen = { instances: 0, calledDead: [] as string[] }
    Object.assign(self, { seen })
    const instantiate = WebAssembly.instantiate as (module: WebAssembly.Module, imports: WebAssembly.Imports) => Promise<WebAssembly.Instance>
    WebAssembly.instantiate = (async (...args: Parameters<typeof instantiate>) => {
      const instance = await instantiate(...args)
      seen.instances++
      let dead = false
      const exports = Object.fromEntries(
        Object.entries(instance.exports).map(([name, value]) => {
          if (typeof value !== 'function') return [name, value]
          const call = (...given: unknown[]) => {
            if (dead) seen.calledDead.push(name)
            try {
              return (value as (...given: unknown[]) => unknown)(...given)
            } catch (error) {
              dead = true
              throw error
            }
          }
          return [name, call]
        }),
      )
      return Object.create(WebAssembly.Instance.prototype, { exports: { value: exports } }) as WebAssembly.Instance
    }) as never
  })
}
const seen = (page: Page) => page.evaluate(() => (self as unknown as { seen: { instances: number; calledDead: string[] } }).seen)

/** Figures, each in a state of its own, and a log beside them. */
async function openAll(page: Page, names: string[]): Promise<Figure[]> {
  await page.route('**/*.wasm', route => route.fulfill({ contentType: 'application/wasm', body: readFileSync(troubleWasm) }))
  await watchInstances(page)
  const tags = names.map(name => `fastslam-${name}`)
  await openCourse(page, `${tags.map(tag => `<${tag}></${tag}>`).join('')}<fastslam-log universes="5"></fastslam-log>`)
  const log = page.locator('fastslam-log')
  await log.scrollIntoViewIfNeeded()
  await log.locator('input[type=file]').setInputFiles(TINY)
  await expect(log.locator('[part=sentence]')).toContainText('91 scans')
  const figures: Figure[] = []
  for (const tag of tags) {
    const figure = new Figure(page, tag)
    await figure.element.evaluate((element, state) => Object.assign(element, { state }), STATES[tag.slice('fastslam-'.length)])
    await figure.element.scrollIntoViewIfNeeded()
    await figure.live()
    figures.push(figure)
  }
  return figures
}

const statesOf = (figures: Figure[]) => Promise.all(figures.map(({ element }) => element.evaluate(figure => (figure as FigureElement).state)))

/** Brings each into view, as only there it is painted. */
async function readoutsOf(figures: Figure[]): Promise<Record<string, string>[]> {
  const all: Record<string, string>[] = []
  for (const figure of figures) {
    await figure.element.scrollIntoViewIfNeeded()
    await figure.settled()
    all.push(await figure.readouts())
  }
  return all
}

const die = (figure: Figure, kind: string) => figure.element.evaluate((element, kind) => element.setAttribute('trouble', kind), kind)

/** What the program and the figure wrote about the trap is meant to be there. */
function forgiveTrap(complaints: string[]): void {
  complaints.splice(0, Infinity, ...complaints.filter(line => !/trouble was asked for|unreachable|call stack|out of bounds|has stopped/.test(line)))
}

test('one figure among six dies, of a panic, a full stack or a full memory: it says so and is as it was, the others go on, and nothing is lost', async ({ page, complaints }) => {
  const figures = await openAll(page, SIX)
  expect((await seen(page)).instances).toBe(1)
  const dead = new Set<Figure>()
  for (const [kind, message, name] of KINDS) {
    await test.step(kind, async () => {
      const dying = figures[SIX.indexOf(name)]!
      const before = [await statesOf(figures), await readoutsOf(figures)]
      await dying.element.scrollIntoViewIfNeeded()
      await die(dying, kind)
      dead.add(dying)
      await expect(dying.alert).toContainText('Something failed inside this figure')
      await expect(dying.alert).toContainText(message)
      await expect(dying.alert).toContainText('rebuilt as it was before')

      expect([await statesOf(figures), await readoutsOf(figures)]).toEqual(before)
      for (const figure of figures) if (!dead.has(figure)) await expect(figure.alert).toBeEmpty()
      await expect(page.locator('fastslam-log [part=sentence]')).toContainText('91 scans')
      // All of them live on a new instance, and of the dead one nothing was called but what it had to say.
      const { instances, calledDead } = await seen(page)
      expect(instances).toBe(1 + dead.size)
      expect(calledDead.filter(name => !/^(last_panic|__wbindgen_free)$/.test(name))).toEqual([])
      for (const figure of [dying, figures[SIX.indexOf(name === 'lap' ? 'resampling' : 'lap')]!]) {
        await figure.element.scrollIntoViewIfNeeded()
        const step = await figure.position()
        await figure.step.click()
        await expect.poll(() => figure.position()).toBe(step + 1)
      }
    })
  }
  forgiveTrap(complaints)
})

test('whoever compares nothing compares nothing after a program died, and what is set then is compared by all others', async ({ page, complaints }) => {
  const figures = await openAll(page, THREE)
  await figures[0]!.element.scrollIntoViewIfNeeded()
  await figures[0]!.menu('Compare with nothing')
  await die(figures[0]!, 'panic')
  await expect(figures[0]!.alert).toContainText('rebuilt as it was before')
  await expect.poll(async () => (await seen(page)).instances).toBe(2)
  for (const [k, figure] of figures.entries()) {
    await figure.element.scrollIntoViewIfNeeded()
    await figure.reroll.click()
    await figure.settled()
    const compared = await figure.told.evaluate(sentence => sentence.textContent!.includes(' → '))
    expect(compared, `figure ${k}`).toBe(k > 0)
  }
  forgiveTrap(complaints)
})

test('a figure that dies again stops and offers to begin anew; the others go on as they were', async ({ page, complaints }) => {
  const figures = await openAll(page, THREE)
  const [lap, ...others] = figures as [Figure, ...Figure[]]
  const before = await statesOf(figures)
  await lap.element.scrollIntoViewIfNeeded()
  await die(lap, 'panic')
  await expect(lap.alert).toContainText('rebuilt')
  await lap.settled()
  await die(lap, 'panic ') // another value is another setting; it dies of no other
  await expect(lap.alert).toContainText('trouble')
  await die(lap, 'panic')
  await expect(lap.alert).toContainText('so it has stopped')
  await expect(lap.element.locator('[part=transport]')).toHaveAttribute('inert')
  expect(await statesOf(figures), 'also the state of the one that stopped is there to be copied').toEqual(before)
  await readoutsOf(others)
  for (const { alert } of others) await expect(alert).toBeEmpty()

  await lap.element.scrollIntoViewIfNeeded()
  await lap.element.evaluate(element => element.removeAttribute('trouble'))
  await lap.alert.getByRole('button', { name: 'Reset' }).click()
  await lap.live()
  await expect(lap.alert).toBeEmpty()
  await lap.step.click()
  await expect.poll(() => lap.position()).toBe(1)
  forgiveTrap(complaints)
})

test('a log that dies in its worker is opened again with its settings, and no other figure feels it', async ({ page, complaints }) => {
  const figures = await openAll(page, THREE)
  const before = await statesOf(figures)
  const log = new Figure(page, 'fastslam-log')
  await log.element.scrollIntoViewIfNeeded()
  await die(log, 'panic')
  await expect(log.alert).toContainText('Something failed while this log was mapped')
  await expect(log.alert).toContainText('trouble was asked for')
  await expect(log.alert).toContainText('The log is open again.')
  await expect(log.element.getByRole('status')).toHaveText('tiny.clf')
  await expect(log.sentence).toContainText('91 scans')
  await expect(log.box('universes')).toHaveValue('5')
  await log.element.getByRole('button', { name: 'Map this building', exact: true }).click()
  await expect(log.sentence).toContainText('All scans are mapped')
  expect(await statesOf(figures)).toEqual(before)
  expect((await seen(page)).instances).toBe(1)
  forgiveTrap(complaints)
})
