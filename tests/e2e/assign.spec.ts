// The lecturer on Monday morning: an assignment is composed, handed out and comes back; a page with a quiz; what a frame tells; what is saved.
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import { pathToFileURL } from 'node:url'
import type { Page } from '@playwright/test'
import { unzipSync } from 'fflate'
import { root } from '../../scripts/lib.mjs'
import { brokenRules } from './axe'
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { breadth, forgiveHost, openHost } from './host'
import { forgiveSystem, LearningSystem } from './learning-system'

test.use({ contextOptions: { reducedMotion: 'reduce' }, permissions: ['clipboard-read', 'clipboard-write'] })

const editor = (page: Page) => page.getByRole('form', { name: 'Attributes' })
const code = (page: Page) => page.locator('.codes code')

/** The page on embedding with a figure, and a question about it to choose an answer to. */
async function compose(page: Page, query: string): Promise<Figure> {
  await page.goto(`./embed/?${query}#assign`)
  const figure = new Figure(page, `#preview fastslam-${new URLSearchParams(query).get('figure')}`)
  await figure.element.scrollIntoViewIfNeeded()
  await figure.live()
  return figure
}

async function composeChoice(page: Page): Promise<void> {
  await editor(page).getByLabel('Question').fill('Which filter has samples at both landmarks?')
  await editor(page).getByLabel('Asks for').selectOption('choice')
  await editor(page).getByLabel('Answers').fill('FastSLAM 2.0\n* FastSLAM 1.0\nboth')
  await editor(page).getByLabel('Tries').fill('2')
  await editor(page).getByLabel('Points a wrong try takes').fill('40')
}

test('first screen: figure, wishes and the block to copy are in sight at 1366 × 650, and each wish has its block', async ({ page }) => {
  await page.setViewportSize({ width: 1366, height: 650 })
  await page.goto('./embed/?figure=proposal&v=3&range-std=0.08')
  const figure = new Figure(page, '#preview fastslam-proposal')
  await figure.live()
  for (const part of [figure.canvas, page.locator('.codes'), page.getByRole('radio', { name: 'Notebook' })]) await expect(part).toBeInViewport({ ratio: 1 })
  const blocks: [string, RegExp][] = [
    ['Show', /^<script type="module" .*<fastslam-proposal v="3" range-std="0.08">/s],
    ['Project', /embed\.html\?figure=proposal&v=3&range-std=0\.08&size=presentation$/],
    ['Print', /task\.html\?figure=proposal&v=3&range-std=0\.08&print=on$/],
    ['Notebook', /FastslamProposal\(v=3, range_std=0\.08\)$/],
  ]
  for (const [name, text] of blocks) {
    await page.getByRole('radio', { name }).check()
    await expect(code(page), name).toHaveText(text)
    await expect(page.getByRole('button', { name: /^Copy the code/ }), name).toBeInViewport({ ratio: 1 })
  }
  await page.getByRole('radio', { name: 'Show' }).check()
  await page.getByLabel('Into').selectOption('link')
  await page.getByLabel('Readers may change').selectOption('all')
  await expect(code(page)).toHaveText(/\/#fastslam-proposal\?v=3&range-std=0\.08$/)
  await page.getByLabel('Into').selectOption('iframe')
  await expect(code(page)).toContainText('lock=all')
  await page.getByRole('radio', { name: 'Assign' }).check()
  await expect(page.locator('.missing')).toHaveText('Write the question.')
  await expect(page.getByRole('button', { name: /^Copy the code/ })).toBeDisabled()
  // What an attribute does is there for touch and keyboard: as text, and as the description of its field.
  await page.getByText('All attributes').click()
  const box = editor(page).getByRole('textbox', { name: 'range-std' })
  await expect(box).toHaveAccessibleDescription(/From 0\.005 to 0\.5 m/)
  await expect(page.locator('#about-range-std')).toBeVisible()
})

test('every state of the gallery is a challenge of its figure', async ({ page, request }) => {
  const { modules } = (await (await request.get('./custom-elements.json')).json()) as { modules: { declarations: { tagName: string; challenges: { name: string }[] }[] }[] }
  await page.goto('./embed/?figure=doors')
  const listed = await page.locator('#gallery button').evaluateAll(buttons => buttons.map(button => ({ ...(button as HTMLElement).dataset })))
  expect(new Set(listed.map(({ figure }) => figure)).size).toBe(12)
  for (const { figure, challenge } of listed) {
    const { challenges } = modules[0]!.declarations.find(({ tagName }) => tagName === `fastslam-${figure}`)!
    expect(challenges.map(({ name }) => name), figure).toContain(challenge)
  }
  await page.locator('#gallery [data-figure=conditioning]').click()
  await expect(code(page)).toContainText(/<fastslam-conditioning v="\d+" condition="on">/)
})

test('who presses a state of the gallery before the page knows its figures gets it all the same', async ({ page }) => {
  let arrive: () => void
  const arrived = new Promise<void>(resolve => (arrive = resolve))
  await page.route('**/custom-elements.json', async route => {
    await arrived
    await route.continue()
  })
  await Promise.all([page.waitForRequest('**/custom-elements.json'), page.goto('./embed/')])
  await page.locator('#gallery [data-figure=em]').click()
  arrive!()
  await expect(page.locator('#preview fastslam-em')).toBeInViewport()
})

test('a number, foretold first: the figure waits for the prediction, and tries cost points', async ({ page }) => {
  const figure = await compose(page, 'figure=proposal&v=3&lock=odometry')
  await editor(page).getByLabel('Question').fill('How much is a sample of 2.0 worth?')
  await editor(page).getByLabel('Measured value').selectOption('ratio')
  const ratio = await figure.element.evaluate(element => (element as unknown as { readouts: { name: string; value: number }[] }).readouts.find(({ name }) => name === 'ratio')!.value)
  expect(Number(await editor(page).getByLabel('Right answer').inputValue())).toBeCloseTo(ratio, 1)
  await editor(page).getByLabel('Prediction first').check()
  await editor(page).getByLabel('Points a wrong try takes').fill('25')
  await editor(page).getByLabel('Explanation').fill('It is read off the figure.')
  await expect(page.locator('.missing')).toBeEmpty()
  await page.goto((await code(page).textContent())!)
  const asked = new Figure(page, 'fastslam-proposal')
  await asked.live()
  const task = page.getByRole('region', { name: 'Assignment' })
  expect(await asked.element.evaluate(element => (element as HTMLElement).inert)).toBe(true)
  await task.getByLabel('Your prediction').fill('2')
  await task.getByRole('button', { name: 'Keep my prediction' }).click()
  await expect(task).toContainText('Your prediction was 2')
  expect(await asked.element.evaluate(element => (element as HTMLElement).inert)).toBe(false)
  await expect(asked.element.locator('input[type=range][name=odometry]')).toBeDisabled()
  const answer = async (text: string) => {
    await task.getByLabel('Your answer').fill(text)
    await task.getByRole('button', { name: 'Hand in' }).click()
  }
  await answer('many')
  await expect(task.locator('.verdict').first()).toHaveText('Please write a number.')
  await answer('100')
  await expect(task.locator('.verdict').first()).toHaveText('Not right. You have 2 tries left.')
  await answer(String(ratio).replace('.', ','))
  await expect(task.locator('.verdict').first()).toHaveText('Right. It is read off the figure.')
  await expect(task).toContainText('Tries: 2 · Score: 75 of 100')
  await answer('100')
  await expect(task.locator('.verdict').first()).toContainText('after the answer was shown')
  await expect(task).toContainText('Score: 75 of 100')
  expect(await brokenRules(page, { frames: true })).toEqual([])
  for (const width of [1366, 380]) {
    await page.setViewportSize({ width, height: 700 })
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(width)
  }
})

test('a SCORM package zipped in the browser: wrong, right, and a guess after the answer, told apart with score and time', async ({ page, complaints }) => {
  const composed = await compose(page, 'figure=proposal&v=3&landmarks=pair&lock=landmarks')
  await composeChoice(page)
  await editor(page).getByLabel('Hand it out as').selectOption('scorm')
  await editor(page).getByLabel('Pass mark').fill('50')
  const state = await composed.state()
  const [saved] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'Save: SCORM 1.2 package' }).click()])
  expect(saved.suggestedFilename()).toBe('fastslam-proposal-task.zip')
  const files = unzipSync(readFileSync(await saved.path()))
  expect(Object.keys(files)).toEqual(expect.arrayContaining(['index.html', 'imsmanifest.xml', 'scorm.js', 'licences.txt', 'sbom.cdx.json']))

  const system = new LearningSystem(page, 'fastslam-proposal', files)
  const figure = await system.visit()
  expect(await figure.state()).toBe(state)
  const told = (name: string) => system.told(`cmi.${name}`)
  const answer = async (choice: string) => {
    await system.frame.getByLabel(choice).check()
    await system.frame.getByRole('button', { name: 'Hand in' }).click()
  }
  await figure.openSettings()
  await figure.box('samples').fill('50')
  await figure.box('samples').press('Enter')
  await figure.settled()
  await answer('FastSLAM 2.0')
  await expect.poll(() => told('interactions.0.result')).toBe('wrong')
  expect([await told('interactions.0.id'), await told('interactions.0.student_response'), await told('interactions.0.correct_responses.0.pattern')]).toEqual(['answer.try_1', 'a', 'b'])
  expect(await told('core.lesson_status'), 'a wrong try with one left, and what was done with the figure').toBe('incomplete')
  expect(await told('core.score.raw')).toBeUndefined()
  await system.leave()

  await system.visit()
  await expect(system.frame.getByText('Tries: 1')).toBeVisible() // it is the second visit
  await answer('FastSLAM 1.0')
  await expect.poll(() => told('core.score.raw')).toBe('60')
  expect([await told('interactions.1.id'), await told('interactions.1.result'), await told('core.lesson_status')]).toEqual(['answer.try_2', 'correct', 'passed'])
  expect(await told('core.session_time')).toMatch(/^0000:\d\d:\d\d$/)
  await answer('both')
  await expect.poll(() => told('interactions.2.id')).toBe('answer.try_3.after_the_answer')
  expect([await told('interactions.2.result'), await told('core.score.raw'), await told('core.lesson_status')]).toEqual(['neutral', '60', 'passed'])
  await system.leave()
  system.close()
  forgiveSystem(complaints)
})

test('answered wrongly to the end it is failed, and looking at it completes nothing', async ({ page, complaints }) => {
  await compose(page, 'figure=proposal&v=3')
  await composeChoice(page)
  await editor(page).getByLabel('Hand it out as').selectOption('scorm')
  await editor(page).getByLabel('Pass mark').fill('50')
  const [saved] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'Save: SCORM 1.2 package' }).click()])
  const system = new LearningSystem(page, 'fastslam-proposal', unzipSync(readFileSync(await saved.path())))
  const figure = await system.visit()
  await figure.reroll.click()
  await expect.poll(() => system.told('cmi.suspend_data')).toContain('seed=')
  expect(await system.told('cmi.core.lesson_status')).toBe('incomplete')
  for (const choice of ['both', 'FastSLAM 2.0']) {
    await system.frame.getByLabel(choice).check()
    await system.frame.getByRole('button', { name: 'Hand in' }).click()
  }
  await expect.poll(() => system.told('cmi.core.lesson_status')).toBe('failed')
  expect(await system.told('cmi.core.score.raw')).toBe('0')
  await expect(system.frame.getByText('The answer is “FastSLAM 1.0”.')).toBeVisible()
  await system.leave()
  system.close()
  forgiveSystem(complaints)
})

test('what is handed in on paper is one page: name, date, question, tries, and below the whole picture the words and the link of its state', async ({ page }) => {
  await compose(page, 'figure=proposal&v=3&range-std=0.08')
  await composeChoice(page)
  await page.goto((await code(page).textContent())!)
  const figure = new Figure(page, 'fastslam-proposal')
  await figure.live()
  await page.getByLabel('FastSLAM 1.0').check()
  await page.getByRole('button', { name: 'Hand in' }).click()
  await page.getByLabel('Name').fill('A. Student')
  const pdf = (await page.pdf({ format: 'A4' })).toString('latin1')
  expect(pdf.match(/\/Type\s*\/Page\b(?!s)/g)).toHaveLength(1)
  expect(pdf).toContain('range-std=0.08')
  // As wide as A4 between its margins.
  await page.setViewportSize({ width: 718, height: 1000 })
  await page.emulateMedia({ media: 'print' })
  const [words, picture, link] = await Promise.all([figure.told, figure.canvas, figure.element.locator('.paper')].map(part => part.boundingBox()))
  expect(picture!.y, 'below what happens in it').toBeGreaterThanOrEqual(words!.y + words!.height)
  expect(link!.y).toBeGreaterThanOrEqual(picture!.y + picture!.height)
  for (const text of ['Which filter has samples', 'Tries: 1 · Score: 100 of 100']) await expect(page.getByText(text)).toBeVisible()
  await expect(page.getByRole('button', { name: 'Hand in' })).toBeHidden()
})

test('a text is handed in whole, without points, and is there at the next visit; the page speaks the figure’s language, and on paper names the site where the state opens again', async ({ page, baseURL, complaints }) => {
  await compose(page, 'figure=proposal&v=3&lang=de')
  await editor(page).getByLabel('Question').fill('Warum verliert FastSLAM 1.0 seine Partikel?')
  await editor(page).getByLabel('Asks for').selectOption('text')
  await editor(page).getByLabel('Hand it out as').selectOption('scorm')
  const [saved] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'Save: SCORM 1.2 package' }).click()])
  const system = new LearningSystem(page, 'fastslam-proposal', unzipSync(readFileSync(await saved.path())))
  await system.visit()
  const text = 'Weil der Sensor schärfer ist als die Bewegung. '.repeat(10).trim()
  await system.frame.getByLabel('Ihre Antwort').fill(text)
  await system.frame.getByRole('button', { name: 'Abgeben' }).click()
  await expect.poll(() => system.told('cmi.core.lesson_status')).toBe('completed')
  expect([await system.told('cmi.comments'), await system.told('cmi.interactions.0.result'), await system.told('cmi.core.score.raw')]).toEqual([text, 'neutral', undefined])
  expect((await system.told('cmi.interactions.0.student_response'))!.length).toBe(255)
  await system.frame.evaluate(() => dispatchEvent(new Event('beforeprint')))
  await expect(system.frame.locator('.site')).toHaveText(`Der Zustand der Abbildung: ${baseURL}#fastslam-proposal?v=3`)
  await system.leave()
  await system.visit()
  await expect(system.frame.getByText('Abgegeben.')).toBeVisible()
  await system.leave()
  system.close()
  forgiveSystem(complaints)
})

test('a state to reach counts when the reader has reached it; the page around hears of it if the frame’s address names its origin, and no other page does', async ({ page, baseURL, complaints }) => {
  await compose(page, 'figure=proposal&v=3')
  await editor(page).getByLabel('Question').fill('Make a sample of 2.0 worth six.')
  await editor(page).getByLabel('Asks for').selectOption('reach')
  await editor(page).getByRole('combobox', { name: 'What', exact: true }).selectOption('ratio')
  await editor(page).getByRole('combobox', { name: 'is', exact: true }).selectOption('least')
  await editor(page).getByRole('textbox', { name: 'Value', exact: true }).fill('6')
  const address = (await code(page).textContent())!
  await openHost(page, '<iframe width="900" height="800"></iframe>', '<script>heard = []; addEventListener("message", ({ origin, data }) => data.type?.startsWith("fastslam-") && data.type !== "fastslam-height" && heard.push({ origin, ...data }))</script>')
  const open = (tell: string) =>
    // A frame of its own for each: one that is sent on shows the figure before for a while, and that is live.
    page.locator('iframe').evaluate((frame: HTMLIFrameElement, src) => {
      const next = frame.cloneNode() as HTMLIFrameElement
      next.src = src
      frame.replaceWith(next)
      ;(self as unknown as { heard: unknown[] }).heard.length = 0
    }, `${address}&tell=${tell}`)
  const heard = () => page.evaluate(() => (self as unknown as { heard: { type: string; origin: string; figure: string; result: string; score: number; state: string }[] }).heard)
  const inFrame = async () => {
    await expect.poll(() => page.frames().length).toBe(2)
    const figure = new Figure(page.frames()[1]!, 'fastslam-proposal')
    await figure.live()
    return figure
  }
  await open(encodeURIComponent(`https://other.example,${new URL(page.url()).origin}`))
  const figure = await inFrame()
  const task = page.frames()[1]!.getByRole('region', { name: 'Assignment' })
  await task.getByRole('button', { name: 'Hand in this state' }).click()
  await expect(task).toContainText('Change something first')
  await figure.openSettings()
  await figure.box('range-std').fill('0.005')
  await figure.box('range-std').press('Enter')
  await figure.settled()
  await expect(task.locator('.reached')).toBeVisible()
  await task.getByRole('button', { name: 'Hand in this state' }).click()
  await expect(task).toContainText('Right.')
  // They come from another process, a while after what they tell of has been seen.
  await expect.poll(async () => (await heard()).findLast(({ type }) => type === 'fastslam-state')?.state).toContain('range-std=0.005')
  await expect.poll(async () => (await heard()).filter(({ type }) => type === 'fastslam-answer')).toMatchObject([{ result: 'right', score: 100 }])
  expect((await heard()).every(({ origin, figure }) => `${origin}/` === baseURL && figure === 'fastslam-proposal')).toBe(true)

  for (const tell of ['https://other.example', '*']) {
    await open(encodeURIComponent(tell))
    const silent = await inFrame()
    await silent.reroll.click()
    await silent.settled()
    // What comes last says that nothing else is on its way.
    await page.frames()[1]!.evaluate(() => parent.postMessage({ type: 'fastslam-end' }, '*'))
    await expect.poll(heard, tell).toMatchObject([{ type: 'fastslam-end' }])
  }
  forgiveHost(complaints)
  complaints.splice(0, Infinity, ...complaints.filter(line => !line.startsWith('left the site: http://127.0.0.1')))
})

test('the quiz of twenty lines that the documents show works as it stands', async ({ page, baseURL }) => {
  const html = readFileSync(join(root, 'www', 'embed', 'index.html'), 'utf8')
  const example = /<pre id="quiz"><code>([^]*?)<\/code>/.exec(html)![1]!.replaceAll('&lt;', '<').replaceAll('&gt;', '>').replaceAll('&amp;', '&')
  expect(example.trim().split('\n').length).toBeLessThanOrEqual(20)
  await page.route('**/quiz', route => route.fulfill({ contentType: 'text/html', body: example.replace('https://figures.example/', baseURL!) }))
  await page.goto('./quiz')
  const figure = new Figure(page, 'fastslam-proposal')
  await figure.live()
  const check = page.getByRole('button', { name: 'Check', exact: true })
  await check.click()
  await expect(page.locator('output')).toHaveText(/^Not yet: \d\.\d/)
  await figure.openSettings()
  await figure.box('range-std').fill('0.005')
  await figure.box('range-std').press('Enter')
  await check.click()
  await expect(page.locator('output')).toHaveText(/^Right: \d+\.\d at σ = 0\.005 m/)
})

test('what an author has mistaken goes to the console and to who listens, not to readers; what a reader types is refused in the figure', async ({ page, baseURL, complaints }) => {
  const lines: string[] = []
  page.on('console', message => message.type() === 'info' && lines.push(message.text()))
  const body = `<!doctype html><html lang="en"><title>Course</title><link rel="icon" href="data:,"><script>told = []; addEventListener('fastslam-notice', event => told.push(event.detail.name))</script><script type="module" src="fastslam.js"></script><body><fastslam-proposal v="3" samples="many" nonsense="1" lock="everything"></fastslam-proposal>`
  // A site as any other, with the figures' files on it: localhost is where pages are made.
  await page.route('http://course.example/**', async route => {
    const path = new URL(route.request().url()).pathname.slice(1)
    await route.fulfill(path === '' ? { contentType: 'text/html', body } : { response: await route.fetch({ url: baseURL + path }) })
  })
  await page.goto('http://course.example/')
  const figure = new Figure(page, 'fastslam-proposal')
  await figure.live()
  expect((await page.evaluate(() => (self as unknown as { told: string[] }).told)).sort()).toEqual(['lock', 'nonsense', 'samples'])
  expect(lines.filter(line => line.startsWith('<fastslam-proposal>: ')).length).toBe(3)
  await expect(figure.alert).toBeEmpty()
  await figure.openSettings()
  await figure.box('samples').fill('-3')
  await figure.box('samples').press('Enter')
  await expect(figure.alert).toContainText('samples')
  complaints.splice(0, Infinity, ...complaints.filter(line => !line.startsWith('left the site: http://course.example/')))
})

test('a figure is saved as one file, which lives from file:// in its state and asks for nothing', async ({ page, context }) => {
  const composed = await compose(page, 'figure=proposal&v=3&range-std=0.08&lock=seed')
  await page.getByRole('radio', { name: 'Offline' }).check()
  const [saved] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'Save: fastslam-proposal.html' }).click()])
  const state = await composed.state()
  const path = join(root, '.cache', 'e2e', `saved-${process.pid}.html`)
  await saved.saveAs(path)
  const asked: string[] = []
  context.on('request', request => !/^(data|blob):/.test(request.url()) && asked.push(request.url()))
  const figure = new Figure(page, 'fastslam-proposal')
  const address = pathToFileURL(path).href
  await page.goto(address)
  await figure.live()
  expect(await figure.state()).toBe(state)
  await expect(figure.reroll).toBeDisabled()
  expect(asked).toEqual([address])
})

test('axe finds nothing on the page on embedding while an assignment is composed, in the dark', breadth, async ({ browser, baseURL }) => {
  const page = await (await browser.newContext({ baseURL: baseURL!, reducedMotion: 'reduce', colorScheme: 'dark' })).newPage()
  await compose(page, 'figure=proposal')
  for (const kind of ['number', 'choice', 'text', 'reach']) {
    await editor(page).getByLabel('Asks for').selectOption(kind)
    expect(await brokenRules(page, { frames: true }), kind).toEqual([])
  }
  await page.context().close()
})
