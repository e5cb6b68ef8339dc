// Paper shows the states that were asked for, says what it does not show, and where all of it is to be had again.
import type { Page } from '@playwright/test'
import { expect, test } from './fixtures'
import { Figure, holdPrograms, openChapterOf } from './figure'
import { openCourse } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

/** Links on paper. */
const linksOf = async (page: Page): Promise<string[]> => [...(await page.pdf()).toString('latin1').matchAll(/\/URI \(([^)]*)\)/g)].map(match => match[1]!)

/** What the page does when it prints: in place of the printer, and of the browser's own event. */
async function withoutPrinter(page: Page): Promise<() => Promise<string[] | undefined>> {
  await page.addInitScript(() => {
    self.print = () => {
      dispatchEvent(new Event('beforeprint'))
      const figures = [...document.querySelectorAll('*')].filter(({ localName }) => /^fastslam-(?!lap-table)/.test(localName))
      Object.assign(self, { printed: figures.filter(({ shadowRoot }) => shadowRoot!.querySelector('.stage.live')).map(({ localName }) => localName) })
      dispatchEvent(new Event('afterprint'))
    }
  })
  return () => page.evaluate(() => (self as unknown as { printed?: string[] }).printed)
}

test('a figure that nobody has seen is on paper in the state that its author asked for, with the link to it', async ({ page, baseURL }) => {
  await page.setViewportSize({ width: 1000, height: 500 })
  await openCourse(page, '<fastslam-lap v="latest"></fastslam-lap><p style="height: 4000px">Not yet.</p><fastslam-lap v="latest" universes="4" step="30"></fastslam-lap><fastslam-doors lang="de"></fastslam-doors>', { lang: 'en' })
  await new Figure(page, 'fastslam-lap >> nth=0').live()
  const lap = new Figure(page, 'fastslam-lap >> nth=1')
  expect(await lap.element.locator('.stage.live').count(), 'it is out of sight').toBe(0)
  const links = await linksOf(page)
  expect(links).toContain(`${baseURL}course?#fastslam-lap.2?v=13&universes=4&step=30`)
  expect(links).toContain(`${baseURL}course?#fastslam-doors?`)
  expect(await page.evaluate(() => scrollY)).toBe(0)
  const printed = [await lap.sentence.textContent(), await lap.readouts()]
  expect(await lap.position()).toBe(30)
  await lap.element.scrollIntoViewIfNeeded()
  await lap.live()
  expect([await lap.sentence.textContent(), await lap.readouts()]).toEqual(printed)
  expect(await lap.element.locator('.paper').textContent()).not.toContain('default')
})

test('on paper a dark figure is light, and dark again after it', async ({ page }) => {
  await page.emulateMedia({ colorScheme: 'dark' })
  await openCourse(page, '<fastslam-lap step="3"></fastslam-lap><fastslam-lap theme="dark" step="3"></fastslam-lap>')
  for (const nth of [0, 1]) {
    const lap = new Figure(page, `fastslam-lap >> nth=${nth}`)
    await lap.element.scrollIntoViewIfNeeded()
    await lap.live()
    const paper = () =>
      lap.canvas.evaluate((canvas: HTMLCanvasElement) => {
        const copy = new OffscreenCanvas(1, 1).getContext('2d')!
        copy.drawImage(canvas, 0, 0)
        return copy.getImageData(0, 0, 1, 1).data[0]!
      })
    expect(await paper()).toBeLessThan(60)
    await page.evaluate(() => dispatchEvent(new Event('beforeprint')))
    expect(await paper()).toBeGreaterThan(240)
    await page.evaluate(() => dispatchEvent(new Event('afterprint')))
    await lap.settled()
    expect(await paper()).toBeLessThan(60)
  }
})

test('a figure whose program is not there is its default picture, and says so; a picture of the page’s own is its author’s word', async ({ page }) => {
  const open = await holdPrograms(page)
  const pixel = 'data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=='
  await openCourse(page, `<fastslam-lap universes="4" step="30"></fastslam-lap><fastslam-doors step="3"><img src="${pixel}" alt="A dot" /></fastslam-doors><fastslam-joint><p slot="no-script"><img src="${pixel}" alt="" /></p></fastslam-joint>`)
  await page.evaluate(() => Promise.all(['lap', 'doors', 'joint'].map(name => customElements.whenDefined(`fastslam-${name}`))).then(() => undefined))
  await page.evaluate(() => dispatchEvent(new Event('beforeprint')))
  await page.emulateMedia({ media: 'print' })
  const [lap, doors] = [page.locator('fastslam-lap'), page.locator('fastslam-doors')]
  await expect(lap.locator('.fallback img')).toBeVisible()
  await expect(lap.getByText('default picture')).toBeVisible()
  await expect(lap.getByRole('link')).toHaveText(/#fastslam-lap\?v=8&universes=4&step=30$/)
  // What a copied code has in its tag until the script arrives is no picture of the author's.
  await expect(page.locator('fastslam-joint').getByText('default picture')).toBeVisible()
  await expect(doors.locator('img')).toBeVisible()
  await expect(doors.getByText('default picture')).toHaveCount(0)
  await expect(doors.getByRole('link')).toHaveText(/#fastslam-doors\?v=1&step=3$/)
  open()
})

test('the key for printing, on our own page, waits until all figures are there; what is printed is what they show', async ({ page }) => {
  const printed = await withoutPrinter(page)
  await page.setViewportSize({ width: 1000, height: 300 })
  const tags = ['fastslam-doors', 'fastslam-conditioning']
  await openChapterOf(page, tags)
  await page.evaluate(() => document.querySelector('main')!.prepend(Object.assign(document.createElement('p'), { style: 'height: 3000px' })))
  await page.keyboard.press('Control+p')
  await expect.poll(printed).toEqual(tags)
  await page.emulateMedia({ media: 'print' })
  for (const tag of tags) await expect(page.locator(`figure > ${tag} canvas`)).toBeVisible()
  // Each says itself where it is live.
  await expect(page.locator('figure > fastslam-doors').getByRole('link')).toHaveText(/\/#fastslam-doors\?/)
  await expect(page.locator('.address').filter({ visible: true })).toHaveCount(0)
})

test('the menu prints in a frame, by the code that is copied; where its sandbox forbids that, it says so', async ({ page, complaints }) => {
  const printed = await withoutPrinter(page)
  const open = async (sandbox: string) => {
    await page.route('**/framed', route => route.fulfill({ contentType: 'text/html', body: `<!doctype html><html lang="en"><title>Course</title><iframe sandbox="${sandbox}" width="900" height="700" src="./embed.html?figure=doors"></iframe>` }))
    await page.goto('./framed')
    const doors = new Figure(page.frames()[1]!, 'fastslam-doors')
    await doors.live()
    return doors
  }
  await page.goto('./embed-doors.html')
  const alone = new Figure(page, 'fastslam-doors')
  await alone.live()
  const sandbox = /sandbox="([^"]*)"/.exec(await alone.element.evaluate(element => (element as HTMLElement & { embedCode(name: string): string }).embedCode('iframe')))![1]!
  await alone.menu('Print…')
  await expect.poll(printed).toEqual(['fastslam-doors'])
  const doors = await open(sandbox)
  await doors.menu('Print…')
  await expect(doors.alert).toBeEmpty()
  expect(sandbox).toContain('allow-modals')
  // The browser's own word, as no page can have it.
  await page.addInitScript(() => (self.print = () => {}))
  const locked = await open('allow-scripts')
  await locked.menu('Print…')
  await expect(locked.alert).toContainText('allow-modals')
  complaints.splice(0)
})
