// A new lecturer's first hour, walked from the front page by what is to be seen there: she finds her pages, composes an assignment and packs it; two
// students play it in her learning system, one right and one wrong; she prints a handout and puts a quiz on a page of her own. How long each part takes
// is printed, for whoever wants to know, and asserted nowhere.
import { readFileSync } from 'node:fs'
import type { Page } from '@playwright/test'
import { unzipSync } from 'fflate'
import { expect, test } from './fixtures'
import { Figure, settled } from './figure'
import { breadth, forgiveHost, openHost } from './host'
import { forgiveSystem, LearningSystem } from './learning-system'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

const way = (page: Page, name: string) => page.getByRole('navigation', { name: 'Site' }).getByRole('link', { name, exact: true })

test('a new lecturer finds her pages, sets a task, gets it back with score and tries, prints a handout and has a quiz', breadth, async ({ page, context, baseURL, complaints }) => {
  test.slow()
  const part = async <T>(name: string, walk: () => Promise<T>): Promise<T> => {
    const begun = Date.now()
    const result = await test.step(name, walk)
    console.log(`walk: ${((Date.now() - begun) / 1000).toFixed(1).padStart(6)} s  ${name}`)
    return result
  }

  await part('from the front page to the page on embedding', async () => {
    await page.goto('./index.html')
    await way(page, 'For teachers').click()
    await expect(page.getByRole('heading', { level: 1 })).toContainText('For teachers')
    await page.locator('main').getByRole('link', { name: 'Figures for your own pages' }).click()
    await expect(page.getByRole('heading', { level: 1 })).toHaveText('Figures for your own pages')
  })

  const files = await part('an assignment, composed and packed', async () => {
    const form = page.getByRole('form', { name: 'Attributes' })
    await page.locator('#gallery').getByRole('button', { name: 'Two proposals' }).click()
    const figure = new Figure(page, '#preview fastslam-proposal')
    await figure.live()
    await page.getByRole('radio', { name: 'Assign' }).check()
    await form.getByLabel('Question').fill('Which filter keeps samples at both places?')
    await form.getByLabel('Asks for').selectOption('choice')
    await form.getByLabel('Answers').fill('FastSLAM 2.0\n* FastSLAM 1.0\nboth')
    await form.getByLabel('Tries').fill('2')
    await form.getByLabel('Hand it out as').selectOption('scorm')
    await form.getByLabel('Pass mark').fill('50')
    const [saved] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'Save: SCORM 1.2 package' }).click()])
    return unzipSync(readFileSync(await saved.path()))
  })

  const students: [name: string, choices: string[], status: string, score: string, results: string[]][] = [
    ['right', ['FastSLAM 1.0'], 'passed', '100', ['correct']],
    ['wrong', ['both', 'FastSLAM 2.0'], 'failed', '0', ['wrong', 'wrong']],
  ]
  for (const [name, choices, status, score, results] of students) {
    await part(`a student who is ${name}, and what the learning system has of it`, async () => {
      const student = await context.newPage()
      const system = new LearningSystem(student, 'fastslam-proposal', files)
      await system.visit()
      for (const choice of choices) {
        await system.frame.getByLabel(choice, { exact: true }).check()
        await system.frame.getByRole('button', { name: 'Hand in' }).click()
      }
      await expect.poll(() => system.told('cmi.core.lesson_status')).toBe(status)
      expect(await system.told('cmi.core.score.raw')).toBe(score)
      expect(await Promise.all(results.map((_, i) => system.told(`cmi.interactions.${i}.result`)))).toEqual(results)
      expect(await system.told(`cmi.interactions.${results.length}.id`)).toBeUndefined()
      await system.leave()
      system.close()
      await student.close()
    })
  }

  await part('a handout, printed', async () => {
    await way(page, 'For teachers').click()
    await page.getByRole('link', { name: '20', exact: true }).click()
    await expect(page.getByRole('heading', { level: 1 })).toHaveText('Worksheet: the idea')
    const ring = new Figure(page, 'fastslam-lap >> nth=0')
    await ring.element.scrollIntoViewIfNeeded()
    await ring.live()
    await settled(ring.element)
    const pdf = (await page.pdf({ preferCSSPageSize: true })).toString('latin1')
    expect(pdf.match(/\/Subtype \/Image/g)!.length).toBeGreaterThanOrEqual(3)
  })

  await part('a quiz, on a page of her own', async () => {
    await way(page, 'Embed').click()
    const example = (await page.locator('#quiz code').textContent())!
    const body = example.slice(example.indexOf('<script')).replace('https://figures.example/', baseURL!)
    await openHost(page, body, '<meta charset="utf-8">')
    const figure = new Figure(page, 'fastslam-proposal')
    await figure.live()
    await page.getByRole('button', { name: 'Check', exact: true }).click()
    await expect(page.locator('output')).toHaveText(/^Not yet: \d\.\d/)
    await figure.openSettings()
    await figure.box('range-std').fill('0.005')
    await figure.box('range-std').press('Enter')
    await page.getByRole('button', { name: 'Check', exact: true }).click()
    await expect(page.locator('output')).toHaveText(/^Right: \d+\.\d at σ = 0\.005 m/)
  })
  forgiveHost(complaints)
  forgiveSystem(complaints)
})
