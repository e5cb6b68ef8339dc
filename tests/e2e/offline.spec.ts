// The files for offline use, opened as a double click does; and the SCORM packages in a run-time that learning systems are built on.
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import { pathToFileURL } from 'node:url'
import type { Page } from '@playwright/test'
import { unzipSync } from 'fflate'
import { root } from '../../scripts/lib.mjs'
import { offline, writeOffline } from '../../scripts/offline.mjs'
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { breadth, breadthOf, FIGURES, programsMade } from './host'
import { forgiveSystem, LearningSystem } from './learning-system'
import { LogFigure } from './log-figure'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

// One worker, as what comes first is written once.
test.describe.configure({ mode: 'default' })

test.beforeAll(async () => {
  // Every figure's file and package are made, which takes a minute where the machine has other things to do.
  test.setTimeout(240_000)
  await writeOffline()
})

for (const name of FIGURES) {
  test(`the file of ${name} lives from file:// and asks for nothing`, breadthOf(name), async ({ page, context }) => {
    const path = join(offline, `fastslam-${name}.html`)
    const asked: string[] = []
    context.on('request', request => !/^(data|blob):/.test(request.url()) && asked.push(request.url()))
    const figure = new Figure(page, `fastslam-${name}`)
    const address = pathToFileURL(path).href
    await figure.open(address)
    await figure.reset.click()
    await figure.settled()
    await expect(figure.alert).toBeEmpty()
    expect(asked).toEqual([address])
    // There is no site to link frames to; the rest of the menu is there.
    await figure.element.locator('button[aria-label=Menu]').click()
    await expect(figure.element.getByRole('menuitem', { name: 'Copy code: Python' })).toBeVisible()
    await expect(figure.element.getByRole('menuitem', { name: 'Copy code: iframe' })).toHaveCount(0)
  })
}

test('a count in the background runs from file:// too', async ({ page }) => {
  const figure = await new Figure(page, 'fastslam-resampling').open(pathToFileURL(join(offline, 'fastslam-resampling.html')).href)
  await figure.openCount()
  await figure.element.getByRole('button', { name: /Count over/ }).click()
  await expect(figure.element.getByRole('progressbar')).toHaveAttribute('value', /[1-9]/, { timeout: 30_000 })
})

test('the laps behind a chart are run again from file:// too', programsMade, async ({ page }) => {
  const figure = await new Figure(page, 'fastslam-universes').open(pathToFileURL(join(offline, 'fastslam-universes.html')).href)
  await figure.openCount()
  await figure.element.getByRole('button', { name: 'Run 200 laps' }).click()
  await expect(figure.element.getByRole('progressbar')).toHaveAttribute('value', /[1-9]/, { timeout: 30_000 })
})

test('the example is mapped from file:// too', async ({ page, context }) => {
  const path = join(offline, 'fastslam-log.html')
  const asked: string[] = []
  context.on('request', request => !/^(data|blob):/.test(request.url()) && asked.push(request.url()))
  const address = pathToFileURL(path).href
  await page.goto(address)
  const figure = page.locator('fastslam-log')
  await figure.getByRole('button', { name: 'Map this building' }).click()
  await expect(figure.locator('[part=transport] .position')).toHaveText(/^[1-9]\d+ /)
  expect(asked).toEqual([address])
})

test('files of other programs are read and written from file:// too', async ({ page, context }) => {
  const path = join(offline, 'fastslam-log.html')
  const asked: string[] = []
  context.on('request', request => !/^(data|blob):/.test(request.url()) && asked.push(request.url()))
  const address = pathToFileURL(path).href
  await page.goto(address)
  const log = await new LogFigure(page).begin()
  await log.set('universes', '3')
  const bags = join(root, 'tests', 'bags')
  await log.choose('odometry-zstd.mcap', readFileSync(join(bags, 'odometry-zstd.mcap')))
  await expect(log.sentence).toContainText('30 scans')
  await log.button('Map this building').click()
  await log.done()
  await log.unfold('saves')
  const saved = async (button: string) => {
    const [download] = await Promise.all([page.waitForEvent('download'), log.button(button).click()])
    return readFileSync(await download.path())
  }
  expect((await saved('Path for ROS 2 (MCAP)')).equals(readFileSync(join(bags, 'lap-path.mcap'))), 'as the command saves it').toBe(true)
  expect((await saved('Path (TUM)')).toString()).toMatch(/^([\d.-]+ ){7}[\d.-]+\n/m)
  const lines = [1, 2].map(time => JSON.stringify({ time, angle_min: -1, angle_increment: 0.5, ranges: [1, 2, null, 2, 1] }))
  await log.choose('log.jsonl', lines.join('\n'))
  await expect(log.sentence).toContainText('2 scans of up to 5 beams')
  expect(asked).toEqual([address])
})

test('the whole chapter lives from one file', breadth, async ({ page, context }) => {
  const asked: string[] = []
  context.on('request', request => !/^(data|blob):/.test(request.url()) && asked.push(request.url()))
  const address = pathToFileURL(join(offline, 'chapter.html')).href
  const lap = await new Figure(page, 'fastslam-lap').open(address)
  const before = await lap.position()
  await lap.step.click()
  await lap.settled()
  expect(await lap.position()).toBe(before + 1)
  // What unfolds from another page is in it.
  const walls = page.locator('#check-opening-walls')
  await page.locator('details.elsewhere', { has: walls }).locator('> summary').click()
  await walls.getByRole('radio').last().check()
  await expect(walls.getByRole('status')).toHaveText(/^C: yes/)
  expect(asked).toEqual([address])
})

/** The package of a figure, whole, in a learning system. */
function systemOf(page: Page, name: string): LearningSystem {
  const files = unzipSync(readFileSync(join(offline, `fastslam-${name}-scorm.zip`)))
  expect(Object.keys(files).sort()).toEqual(['imsmanifest.xml', 'index.html', 'licences.txt', 'sbom.cdx.json', 'scorm.js'])
  return new LearningSystem(page, `fastslam-${name}`, files)
}

const STATUS = 'cmi.core.lesson_status'

test('a learning system that speaks SCORM 1.2 keeps the state and gives it back at the next visit', async ({ page, complaints }) => {
  const system = systemOf(page, 'lap')
  const first = await system.visit()
  await first.openSettings()
  await first.box('universes').fill('6')
  await first.box('universes').press('Enter')
  const step = (await first.position()) + 3
  for (let i = 0; i < 3; i++) await first.step.click()
  await expect.poll(() => page.evaluate(() => sessionStorage['kept'] ?? ''), { timeout: 10_000 }).toContain(`universes=6&step=${step}`)
  await system.leave()
  expect(await system.told('cmi.core.session_time')).toMatch(/^0000:\d\d:\d\d$/)
  expect(await system.told('cmi.core.exit'), 'the next visit is told to begin with what was kept').toBe('suspend')
  const second = await system.visit()
  await expect.poll(() => second.position()).toBe(step)
  await expect(second.box('universes')).toHaveValue('6')
  system.close()
  forgiveSystem(complaints)
})

test('in a learning system, what merely played completes nothing, and the last step reached by hand does', async ({ browser }) => {
  const page = await (await browser.newContext({ reducedMotion: 'no-preference' })).newPage()
  const system = systemOf(page, 'lap')
  const first = await system.visit()
  // It begins by itself: nobody touches it.
  await expect.poll(() => first.position()).toBeGreaterThan(1)
  await system.leave()
  expect(await system.told('cmi.suspend_data')).toMatch(/step=\d/)
  expect(await system.told(STATUS)).toBe('incomplete')

  const second = await system.visit()
  const ring = await second.last()
  await second.element.evaluate((element: HTMLElement & { state: string }) => (element.state = 'course=apartment&universes=2'))
  // Another course has another last step: it has begun.
  await expect.poll(() => second.last()).not.toBe(ring)
  const last = await second.last()
  await second.element.evaluate((element: HTMLElement & { seek(step: number): void }, step) => element.seek(step), last - 2)
  await second.play.click()
  await expect.poll(() => second.position()).toBe(last)
  await expect(second.play).toBeVisible()
  await second.element.locator('input[name=raw]').click()
  await expect.poll(() => page.evaluate(() => sessionStorage['told'] ?? '')).toContain('raw=')
  await system.leave()
  expect(await system.told('cmi.suspend_data')).toContain(`step=${last}`)
  expect(await system.told(STATUS), 'played to the end').toBe('incomplete')

  const third = await system.visit()
  await expect.poll(() => third.position()).toBe(last)
  await third.stepBack.click()
  await expect.poll(() => third.position()).toBe(last - 1)
  expect(await system.told(STATUS), 'opened at the end, and a step back').toBe('incomplete')
  await third.step.click()
  await expect.poll(() => system.told(STATUS)).toBe('completed')
  await system.leave()

  await system.visit()
  await system.leave()
  expect(await system.told(STATUS), 'what is completed stays so').toBe('completed')
  system.close()
  await page.context().close()
})

test('in a learning system, a prediction completes what has no steps, once it was placed and run; it is an interaction, which is not told again', async ({ page, complaints }) => {
  const system = systemOf(page, 'proposal')
  const figure = await system.visit()
  await figure.reroll.click()
  await figure.reset.click()
  await figure.toggle('predict').click()
  await expect(figure.toggle('predict')).toHaveAttribute('aria-pressed', 'true')
  await figure.grasp('guess').focus()
  await figure.grasp('guess').press('ArrowUp')
  await expect.poll(() => system.told('cmi.suspend_data')).toContain('guess=')
  expect(await system.told(STATUS), 'placed, and not yet run').toBe('incomplete')
  await figure.box('guess').fill('6')
  await figure.box('guess').press('Enter')
  await figure.settled()
  expect(await system.told('cmi.interactions.0.id')).toBeUndefined()
  await figure.toggle('run').click()
  await expect.poll(() => system.told(STATUS)).toBe('completed')
  const said = async (n: number) => Object.fromEntries(await Promise.all(['id', 'type', 'student_response', 'correct_responses.0.pattern', 'result', 'time'].map(async what => [what, await system.told(`cmi.interactions.${n}.${what}`)])))
  await expect.poll(() => system.told('cmi.interactions.0.result')).toBe('correct') // within a tenth
  expect(await said(0)).toMatchObject({ id: 'ratio_half', type: 'numeric', student_response: '6', 'correct_responses.0.pattern': expect.stringMatching(/^6\.\d+$/), time: expect.stringMatching(/^\d\d:\d\d:\d\d$/) })
  await figure.reroll.click()
  await figure.settled()
  await figure.toggle('run').click() // without a guess
  await expect.poll(() => system.told('cmi.interactions.1.result')).toBe('neutral')
  expect((await said(1))['id'], 'the result was known by then').toBe('ratio_half.try_2.after_the_answer')
  expect((await said(1))['student_response']).toBeUndefined()
  await expect.poll(() => system.told('cmi.suspend_data')).toContain('run=on')
  await system.leave()
  const again = await system.visit()
  await expect(again.toggle('run')).toHaveAttribute('aria-pressed', 'true')
  await again.settled()
  expect(await system.told('cmi.interactions.2.id')).toBeUndefined()
  await system.leave()
  system.close()
  forgiveSystem(complaints)
})
