// npm test: sets up, builds, checks, and runs every test there is. A step that fails is named; those after it still run, so that
// one run shows all that is wrong. The last line is the total of all the runners: `N passed, M failed, K skipped`.
//
// A test in Rust that lacks what it needs (a log that may not be shipped, Python) cannot tell cargo so: it prints a line
// `skipped: why` and returns. `counted` counts such a test as skipped and not as passed, and names the reasons.
import { mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import { buildPages, buildPrograms, buildTrouble, buildWasm } from './build.mjs'
import { checks } from './check.mjs'
import { aboutFailures, bold, cache, main, npmBin, readIfThere, red, root, run, step, StepError } from './lib.mjs'
import { findChrome, findChromeDriver, setUp } from './setup.mjs'
import { checkEmbedSizes, checkSize } from './size.mjs'

const total = { passed: 0, failed: 0, skipped: 0 }
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

/** A step that runs tests of cargo's kind, and adds up what they count. @param {() => Promise<{ output: string }>} tests */
async function counted(tests) {
  try {
    return count((await tests()).output)
  } catch (error) {
    count(/** @type {{ output?: string }} */ (error).output ?? '')
    throw error
  }
}

/** @param {string} output */
function count(output) {
  let [passed, skipped] = [0, 0]
  for (const [, good, bad, ignored] of output.matchAll(/^test result: .*?(\d+) passed; (\d+) failed(?:; (\d+) ignored)?/gm)) {
    passed += Number(good)
    skipped += Number(ignored ?? 0)
    total.failed += Number(bad)
  }
  // What a test printed: at the start of a line, or behind its name.
  const reasons = [...output.matchAll(/^(?:test .*\.\.\. )?skipped: (.*)$/gm)].map(([, why]) => why)
  passed -= reasons.length
  skipped += reasons.length
  total.passed += passed
  total.skipped += skipped
  if (passed + skipped === 0) throw new StepError('Not one test passed: have the tests been lost?')
  return [`${passed} passed`, ...(skipped > 0 ? [`${skipped} skipped`] : []), ...reasons].join(', ')
}

/** Tests of scripts, by Node's own runner. */
async function nodeTest() {
  const files = readdirSync(join(root, 'tests', 'chapter')).filter(file => file.endsWith('.test.mjs'))
  return counted(async () => {
    const args = ['--test', '--test-reporter=tap', ...files.map(file => join(root, 'tests', 'chapter', file))]
    // Told in cargo's words, so that all runners are added up alike.
    const inCargosWords = (/** @type {{ output?: string }} */ { output = '' }) => {
      const number = (/** @type {string} */ name) => Number(new RegExp(`^# ${name} (\\d+)$`, 'm').exec(output)?.[1] ?? 0)
      const ignored = number('skipped') + number('todo')
      return { output: `${output}\ntest result: ${number('pass')} passed; ${number('fail')} failed; ${ignored} ignored` }
    }
    try {
      return inCargosWords(await run(process.execPath, args))
    } catch (error) {
      throw Object.assign(/** @type {Error} */ (error), inCargosWords(/** @type {{ output?: string }} */ (error)))
    }
  })
}

/** Test of the step `oracle`, and of no other. */
const oracleTest = 'the_same_weights_and_uniforms_give_the_ancestors_of_the_package_particles'

/** Shows what passed tests print as well, for the reasons of those that skip. @param {string[]} args */
const cargoTest = (...args) =>
  counted(() => run('cargo', ['test', '--no-fail-fast', ...args, '--', '--show-output', '--skip', oracleTest]))

/**
 * Holds resampling against a Python package, which it installs at its first run. Without Python or PyPI it is skipped. Of the whole
 * workspace, as the native tests are: of `laws` alone, the filter crate would be built once more, with its features only.
 */
const oracle = () => counted(() => run('cargo', ['test', '--workspace', '--test', 'oracle', '--', '--ignored', '--show-output']))

/** Of packages outside the workspace: this target folder, where most of what they need is built. */
const sharedTarget = { CARGO_TARGET_DIR: process.env.CARGO_TARGET_DIR ?? join(root, 'target') }

/** Somebody else's package, outside the workspace. */
const outside = () =>
  counted(() =>
    run('cargo', ['test', '--no-fail-fast', '--', '--show-output'], { cwd: join(root, 'tests', 'outside'), env: sharedTarget }),
  )

/** The pose graph against `factrs`, a package of somebody else's that switches on features which would change results. */
const factrs = () =>
  counted(() =>
    run('cargo', ['test', '--no-fail-fast', '--', '--show-output'], { cwd: join(root, 'tests', 'factrs'), env: sharedTarget }),
  )

/** Those of the filter crate, which check their own results. */
async function examples() {
  const log = [join(root, 'tests', 'figures', 'golden', 'tiny.clf'), cache('example')]
  for (const [name, ...args] of [['landmarks'], ['laser_log', ...log], ['own_sensor'], ['own_map']]) {
    await run('cargo', ['run', '--quiet', '--profile', 'test', '--example', name, '--', ...args])
  }
}

/** The fuzz target needs a nightly compiler to run, but none to compile. */
const fuzz = () => run('cargo', ['check'], { cwd: join(root, 'tests', 'fuzz'), env: sharedTarget })

/** wasm-pack's tests in the Chromium that set-up found, which need not be the one ChromeDriver would choose. */
function wasmTest() {
  const settings = JSON.parse(readFileSync(join(root, 'tests', 'browser', 'webdriver.json'), 'utf8'))
  settings['goog:chromeOptions'].binary = findChrome()
  const capabilities = cache('webdriver.json')
  mkdirSync(cache(), { recursive: true })
  writeFileSync(capabilities, JSON.stringify(settings))
  const driver = findChromeDriver() ?? 'chromedriver'
  return counted(() =>
    run('wasm-pack', ['test', '--headless', '--chrome', '--chromedriver', driver, '--release', 'tests/browser'], {
      env: { WASM_BINDGEN_TEST_WEBDRIVER_JSON: capabilities, WASM_BINDGEN_TEST_TIMEOUT: '600', WASM_BINDGEN_TEST_DRIVER_TIMEOUT: '60' },
    }),
  )
}

async function playwright() {
  rmSync(cache('e2e.json'), { force: true })
  let stats
  try {
    await run(npmBin('playwright'), ['test', '--config', join(root, 'tests', 'e2e')])
  } finally {
    stats = JSON.parse(readIfThere(cache('e2e.json')) ?? '{}').stats
    total.passed += stats?.expected ?? 0
    total.failed += (stats?.unexpected ?? 0) + (stats?.flaky ?? 0)
    total.skipped += stats?.skipped ?? 0
  }
  return `${stats.expected} passed${stats.skipped > 0 ? `, ${stats.skipped} skipped` : ''}`
}

await main(async () => {
  const started = performance.now()
  await setUp({ browser: true })
  const [format, ...otherChecks] = checks
  await attempt(...format)
  // Without these there is nothing to test: a failure here ends the run.
  await buildWasm()
  await buildPrograms()
  await buildTrouble()
  await buildPages()
  for (const check of otherChecks) await attempt(...check)
  await attempt('Tests of the chapter’s making', nodeTest)
  await attempt('Tests, native, with all checks on', () => cargoTest('--workspace'))
  await attempt('Tests of a package outside the workspace', outside)
  await attempt('Pose graphs against factrs', factrs)
  await attempt('Examples run', examples)
  await attempt('The fuzz target compiles', fuzz)
  await attempt('Resampling against the Python package particles', oracle)
  await attempt('Same bits, as releases are built', () => cargoTest('--release', '-p', 'portability'))
  await attempt('Tests in WebAssembly, in Chromium', wasmTest)
  await attempt('Tests of the page, in Chromium', playwright)
  await attempt('Size of the page', checkSize)
  await attempt('Size of an embedded figure', checkEmbedSizes)

  const minutes = ((performance.now() - started) / 60_000).toFixed(1)
  for (const { title, about } of failures) console.log(`\n${red(bold(title))}\n${about}`)
  if (failures.length > 0) console.log(red(bold(`\nFailed after ${minutes} min: ${failures.map(({ title }) => title).join('; ')}`)))
  else console.log(bold(`\nAll well after ${minutes} min.`))
  console.log(`${total.passed} passed, ${total.failed} failed, ${total.skipped} skipped`)
  if (failures.length > 0) process.exitCode = 1
})
