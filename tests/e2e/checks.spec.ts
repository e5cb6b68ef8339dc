// Questions at the ends of sections: fetched when they are unfolded, graded at once with the reason, kept on this device, worked by keyboard;
// without script the answers unfold on their own page.
import type { Page } from '@playwright/test'
import { brokenRules } from './axe'
import { expect, test } from './fixtures'
import { breadth } from './host'
import { settled } from './figure'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

const fold = (page: Page, name: string) => page.locator(`details.elsewhere:has(a[href="practice.html#check-${name}"]), details.elsewhere:has([id^="check-${name}-"])`)

/** Unfolds the questions of a section by keyboard. */
async function unfold(page: Page, name: string): Promise<void> {
  const summary = fold(page, name).locator('> summary')
  await summary.focus()
  await page.keyboard.press('Enter')
  await expect(fold(page, name).locator('.check')).toHaveCount(2)
}

test('questions unfold where they belong, are graded at once with the reason, kept on this device and forgotten', async ({ page }) => {
  await page.goto('./')
  const asked: string[] = []
  page.on('request', request => asked.push(new URL(request.url()).pathname))
  await unfold(page, 'opening')
  expect(asked.filter(path => path.endsWith('practice.html'))).toHaveLength(1)

  // One of several answers, by keyboard.
  const walls = page.locator('#check-opening-walls')
  const radios = walls.getByRole('radio')
  await radios.first().focus()
  await page.keyboard.press('Space')
  await expect(walls.getByRole('status')).toHaveText(/^A: no\. This filter never moves a wall/)
  await page.keyboard.press('ArrowDown')
  await page.keyboard.press('ArrowDown')
  await expect(walls.getByRole('status')).toHaveText(/^C: yes\. A universe that did not fit/)
  await expect(walls).toHaveAttribute('data-grade', 'right')
  await expect(walls.locator('.answer .fold')).toBeHidden()

  // A number within its tolerance, however it is written.
  const halves = page.locator('#check-opening-halves')
  const field = halves.getByRole('textbox', { name: 'Your answer' })
  for (const [answer, said] of [['5000', /^5000 is too low\.$/], ['20480', /^20480 is too high\.$/], ['many', /^Write a number/], ['20 480/2', /^Yes\. 10.240\. Each of the ten axes/]] as const) {
    await field.fill(answer)
    await field.press('Enter')
    await expect(halves.getByRole('status')).toHaveText(said)
  }
  expect(await brokenRules(page, { of: 'details.elsewhere[open]' })).toEqual([])

  await page.reload()
  await unfold(page, 'opening')
  await expect(walls.getByRole('status')).toHaveText(/^C: yes\./)
  await expect(radios.nth(2)).toBeChecked()
  await expect(field).toHaveValue('20 480/2')
  await halves.getByRole('button', { name: 'Forget my answer' }).click()
  await expect(field).toHaveValue('')
  await expect(field).toBeFocused()

  // The page of questions has what is left.
  await page.goto('./practice.html#check-opening')
  await expect(walls.getByRole('status')).toHaveText(/^C: yes\./)
  await expect(halves.getByRole('status')).toBeHidden()
})

test('a state to reach is graded by the figure, a recap and short exercises unfold, and links within them are links of this page', async ({ page }) => {
  await page.goto('./')
  await unfold(page, 'by-hand')
  const ten = page.locator('#check-by-hand-ten')
  await expect(ten.getByRole('status')).toBeHidden()
  await ten.getByRole('link', { name: 'Set the figure up for it' }).click()
  const figure = page.locator('figure > fastslam-worked-example')
  await expect(figure).toBeInViewport()
  await expect(figure.locator('.stage.live')).toBeVisible()
  await settled(figure)
  await expect(ten.getByRole('status')).toBeHidden()
  await figure.getByRole('button', { name: 'Lab' }).click()
  const far = figure.locator('input[name=phi2]').first()
  await far.fill('0.3')
  await far.press('Enter')
  await expect(ten.getByRole('status')).toHaveText(/^Done\. The squared distance/)
  await page.reload()
  await unfold(page, 'by-hand')
  await expect(ten.getByRole('status')).toHaveText(/^Done\./)

  for (const [id, words] of [['recap-kalman', 'The gain'], ['short', 'Does a filter that resamples below']] as const) {
    const recap = page.locator(`details.elsewhere:has(a[href="practice.html#${id}"])`)
    await recap.locator('> summary').click()
    await expect(page.getByText(words).first()).toBeVisible()
  }
  expect(await page.locator('details.elsewhere a[href*="index.html#"]').count()).toBe(0)
})

test('a solution unfolds below its exercise, and links lead to what is in it here from then on', async ({ page }) => {
  await page.goto('./')
  const solution = page.locator('#ex-depletion .solution')
  const link = page.locator('#fig-universes figcaption a[href$="#eq-depletion"]')
  await expect(link).toHaveAttribute('href', 'solutions.html#eq-depletion')
  await solution.locator('summary').click()
  await expect(solution.locator('#eq-depletion math')).toBeVisible()
  await expect(link).toHaveAttribute('href', '#eq-depletion')
  // From it to another solution, which is not here, and to the text, which is.
  await expect(solution.locator('a[href="#ex-variance"]').first()).toBeVisible()
  for (const href of await solution.locator('a').evaluateAll(links => links.map(link => link.getAttribute('href')!))) {
    if (href.startsWith('#') && !href.includes('?')) expect(await page.locator(`[id="${href.slice(1)}"]`).count(), href).toBe(1)
    else expect(href).toMatch(/^solutions\.html#|^#fastslam|^https:/)
  }
  await page.goto('./solutions.html#eq-depletion')
  await expect(page.locator('#eq-depletion')).toBeInViewport()
})

test('an old link to a place that is in a solution now unfolds it and goes there, on arrival and on the page', async ({ page }) => {
  await page.goto('./#eq-depletion')
  await expect(page.locator('#ex-depletion #eq-depletion')).toBeInViewport()
  await page.evaluate(() => void (location.hash = '#tab-doors'))
  await expect(page.locator('.solution[open] #tab-doors')).toBeInViewport()
  // Of a place that is nowhere nothing unfolds.
  await page.goto('./?again#nowhere')
  await page.waitForLoadState('networkidle')
  expect(await page.locator('details.elsewhere[open]').count()).toBe(0)
})

test('the picture of a real robot is fetched by who unfolds it, and goes to paper with the rest', async ({ page }) => {
  const fetched: string[] = []
  page.on('request', request => /\/intel-[^/]*\.png$/.test(request.url()) && fetched.push(request.url()))
  await page.goto('./#real-robot')
  const fold = page.locator('details:has(> .fold > #fig-intel)')
  await expect(fold.locator('> summary')).toBeInViewport()
  await page.waitForLoadState('networkidle')
  expect(fetched).toEqual([])
  await fold.locator('> summary').click()
  const picture = fold.locator('img')
  await picture.scrollIntoViewIfNeeded()
  await expect.poll(() => picture.evaluate(img => (img as HTMLImageElement).naturalWidth)).toBe(1160)
  expect((await picture.boundingBox())!.width).toBeLessThanOrEqual(page.viewportSize()!.width)
  await page.emulateMedia({ media: 'print' })
  await expect(picture).toBeVisible()
})

test('where the questions cannot be fetched, a link leads to their page, and another try may find them', async ({ page, complaints }) => {
  await page.goto('./')
  await page.route('**/practice.html', route => route.abort())
  const summary = fold(page, 'weight').locator('> summary')
  await summary.click()
  await expect(fold(page, 'weight').getByRole('link')).toBeVisible()
  await page.unroute('**/practice.html')
  await summary.click()
  await summary.click()
  await expect(fold(page, 'weight').locator('.check')).toHaveCount(2)
  complaints.splice(0, Infinity, ...complaints.filter(line => !/ERR_FAILED/.test(line)))
})

test('the key for printing has all of them on paper, with their answers', async ({ page }) => {
  await page.addInitScript(() => {
    self.print = () => void (document.body.dataset['printed'] = String(document.querySelectorAll('.check').length))
    // The figures have their own tests.
    const leave = () => document.querySelectorAll('main figure > *, .trial > *').forEach(element => element.localName.startsWith('fastslam-') && element.remove())
    document.addEventListener('readystatechange', leave, { once: true })
  })
  await page.goto('./')
  await expect(page.locator('main')).toBeVisible()
  await page.keyboard.press('Control+p')
  await expect(page.locator('body')).toHaveAttribute('data-printed', /^3\d$/)
  expect(await page.locator('details.elsewhere > .fold > p:only-child > a:only-child').count(), 'folds that are links still').toBe(0)
  await page.emulateMedia({ media: 'print' })
  await expect(page.locator('#check-verdict-why .answer .fold')).toBeVisible()
  await expect(page.locator('#check-verdict-why input').first()).toBeHidden()
})

for (const [name, least, more] of [['practice', 30, breadth], ['bank', 40, {}]] as const) {
  test(`each question of ${name} has one right answer, which its answer gives, and says another reason to each other one`, async ({ page }) => {
    await page.goto(`./${name}.html`)
    await expect(page.locator('.check [role=status]')).toHaveCount(await page.locator('.check').count())
    const said = await page.evaluate(() => {
      const answer = (question: HTMLElement, act: () => void) => {
        act()
        return { grade: question.dataset['grade'], text: question.querySelector('[role=status]')!.textContent!.trim() }
      }
      return [...document.querySelectorAll<HTMLElement>('.check')].map(question => {
        const [radios, field] = [[...question.querySelectorAll<HTMLInputElement>('[type=radio]')], question.querySelector<HTMLInputElement>('[type=text]')]
        const write = (value: number) => () => (Object.assign(field!, { value: String(value) }), field!.dispatchEvent(new Event('change')))
        const is = Number(question.dataset['is'])
        // As the answer prints it, and far from it.
        const printed = Number.parseFloat((question.querySelector('.answer b')?.textContent ?? '').replace(/\s/g, ''))
        const answers = field ? [write(printed), write(2 * is), write(is / 2)].map(act => answer(question, act)) : radios.map(radio => answer(question, () => radio.click()))
        return { id: question.id, answers }
      })
    })
    expect(said.length).toBeGreaterThanOrEqual(least)
    for (const { id, answers } of said.filter(({ answers }) => answers.length > 0)) {
      expect(answers.filter(({ grade }) => grade === 'right'), id).toHaveLength(1)
      expect(new Set(answers.map(({ text }) => text)).size, id).toBe(answers.length)
      for (const { text } of answers) expect(text.length, id).toBeGreaterThan(8)
    }
  })

  test(`axe finds nothing in the questions of ${name}, answered and unfolded, light and dark`, more, async ({ page }) => {
    await page.goto(`./${name}.html`)
    for (const radio of await page.locator('.check label:first-of-type input[type=radio]').all()) await radio.check()
    await page.evaluate(() => document.querySelectorAll('details').forEach(details => (details.open = true)))
    for (const colorScheme of ['light', 'dark'] as const) {
      await page.emulateMedia({ colorScheme })
      expect(await brokenRules(page)).toEqual([])
    }
    await page.setViewportSize({ width: 320, height: 700 })
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(320)
  })
}

test.describe('without JavaScript', () => {
  test.use({ javaScriptEnabled: false })

  test('a fold of the chapter leads to the solution on its page', async ({ page }) => {
    await page.goto('./')
    const solution = page.locator('#ex-prove .solution')
    await solution.locator('summary').click()
    await solution.getByRole('link').click()
    await expect(page.locator('#solution-ex-prove')).toBeInViewport()
  })

  test('a fold of the chapter leads to the questions, whose answers unfold', async ({ page }) => {
    await page.goto('./')
    const summary = fold(page, 'opening').locator('> summary')
    await summary.click()
    await fold(page, 'opening').getByRole('link').click()
    const walls = page.locator('#check-opening-walls')
    await expect(walls.locator('legend')).toBeInViewport()
    await expect(walls.locator('.answer .fold')).toBeHidden()
    await walls.locator('.answer summary').click()
    await expect(walls.getByText('C: yes.')).toBeVisible()
  })
})
