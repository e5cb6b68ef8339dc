// What the page for teachers says of the states that break a misconception: each link opens without a notice, and shows what is claimed.
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import { root } from '../../scripts/lib.mjs'
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { breadth } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

type Numbers = Record<string, number | null>

/** What is claimed of a link, by its figure and a part of its state; every link of the list has one. */
const CLAIMS: [link: string, holds: (now: Numbers, words: string) => boolean][] = [
  ['proposal?v=3&landmarks=pair', (_, words) => words.includes('is lost, and N_eff does not show it')],
  ['resampling?v=4&wings=on', ({ always_ess, always_right }) => always_ess! > 15.9 && always_right === 0],
  ['proposal?v=3&range-std=0.005', ({ ess_motion }) => ess_motion! < 200],
  ['proposal?v=3&range-std=0.5', ({ ess_motion }) => ess_motion! > 800],
  ['resampling?v=4&threshold=1', ({ always_lineage }) => always_lineage === 1],
  ['conditioning?v=2', ({ rho }, words) => Math.abs(rho!) > 0.3 && words.includes('though no pose saw both')],
  ['conditioning?v=2&last-pose=on', (_, words) => /others still couple the map: [1-9]/.test(words)],
  ['doors?v=1', ({ ekf_std }, words) => ekf_std! < 0.1 && words.includes('doors: wrong')],
  ['joint?v=1', ({ ess_sampled }) => ess_sampled! < 2],
  ['em?v=1&mark-3=5.2', (_, words) => words.includes('nothing changes any more') && words.includes('passed the same two doors again')],
  ['smoothing?v=3&at=30', ({ coalescence }) => coalescence! >= 30],
  ['graph?v=3&wrong=on', ({ rms, rms_start }) => rms! > rms_start!],
  ['universes?v=2&proposals=motion', ({ passes_motion }) => passes_motion! > 0],
]

test('each misconception is broken by the state that its link opens', breadth, async ({ page }) => {
  const text = readFileSync(join(root, 'www', 'model.md'), 'utf8')
  const list = text.slice(text.indexOf('{#misconceptions}'), text.indexOf('{#plans}'))
  const links = [...list.matchAll(/index\.html#fastslam-([a-z-]+)\?([^)]*)\)/g)].map(([, name, state]) => ({ name: name!, state: state! }))
  expect(links.length).toBe(CLAIMS.length)
  for (const { name, state } of links) {
    await page.goto('about:blank')
    const figure = await new Figure(page, `fastslam-${name}`).open(`./embed-${name}.html#fastslam-${name}?${state}`)
    await expect(figure.alert).toBeEmpty()
    const now = await figure.element.evaluate(element => Object.fromEntries((element as unknown as { readouts: { name: string; value: number | null }[] }).readouts.map(({ name, value }) => [name, value])))
    // The claim of that link is the longest that fits.
    const claims = CLAIMS.filter(([link]) => `${name}?${state}`.startsWith(link)).sort(([a], [b]) => b.length - a.length)
    const words = (await figure.sentence.textContent())!
    expect(claims[0]?.[1](now, words), `${name}?${state}: ${words} ${JSON.stringify(now)}`).toBe(true)
  }
})

/** What the answers to questions of the bank say of a state that they ask to open, each by its link. */
const ANSWERS: [state: string, holds: (now: Numbers) => boolean][] = [
  ['resampling?v=4&step=90', ({ never_ess, never_lineage, always_lineage, always_ess }) => never_ess! < 1.5 && never_lineage === 16 && always_lineage === 1 && always_ess! > 8],
  ['proposal?v=3', ({ ess_motion }) => Math.abs(ess_motion! - 1000 * measured('proposal.ess.motion')) < 0.1 * 1000 * measured('proposal.ess.motion')],
  ['graph?v=3&step=60', ({ rms }) => Math.abs(rms! - measured('graph.opening.end')) < 1e-6],
  ['graph?v=3&wrong=on&step=60', ({ rms }) => Math.abs(rms! - measured('graph.opening.folded')) < 1e-6],
]
const measured = (key: string): number => (JSON.parse(readFileSync(join(root, 'www', 'data', 'numbers.json'), 'utf8')) as Record<string, { value: number }>)[key]!.value

test('what the bank asks to open shows what its answers say', breadth, async ({ page }) => {
  const text = readFileSync(join(root, 'www', 'bank.md'), 'utf8')
  const links = [...text.matchAll(/index\.html#fastslam-([^)]*)\)/g)].map(([, state]) => state!)
  expect(links.filter(state => !state.startsWith('lap?')).sort()).toEqual(ANSWERS.map(([state]) => state).sort())
  for (const [state, holds] of ANSWERS) {
    await page.goto('about:blank')
    const name = state.split('?')[0]!
    const figure = await new Figure(page, `fastslam-${name}`).open(`./embed-${name}.html#fastslam-${state}`)
    await expect(figure.alert).toBeEmpty()
    const now = await figure.element.evaluate(element => Object.fromEntries((element as unknown as { readouts: { name: string; value: number | null }[] }).readouts.map(({ name, value }) => [name, value])))
    expect(holds(now), `${state}: ${JSON.stringify(now)}`).toBe(true)
  }
  // Of the rooms the deaths are no readout: the picture says them, and the numbers of the chapter count them (rooms.deaths).
  expect(links.filter(state => state.startsWith('lap?'))).toEqual(['lap?v=13&step=79'])
})

test('from the page for teachers a lecturer reaches the bank of questions, and takes it along for a learning system', async ({ page }) => {
  await page.goto('./')
  await page.getByRole('navigation', { name: 'Site' }).getByRole('link', { name: 'For teachers' }).click()
  await page.getByRole('link', { name: 'bank of forty more' }).click()
  await expect(page.getByRole('heading', { level: 1 })).toHaveText('Question bank')
  await expect(page.locator('.check')).toHaveCount(40)
  const take = async (name: string): Promise<string> => (await page.request.get(await page.getByRole('link', { name, exact: true }).evaluate(link => (link as HTMLAnchorElement).href))).text()
  expect((await take('GIFT')).match(/^::/gm)).toHaveLength(40)
  const kinds = await page.evaluate(
    xml => [...new DOMParser().parseFromString(xml, 'text/xml').querySelectorAll('question, parsererror')].map(element => element.getAttribute('type') ?? element.textContent),
    await take('Moodle XML'),
  )
  const count = (kind: string) => kinds.filter(other => other === kind).length
  expect([count('multichoice') + count('numerical') + count('essay'), count('category'), kinds.length]).toEqual([40, 12, 52])
  // Its questions lead to what they are about.
  await page.getByRole('link', { name: 'three policies after 90 steps' }).click()
  await expect(page).toHaveURL(/index\.html#fastslam-resampling\?v=4&step=90$/)
})
