// What a reader does with the pose graph: the caption's claims, in the page alone, by mouse and by keyboard.
import type { Page } from '@playwright/test'
import { brokenRules } from './axe'
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { breadth } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

const TAG = 'fastslam-graph'
const open = (page: Page, query?: string) => new Figure(page, TAG).alone(query && `#${TAG}?v=2&${query}`)


/** Drags a handle of the picture. */
async function drag(page: Page, figure: Figure, name: string, [right, down]: [number, number]): Promise<void> {
  const box = (await figure.handle(name).boundingBox())!
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2]
  await page.mouse.move(x, y)
  await page.mouse.down()
  await page.mouse.move(x + right, y + down, { steps: 6 })
  await page.mouse.up()
  await figure.settled()
}

test('it opens before the first iteration with a ring that does not close; by its iterations the path snaps into the building, and a false edge folds it, is dragged and moved by arrow keys, until a repair mends it', async ({ page }) => {
  const figure = await open(page)
  expect(await figure.position()).toBe(0)
  await expect(figure.sentence).toContainText('Before the first of')
  expect(await figure.number('rms')).toBeGreaterThan(1.5)
  expect(await figure.number('rms_universe')).toBeLessThan(0.2)
  expect(await figure.number('loop_edges')).toBeGreaterThan(10)
  expect(await brokenRules(page, { of: TAG })).toEqual([])

  await figure.scrubTo(await figure.last())
  expect(await figure.number('rms')).toBeLessThan(0.1)
  await expect(figure.sentence).toContainText('the path is off by 0.07 m')
  expect(await figure.state()).toBe('v=3&step=60')
  await figure.scrub.focus()
  await page.keyboard.press('Home')
  await figure.settled()
  expect(await figure.number('rms')).toBeGreaterThan(1.5)

  await figure.scrubTo(await figure.last())
  await figure.toggle('wrong').click()
  await figure.settled()
  const folded = await figure.number('rms')
  expect(folded).toBeGreaterThan(2.5)
  expect(await figure.number('wrong_weight')).toBe(100)
  await drag(page, figure, 'wrong-to', [-60, 0])
  expect(await figure.state()).toMatch(/wrong-to=\d+/)
  const moved = await figure.state()
  await figure.grasp('wrong-to').press('ArrowRight')
  await figure.settled()
  expect(await figure.state()).not.toBe(moved)
  await figure.grasp('wrong-to').press('ArrowLeft')
  await figure.settled()
  expect(await figure.state()).toBe(moved)
  for (const repair of ['robust', 'switchable', 'mixture']) {
    await figure.element.evaluate((element, repair) => element.setAttribute('repair', repair), repair)
    await figure.settled()
    expect(await figure.number('rms'), repair).toBeLessThan(0.25)
    expect((await figure.readouts())['wrong_weight'], repair).toContain('< 0.1')
  }
})

/** Sets the noise of the wheels, and returns what is told on the way and at which iteration of how many, picture by picture. */
const wheels = (figure: Figure, noise: string): Promise<[told: string, position: string][]> =>
  figure.element.evaluate(async (element, noise) => {
    const [described, position] = ['.described', '.timeline .position'].map(part => element.shadowRoot!.querySelector(part)!) as [Element, Element]
    const told: [string, string][] = []
    const observer = new MutationObserver(() => told.push([described.textContent!, position.textContent!]))
    observer.observe(described, { childList: true, characterData: true, subtree: true })
    element.setAttribute('odometry', noise)
    await (element as HTMLElement & { settled(): Promise<void> }).settled()
    observer.disconnect()
    return told
  }, noise)

test('of other wheels the graph is shown when the first loops are found, at its last iteration, and then as a new figure shows it', async ({ page, context }) => {
  const figure = await open(page, 'step=60')
  const pictures = [await figure.picture()]
  const told = await wheels(figure, '0.6')
  pictures.push(await figure.picture())
  const [first, last] = [told[0]!, told.at(-1)!]
  expect(first[0]).toMatch(/^3 loops found so far\. The path is off by 0\.\d\d m\.$/)
  expect(last[0]).toMatch(/^Iteration .* with 23 loop edges\. The best of 16 universes/)
  for (const [, position] of told) {
    const [step, of] = position.split('/').map(Number)
    expect(step, position).toBe(of)
    expect(step, position).toBeGreaterThan(0)
  }
  const other = await open(await context.newPage(), 'step=60&odometry=0.6')
  expect([await other.readouts(), await other.picture()]).toEqual([await figure.readouts(), pictures[1]])
  expect(pictures[0]).not.toBe(pictures[1])
})

test('a link reopens the same numbers', breadth, async ({ page }) => {
  const query = 'repair=switchable&wrong=on&odometry=1&seed=3&start=matches&step=60'
  const before = await (await open(page, query)).readouts()
  await page.goto('about:blank')
  expect(await (await open(page, query)).readouts()).toEqual(before)
})

test('exercise 8: a guess is dragged and moved by keys, nothing tells the answer before, and a repair that lets the false edge go is another question', async ({ page }) => {
  const figure = await open(page, 'wrong=on&predict=on')
  await expect(figure.play).toBeHidden()
  await expect(figure.sentence).toContainText('How far off will the path be at the last iteration?')
  expect(await figure.number('rms')).toBe(await figure.number('rms_start'))
  await expect(figure.toggle('run')).toHaveText('Show me')
  await drag(page, figure, 'guess', [0, 14])
  const dragged = Number(await figure.box('guess').inputValue())
  expect(dragged).toBeLessThan(0.6)
  await figure.grasp('guess').focus()
  await page.keyboard.press('ArrowUp')
  await figure.settled()
  const guess = Number(await figure.box('guess').inputValue())
  expect(guess).toBeGreaterThan(dragged)
  await expect(figure.toggle('run')).toHaveText('Solve the graph')
  await figure.toggle('run').click()
  await figure.settled()
  await expect(figure.sentence).toContainText(`The path ends 3.15 m off; the guess was ${guess} m`)
  expect(await figure.number('rms')).toBeCloseTo(3.15, 2)
  // Another judge is another question, which may be waived.
  await figure.element.evaluate(element => element.setAttribute('repair', 'mixture'))
  await figure.settled()
  await expect(figure.box('guess')).toHaveValue('')
  await figure.toggle('run').click()
  await figure.settled()
  expect(await figure.number('rms')).toBeGreaterThan(0.1)
  expect(await figure.number('rms')).toBeLessThan(0.25)
  expect((await figure.readouts())['wrong_weight']).toContain('< 0.1')
  await expect(figure.sentence).toContainText('no guess was made')
})
