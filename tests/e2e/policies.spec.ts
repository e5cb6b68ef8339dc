// Pages whose policies are strict, hosts that send too little, and files that do not arrive: a figure lives, or says why it does not.
import { readFileSync } from 'node:fs'
import { createServer } from 'node:http'
import type { AddressInfo } from 'node:net'
import { join } from 'node:path'
import type { Page } from '@playwright/test'
import { root } from '../../scripts/lib.mjs'
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { forgiveHost, openHost } from './host'
import { LogFigure } from './log-figure'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

const ANYONE = { 'Access-Control-Allow-Origin': '*' }
const ISOLATED = { 'Cross-Origin-Embedder-Policy': 'require-corp', 'Cross-Origin-Opener-Policy': 'same-origin' }

/** The code that a figure copies. */
async function codeOf(page: Page, name: 'element' | 'iframe', tag = 'fastslam-lap'): Promise<string> {
  await page.goto(`./embed-${tag.replace('fastslam-', '')}.html`)
  // The element may be there before its class.
  return page.locator(tag).evaluate(async (figure, name) => {
    await customElements.whenDefined(figure.localName)
    return (figure as HTMLElement & { embedCode(name: string): string }).embedCode(name)
  }, name)
}

/** Maps a log, which needs a worker. */
async function map(page: Page): Promise<void> {
  const log = new LogFigure(page)
  await log.choose('tiny.clf', readFileSync(join(root, 'tests', 'figures', 'golden', 'tiny.clf')))
  await log.button('Map this building').click()
  await log.done()
}

for (const own of [true, false]) {
  test(`where scripts need trusted types, a log is mapped and seeds are counted, with ${own ? 'the figures’ files on the page’s own site' : 'figures from another site'}`, async ({ page, baseURL, complaints }) => {
    const sources = own ? "'self'" : `'self' blob: ${new URL(baseURL!).origin}`
    const policy = `require-trusted-types-for 'script'; trusted-types fastslam; script-src ${sources} 'wasm-unsafe-eval'; worker-src ${sources}`
    const head = `<script type="module" src="${baseURL}fastslam.js"></script>`
    const body = '<fastslam-log universes="2" cell="0.2"></fastslam-log><fastslam-resampling></fastslam-resampling>'
    if (own) {
      await page.route('**/course', route => route.fulfill({ contentType: 'text/html', headers: { 'Content-Security-Policy': policy }, body: `<!doctype html><html lang="en"><title>Course</title><link rel="icon" href="data:," />${head}${body}</html>` }))
      await page.goto('./course')
    } else await openHost(page, body, head, { 'Content-Security-Policy': policy })
    // The policy is in force.
    expect(await page.evaluate(() => { try { return String(new Worker('data:,')) } catch (error) { return (error as Error).name } })).toBe('TypeError')
    await map(page)
    const resampling = new Figure(page, 'fastslam-resampling')
    await resampling.element.scrollIntoViewIfNeeded()
    await resampling.live()
    await resampling.openCount()
    await resampling.element.locator('[part=count] button').first().click()
    await expect.poll(() => resampling.element.locator('[part=count] progress').evaluate((bar: HTMLProgressElement) => bar.value)).toBeGreaterThan(0)
    if (!own) forgiveHost(complaints)
    // Of the test's own try, and of no other.
    expect(complaints.splice(0)).toEqual([expect.stringContaining('TrustedScriptURL')])
  })
}

test('on a page that is isolated from other origins, frames and elements of ours live, also beside a worker', async ({ page, baseURL, complaints }) => {
  const address = (name: string) => `${baseURL}embed.html?figure=${name}`
  const frames = [`<iframe title="plain" width="832" height="700" src="${address('proposal')}"></iframe>`, `<iframe title="sandboxed" sandbox="allow-scripts" width="832" height="700" src="${address('proposal')}"></iframe>`, `<iframe title="log" width="832" height="700" src="${address('log')}&universes=2&cell=0.2"></iframe>`, await codeOf(page, 'iframe')]
  await openHost(page, `<fastslam-log universes="2" cell="0.2"></fastslam-log>${frames.join('')}`, `<script type="module" src="${baseURL}fastslam.js"></script>`, ISOLATED)
  expect(await page.evaluate(() => crossOriginIsolated)).toBe(true)
  await map(page)
  for (const [i, tag] of ['fastslam-proposal', 'fastslam-proposal', 'fastslam-log', 'fastslam-lap'].entries()) {
    const frame = page.frameLocator('iframe').nth(i)
    await page.locator('iframe').nth(i).scrollIntoViewIfNeeded()
    if (tag === 'fastslam-log') {
      await frame.locator('input[type=file]').setInputFiles(join(root, 'tests', 'figures', 'golden', 'tiny.clf'))
      await frame.getByRole('button', { name: 'Map this building', exact: true }).click()
      await expect(frame.locator('[part=sentence]')).toContainText('All scans are mapped')
    } else await expect(frame.locator(`${tag} .stage.live`)).toBeVisible()
  }
  forgiveHost(complaints)
})

test('a frame is offered in a code that also isolated pages take from a host that sends no headers for them', async ({ page }) => {
  expect(await codeOf(page, 'iframe')).toMatch(/^<iframe [^>]* credentialless /)
})

/** Our site as a host serves it that sends no header that it need not, without some of its files. Gives its address. */
async function poorHost(page: Page, baseURL: string, missing: RegExp, headers: Record<string, string> = {}): Promise<string> {
  const server = createServer(async (request, response) => {
    const answer = await fetch(new URL(`.${request.url}`, baseURL))
    const gone = missing.test(request.url!)
    response.writeHead(gone ? 404 : answer.status, { 'Content-Type': gone ? 'text/plain' : answer.headers.get('Content-Type')!, ...headers })
    response.end(gone ? 'gone' : Buffer.from(await answer.arrayBuffer()))
  })
  await new Promise<void>(done => server.listen(0, '127.0.0.1', done))
  page.once('close', () => server.close())
  return `http://127.0.0.1:${(server.address() as AddressInfo).port}/`
}

for (const [what, missing, sandbox, why] of [
  ['without CORS, sandboxed', /^$/, 'sandbox="allow-scripts"', 'Access-Control-Allow-Origin'],
  ['without its script', /^\/assets\/embed-.*\.js$/, '', 'the server answered 404'],
  ['renewed since', /^\/fastslam-.*\.js$/, '', 'load this page again'],
] as const) {
  test(`a frame from a host ${what} names the cause and shows the picture`, async ({ page, baseURL, complaints }) => {
    const home = await poorHost(page, baseURL!, missing)
    await openHost(page, ['embed.html?figure=lap', 'embed-lap.html'].map(address => `<iframe title="lap" ${sandbox} width="832" height="700" src="${home}${address}"></iframe>`).join(''))
    for (const i of [0, 1]) {
      const frame = page.frameLocator('iframe').nth(i)
      await expect(frame.locator('.blocked')).toContainText(why)
      await expect(frame.locator('img')).toBeVisible({ timeout: 2000 })
      expect((await frame.locator('img').boundingBox())!.width, 'it fits the frame').toBeLessThanOrEqual(832)
      expect(await frame.locator('img').evaluate((image: HTMLImageElement) => image.decode().then(() => image.naturalWidth))).toBeGreaterThan(300)
    }
    complaints.splice(0)
  })
}

for (const [what, missing] of [
  ['script', /^\/fastslam\.js$/],
  ['file with a hash in its name, of a host that was renewed', /^\/fastslam-.*\.js$/],
] as const) {
  test(`an element as it is copied, without its ${what}, is its picture, which leads to it, and says why`, async ({ page, baseURL, complaints }) => {
    const home = await poorHost(page, baseURL!, missing, ANYONE)
    const code = (await codeOf(page, 'element')).replaceAll(baseURL!, home)
    for (const [around, width] of [['width: 700px', 700], ['display: flex; width: 700px', 700], ['width: 300px', 300]] as const) {
      await openHost(page, `<div style="${around}">${code}</div>`)
      const lap = page.locator('fastslam-lap')
      await expect(lap).toContainText('its script has not arrived')
      await expect(lap.getByRole('link')).toHaveAttribute('href', `${home}embed-lap.html`)
      await expect.poll(() => lap.locator('img').evaluate((image: HTMLImageElement) => image.complete && image.naturalWidth)).toBeGreaterThan(300)
      const { width: wide, height } = (await lap.locator('img').boundingBox())!
      expect(wide).toBeGreaterThan(0.9 * Math.min(width, 832))
      expect(wide).toBeLessThanOrEqual(width)
      expect(height).toBeGreaterThan(100)
    }
    complaints.splice(0)
  })
}

test('an element without anything in it is its picture and says why, where the file with its hash is gone', async ({ page, baseURL, complaints }) => {
  const home = await poorHost(page, baseURL!, /^\/(assets\/figures|fastslam)-.*\.js$/, ANYONE)
  const script = `<script type="module" src="${home}fastslam.js"></script>`
  await openHost(page, `${script}<fastslam-lap></fastslam-lap><fastslam-log lang="de"></fastslam-log><fastslam-em><b>of the author</b></fastslam-em>`)
  for (const [tag, words] of [['lap', 'its script has not arrived'], ['log', 'Skript ist nicht angekommen']] as const) {
    const figure = page.locator(`fastslam-${tag}`)
    await expect(figure.getByRole('link')).toHaveAttribute('href', `${home}embed-${tag}.html`)
    await expect(figure).toContainText(words)
    await expect.poll(() => figure.locator('img').evaluate((image: HTMLImageElement) => image.complete && image.naturalWidth)).toBeGreaterThan(300)
  }
  await expect(page.locator('fastslam-em')).toHaveText('of the author')
  complaints.splice(0)
})

test('a script that a browser has kept from before the site was renewed finds the files of now', async ({ page, baseURL, complaints }) => {
  await page.route(`${baseURL}fastslam.js`, async route => {
    const response = await route.fetch()
    await route.fulfill({ response, body: (await response.text()).replace(/figures-[\w-]{8}/, 'figures-of-long-ago').replace(/fastslam-[\w-]{8}\.js/, 'fastslam-of-long-ago.js') })
  })
  await openHost(page, `<script type="module">import { FastslamLap } from '${baseURL}fastslam.js'; document.querySelector('fastslam-lap').title = FastslamLap.name</script><fastslam-lap></fastslam-lap>`)
  await new Figure(page, 'fastslam-lap').live()
  await expect(page.locator('fastslam-lap')).toHaveAttribute('title', /./)
  forgiveHost(complaints)
  expect(complaints.splice(0).filter(line => !/of-long-ago|404/.test(line) && !line.startsWith('left the site'))).toEqual([])
})

test('of what stands for a missing script nothing is left when it has arrived, on paper either, nor where the program then fails', async ({ page, baseURL, complaints }) => {
  const code = await codeOf(page, 'element')
  await openHost(page, code)
  const lap = new Figure(page, 'fastslam-lap')
  await lap.live()
  await expect(lap.element.locator('p[slot]')).toBeHidden()
  await page.emulateMedia({ media: 'print' })
  await expect(lap.canvas).toBeVisible()
  await expect(lap.element.locator('p[slot]')).toBeHidden()
  await page.emulateMedia({ media: 'screen' })
  await page.route('**/*.wasm', route => route.abort())
  await page.reload()
  await expect(lap.alert).toContainText('could not be fetched')
  await expect(lap.element.locator('p[slot]')).toBeHidden()
  await expect(lap.element.locator('.fallback img')).toBeVisible()
  forgiveHost(complaints)
  complaints.splice(0, Infinity, ...complaints.filter(line => !/ERR_FAILED/.test(line) && !line.includes(baseURL!)))
})
