// A unit of breadth: what widgets/README.md says of adding a figure and a panel, done by the letter in a copy of the sources. The figure of
// its example becomes a folder, and the registry gets a row; then the site is built, and the figure is opened in a browser. No other file is touched.
//   node tests/newcomer/run.mjs
import { cpSync, existsSync, mkdirSync, readFileSync, rmSync, symlinkSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import { launchChromium } from '../../scripts/browser.mjs'
import { remapped } from '../../scripts/build.mjs'
import { cache, capture, main, root, run, say, step, StepError } from '../../scripts/lib.mjs'
import { startServer } from '../../scripts/serve.mjs'

/** At the same place each time, so that Cargo finds what it has compiled. */
const copy = cache('newcomer')

const registry = join(copy, 'widgets', 'src', 'registry.rs')

/** What the README shows, and so what is tried: the row, and another panel. */
const readme = readFileSync(join(root, 'widgets', 'README.md'), 'utf8')
const [row, panel] = [/^("pi": darts::Darts, .*;)$/m, /^(\/\/\/ Where the darts are drawn[^]*?)^```$/m].map(shown => shown.exec(readme)?.[1])

function copySources() {
  rmSync(copy, { recursive: true, force: true })
  const sources = (capture('git', 'ls-files', '--cached', '--others', '--exclude-standard', '-z') ?? '').split('\0').filter(file => file !== '' && existsSync(join(root, file)))
  const made = ['widgets/pkg', '.cache/programs/page', '.cache/fonts']
  for (const file of [...sources, ...made]) cpSync(join(root, file), join(copy, file), { recursive: true, preserveTimestamps: true })
  symlinkSync(join(root, 'node_modules'), join(copy, 'node_modules'))
}

/** The folder: the example as a module of the crate. */
function addFolder() {
  const example = readFileSync(join(root, 'widgets', 'kit', 'examples', 'pi.rs'), 'utf8')
  const figure = example.slice(0, example.indexOf('fn main()')).replaceAll('fastslam_figures_kit::', 'crate::')
  const title = /^ {4}const TITLE: .*\n/m
  if (!panel || !title.test(figure)) throw new StepError('widgets/README.md shows no panel for the example.')
  const module = figure.replace(title, `$&\n${panel.trimEnd().replaceAll(/^(?=.)/gm, '    ')}\n`)
  mkdirSync(join(copy, 'widgets', 'src', 'darts'))
  writeFileSync(join(copy, 'widgets', 'src', 'darts', 'mod.rs'), module)
}

function addRow() {
  if (!row) throw new StepError('widgets/README.md shows no row for the registry.')
  const text = readFileSync(registry, 'utf8')
  writeFileSync(registry, text.replace(/^figures! \{\n/m, `$&    ${row}\n`))
}

const env = { CARGO_TARGET_DIR: process.env.CARGO_TARGET_DIR ?? join(root, 'target'), FASTSLAM_DIST: join(copy, 'dist') }

/** Calls functions of the copy's scripts. @param {string} calls @param {Record<string, string>} [more] variables */
const inCopy = (calls, more = {}) =>
  run(process.execPath, ['--input-type=module', '--eval', `const [build, elements, registry] = await Promise.all(['build', 'elements', 'registry'].map(name => import(\`./scripts/\${name}.mjs\`)))\n${calls}`], { cwd: copy, env: { ...env, ...more } })

// Together they are `npm run build -- --singles pi`, but for the programs of other figures, which are those that are here.
const tell = () => inCopy('registry.writeLists()\nawait elements.tellFigures()')
/** With the flags of the sources that are here: what all programs stand on is compiled already. */
const buildProgram = () => inCopy("await build.buildPrograms(['pi'], [])", { CARGO_ENCODED_RUSTFLAGS: remapped().join('\x1f') })
const buildPages = () => inCopy('await elements.writeNames()\nawait build.buildPages()')

/** @param {string} file */
const there = file => readFileSync(join(copy, file), 'utf8')

/** @param {string} what @param {unknown} found @param {unknown} expected */
function expectSame(what, found, expected) {
  if (JSON.stringify(found) !== JSON.stringify(expected)) throw new StepError(`${what}: ${JSON.stringify(found)} in place of ${JSON.stringify(expected)}`)
}

async function openFigure() {
  const [server, browser] = [await startServer({ folder: env.FASTSLAM_DIST }), await launchChromium()]
  try {
    const page = await browser.newPage()
    /** @type {string[]} */
    const complaints = []
    page.on('console', message => message.type() === 'error' && complaints.push(message.text()))
    page.on('pageerror', error => complaints.push(String(error)))
    await page.goto(`${server.url}embed-pi.html`)
    const { shown, lower } = await page.locator('fastslam-pi').evaluate(async element => {
      const figure = /** @type {import('../../widgets/elements/figure-element').FigureElement & { darts: number }} */ (element)
      const look = async () => {
        await figure.settled()
        const canvas = figure.shadowRoot?.querySelector('canvas')
        const pixels = canvas?.getContext('2d')?.getImageData(0, 0, canvas.width, canvas.height).data ?? []
        return { state: figure.state, readout: figure.readouts[0]?.text, colours: new Set(new Uint32Array(new Uint8ClampedArray(pixels).buffer)).size > 2 }
      }
      const before = await look()
      figure.darts = 4000
      const after = await look()
      const high = figure.naturalHeight
      figure.setAttribute('show', 'small')
      await figure.settled()
      return { shown: [before, after], lower: figure.naturalHeight < high - 100 }
    })
    if (!lower) throw new StepError('The small panel alone is as high as both.')
    // The same number as natively, and another one of other darts.
    const native = JSON.parse(there('.cache/figures.json')).find((/** @type {{ tag: string }} */ { tag }) => tag === 'fastslam-pi').readouts[0].text
    expectSame('the figure, before and after a script has set a parameter', shown, [
      { state: '', readout: native, colours: true },
      { state: 'darts=4000', readout: shown[1]?.readout, colours: true },
    ])
    if (shown[1]?.readout === native) throw new StepError(`4000 darts say ${native}, as 500 do.`)
    await page.goto(`${server.url}embed.html?figure=pi&darts=4000&seed=7`)
    await page.locator('fastslam-pi input[type=range][name=darts][aria-valuetext="4000"]').waitFor({ state: 'attached' }) // in its Lab
    expectSame('complaints', complaints, [])
  } finally {
    await browser.close()
    await server.close()
  }
}

function judgeFiles() {
  for (const [file, text] of [
    ['README.md', '`<fastslam-pi>`'],
    ['widgets/Cargo.toml', 'pi = []'],
    ['dist/fastslam.d.ts', 'export declare class FastslamPi extends FigureElement {'],
    ['dist/custom-elements.json', '"tagName": "fastslam-pi"'],
    ['dist/fastslam.js', 'FastslamPi'],
  ]) {
    if (!there(file).includes(text)) throw new StepError(`${file} does not have ${text}.`)
  }
}

await main(async () => {
  await step('A copy of the sources', copySources)
  await step('A folder', addFolder)
  await step('A row', addRow)
  await step('What the figure tells of itself', tell)
  await step('Its program', buildProgram)
  await step('Its pages', buildPages)
  await step('The figure in a browser', openFigure)
  await step('Types, manifest and lists', judgeFiles)
  rmSync(copy, { recursive: true, force: true })
  say('1 passed, 0 failed')
})
