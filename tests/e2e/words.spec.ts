// Figures in the language of the page around them.
import type { Page } from '@playwright/test'
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { FIGURES, openCourse } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

const button = (lap: Figure, name: string) => lap.element.getByRole('button', { name, exact: true })
const title = (lap: Figure) => lap.element.locator('[part=title]')
const speaks = (lap: Figure) => lap.element.locator('[part=figure]')

async function openLap(page: Page, attributes: string, lang = 'en'): Promise<Figure> {
  await openCourse(page, `<main><fastslam-lap step="9" universes="4" ${attributes}></fastslam-lap></main>`, { lang })
  const lap = new Figure(page, 'fastslam-lap')
  await lap.live()
  return lap
}

const say = async (lap: Figure, language: string | null) => {
  await lap.element.evaluate((figure, lang) => (lang === null ? figure.removeAttribute('lang') : figure.setAttribute('lang', lang)), language)
  await expect(speaks(lap)).toHaveAttribute('lang', language === 'de' ? 'de' : 'en')
  await lap.settled()
}

/** Everything that is to be read in it, without the sentence that is read out: it is taken away a second later. */
const words = (lap: Figure) =>
  lap.element.evaluate(figure => {
    const names = ['title', 'aria-label', 'aria-valuetext'].flatMap(name => [...figure.shadowRoot!.querySelectorAll(`[${name}]`)].map(element => element.getAttribute(name)))
    return [...names, ...[...figure.shadowRoot!.querySelectorAll('*')].filter(element => element.childElementCount === 0 && !element.matches('.spoken')).map(element => element.textContent)]
  })

test('a lap in German is German from its title to its picture, and English again when the page says so', async ({ page }) => {
  const lap = await openLap(page, '')
  await expect(title(lap)).toHaveText('One lap, many maps')
  const english = { words: await words(lap), picture: await lap.picture(), readouts: await lap.readouts() }

  await say(lap, 'de')
  await expect(title(lap)).toHaveText('Eine Runde, viele Karten')
  for (const name of ['Abspielen', 'Schritt', 'Schritt zurück', 'Startwert neu würfeln']) await expect(button(lap, name)).toBeVisible()
  await expect(lap.element.locator('button[aria-label=Menü]')).toBeVisible()
  await expect(lap.sentence).toHaveText(/^Schritt 9 von 110, 4 Universen, überlagert\..*um \d,\d\d m daneben/)
  const readouts = await lap.readouts()
  expect(readouts['rms_best']).toBe(english.readouts['rms_best']!.replace('.', ','))
  expect(await lap.picture()).not.toBe(english.picture)
  const left = (await words(lap)).filter(text => text !== null && /\b(the|of|and|step|universe)\b|[{}]/i.test(text))
  expect(left, 'no English is left').toEqual([])

  await say(lap, null)
  expect(await words(lap)).toEqual(english.words)
  expect(await lap.picture()).toBe(english.picture)
})

test('the language is that of the nearest lang, also beyond a shadow root, and one that we do not have is English', async ({ page }) => {
  const lap = await openLap(page, '', 'de-AT')
  await expect(title(lap)).toHaveText('Eine Runde, viele Karten')
  await say(lap, 'fr')
  await expect(title(lap)).toHaveText('One lap, many maps')
  await page.evaluate(() => {
    const host = document.body.appendChild(document.createElement('section'))
    host.lang = 'de'
    document.documentElement.lang = 'en'
    const lap = document.querySelector('fastslam-lap')!
    lap.removeAttribute('lang')
    host.attachShadow({ mode: 'open' }).append(lap)
  })
  await expect(title(new Figure(page, 'fastslam-lap'))).toHaveText('Eine Runde, viele Karten')
})

test('links and attributes are the same in every language, what is refused is said in the figure’s, and the comma follows it unless the attribute decimal says else', async ({ page }) => {
  const lap = await openLap(page, 'lang="de" decimal="point" policy="always" odometry="4"')
  await expect(lap.alert).toContainText('odometry = "4": erlaubt ist')
  const german = await lap.state()
  expect((await lap.readouts())['rms_best']).toContain('.')
  await lap.element.evaluate(figure => figure.removeAttribute('decimal'))
  await lap.settled()
  expect((await lap.readouts())['rms_best']).toContain(',')
  await say(lap, 'en')
  expect((await lap.readouts())['rms_best']).toContain('.')
  expect(await lap.state()).toBe(german)
  expect(german).toContain('policy=always')
})

test('every figure in German has German controls, numbers and sentence', async ({ page }) => {
  const names = [...FIGURES.slice(1), 'log']
  // What they say does not depend on how much they have to count.
  const small: Record<string, string> = { joint: 'particles="50"', graph: 'universes="2"', smoothing: 'particles="4"', em: 'particles="50"' }
  await openCourse(page, `<main lang="de">${names.map(name => `<fastslam-${name} ${small[name] ?? ''}></fastslam-${name}>`).join('')}</main>`)
  for (const name of names) {
    const figure = new Figure(page, `fastslam-${name}`)
    await figure.element.scrollIntoViewIfNeeded()
    await expect(figure.sentence).toHaveText(/\b(von|ist|sind|Noch|und)\b/)
    await figure.settled()
    const left = (await words(figure)).filter(text => text !== null && /\b(the|of|and|step|is)\b|[{}]/i.test(text))
    expect(left, `no English is left in ${name}`).toEqual([])
  }
})

test('where the words of a language cannot be fetched, the figure is English and lives', async ({ page, complaints }) => {
  await page.route('**/de-*.json', route => route.abort())
  const lap = await openLap(page, 'lang="de"')
  await expect(title(lap)).toHaveText('One lap, many maps')
  await expect(lap.sentence).toHaveText(/^Step 9 of 110/)
  complaints.splice(0, Infinity, ...complaints.filter(line => !/de-[\w-]+\.json|No words of language de|ERR_FAILED/.test(line)))
})
