// Worksheets: figures in the states that their tasks are about, on the screen and on paper, with and without solutions.
import { mkdtempSync, readFileSync, rmSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { dist } from '../../scripts/build.mjs'
import { makeSheets } from '../../scripts/pdf.mjs'
import { brokenRules } from './axe'
import { expect, test } from './fixtures'
import { Figure, settled } from './figure'
import { breadth } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

const pictures = (pdf: Buffer) => pdf.toString('latin1').match(/\/Subtype \/Image/g)?.length ?? 0
const leaves = (pdf: Buffer) => pdf.toString('latin1').match(/\/Type\s*\/Page\b(?!s)/g)?.length ?? 0

test('a plan leads to its sheet, whose figures stand in the states that its tasks are about; on paper each is there, and no answer', async ({ page }) => {
  await page.goto('./model.html#plans')
  await page.getByRole('link', { name: '20', exact: true }).click()
  await expect(page.getByRole('heading', { level: 1 })).toHaveText('Worksheet: the idea')
  const [ring, matrix, alone] = ['lap >> nth=0', 'conditioning', 'lap >> nth=1'].map(name => new Figure(page, `fastslam-${name}`))
  for (const figure of [ring!, matrix!, alone!]) {
    await figure.element.scrollIntoViewIfNeeded()
    await figure.live()
    await settled(figure.element)
    await expect(figure.alert).toBeEmpty()
  }
  expect(await ring!.position()).toBe(79)
  expect(await alone!.position()).toBe(110)
  expect(await alone!.element.evaluate(element => (element as unknown as { values: Record<string, string> }).values['universes'])).toBe('1')
  await expect(ring!.element.locator('.sentence'), 'it would answer for the student').toBeHidden()
  await expect(page.locator('.room')).toHaveCount(4)
  expect(await page.locator('main').textContent()).not.toContain('closing the loop was a choice')
  const pdf = await page.pdf({ preferCSSPageSize: true })
  expect(pictures(pdf)).toBeGreaterThanOrEqual(3)
  expect(leaves(pdf)).toBeLessThanOrEqual(4)
  await page.goto('./worksheet-20-solutions.html')
  await expect(page.locator('main')).toContainText('closing the loop was a choice')
  await expect(page.locator('.room')).toHaveCount(0)
})

for (const [name, more] of [['worksheet-45', breadth], ['worksheet-45-solutions', {}], ['worksheet-90', breadth]] as const) {
  test(`axe finds nothing in ${name}, light and dark, and it fits a phone`, more, async ({ page }) => {
    await page.goto(`./${name}.html`)
    for (const colorScheme of ['light', 'dark'] as const) {
      await page.emulateMedia({ colorScheme })
      expect(await brokenRules(page, { but: 'figure > :defined' }), `${name}, ${colorScheme}`).toEqual([])
    }
    await page.setViewportSize({ width: 320, height: 700 })
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(320)
  })
}

test('as PDF a sheet links to where the site will be, and without an address to nowhere', breadth, async () => {
  const folder = mkdtempSync(join(tmpdir(), 'sheets-'))
  try {
    for (const address of ['https://course.example/slam/', '']) {
      await makeSheets(address, process.env.FASTSLAM_DIST ?? dist, file => file === 'worksheet-90.html', folder)
      const pdf = readFileSync(join(folder, 'worksheet-90.pdf'))
      const text = pdf.toString('latin1')
      expect(pictures(pdf)).toBeGreaterThanOrEqual(4)
      expect(leaves(pdf)).toBeLessThanOrEqual(6)
      expect(text).not.toMatch(/localhost|127\.0\.0\.1/)
      const links = [...text.matchAll(/\/URI \(([^)]*)\)/g)].map(match => match[1]!)
      if (address) expect(links.find(link => link.startsWith(`${address}worksheet-90.html?#fastslam-graph?v=3&wrong=on`))).toBeDefined()
      else expect(links).toEqual([])
    }
  } finally {
    rmSync(folder, { recursive: true })
  }
})
