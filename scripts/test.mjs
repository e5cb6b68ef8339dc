// npm test: sets up, builds, checks, and runs every kind of test; npm run test:all adds breadth. A step that fails is named; those after
// it still run, so that one run shows all that is wrong. At the end stand what each step and the dearest tests took, and the total of
// all the runners: `N passed, M failed, K skipped`.
import { readdirSync, rmSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import { buildPages, buildPrograms, buildTrouble } from './build.mjs'
import { checks } from './check.mjs'
import { tellFigures, writeNames } from './elements.mjs'
import { aboutFailures, bold, cache, capture, main, npmBin, red, root, run, step, StepError } from './lib.mjs'
import { singlesTested } from './registry.mjs'
import { setUp } from './setup.mjs'
import { checkEmbedSizes, checkSize } from './size.mjs'
import { add, closingLine, counted, inWords, printTable, timeCargo, timePlaywright, total } from './tally.mjs'
import { wasmTests } from './wasm-tests.mjs'

/** Where cargo builds. */
const target = process.env.CARGO_TARGET_DIR ?? join(root, 'target')

/** What failed, with the lines of the tools about it, which the end of the run repeats. @type {{ title: string, about: string }[]} */
const failures = []

/** A step whose failure does not keep the next ones from running. @param {string} title @param {() => unknown} action */
async function attempt(title, action) {
  const before = total.failed
  try {
    await step(title, action)
  } catch (error) {
    const { message, output } = /** @type {Error & { output?: string }} */ (error)
    failures.push({ title, about: output === undefined ? message : aboutFailures(output) })
    // A compile error or a lint has no count of its own: the total must not read as all well.
    if (total.failed === before) total.failed++
  }
}

/** @param {[title: string, action: () => unknown][]} steps */
async function inTurn(steps) {
  for (const step of steps) await attempt(...step)
}

/** Runs tests and adds up what they count. @param {Parameters<typeof run>} command */
async function tests(...command) {
  const { output, error } = await run(...command).then(({ output }) => ({ output, error: undefined }), error => ({ output: String(error.output ?? ''), error }))
  const counts = counted(output)
  if (counts) add(counts)
  timeCargo(output)
  if (error) throw error
  if (!counts || counts.passed + counts.skipped === 0) throw new StepError('Not one test passed: have the tests been lost?')
  return inWords(counts)
}

/** Tests of scripts, by Node's own runner. */
function nodeTest() {
  const files = readdirSync(join(root, 'tests', 'chapter')).filter(file => file.endsWith('.test.mjs'))
  return tests(process.execPath, ['--test', '--test-reporter=tap', ...files.map(file => join(root, 'tests', 'chapter', file))])
}

/** libtest tells how long a test took where it is told that it may. */
const timed = { env: { [`CARGO_TARGET_${(capture('rustc', '--print', 'host-tuple') ?? '').toUpperCase().replaceAll('-', '_')}_RUNNER`]: 'env RUSTC_BOOTSTRAP=1' } }

/** Shows what passed tests print as well, for the reasons of those that skip. @param {string[]} args */
const cargoTest = (...args) => tests('cargo', ['test', '--no-fail-fast', ...args, '--', '--show-output', '-Zunstable-options', '--report-time'], timed)

/** Examples in the documentation. */
const docTest = () => tests('cargo', ['test', '--no-fail-fast', '--workspace', '--doc'])

/**
 * Holds resampling against a Python package, which it installs at its first run. Without Python or PyPI it is skipped. Of the whole
 * workspace, as the native tests are: of `laws` alone, the filter crate would be built once more, with its features only.
 */
const oracle = () => tests('cargo', ['test', '--workspace', '--test', 'oracle', '--', '--ignored', '--show-output'])

/** All that runs natively, compiled: the tests, the examples and the command line stand on the same crates. */
const compile = () => run('cargo', ['test', '--workspace', '--no-run'])

/** What the tests of the page take on two quiet cores [s]: by that, breadth knows how slow this machine is now. */
const usualPage = 320

async function playwright() {
  rmSync(cache('e2e.json'), { force: true })
  const started = performance.now()
  const note = await tests(npmBin('playwright'), ['test', '--config', join(root, 'tests', 'e2e'), '--grep-invert', '@breadth'])
  writeFileSync(cache('pace'), String((performance.now() - started) / 1000 / usualPage))
  return note
}

await main(async () => {
  const started = performance.now()
  await setUp({ browser: true })
  const [format, ...otherChecks] = checks
  await attempt(...format)
  // Without these there is nothing to test: a failure here ends the run. While one links, the other has a core to spare.
  await Promise.all([buildPrograms(singlesTested), step('Native tests, compiled', compile)])
  await step('What the figures tell of themselves', () => tellFigures(join(target, 'debug', 'examples', 'figures')))
  await step('Names of the figures', writeNames)
  await buildPages()
  await buildTrouble()
  await inTurn(otherChecks)
  await attempt('Tests, native, with all checks on', () => cargoTest('--workspace', '--tests'))
  // The first keeps one core busy, and the others together keep the second.
  await Promise.all([
    attempt('Tests in WebAssembly, in Chromium', () => tests(...wasmTests())),
    inTurn([
      ['Tests of scripts and of what they make', nodeTest],
      ['Examples in the documentation', docTest],
      ['Resampling against the Python package particles', oracle],
      ['Same bits, as releases are built', () => cargoTest('--release', '-p', 'portability')],
      ['Size of the page', checkSize],
      ['Size of an embedded figure', checkEmbedSizes],
    ]),
  ])
  await attempt('Tests of the page, in Chromium', playwright)

  timePlaywright()
  printTable()
  const minutes = ((performance.now() - started) / 60_000).toFixed(1)
  for (const { title, about } of failures) console.log(`\n${red(bold(title))}\n${about}`)
  if (failures.length > 0) console.log(red(bold(`\nFailed after ${minutes} min: ${failures.map(({ title }) => title).join('; ')}`)))
  else console.log(bold(`\nAll well after ${minutes} min.`))
  console.log(closingLine())
  if (failures.length > 0) process.exitCode = 1
})
