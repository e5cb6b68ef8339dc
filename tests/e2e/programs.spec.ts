// Which program a page loads: that of its figure alone where it has one or two kinds, and that of the chapter where it has more.
import { existsSync } from 'node:fs'
import type { Page } from '@playwright/test'
import { programFile, singlePrograms } from '../../scripts/registry.mjs'
import { Figure } from './figure'
import { expect, test } from './fixtures'
import { openCourse, programsMade, quick } from './host'

/** Names of the programs that a page asks for from now on. */
function programsOf(page: Page): string[] {
  const asked: string[] = []
  page.on('request', request => {
    const name = /\/fastslam-([\w-]+)-[\w-]{8}\.wasm$/.exec(request.url())?.[1]
    if (name) asked.push(name)
  })
  return asked
}

const live = async (page: Page, ...names: string[]) => {
  for (const name of names) await new Figure(page, `fastslam-${name}`).settled()
}

test('a page of one figure, and a frame, load that figure alone, once for all copies of it', async ({ page }) => {
  const asked = programsOf(page)
  await openCourse(page, quick('proposal') + quick('proposal'))
  for (const figure of await page.locator('fastslam-proposal').all()) await expect(figure.locator('.stage.live')).toBeVisible()
  expect(asked).toEqual(['proposal'])
  await page.goto('./embed-proposal.html')
  await live(page, 'proposal')
  expect(new Set(asked), 'the frame asks for no other').toEqual(new Set(['proposal']))
  expect(asked.length, 'nor twice').toBeLessThanOrEqual(2)
})

test('a page of three kinds of figures loads one program for all of them', async ({ page }) => {
  const asked = programsOf(page)
  await openCourse(page, quick('proposal') + quick('doors') + quick('worked-example'))
  await live(page, 'proposal', 'doors', 'worked-example')
  expect(asked).toEqual(['page'])
})

test('a figure that comes later finds a program, and the ones that are there stay as they are', async ({ page }) => {
  const asked = programsOf(page)
  await openCourse(page, quick('proposal'))
  const proposal = new Figure(page, 'fastslam-proposal')
  await proposal.settled()
  await proposal.element.evaluate(element => element.setAttribute('samples', '32'))
  await proposal.settled()
  const said = await proposal.sentence.textContent()
  for (const name of ['doors', 'worked-example']) {
    await page.evaluate(html => document.body.insertAdjacentHTML('beforeend', html), quick(name))
    await page.locator(`fastslam-${name}`).scrollIntoViewIfNeeded()
    await live(page, name)
    await expect(page.locator(`fastslam-${name} .stage.live`)).toBeVisible()
  }
  expect(asked[0]).toBe('proposal')
  expect(new Set(asked).size, 'no program is fetched twice').toBe(asked.length)
  await proposal.element.scrollIntoViewIfNeeded()
  await expect(proposal.sentence).toHaveText(said!)
})

test('one whose own program was not built takes that of the chapter', async ({ page }) => {
  // As on a site that was built without: it knows no address of it.
  await page.route(/\/fastslam-[\w-]+\.js$/, async route => {
    const response = await route.fetch()
    await route.fulfill({ response, body: (await response.text()).replace(/"\.\.\/pkg\/fastslam-proposal\.wasm":\w+,?/, '') })
  })
  const asked = programsOf(page)
  await openCourse(page, quick('proposal'))
  await live(page, 'proposal')
  expect(asked).toEqual(['page'])
})

test('every program that was built drives its frame, and says what the one of the chapter says', programsMade, async ({ page }) => {
  const built = singlePrograms.filter(name => existsSync(programFile(name)))
  expect(built.length, 'of these there are several, or this test shows nothing').toBeGreaterThan(1)
  for (const name of built) {
    const asked = programsOf(page)
    const figure = new Figure(page, `fastslam-${name}`)
    await page.goto(`./embed-${name}.html`)
    await figure.settled()
    expect(asked, name).toEqual([name])
    const alone = await figure.sentence.textContent()
    const [first, second] = singlePrograms.filter(other => other !== name)
    await openCourse(page, quick(name).replace(/ particles="\d+"/, '') + quick(first!) + quick(second!))
    await figure.settled()
    expect(asked.filter(program => program !== name), name).toEqual(['page'])
    await expect(figure.sentence, name).toHaveText(alone!)
  }
})
