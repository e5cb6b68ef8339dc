// Versions that are kept: the code for one runs, and where a byte of what it loads is another, nothing of that is run.
import type { Page } from '@playwright/test'
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { forgiveHost, openHost } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

/** What the page on embedding says for a figure, to be kept as it is. */
async function keptCode(page: Page): Promise<string> {
  await page.goto('./embed/?figure=lap&v=13&universes=4&step=3')
  await new Figure(page, '#preview fastslam-lap').live()
  await page.getByLabel('Into').selectOption('kept')
  await expect(page.locator('.codes')).toContainText(/version \d+\.\d+\.\d+/)
  return (await page.locator('.codes code').textContent())!
}

/** Another byte at the end of what is fetched. */
const changed = (page: Page, files: RegExp) =>
  page.route(files, async route => {
    const response = await route.fetch()
    await route.fulfill({ response, body: Buffer.concat([await response.body(), Buffer.from('\n')]) })
  })

test('the code for a version runs on a page of another site, from the folder of that version alone', async ({ page, baseURL, complaints }) => {
  const code = await keptCode(page)
  expect(code).toMatch(new RegExp(`^<script type="module" src="${baseURL}v/[\\w.]+/fastslam\\.js" integrity="sha384-[\\w+/]{64}" crossorigin></script>\n<fastslam-lap v="13" universes="4" step="3"><p slot="no-script"><a href="${baseURL}v/[\\w.]+/embed-lap\\.html">`))
  const asked: string[] = []
  page.on('request', request => request.url().startsWith(baseURL!) && asked.push(request.url()))
  await openHost(page, code)
  const lap = new Figure(page, 'fastslam-lap')
  await lap.live()
  expect(await lap.position()).toBe(3)
  expect(asked.filter(url => !url.startsWith(`${baseURL}v/`))).toEqual([])
  expect(asked.some(url => url.endsWith('.wasm'))).toBe(true)
  // The chapter, and the page on embedding, are those of the site.
  const [opened] = await Promise.all([page.context().waitForEvent('page'), lap.menu('Use this in class…')])
  await expect(opened).toHaveURL(`${baseURL}embed/?figure=lap&v=13&universes=4&step=3`)
  forgiveHost(complaints)
})

for (const [what, files] of [
  ['fastslam.js', /\/v\/[^/]+\/fastslam\.js$/],
  ['the script that the figures share', /\/v\/[^/]+\/fastslam-[\w-]{8}\.js$/],
  ['a script of its own', /\/v\/[^/]+\/assets\/fastslam-lap-[\w-]{8}\.js$/],
] as const) {
  test(`where a byte of ${what} is another, its picture stands there, leads to it, and says why`, async ({ page, baseURL, complaints }) => {
    const code = await keptCode(page)
    await changed(page, files)
    const refused = page.waitForEvent('console', line => /integrity/i.test(line.text()))
    await openHost(page, code)
    await refused
    const lap = page.locator('fastslam-lap')
    await expect(lap).toContainText('its script has not arrived')
    await expect(lap.getByRole('link')).toHaveAttribute('href', new RegExp(`^${baseURL}v/[\\w.]+/embed-lap\\.html$`))
    await expect.poll(() => lap.locator('img').evaluate((image: HTMLImageElement) => image.complete && image.naturalWidth)).toBeGreaterThan(300)
    expect(await page.evaluate(() => customElements.get('fastslam-lap') === undefined)).toBe(true)
    complaints.splice(0)
  })
}

test('where a byte of its program is another, the figure says so over its picture', async ({ page, complaints }) => {
  const code = await keptCode(page)
  await changed(page, /\/v\/.*\.wasm$/)
  await openHost(page, code)
  const lap = new Figure(page, 'fastslam-lap')
  await expect(lap.alert).toContainText('could not be fetched')
  await expect(lap.element.locator('.fallback img')).toBeVisible()
  complaints.splice(0)
})

test('the pages for frames of a version show the figure from its folder', async ({ page, baseURL, request }) => {
  const versions = (await (await request.get('./v/versions.json')).json()) as Record<string, string>
  const asked: string[] = []
  page.on('request', request => asked.push(request.url()))
  await page.goto(`./v/${Object.keys(versions).at(-1)}/embed.html?figure=lap&v=13&universes=4&step=3`)
  const lap = new Figure(page, 'fastslam-lap')
  await lap.live()
  expect(await lap.position()).toBe(3)
  expect(asked.filter(url => url.startsWith(baseURL!) && !url.startsWith(`${baseURL}v/`))).toEqual([])
})
