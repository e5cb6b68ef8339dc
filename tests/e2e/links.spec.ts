// Links carry the whole state; attributes and properties set it; what is wrong is said, and changes nothing else.
import type { Page } from '@playwright/test'
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { openCourse } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' }, permissions: ['clipboard-read', 'clipboard-write'] })

/** Adds a figure at the top of the page, with these attributes, before its first script runs on it. */
async function addFigure(page: Page, attributes: Record<string, string>): Promise<Figure> {
  await page.evaluate(given => {
    const host = document.createElement('div')
    const text = Object.entries(given).map(([name, value]) => ` ${name}="${value}"`)
    host.innerHTML = `<fastslam-lap id="added"${text.join('')}></fastslam-lap>`
    document.querySelector('main')!.prepend(host)
  }, attributes)
  const lap = new Figure(page, '#added')
  await lap.element.scrollIntoViewIfNeeded()
  await lap.live()
  return lap
}

test('a link of a later version says so, and what this page knows of it is shown; another is followed when the address changes, and plays nothing', async ({ page }) => {
  const lap = await new Figure(page, 'fastslam-lap').alone('#fastslam-lap?v=14&universes=8&step=3')
  await expect(lap.alert).toContainText('version 14 of the figure')
  await lap.settled()
  expect(await lap.position()).toBe(3)
  await lap.openSettings()
  await expect(lap.box('universes')).toHaveValue('8')
  await page.evaluate(() => (location.hash = 'fastslam-lap?universes=4&step=9'))
  await expect.poll(() => lap.position()).toBe(9)
  await lap.settled()
  await expect(lap.box('universes')).toHaveValue('4')
  await expect(lap.play).toBeVisible()
})

test('a copied link opens the very same state', async ({ page, context }) => {
  const lap = await new Figure(page, 'fastslam-lap').alone()
  await lap.openSettings()
  await lap.box('universes').fill('8')
  await lap.box('universes').press('Enter')
  await lap.box('odometry').fill('1.35')
  await lap.box('odometry').press('Enter')
  await lap.element.locator('select[name=proposal]').selectOption('motion')
  await lap.element.locator('input[name=raw]').click()
  await lap.element.locator('select[name=universe]').selectOption('3')
  await lap.reroll.click()
  await lap.scrubTo(31)
  await lap.menu('Copy link')
  await expect(lap.element.getByText('Link copied')).toBeVisible()
  const link = await page.evaluate(() => navigator.clipboard.readText())
  expect(link).toContain('#fastslam-lap?')

  const other = await new Figure(await context.newPage(), 'fastslam-lap').open(link)
  await other.settled()
  await expect(other.alert).toBeEmpty()
  expect(await other.position()).toBe(31)
  expect(await other.readouts()).toEqual(await lap.readouts())
  expect(await other.seed.inputValue()).toBe(await lap.seed.inputValue())
  await other.openSettings()
  await expect(other.box('universes')).toHaveValue('8')
  await expect(other.box('odometry')).toHaveValue('1.35')
  await expect(other.element.locator('select[name=universe]')).toHaveValue('3')
  await lap.menu('Compare with nothing') // what was set before is in no link
  await lap.settled()
  expect(await other.picture()).toBe(await lap.picture())
})

test('bad links are refused with the parameter and its range, and the rest of each is applied', async ({ page }) => {
  const lap = new Figure(page, 'fastslam-lap')
  let step = 6
  // What each figure refuses, and how, is in `widgets/tests/all/figures.rs`.
  for (const [what, query, parameter, range] of [
    ['markup', `seed=${encodeURIComponent('<img src=x onerror=alert(1)>')}`, 'seed', /0 to 4294967295/],
    ['broken escapes', 'seed=%E0%A4%A', 'seed', /0 to 4294967295/],
    ['a number out of range', 'universes=999', 'universes', /1 to 256/],
    ['a word for a number', 'odometry=lots', 'odometry', /0 to 2/],
    ['an unknown choice', 'proposal=psychic', 'proposal', /aware, motion/],
    ['an unknown name', 'nonsense=1', 'nonsense', /universes/],
  ] as const) {
    await test.step(what, async () => {
      const link = `#fastslam-lap?${query}&step=${++step}`
      if (page.url() === 'about:blank') await lap.alone(link)
      else await page.evaluate(link => (location.hash = link), link)
      await expect(lap.alert).toContainText(parameter)
      await expect(lap.alert).toContainText(range)
      await expect.poll(() => lap.position()).toBe(step)
      await lap.openSettings()
      await expect(lap.box('universes')).toHaveValue('16')
      await lap.alert.getByRole('button', { name: 'Dismiss' }).click()
      await expect(lap.alert).toBeEmpty()
    })
  }
})

test('a link for one figure leaves the others alone', async ({ page }) => {
  await new Figure(page, 'fastslam-lap').alone()
  const first = new Figure(page, 'fastslam-lap:not(#added)')
  const added = await addFigure(page, {})
  const before = await first.readouts()
  await page.evaluate(() => (location.hash = 'added?seed=77&step=4'))
  await expect.poll(() => added.position()).toBe(4)
  await first.element.scrollIntoViewIfNeeded()
  await first.settled()
  expect(await first.readouts()).toEqual(before)
})

test('attributes set the parameters, at any time, and taking one away gives the default; those of the platform and of frameworks are no mistakes', async ({ page }) => {
  await new Figure(page, 'fastslam-lap').alone()
  const parameters = { universes: '8', seed: '42', proposal: 'motion', 'range-std': '0.1', raw: '', step: '5' }
  const others = { class: 'a', 'data-x': '1', 'aria-label': 'x', title: 't', lang: 'en', tabindex: '0', '_ngcontent-abc': '', 'v-if': 'a' }
  const lap = await addFigure(page, { ...others, ...parameters })
  await expect(lap.alert).toBeEmpty()
  expect(await lap.position()).toBe(5)
  await lap.openSettings()
  await expect(lap.box('universes')).toHaveValue('8')
  await expect(lap.seed).toHaveValue('42')
  await expect(lap.box('range-std')).toHaveValue('0.1')
  await expect(lap.element.locator('select[name=proposal]')).toHaveValue('motion')
  await expect(lap.element.locator('input[name=raw]')).toBeChecked()
  await lap.element.evaluate(element => {
    element.setAttribute('universes', '5')
    element.removeAttribute('seed')
  })
  await expect(lap.box('universes')).toHaveValue('5')
  await expect(lap.seed).toHaveValue('9')
})

test('properties set the parameters, before and after the figure is live', async ({ page }) => {
  await new Figure(page, 'fastslam-lap').alone()
  await page.evaluate(() => {
    const early = document.createElement('fastslam-lap')
    Object.assign(early, { id: 'added', universes: 6, rangeStd: 0.12, step: 7 })
    document.querySelector('main')!.prepend(early)
  })
  const lap = new Figure(page, '#added')
  await lap.element.scrollIntoViewIfNeeded()
  await lap.live()
  expect(await lap.position()).toBe(7)
  await lap.openSettings()
  await expect(lap.box('universes')).toHaveValue('6')
  await expect(lap.box('range-std')).toHaveValue('0.12')
  const read = await lap.element.evaluate(element => {
    const figure = element as unknown as { universes: number; truth: boolean; proposal: string; currentStep: number; step(): void }
    figure.truth = !figure.truth
    figure.step()
    return [figure.universes, typeof figure.truth, figure.proposal, figure.currentStep]
  })
  expect(read).toEqual([6, 'boolean', 'aware', 8])
})

test('properties set while the page does not know them yet are kept', async ({ page }) => {
  await page.setViewportSize({ width: 1000, height: 300 })
  await openCourse(page, '<p style="height: 3000px">Not yet.</p><fastslam-lap></fastslam-lap>')
  const lap = new Figure(page, 'fastslam-lap')
  await lap.element.evaluate(element => Object.assign(element, { universes: 6, rangeStd: 0.12 }))
  await lap.element.scrollIntoViewIfNeeded()
  await lap.live()
  await lap.openSettings()
  await expect(lap.box('universes')).toHaveValue('6')
  await expect(lap.box('range-std')).toHaveValue('0.12')
  await lap.element.evaluate(element => Object.assign(element, { universes: 7 }))
  await expect(lap.box('universes')).toHaveValue('7')
})

test('bad attributes are refused with their range; the default is kept and no other figure suffers', async ({ page }) => {
  await new Figure(page, 'fastslam-lap').alone()
  const first = new Figure(page, 'fastslam-lap:not(#added)')
  for (const [name, value, range] of [
    ['universes', '0', /1 to 256/],
    ['universes', 'sixteen', /1 to 256/],
    ['range-std', '-1', /0.01 to 0.3/],
    ['proposal', 'best', /aware, motion/],
    ['theme', 'blue', /light, dark or auto/],
    ['particles', '16', /universes/],
  ] as const) {
    await test.step(`${name}="${value}"`, async () => {
      const lap = await addFigure(page, { [name]: value })
      await expect(lap.alert).toContainText(name)
      await expect(lap.alert).toContainText(range)
      await expect(first.alert).toBeEmpty()
      await lap.openSettings()
      await expect(lap.box('universes')).toHaveValue('16')
      expect((await lap.readouts())['step']).toBeDefined()
      await lap.element.evaluate((element, bad) => element.removeAttribute(bad), name)
      await expect(lap.alert).toBeEmpty()
      await lap.element.evaluate(element => element.parentElement!.remove())
    })
  }
})

test('a bad value typed into a box is refused, and the box goes back', async ({ page }) => {
  const lap = await new Figure(page, 'fastslam-lap').alone()
  await lap.openSettings()
  const before = await lap.readouts()
  await lap.box('universes').fill('300')
  await lap.box('universes').press('Enter')
  await expect(lap.alert).toContainText(/universes.*1 to 256/)
  await expect(lap.box('universes')).toHaveValue('16')
  expect(await lap.readouts()).toEqual(before)
  await lap.box('universes').fill('12')
  await lap.box('universes').press('Enter')
  await expect(lap.alert).toBeEmpty()
})

test('where the clipboard is refused, the link is shown', async ({ page }) => {
  await page.addInitScript(() => {
    navigator.clipboard.writeText = () => Promise.reject(new Error('refused'))
  })
  const lap = await new Figure(page, 'fastslam-lap').alone()
  await lap.scrubTo(3)
  await lap.menu('Copy link')
  await expect(lap.alert).toContainText(/#fastslam-lap\?v=13&\S*step=3/)
})

/** Every way in which an author's value comes to a figure. */
const WAYS = {
  'a parsed tag': '<fastslam-lap universes="8" lock="LOCK"></fastslam-lap>',
  'a tag made by a script': `<script type="module">
    import './fastslam.js'
    const lap = document.createElement('fastslam-lap')
    lap.setAttribute('universes', '8')
    lap.setAttribute('lock', 'LOCK')
    document.body.append(lap)
  </script>`,
  'a tag made before its class was known': `<script>
    const lap = document.createElement('fastslam-lap')
    lap.setAttribute('universes', '8')
    lap.setAttribute('lock', 'LOCK')
    document.body.append(lap)
  </script>`,
  'a copy': `<script type="module">
    import './fastslam.js'
    const lap = document.createElement('fastslam-lap')
    lap.setAttribute('universes', '8')
    lap.setAttribute('lock', 'LOCK')
    document.body.append(lap.cloneNode())
  </script>`,
  'a property': `<script type="module">
    import './fastslam.js'
    const lap = document.createElement('fastslam-lap')
    lap.universes = 8
    lap.setAttribute('lock', 'LOCK')
    document.body.append(lap)
  </script>`,
  'a property set before its class was known': `<script>
    const lap = document.createElement('fastslam-lap')
    lap.universes = 8
    lap.setAttribute('lock', 'LOCK')
    document.body.append(lap)
  </script>`,
}

const universes = (lap: Figure) => lap.element.evaluate(element => (element as HTMLElement & { universes: number }).universes)

for (const [way, body] of Object.entries(WAYS)) {
  test(`a link stands over ${way}, and what is locked over the link`, async ({ page }) => {
    const lap = new Figure(page, 'fastslam-lap')
    for (const [link, lock, expected] of [
      ['#fastslam-lap?universes=4&step=5', '', 4],
      ['#fastslam-lap?step=5', '', 16], // the whole state: what it does not name is at its default
      ['#fastslam-lap?universes=4&step=5', 'universes', 8],
    ] as const) {
      await page.unrouteAll()
      await page.goto('about:blank')
      await openCourse(page, body.replace('LOCK', lock), { link })
      await lap.live()
      expect(await universes(lap), `${link}, locked: ${lock}`).toBe(expected)
      expect(await lap.position()).toBe(5)
      await expect(lap.box('universes')).toHaveValue(String(expected))
    }
  })
}

test('without a link, what the author gives stands over the default, locked or not', async ({ page }) => {
  const bodies = Object.values(WAYS).flatMap(body => ['', 'universes'].map(lock => body.replace('LOCK', lock)))
  // Each within a function, so that names do not meet.
  await openCourse(page, bodies.map(body => body.replace(/(<script>)([^]*)(<\/script>)/, '$1{$2}$3')).join(''))
  await expect(page.locator('fastslam-lap')).toHaveCount(bodies.length)
  for (const i of bodies.keys()) {
    const lap = new Figure(page, `fastslam-lap >> nth=${i}`)
    await lap.element.scrollIntoViewIfNeeded()
    await lap.live()
    const markup = await lap.element.evaluate(element => element.outerHTML)
    expect(await universes(lap), markup).toBe(8)
    expect(await lap.position(), markup).toBe(0)
    await expect(lap.box('universes'), markup).toHaveValue('8')
  }
})

test('an attribute that is set is the property that is read, before the figure lives and after, in the page and out of it', async ({ page }) => {
  const read = (lap: Figure) =>
    lap.element.evaluate(element => {
      const figure = element as HTMLElement & { universes?: number; raw?: boolean }
      const values: unknown[] = []
      for (const text of ['5', '7']) {
        figure.setAttribute('universes', text)
        values.push(figure.universes)
      }
      figure.universes = 9
      values.push(figure.universes)
      figure.setAttribute('universes', '6')
      values.push(figure.universes)
      figure.remove()
      figure.setAttribute('universes', '3')
      values.push(figure.universes)
      document.body.append(figure)
      values.push(figure.universes)
      return values
    })
  const lap = new Figure(page, 'fastslam-lap')
  for (const link of ['', '#fastslam-lap?universes=4']) {
    await page.unrouteAll()
    await page.goto('about:blank')
    let answer = () => {}
    const answered = new Promise<void>(done => (answer = done))
    await page.route('**/*.wasm', async route => {
      await answered
      await route.continue()
    })
    await openCourse(page, '<fastslam-lap></fastslam-lap>', { link })
    await page.evaluate(() => customElements.whenDefined('fastslam-lap').then(() => undefined))
    expect(await read(lap)).toEqual([5, 7, 9, 6, 3, 3])
    answer()
    await lap.live()
    await expect(lap.box('universes')).toHaveValue('3')
    expect(await read(lap)).toEqual([5, 7, 9, 6, 3, 3])
    await lap.element.evaluate(element => element.removeAttribute('universes'))
    await expect(lap.box('universes')).toHaveValue('16')
  }
})

for (const address of ['embed.html?figure=lap&', 'embed-lap.html?']) {
  test(`in a frame, a link stands over the parameters of its address: ${address}`, async ({ page }) => {
    const lap = await new Figure(page, 'fastslam-lap').open(`./${address}universes=8&seed=5&step=10#fastslam-lap?v=13&universes=4&step=20`)
    expect(await lap.position()).toBe(20)
    await expect(lap.box('universes')).toHaveValue('4')
    await expect(lap.seed).toHaveValue('17')
    const link = await lap.element.evaluate(element => (element as HTMLElement & { link: string }).link)
    expect(link.split('#')[1], 'what is copied is what was opened').toBe('fastslam-lap?v=13&universes=4&step=20')
    await lap.reset.click()
    await expect.poll(() => lap.position()).toBe(10)
    await expect(lap.box('universes')).toHaveValue('8')
  })
}

for (const [how, address, head] of [
  ['under a base address', 'site', '<base href="https://elsewhere.example/assets/" />'],
  ['that routes by its path', 'site/lesson/3', ''],
  ['that routes by its query', 'site?page=lesson/3&x', ''],
  ['that routes by its fragment', 'site#/lesson/3?tab=1', '<script>addEventListener("DOMContentLoaded", () => /^#\\/lesson\\/3\\?tab=1$/.test(location.hash) || document.body.replaceChildren("404"))</script>'],
] as const) {
  test(`on a site ${how}, what a figure copies opens again`, async ({ page, baseURL }) => {
    const open = async (address: string) => {
      await page.goto('about:blank')
      await page.goto(address)
      const lap = new Figure(page, 'fastslam-lap')
      await lap.live()
      return lap
    }
    const html = `<!doctype html><html lang="en"><head><title>Course</title><link rel="icon" href="data:," />${head}<script type="module" src="${baseURL}fastslam.js"></script></head><body><fastslam-lap universes="4"></fastslam-lap></body></html>`
    await page.route(url => url.pathname.startsWith('/site'), route => route.fulfill({ contentType: 'text/html', body: html }))
    const lap = await open(`${baseURL}${address}`)
    await lap.scrubTo(3)
    const state = await lap.state()
    await lap.menu('Copy link')
    await expect(lap.element.getByText('Link copied')).toBeVisible()
    const again = await open(await page.evaluate(() => navigator.clipboard.readText()))
    expect(await again.state()).toBe(state)
    expect(await again.position()).toBe(3)
  })
}

test('a page that its host puts aside as a copy, and takes back, has the state that the reader left', async ({ page }) => {
  const lap = await new Figure(page, 'fastslam-lap').alone()
  await lap.goTo('v=13&universes=4&step=7')
  const left = await lap.state()
  // As Turbo does it: the copy is made of the page, which another takes the place of, and Back puts the copy there.
  await page.evaluate(() => {
    document.dispatchEvent(new Event('turbo:before-cache'))
    const copy = document.body.cloneNode(true)
    document.body.replaceWith(document.createElement('body'))
    document.body.replaceWith(copy)
  })
  await lap.live()
  expect(await lap.state()).toBe(left)
  expect(await lap.position()).toBe(7)
  await expect(lap.element).not.toHaveAttribute('data-state')
  // What is put aside again is what is there then.
  await lap.step.click()
  expect(await lap.position()).toBe(8)
})
