// Predictions: what is hidden until a guess is placed or waived, what stands beside it then, and what is kept of it.
import { readFile } from 'node:fs/promises'
import type { Locator, Page } from '@playwright/test'
import { expect, test } from './fixtures'
import { Figure, frames } from './figure'
import { breadthOf } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

const proposal = (page: Page, query: string) => new Figure(page, 'fastslam-proposal').alone(`#fastslam-proposal?v=3&${query}`)
const resampling = (page: Page, query: string) => new Figure(page, 'fastslam-resampling').alone(`#fastslam-resampling?v=4&${query}`)

interface Guess {
  name: string
  guess: number | null
  result: number | null
  waived: boolean
}

/** What the figure tells of predictions from now on. */
async function guesses(figure: Figure): Promise<() => Promise<Guess[]>> {
  await figure.element.evaluate(element => {
    const told: unknown[] = ((element as HTMLElement & { told?: unknown[] }).told = [])
    element.addEventListener('fastslam-guess', event => told.push((event as CustomEvent).detail))
  })
  return () => figure.element.evaluate(element => (element as HTMLElement & { told: Guess[] }).told)
}

async function middle(handle: Locator): Promise<{ x: number; y: number }> {
  await handle.scrollIntoViewIfNeeded()
  const box = (await handle.boundingBox())!
  return { x: box.x + box.width / 2, y: box.y + box.height / 2 }
}

test('without a guess nothing is run, unless the reader says so', async ({ page }) => {
  const figure = await proposal(page, '')
  const told = await guesses(figure)
  await expect(figure.toggle('run'), 'where nobody was asked, there is nothing to run').toBeHidden()
  await figure.toggle('predict').click()
  await figure.settled()
  // It asks, instead of answering.
  await expect(figure.toggle('predict')).toHaveAttribute('aria-pressed', 'true')
  await expect(figure.toggle('run')).toHaveAttribute('aria-pressed', 'false')
  await expect(figure.sentence).toContainText('There is no guess yet')
  expect(await told()).toEqual([])
  await expect(figure.toggle('run')).toHaveText('Show me')
  await figure.toggle('run').click()
  await figure.settled()
  await expect(figure.sentence).toContainText('no guess was made')
  const [guess] = await told()
  expect(guess).toMatchObject({ name: 'ratio_half', guess: null, waived: true })
  expect(guess!.result).toBeGreaterThan(1)
})

test('a guess is dragged by the mouse and moved by keys; then the samples move, guess and result stand side by side, and a link brings both to another reader', async ({ page, context }) => {
  const figure = await proposal(page, '')
  const told = await guesses(figure)
  await expect(figure.handle('guess')).toHaveCount(0)
  await figure.toggle('predict').click()
  await figure.settled()
  const asked = await figure.picture()
  const { x, y } = await middle(figure.handle('guess'))
  await page.mouse.move(x, y)
  await page.mouse.down()
  await page.mouse.move(x + 150, y, { steps: 6 })
  await page.mouse.up()
  await figure.settled()
  await expect(figure.sentence).toContainText('it has not been run')
  await figure.grasp('guess').focus()
  const dragged = Number(await figure.grasp('guess').inputValue())
  await page.keyboard.press('ArrowRight')
  await figure.settled()
  expect(Number(await figure.grasp('guess').inputValue())).toBeCloseTo(dragged + 0.1, 5)
  await expect(figure.toggle('run')).toHaveText('Run at half σ')
  expect(await told()).toEqual([])
  const inside = (await figure.readouts())['inside_motion']
  await figure.toggle('run').click()
  await figure.settled()
  await expect(figure.toggle('run')).toHaveAttribute('aria-pressed', 'true')
  await expect(figure.sentence).toContainText('At half the range noise')
  expect(await figure.picture()).not.toBe(asked)
  expect((await figure.readouts())['inside_motion'], 'other samples').not.toBe(inside)
  await expect(figure.sentence).toContainText(/the guess was [\d.]+: \d+ % too (low|high)/)
  const [guess] = await told()
  expect(guess).toMatchObject({ name: 'ratio_half', waived: false, guess: Number(await figure.box('guess').inputValue()) })

  // Data has both.
  const [file] = await Promise.all([page.waitForEvent('download'), figure.menu('Save data (CSV)')])
  const lines = (await readFile(await file.path())).toString().trim().split('\n')
  expect(lines, 'a row for every sample').toHaveLength(1 + 1000)
  const [header, row] = lines.map(line => line.split(','))
  expect(header).toContain('motion_weight')
  expect(header!.slice(-3)).toEqual(['guess', 'waived', 'result'])
  expect(row!.slice(-3).map(Number)).toEqual([guess!.guess, 0, guess!.result])

  // The link brings guess and result to another reader, for whom another guess is another try.
  const link = await figure.element.evaluate(element => (element as HTMLElement & { link: string }).link)
  expect(link).toContain('predict=on')
  const other = await new Figure(await context.newPage(), 'fastslam-proposal').open(link)
  expect([await other.sentence.textContent(), await other.picture()]).toEqual([await figure.sentence.textContent(), await figure.picture()])
  await other.grasp('guess').press('ArrowLeft')
  await other.settled()
  await expect(other.toggle('run')).toHaveAttribute('aria-pressed', 'false')
  await expect(other.sentence).toContainText('it has not been run')

  // Other settings are another question.
  await figure.reroll.click()
  await figure.settled()
  await expect(figure.box('guess')).toHaveValue('')
  await expect(figure.toggle('run')).toHaveText('Show me')
  await expect(figure.sentence).toContainText('There is no guess yet')
  expect((await told()).length).toBe(1)
})

test('of a run nothing is shown before a guess, which keys place on the axis of time', async ({ page }) => {
  const figure = await resampling(page, 'step=40&policy=always')
  await figure.toggle('predict').click()
  await figure.settled()
  await expect(figure.handle('cursor')).toHaveCount(0)
  await expect(figure.sentence).toContainText('There is no guess yet')
  await expect(figure.sentence).toContainText('Step 0 of')
  const told = await guesses(figure)
  await figure.grasp('guess').focus()
  const from = Number(await figure.grasp('guess').inputValue())
  await page.keyboard.press('Shift+ArrowLeft')
  await page.keyboard.press('ArrowLeft')
  await figure.settled()
  expect(Number(await figure.grasp('guess').inputValue())).toBe(from - 11)
  await figure.toggle('run').click()
  await figure.settled()
  await expect(figure.sentence).toContainText(/^One ancestor is left from step \d+ on; the guess was \d+/)
  expect(await figure.position()).toBe(await figure.last())
  expect(await told()).toMatchObject([{ name: 'one_left', guess: from - 11, waived: false }])
})

test.describe('on a phone', () => {
  test.use({ viewport: { width: 380, height: 760 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 })

  for (const [name, open] of [['proposal', proposal], ['resampling', resampling]] as const) {
    test(`a finger places a guess in ${name}`, breadthOf(name), async ({ page }) => {
      const figure = await open(page, 'predict=on')
      const { x, y } = await middle(figure.handle('guess'))
      const client = await page.context().newCDPSession(page)
      const touch = (type: 'touchStart' | 'touchMove' | 'touchEnd', ...touchPoints: { x: number; y: number }[]) =>
        client.send('Input.dispatchTouchEvent', { type, touchPoints })
      await touch('touchStart', { x, y })
      for (let i = 1; i <= 8; i++) await touch('touchMove', { x: x + 6 * i, y })
      await touch('touchEnd')
      await figure.settled()
      expect(Number(await figure.box('guess').inputValue())).toBeGreaterThan(1)
      // Right behind touches of another kind Chromium now and then loses an emulated tap, and a reader taps again; but not while the figure
      // is still running what the first tap asked for, which a second one would take back, and the guess with it.
      const run = figure.toggle('run')
      await expect(async () => {
        if ((await run.getAttribute('aria-pressed')) !== 'true') await run.tap()
        await frames(page, 5)
        await figure.settled()
        expect(await run.getAttribute('aria-pressed')).toBe('true')
      }).toPass()
      await figure.settled()
      await expect(figure.sentence).toContainText('the guess was')
    })
  }
})

/** The chapter without the figures of its text, taken out before its modules run: asked about are the small ones of the exercises. */
async function openExercises(page: Page): Promise<void> {
  await page.addInitScript(() => {
    const leave = () => document.querySelectorAll('main figure > *').forEach(element => element.localName.startsWith('fastslam-') && element.remove())
    document.addEventListener('readystatechange', leave, { once: true })
  })
  await page.goto('./')
}

test('a guess of an exercise is compared with the figure beside it, kept on this device, and forgotten', async ({ page }) => {
  const question = page.locator('#guess-ratio')
  await openExercises(page)
  await question.scrollIntoViewIfNeeded()
  await expect(question.locator('.trial canvas')).toBeVisible()
  await expect(question.locator('.told')).toBeHidden()
  await question.getByRole('textbox').fill('3')
  await question.getByRole('textbox').press('Enter')
  const told = question.getByRole('status').first()
  await expect(told).toHaveText(/^You guessed 3, the figure says [\d.]+: \d+ % too low\.$/)
  const said = (await told.textContent())!
  const shown = await question.locator('fastslam-proposal').evaluate(element => (element as HTMLElement & { state: string }).state)
  expect(shown).toContain('guess=3&run=on')

  // The figure that comes to life beside it has not been asked yet, and takes nothing away.
  await page.reload()
  await question.scrollIntoViewIfNeeded()
  await expect(question.locator('.trial canvas')).toBeVisible()
  await expect(question.getByRole('textbox')).toHaveValue('3')
  await expect(told).toHaveText(said)
  await expect(question.locator('.fold')).toBeVisible()
  await question.getByRole('button', { name: 'Forget my guess' }).click()
  await expect(question.getByRole('textbox')).toHaveValue('')
  await expect(question.locator('.fold')).toBeHidden()
  await page.reload()
  await expect(question.getByRole('textbox')).toHaveValue('')
})

test('a guess that is placed in the figure of an exercise is in its box too, and goes when settings change', async ({ page }) => {
  await openExercises(page)
  const question = page.locator('#guess-ancestor')
  await question.scrollIntoViewIfNeeded()
  const figure = question.locator('fastslam-resampling')
  await expect(figure.locator('canvas')).toBeVisible()
  await figure.locator('input[name=guess]').fill('30')
  await figure.locator('input[name=guess]').press('Enter')
  await figure.locator('button[name=run]').click()
  await expect(question.locator('> label input')).toHaveValue('30')
  await expect(question.locator('.told')).toContainText(/You guessed 30, the figure says \d+/)
  await figure.locator('input[name=particles][type=number]').fill('8')
  await figure.locator('input[name=particles][type=number]').press('Enter')
  await expect(question.locator('.told')).not.toContainText('the figure says')

  // Asked for in the text alone, and answered by a small copy of the figure.
  const universes = page.locator('#guess-universes')
  await universes.scrollIntoViewIfNeeded()
  await expect(universes.locator('.trial canvas')).toBeVisible()
  await universes.getByRole('textbox').fill('6')
  await universes.getByRole('textbox').press('Enter')
  await expect(universes.getByRole('status').first()).toHaveText('You guessed 6, the figure says 12: 50 % too low.')
  // Over how many samples its numbers are means, where the figure draws its own.
  await expect(page.locator('p', { hasText: 'FastSLAM 1.0 puts' })).toContainText(/the mean over 200.000 samples/)
})
