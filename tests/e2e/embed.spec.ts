// Figures in pages of others: in frames with and without an origin, in learning systems, and the code that puts them there.
import { join } from 'node:path'
import type { Frame, Page } from '@playwright/test'
import { root } from '../../scripts/lib.mjs'
import { brokenRules } from './axe'
import { expect, test } from './fixtures'
import { Figure, frames } from './figure'
import { breadth, breadthOf, FIGURES, forgiveHost, openCourse, openHost, quick, sanitised } from './host'

/** What a page's script may ask of a figure. */
type FigureElement = HTMLElement & { embedCode(name: string): string | undefined; naturalHeight: number; state: string }

test.use({ contextOptions: { reducedMotion: 'reduce' }, permissions: ['clipboard-read', 'clipboard-write'] })

const live = (frame: Page | Frame, tag: string) => expect(frame.locator(`${tag} .stage.live`)).toBeVisible({ timeout: 20_000 })

/** Living, with all there is of it: that of logs has a picture when it has a log. */
async function whole(frame: Page | Frame, name: string): Promise<void> {
  if (name === 'log') await frame.locator('fastslam-log input[type=file]').setInputFiles(join(root, 'tests', 'figures', 'golden', 'tiny.clf'))
  await live(frame, `fastslam-${name}`)
}

for (const name of [...FIGURES, 'log']) {
  test(`the pasted iframe of ${name} shows all of it, after a sanitiser that strips all but five attributes`, breadthOf(name), async ({ page, baseURL, complaints }) => {
    await page.goto(`./embed-${name}.html`)
    await whole(page, name)
    const code = await page.locator(`fastslam-${name}`).evaluate(figure => (figure as FigureElement).embedCode('iframe')!)
    expect(code).toContain(`${baseURL}embed.html?figure=${name}`)
    const left = sanitised(code.replace('allow-scripts allow-downloads', 'allow-scripts'))
    expect(left).not.toMatch(/title|style|onload/)
    await openHost(page, left)
    const frame = page.frames()[1]!
    await whole(frame, name)
    await new Figure(frame, `fastslam-${name}`).settled()
    const heights = await frame.locator(`fastslam-${name}`).evaluate(figure => [(figure as FigureElement).naturalHeight, innerHeight])
    // The height in the code is measured, not guessed: neither is the figure cut off nor the frame half empty.
    expect(heights[1]! - heights[0]!, `natural height ${heights[0]}`).toBeGreaterThanOrEqual(-4)
    expect(heights[1]! - heights[0]!, `natural height ${heights[0]}`).toBeLessThan(50)
    forgiveHost(complaints)
  })
}

test('on other pages the menu says which chapter a figure is from, and opens it', async ({ page, baseURL }) => {
  const item = { name: /^From the chapter “FastSLAM/ }
  await page.goto('./embed-lap.html')
  await live(page.mainFrame(), 'fastslam-lap')
  await page.getByRole('button', { name: 'Menu' }).click()
  const [chapter] = await Promise.all([page.context().waitForEvent('page'), page.getByRole('menuitem', item).click()])
  await expect(chapter).toHaveURL(baseURL!)
  await expect(chapter.locator('h1')).toContainText('FastSLAM')
  // The chapter itself has no need of it.
  const lap = new Figure(chapter, 'fastslam-lap')
  await lap.element.scrollIntoViewIfNeeded()
  await lap.live()
  await lap.element.getByRole('button', { name: 'Menu' }).click()
  await expect(lap.element.getByRole('menuitem', { name: 'Copy link' })).toBeVisible()
  await expect(lap.element.getByRole('menuitem', item)).toHaveCount(0)
})

test('a frame without scripts of its host, storage or an origin runs, and the keyboard gets in and out', async ({ page, baseURL, complaints }) => {
  await openHost(page, `<button>before</button><iframe sandbox="allow-scripts" width="800" height="790" src="${baseURL}embed.html?figure=lap&m=4&step=2"></iframe><button>after</button>`)
  const frame = page.frames()[1]!
  await live(frame, 'fastslam-lap')
  expect(await frame.evaluate(() => self.origin)).toBe('null')
  expect(await frame.evaluate(() => { try { return String(localStorage) } catch { return 'refused' } })).toBe('refused')
  const position = frame.locator('fastslam-lap .timeline .position')
  await expect(position).toHaveText(/^2 \//)
  await page.getByRole('button', { name: 'before' }).focus()
  let stage = false
  for (let i = 0; i < 60; i++) {
    await page.keyboard.press('Tab')
    if (await page.getByRole('button', { name: 'after' }).evaluate(button => button === document.activeElement)) break
    if (!stage && (await frame.evaluate(() => document.activeElement?.shadowRoot?.activeElement?.matches('.stage') ?? false))) {
      stage = true
      await page.keyboard.press('ArrowRight')
      await expect(position).toHaveText(/^3 \//)
    }
  }
  expect(stage).toBe(true)
  await expect(page.getByRole('button', { name: 'after' })).toBeFocused()
  await page.keyboard.press('Shift+Tab')
  expect(await page.evaluate(() => document.activeElement?.localName)).toBe('iframe')
  forgiveHost(complaints)
})

test('hosts that listen are told the height, in our words and in those of LTI', async ({ page, baseURL, complaints }) => {
  await page.addInitScript(() => {
    if (parent !== self) return
    const told: unknown[] = ((self as unknown as { told: unknown[] }).told = [])
    addEventListener('message', ({ data }) => {
      told.push(data)
      if (data.subject === 'lti.frameResize') document.querySelector('iframe')!.height = data.height
    })
  })
  await openHost(page, `<iframe sandbox="allow-scripts" width="800" height="400" src="${baseURL}embed.html?figure=lap"></iframe>`)
  const told = () => page.evaluate(() => (self as unknown as { told: { type?: string; subject?: string; height: number }[] }).told)
  await expect.poll(async () => (await told()).some(({ subject }) => subject === 'lti.frameResize')).toBe(true)
  expect((await told()).some(({ type }) => type === 'fastslam-height')).toBe(true)
  const height = () => page.locator('iframe').evaluate((frame: HTMLIFrameElement) => frame.offsetHeight)
  await expect.poll(height).toBeGreaterThan(600)
  const figure = new Figure(page.frames()[1]!, 'fastslam-lap')
  await figure.settled()
  const closed = await height()
  await page.frames()[1]!.getByRole('button', { name: 'Lab' }).click()
  await expect.poll(height).toBeGreaterThan(closed + 50)
  const count = (await told()).length
  await frames(page.frames()[1]!, 60)
  expect((await told()).length, 'the two do not chase each other').toBeLessThanOrEqual(count + 2)
  forgiveHost(complaints)
})

test('short names of formulas are taken in addresses, and options too', async ({ page }) => {
  await page.goto('./embed.html?figure=proposal&sigma_r=0.08&m=16&theme=dark')
  await live(page, 'fastslam-proposal')
  const figure = new Figure(page, 'fastslam-proposal')
  await expect(figure.box('range-std')).toHaveValue('0.08')
  await expect(figure.box('samples')).toHaveValue('16')
  await expect(figure.element).toHaveAttribute('theme', 'dark')
  await expect(page).toHaveTitle('Two proposals for one step')
})

test('an unknown figure is said, with those there are', async ({ page }) => {
  await page.goto('./embed.html?figure=%3Cimg%20src=x%20onerror=alert(1)%3E')
  await expect(page.getByRole('alert')).toContainText('There is no figure “<img')
  for (const name of FIGURES) await expect(page.getByRole('alert').getByRole('link', { name, exact: true })).toBeVisible()
  await page.getByRole('link', { name: 'lap', exact: true }).click()
  await live(page, 'fastslam-lap')
})

test('parameters that are unknown, out of range or hostile are refused in the figure, and never become attributes', async ({ page }) => {
  await page.goto('./embed.html?figure=lap&universes=999&nonsense=1&onclick=alert(1)&style=display:none&step=4')
  const lap = new Figure(page, 'fastslam-lap')
  await lap.live()
  await expect(lap.alert).toContainText(/universes.*1 to 256/)
  await expect(lap.alert).toContainText(/"nonsense" is not a parameter/)
  await expect(lap.alert).toContainText(/"onclick" is not a parameter/)
  expect(await lap.position()).toBe(4)
  expect(await lap.element.evaluate(element => element.getAttributeNames().sort())).toEqual(['fit', 'step', 'universes'])
})

test('the figure of logs is no exception: refusals, locks, the height that its frame should have', async ({ page, baseURL, complaints }) => {
  await openHost(page, `<iframe title="log" width="700" height="300" src="${baseURL}embed.html?figure=log&universes=4&cell=7&nonsense=1&lock=universes"></iframe>`, '<script>heights = []; addEventListener("message", ({ data }) => data.type === "fastslam-height" && heights.push(data.height))</script>')
  const figure = page.frameLocator('iframe').locator('fastslam-log')
  await expect(figure.getByRole('alert')).toContainText('cell = "7": must be a number from 0.02 to 0.2 m')
  await expect(figure.getByRole('alert')).toContainText('nonsense')
  await expect(figure.locator('input[type=number][name=universes]')).toHaveValue('4')
  await expect(figure.locator('input[type=number][name=universes]')).toBeDisabled()
  await expect.poll(() => page.evaluate('heights.length')).toBeGreaterThan(0)
  const heights = (await page.evaluate('heights')) as number[]
  for (const height of heights) expect(height).toBeGreaterThan(600)
  forgiveHost(complaints)
})

// What such a page says where the site knows its address is in tests/chapter/site.test.mjs.
test('each figure has a page with its picture', async ({ page, request }) => {
  for (const name of FIGURES) {
    const picture = /<img src="([^"]+)"/.exec(await (await request.get(`./embed-${name}.html`)).text())
    expect((await request.get(picture![1]!)).headers()['content-type'], name).toBe('image/png')
  }
  await page.goto('./embed-lap.html')
  await live(page.mainFrame(), 'fastslam-lap')
})

test('a frame of an earlier version shows what the link of that version shows, and tells nobody of changes; one without a version is pinned, too', async ({ page }) => {
  // Of the changes, some are of defaults and some are told to whoever comes by a link.
  for (const [name, code] of [['lap', 'v=1&universes=8&step=3'], ['conditioning', 'v=1&odometry=0'], ['proposal', 'v=2&run=on'], ['lap', 'universes=4&step=3'], ['lap', 'v=latest&universes=4&step=86']] as const) {
    await page.goto(`./embed.html?figure=${name}&${code}`)
    const figure = new Figure(page, `fastslam-${name}`)
    await figure.live()
    await expect(figure.alert, code).toBeEmpty()
    const framed = await figure.state()
    // One without a version is of the one that was shown when codes began to say theirs.
    await figure.goTo(code.startsWith('v=') ? code.replace('v=latest', framed.split('&')[0]!) : `v=8&${code}`)
    expect(framed, `${name}: ${code}`).toBe(await figure.state())
  }
  await page.goto('./embed.html?figure=lap&v=eight')
  await expect(new Figure(page, 'fastslam-lap').alert).toContainText('v = "eight": must be latest or a whole number from 1 to')
})

test('an element of an earlier version has the defaults of that version: taken away, locked, after Reset, and after a change of version', async ({ page }) => {
  const lap = new Figure(page, 'fastslam-lap')
  const values = () => lap.element.evaluate(element => ['course', 'seed', 'universes'].map(name => (element as unknown as Record<string, unknown>)[name]))
  await openCourse(page, '<fastslam-lap v="1" seed="5" universes="8" lock="course"></fastslam-lap>')
  await lap.live()
  expect(await values()).toEqual(['apartment', 5, 8])
  await lap.element.evaluate(element => element.removeAttribute('seed'))
  await lap.settled()
  expect(await values(), 'the seed was another then').toEqual(['apartment', 3, 8])
  await lap.element.evaluate(element => element.setAttribute('v', '8'))
  await lap.settled()
  expect(await values()).toEqual(['ring', 9, 8])
  await lap.element.evaluate(element => element.setAttribute('v', '1'))
  await lap.reset.click()
  await lap.settled()
  expect(await values()).toEqual(['apartment', 3, 8])
  await expect(lap.alert).toBeEmpty()
  await page.evaluate(() => (location.hash = 'fastslam-lap?v=13&universes=4'))
  await lap.settled()
  expect(await values(), 'what is locked is the author’s, as it was in that version').toEqual(['apartment', 17, 4])
})

test.describe('without the script', () => {
  for (const [what, javaScriptEnabled] of [['scripts are off', false], ['the script is blocked', true]] as const) {
    test.describe(what, () => {
      test.use({ javaScriptEnabled })
      test(`where ${what}, the picture stands with a line that says so`, async ({ page, complaints }) => {
        await page.route('**/*.js', route => route.abort())
        await page.goto('./embed-lap.html')
        await expect(page.locator('fastslam-lap img')).toBeVisible({ timeout: 10_000 })
        await expect(page.getByText('This figure needs JavaScript')).toBeVisible({ timeout: 10_000 })
        expect(await page.locator('fastslam-lap img').evaluate((image: HTMLImageElement) => image.decode().then(() => image.naturalWidth))).toBeGreaterThan(300)
        complaints.splice(0, Infinity, ...complaints.filter(line => !/Failed to load resource/.test(line)))
      })
    })
  }
})

test('the menu copies code that works as it is: element, iframe, MyST and Python', async ({ page, baseURL, complaints }) => {
  const lap = await new Figure(page, 'fastslam-lap').alone()
  await lap.element.evaluate(element => {
    element.setAttribute('v', 'latest')
    element.setAttribute('decimal', 'comma')
  })
  await lap.openSettings()
  await lap.box('universes').fill('5')
  await lap.box('universes').press('Enter')
  await lap.element.locator('input[name=truth]').check()
  await lap.scrubTo(6)
  const copied = async (item: string) => {
    await lap.menu(item)
    await expect(lap.element.getByText('Code copied')).toBeVisible()
    return page.evaluate(() => navigator.clipboard.readText())
  }
  const element = await copied('Copy code: HTML element')
  expect(element).toBe(`<script type="module" src="${baseURL}fastslam.js"></script>\n<fastslam-lap v="13" universes="5" step="6" truth="on" decimal="comma"><p slot="no-script"><a href="${baseURL}embed-lap.html"><img src="${baseURL}embed-lap.png" alt="${await lap.element.locator('[part=title]').textContent()}" width="100%" loading="lazy"></a><br>This figure is not live here: its script has not arrived. The picture leads to it.</p></fastslam-lap>`)
  const iframe = await copied('Copy code: iframe')
  expect(iframe).toMatch(/embed\.html\?figure=lap&amp;v=13&amp;universes=5&amp;step=6&amp;truth=on&amp;decimal=comma"/)
  expect(await copied('Copy code: MyST')).toBe(
    `\`\`\`{anywidget} ${baseURL}fastslam-anywidget.js\n{\n  "figure": "lap",\n  "v": "13",\n  "universes": "5",\n  "step": "6",\n  "truth": "on",\n  "decimal": "comma"\n}\n\`\`\``,
  )
  expect(await copied('Copy code: Python')).toBe('from fastslam_widgets import FastslamLap\n\nFastslamLap(v=13, universes=5, step=6, truth=True, decimal="comma")')

  // Both on a page of another site.
  const readouts = await lap.readouts()
  await page.context().unrouteAll()
  await openHost(page, `${element}${iframe}`)
  const pasted = new Figure(page, 'body > fastslam-lap')
  await pasted.live()
  expect(await pasted.readouts()).toEqual(readouts)
  await page.locator('iframe').scrollIntoViewIfNeeded()
  const frame = page.frames()[1]!
  await live(frame, 'fastslam-lap')
  await expect(frame.locator('fastslam-lap .timeline .position')).toHaveText(/^6 \//)
  forgiveHost(complaints)
})

test('the module for MyST shows what its JSON asks for, and says what it does not know', async ({ page, baseURL }) => {
  await page.route('**/myst', route => route.fulfill({ contentType: 'text/html', body: '<!doctype html><html lang="en"><title>MyST</title><main></main></html>' }))
  await page.goto('./myst')
  // As MyST's theme calls it: a model of the JSON, which nobody else changes.
  const show = (json: Record<string, unknown>) =>
    page.evaluate(
      async ([address, values]) => {
        const { default: widget } = await import(address)
        const model = { get: (name: string) => values[name], set() {}, save_changes() {}, on() {}, off() {} }
        const el = document.querySelector('main')!.appendChild(document.createElement('div'))
        ;(self as unknown as { end: () => void }).end = widget.render({ model, el })
      },
      [`${baseURL}fastslam-anywidget.js`, json] as const,
    )
  await show({ figure: 'lap', universes: '5', 'range-std': 0.1, step: 3 })
  const lap = new Figure(page, 'fastslam-lap')
  await lap.live()
  expect(await lap.position()).toBe(3)
  await lap.openSettings()
  await expect(lap.box('universes')).toHaveValue('5')
  await expect(lap.box('range-std')).toHaveValue('0.1')
  await page.evaluate(() => (self as unknown as { end: () => void }).end())
  await expect(lap.element).toHaveCount(0)
  await show({ figure: 'psychic' })
  await expect(page.getByText('There is no figure “psychic”.')).toBeVisible()
})

/** That axe finds nothing on a page of another site with this in it, once these figures live. */
async function expectNothingBroken(page: Page, names: string[], how: (name: string) => string, baseURL: string): Promise<void> {
  await openHost(page, `<main><h1>Figures</h1>${names.map(how).join('')}</main>`, `<script type="module" src="${baseURL}fastslam.js"></script>`)
  const inFrames = how !== quick
  for (const [i, name] of names.entries()) {
    await page.locator(inFrames ? 'iframe' : `fastslam-${name}`).nth(inFrames ? i : 0).scrollIntoViewIfNeeded()
    await live(inFrames ? page.frames()[i + 1]! : page, `fastslam-${name}`)
  }
  expect(await brokenRules(page, { frames: inFrames })).toEqual([])
}

const framed = (baseURL: string) => (name: string) => `<iframe title="${name}" width="800" height="900" src="${baseURL}embed.html?figure=${name}"></iframe>`

test('a page with figures in frames passes axe', async ({ page, baseURL, complaints }) => {
  await expectNothingBroken(page, ['lap'], framed(baseURL!), baseURL!)
  forgiveHost(complaints)
})

test('a page with all figures as elements, and one with all of them in frames, pass axe', breadth, async ({ page, baseURL, complaints }) => {
  test.slow()
  await expectNothingBroken(page, FIGURES, quick, baseURL!)
  await expectNothingBroken(page, FIGURES, framed(baseURL!), baseURL!)
  forgiveHost(complaints)
})
