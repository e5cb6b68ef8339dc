// First sight: what a figure opens with is its picture and a few things to operate; all else is in its Lab.
import type { Page } from '@playwright/test'
import { programs } from '../../scripts/registry.mjs'
import { Figure, settled } from './figure'
import { expect, test } from './fixtures'
import { openCourse } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

/** Things to operate that no figure shows more of at first: playback, chips, menu and what is dragged in the picture count as one each, a slider
 * with its box as one. */
const MOST = 10

/** A figure as readers find it, its Lab closed. */
async function asFound(page: Page, markup: string, tag: string): Promise<Figure> {
  await openCourse(page, markup)
  const figure = new Figure(page, tag)
  await expect(figure.element.locator('.stage.live')).toBeVisible()
  await figure.settled()
  return figure
}

test('a figure opens with ten things to operate at most', async ({ page }) => {
  const tags = [...programs.keys()]
  await openCourse(page, tags.map(tag => `<${tag}></${tag}>`).join(''))
  for (const tag of tags) {
    const element = page.locator(tag)
    await element.scrollIntoViewIfNeeded()
    if (tag !== 'fastslam-log') {
      await expect(element.locator('.stage.live')).toBeVisible()
      await settled(element)
    }
    const things = await element.evaluate(element => {
      const all = [...element.shadowRoot!.querySelectorAll<HTMLElement>('button, input, select, summary')]
      const shown = all.filter(one => one.checkVisibility({ visibilityProperty: true }) && one.getBoundingClientRect().width > 1)
      const thing = (one: HTMLElement) => one.closest('.transport, .chips, .menu, .handles, .slider, .choice, .flag, .number, .toggle, .saves') ?? one
      return [...new Set(shown.map(thing))].map(one => one.className || one.textContent)
    })
    expect(things.length, `${tag}: ${things.join(', ')}`).toBeLessThanOrEqual(MOST)
    expect(things.filter(thing => thing === 'lab'), tag).toHaveLength(1)
  }
})

test('the Lab opens on all else and closes on it, by mouse and by keyboard, and stays open in another language', async ({ page }) => {
  const figure = await asFound(page, '<fastslam-resampling></fastslam-resampling>', 'fastslam-resampling')
  const lab = figure.button('Lab')
  const hidden = [figure.seed, figure.reset, figure.box('odometry'), figure.element.locator('summary', { hasText: 'Numbers' }), figure.element.getByLabel('Speed')]
  for (const control of hidden) await expect(control).toBeHidden()
  await expect(figure.box('threshold')).toBeVisible()
  await expect(lab).toHaveAttribute('aria-expanded', 'false')
  await lab.click()
  await expect(lab).toHaveAttribute('aria-expanded', 'true')
  for (const control of hidden) await expect(control).toBeVisible()
  await figure.element.evaluate(element => element.setAttribute('lang', 'de'))
  await expect(figure.button('Labor')).toHaveAttribute('aria-expanded', 'true')
  await expect(figure.element.getByRole('spinbutton', { name: 'Startwert' })).toBeVisible()
  await figure.button('Labor').press('Enter')
  await expect(figure.button('Labor')).toHaveAttribute('aria-expanded', 'false')
  await expect(figure.element.getByRole('spinbutton', { name: 'Startwert' })).toBeHidden()
})

test('a link and a copied code have an open Lab, and an author may open it', async ({ page }) => {
  const figure = await asFound(page, '<fastslam-proposal></fastslam-proposal>', 'fastslam-proposal')
  const link = () => figure.element.evaluate(element => (element as HTMLElement & { link: string }).link)
  const code = () => figure.element.evaluate(element => (element as HTMLElement & { embedCode(name: string): string }).embedCode('element'))
  expect(await link()).not.toContain('lab')
  await figure.button('Lab').click()
  expect(await link()).toMatch(/\?.*&lab=open$/)
  expect(await code()).toContain('lab="open"')
  const address = await link()
  await figure.button('Lab').click()
  expect(await code()).not.toContain('lab')
  await page.evaluate(address => (location.href = address), address)
  await expect(figure.seed).toBeVisible()
  expect(await figure.state(), 'of the state it is no part').not.toContain('lab')
  await figure.element.evaluate(element => element.setAttribute('lab', 'closed'))
  await expect(figure.seed).toBeHidden()
  await figure.element.evaluate(element => element.setAttribute('lab', 'open'))
  await expect(figure.seed).toBeVisible()
})

test('what a challenge leaves to the reader comes into sight with it, and what a prediction asks for as well', async ({ page }) => {
  const lap = await asFound(page, '<fastslam-lap></fastslam-lap>', 'fastslam-lap')
  const proposal = lap.element.locator('select[name=proposal]')
  await expect(proposal).toBeHidden()
  expect(await lap.element.evaluate(element => (element as HTMLElement & { challenge(name: string): Promise<boolean> }).challenge('four'))).toBe(true)
  await expect(proposal).toBeVisible()
  await lap.element.evaluate(element => ((element as HTMLElement & { state: string }).state = ''))
  await expect(proposal).toBeHidden()

  const joint = await asFound(page, '<fastslam-joint></fastslam-joint>', 'fastslam-joint')
  await expect(joint.box('guess')).toBeHidden()
  await joint.toggle('predict').click()
  await expect(joint.box('guess')).toBeVisible()
  await expect(joint.toggle('run')).toBeVisible()
  await joint.toggle('predict').click()
  await expect(joint.box('guess')).toBeHidden()
})

test('where an author offers no controls, the picture has their column, and where one is offered it stands there', async ({ page }) => {
  for (const tag of ['fastslam-proposal', 'fastslam-em', 'fastslam-worked-example']) {
    const figure = await asFound(page, `<div style="width: 1000px"><${tag} controls="none"></${tag}></div>`, tag)
    const width = () => figure.canvas.evaluate(canvas => canvas.closest<HTMLElement>('.stage')!.offsetWidth)
    expect(await width(), tag).toBeGreaterThan(940)
    // Nothing comes up over the picture, so that all of it is seen.
    expect(await figure.canvas.evaluate(canvas => canvas.closest<HTMLElement>('.stage')!.style.clipPath), tag).toBe('')
    await figure.element.evaluate((element, one) => element.setAttribute('controls', one), tag.endsWith('example') ? 'r1' : 'odometry')
    await expect.poll(width, tag).toBeLessThan(830)
  }
})
