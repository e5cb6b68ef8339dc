// The files for offline use, opened as a double click does; and the SCORM packages in a run-time that learning systems are built on.
import { createServer } from 'node:http'
import { readFileSync, statSync } from 'node:fs'
import { createRequire } from 'node:module'
import type { AddressInfo } from 'node:net'
import { join } from 'node:path'
import { pathToFileURL } from 'node:url'
import { strFromU8, unzipSync } from 'fflate'
import { limit, offline, writeOffline } from '../../scripts/offline.mjs'
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { FIGURES, forgiveHost } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

// One worker, as what comes first is written once.
test.describe.configure({ mode: 'default' })

test.beforeAll(() => writeOffline())

for (const name of FIGURES) {
  test(`the file of ${name} lives from file:// and asks for nothing`, async ({ page, context }) => {
    const path = join(offline, `fastslam-${name}.html`)
    expect(statSync(path).size).toBeLessThanOrEqual(limit)
    const asked: string[] = []
    context.on('request', request => !/^(data|blob):/.test(request.url()) && asked.push(request.url()))
    const figure = new Figure(page, `fastslam-${name}`)
    const address = pathToFileURL(path).href
    await figure.open(address)
    await figure.reset.click()
    await figure.settled()
    await expect(figure.alert).toBeEmpty()
    expect(asked).toEqual([address])
    // There is no site to link frames to; the rest of the menu is there.
    await figure.element.locator('summary[aria-label=Menu]').click()
    await expect(figure.element.getByRole('button', { name: 'Copy code: Python' })).toBeVisible()
    await expect(figure.element.getByRole('button', { name: 'Copy code: iframe' })).toHaveCount(0)
  })
}

test('a count in the background runs from file:// too', async ({ page }) => {
  const figure = await new Figure(page, 'fastslam-resampling').open(pathToFileURL(join(offline, 'fastslam-resampling.html')).href)
  await figure.element.getByRole('button', { name: /Count over/ }).click()
  await expect(figure.element.getByRole('progressbar')).toHaveAttribute('value', /[1-9]/, { timeout: 30_000 })
})

test('the example is mapped from file:// too', async ({ page, context }) => {
  const path = join(offline, 'fastslam-log.html')
  expect(statSync(path).size).toBeLessThanOrEqual(limit)
  const asked: string[] = []
  context.on('request', request => !/^(data|blob):/.test(request.url()) && asked.push(request.url()))
  const address = pathToFileURL(path).href
  await page.goto(address)
  const figure = page.locator('fastslam-log')
  await figure.getByRole('button', { name: 'Run the example' }).click()
  await expect(figure.getByRole('progressbar')).toHaveAttribute('value', /^[1-9]\d/)
  expect(asked).toEqual([address])
})

test('the whole chapter lives from one file', async ({ page, context }) => {
  const asked: string[] = []
  context.on('request', request => !/^(data|blob):/.test(request.url()) && asked.push(request.url()))
  const address = pathToFileURL(join(offline, 'chapter.html')).href
  const lap = await new Figure(page, 'fastslam-lap').open(address)
  await lap.step.click()
  await lap.settled()
  expect(await lap.position()).toBe(1)
  expect(asked).toEqual([address])
})

test('a learning system that speaks SCORM 1.2 keeps the state and gives it back at the next visit', async ({ page, complaints }) => {
  const files = unzipSync(readFileSync(join(offline, 'fastslam-lap-scorm.zip')))
  expect(Object.keys(files).sort()).toEqual(['imsmanifest.xml', 'index.html', 'scorm.js'])
  const manifest = strFromU8(files['imsmanifest.xml']!)
  expect(manifest).toMatch(/<schemaversion>1\.2<\/schemaversion>/)
  const start = /adlcp:scormtype="sco" href="([^"]+)"/.exec(manifest)![1]!
  for (const [, file] of manifest.matchAll(/<file href="([^"]+)"/g)) expect(files[file!]).toBeDefined()

  // The learning system: a page with scorm-again around a frame, which keeps what the run-time commits.
  const runtime = readFileSync(createRequire(import.meta.url).resolve('scorm-again/scorm12'), 'utf8')
  const system = `<!doctype html><html lang="en"><head><title>LMS</title><link rel="icon" href="data:," /><script src="runtime.js"></script></head><body><script>
    const kept = JSON.parse(sessionStorage.kept ?? '{}')
    window.API = new Scorm12API({ logLevel: 5 })
    if (kept.cmi) API.loadFromJSON(kept.cmi, 'cmi')
    API.on('LMSCommit', () => (sessionStorage.kept = JSON.stringify({ cmi: API.renderCMIToJSONObject().cmi })))
    API.on('LMSFinish', () => (sessionStorage.finished = 'yes'))
  </script><iframe src="${start}" width="800" height="780"></iframe></body></html>`
  const types: Record<string, string> = { html: 'text/html', js: 'text/javascript' }
  const server = createServer(({ url }, response) => {
    const name = url!.slice(1).split('?')[0]!
    const body = name === 'lms' ? system : name === 'runtime.js' ? runtime : files[name]
    response.writeHead(body ? 200 : 404, { 'Content-Type': types[name.split('.')[1] ?? 'html']! }).end(body)
  })
  await new Promise<void>(done => server.listen(0, '127.0.0.1', done))
  const address = `http://127.0.0.1:${(server.address() as AddressInfo).port}/lms`
  const figure = () => page.frames()[1]!.locator('fastslam-lap')
  await page.goto(address)
  await expect(figure().locator('.stage.live')).toBeVisible()
  const universes = () => figure().locator('input[type=number][name=universes]')
  await figure().locator('details[part=settings] summary').click()
  await universes().fill('6')
  await universes().press('Enter')
  for (let i = 0; i < 3; i++) await figure().getByRole('button', { name: 'Step', exact: true }).click()
  await expect.poll(() => page.evaluate(() => sessionStorage['kept'] ?? ''), { timeout: 10_000 }).toContain('universes=6&step=3')
  expect(await page.evaluate(() => (window as unknown as { API: { LMSGetValue(name: string): string } }).API.LMSGetValue('cmi.core.lesson_status'))).toBe('completed')

  // The learner leaves, and comes back.
  await page.evaluate(() => document.querySelector('iframe')!.remove())
  await expect.poll(() => page.evaluate(() => sessionStorage['finished'] ?? '')).toBe('yes')
  await page.goto(address)
  await expect(figure().locator('.timeline .position')).toHaveText(/^3 \//)
  await figure().locator('details[part=settings] summary').click()
  await expect(universes()).toHaveValue('6')
  server.close()
  complaints.splice(0, Infinity, ...complaints.filter(line => !/^left the site: http:\/\/127\.0\.0\.1/.test(line)))
  forgiveHost(complaints)
})
