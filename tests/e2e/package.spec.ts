// The npm package as a course's developer meets it: packed, installed, and used with no bundler, in a fresh Vite project, and on a server.
import { execFileSync, spawn } from 'node:child_process'
import { mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import { cache, npmBin } from '../../scripts/lib.mjs'
import { packNpm } from '../../scripts/package.mjs'
import { startServer } from '../../scripts/serve.mjs'
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { breadth } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

const project = cache('e2e-package')
const page = (script: string) =>
  `<!doctype html><html lang="en"><head><title>Fresh</title><link rel="icon" href="data:," />${script}</head><body><fastslam-lap universes="4" step="3"></fastslam-lap></body></html>`

// One worker, as what comes first is written once.
test.describe.configure({ mode: 'default' })

test.beforeAll(async () => {
  const packed = await packNpm()
  rmSync(project, { recursive: true, force: true })
  mkdirSync(project, { recursive: true })
  const write = (name: string, text: string) => writeFileSync(join(project, name), text)
  write('package.json', JSON.stringify({ name: 'fresh', private: true, type: 'module' }))
  write('index.html', page('<script type="module" src="./main.js"></script>'))
  write('main.js', "import 'fastslam-widgets'\n")
  write('plain.html', page('<script type="module" src="node_modules/fastslam-widgets/dist/fastslam.js"></script>'))
  write('standalone.html', page('<script type="module" src="node_modules/fastslam-widgets/dist/standalone.js"></script>'))
  // What the package's README says of Vite.
  write('vite.config.js', "export default { base: './', optimizeDeps: { exclude: ['fastslam-widgets'] } }\n")
  // `node_modules` of ours lies above, with Vite in it: nothing is fetched.
  execFileSync('npm', ['install', '--no-audit', '--no-fund', '--offline', packed], { cwd: project, stdio: 'pipe' })
})

async function expectLive(browserPage: ConstructorParameters<typeof Figure>[0], address: string): Promise<void> {
  const lap = new Figure(browserPage, 'fastslam-lap')
  await lap.open(address)
  expect(await lap.position()).toBe(3)
  await lap.openSettings()
  await expect(lap.box('universes')).toHaveValue('4')
}

test('it is what its README says: exports with types, no word of the chapter, nothing missing', () => {
  const installed = join(project, 'node_modules', 'fastslam-widgets')
  const { exports, sideEffects } = JSON.parse(readFileSync(join(installed, 'package.json'), 'utf8'))
  const files = Object.values(exports).flatMap(target => (typeof target === 'string' ? [target] : Object.values(target as Record<string, string>)))
  for (const file of files) expect(readFileSync(join(installed, file)).length, file).toBeGreaterThan(0)
  expect(sideEffects).toContain('./dist/*.js')
  expect(readFileSync(join(installed, 'dist', 'licences.txt'), 'utf8')).toContain('SIL OPEN FONT LICENSE')
  expect(JSON.parse(readFileSync(join(installed, 'dist', 'sbom.cdx.json'), 'utf8')).components.length).toBeGreaterThan(20)
  const scripts = readdirSync(join(installed, 'dist')).filter(file => /^fastslam(-|\.js)/.test(file))
  const script = scripts.map(file => readFileSync(join(installed, 'dist', file), 'utf8')).join('')
  const named = [...script.matchAll(/new URL\([`"']([^`"']+\.(?:wasm|png|js))[`"'],/g)]
  expect(named.length).toBeGreaterThan(10)
  for (const [, asset] of named) expect(readFileSync(join(installed, 'dist', asset!)).length, asset).toBeGreaterThan(0)
})

for (const file of ['plain.html', 'standalone.html']) {
  test(`a page without a bundler: ${file}`, file === 'plain.html' ? {} : breadth, async ({ browser }) => {
    const server = await startServer({ folder: project })
    const context = await browser.newContext({ reducedMotion: 'reduce' })
    await expectLive(await context.newPage(), `${server.url}${file}`)
    await context.close()
    await server.close()
  })
}

test('the example comes with it; where a page lets no worker run that comes in the script, the figure says so', breadth, async ({ browser }) => {
  const server = await startServer({ folder: project })
  const context = await browser.newContext({ reducedMotion: 'reduce' })
  for (const file of ['plain.html', 'standalone.html']) {
    const course = await context.newPage()
    const warnings: string[] = []
    course.on('console', message => warnings.push(message.text()))
    await course.goto(`${server.url}${file}`)
    await course.evaluate(() => document.body.append(document.createElement('fastslam-log')))
    const figure = course.locator('fastslam-log')
    await figure.getByRole('button', { name: 'Map this building' }).click()
    if (file === 'plain.html') await expect(figure.locator('[part=transport] .position')).toHaveText(/^[1-9]\d+ /)
    else await expect(figure.getByRole('alert')).toContainText('This figure is not live here: this page allows nothing to run in the background.')
    await figure.evaluate(element => (element as HTMLElement & { settled(): Promise<void> }).settled())
    expect(warnings.length, 'it does not try for ever').toBeLessThan(10)
  }
  await context.close()
  await server.close()
})

test('a fresh Vite project, built', breadth, async ({ browser }) => {
  execFileSync(npmBin('vite'), ['build'], { cwd: project, stdio: 'pipe' })
  const server = await startServer({ folder: join(project, 'dist') })
  const context = await browser.newContext({ reducedMotion: 'reduce' })
  await expectLive(await context.newPage(), server.url)
  await context.close()
  await server.close()
})

test('a fresh Vite project, in development', breadth, async ({ browser }) => {
  const child = spawn(npmBin('vite'), ['--port', '0', '--host', '127.0.0.1'], { cwd: project, stdio: 'pipe' })
  try {
    const address = await new Promise<string>((found, fail) => {
      let said = ''
      child.stdout.on('data', chunk => {
        // eslint-disable-next-line no-control-regex -- the colours of its output
        said += String(chunk).replace(/\x1b\[[0-9;]*m/g, '')
        const at = /http:\/\/127\.0\.0\.1:\d+\//.exec(said)
        if (at) found(at[0])
      })
      child.on('close', () => fail(new Error(`Vite ended: ${said}`)))
    })
    const context = await browser.newContext({ reducedMotion: 'reduce' })
    await expectLive(await context.newPage(), address)
    await context.close()
  } finally {
    child.kill()
  }
})

test('on a server it is empty instead of failing, and its types hold', () => {
  execFileSync(process.execPath, ['--input-type=module', '--eval', "await import('fastslam-widgets'); await import('fastslam-widgets/react'); await import('fastslam-widgets/standalone')"], { cwd: project, stdio: 'pipe' })
  const check = (text: string) => {
    writeFileSync(join(project, 'use.ts'), `import type { FastslamLap, FigureElement } from 'fastslam-widgets'\n${text}`)
    return execFileSync(npmBin('tsc'), ['--ignoreConfig', '--noEmit', '--strict', '--target', 'es2022', '--module', 'esnext', '--moduleResolution', 'bundler', '--lib', 'es2022,dom', '--types', '', 'use.ts'], { cwd: project, stdio: 'pipe' })
  }
  check(`const lap: FastslamLap = document.createElement('fastslam-lap')
lap.universes = 8
lap.rangeStd = 0.1
lap.step()
lap.addEventListener('fastslam-step', ({ detail }) => detail.readouts.map(({ value }) => value))
document.querySelector('fastslam-proposal')!.samples += 1
const log = document.createElement('fastslam-log')
void log.open(new Blob())
const all: FigureElement[] = [lap, log]
for (const figure of all) figure.addEventListener('fastslam-step', ({ detail }) => detail.phase === 'done' && figure.link)\n`)
  expect(() => check("document.createElement('fastslam-lap').proposal = 'psychic'\n")).toThrow()
})
