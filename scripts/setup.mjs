// Sets up what building and testing need, from rustup's Rust and Node alone. Every step looks first and installs only what is
// missing, into the places where a bare shell finds it too (~/.cargo/bin, node_modules, the system's packages).
import { createHash } from 'node:crypto'
import { existsSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { homedir } from 'node:os'
import { join } from 'node:path'
import { cache, capture, isMain, main, readIfThere, root, run, say, step, StepError, which } from './lib.mjs'

const wasmPackVersion = '0.15.1'
const wasmTarget = 'wasm32-unknown-unknown'

/** @param {{ browser?: boolean }} [needs] */
export async function setUp({ browser = false } = {}) {
  await step('Node.js', checkNode)
  await step('Rust', checkRust)
  await step('Rust target for WebAssembly', addWasmTarget)
  await Promise.all([step('npm packages', installPackages), installTools()])
  if (browser) {
    await step('Chromium and ChromeDriver', installBrowser)
    await step('Chromium’s headless shell', installHeadlessShell)
  }
}

function checkNode() {
  const [major, minor] = process.versions.node.split('.').map(Number)
  if (major > 22 || (major === 22 && minor >= 12) || (major === 20 && minor >= 19)) return process.versions.node
  throw new StepError(`Node.js ${process.versions.node} is too old or an odd one for Vite 8.`, 'Install Node.js 20.19 or newer, or 22.12 or newer.')
}

function checkRust() {
  const version = capture('cargo', '--version')
  if (!version) throw new StepError('There is no cargo on PATH nor in ~/.cargo/bin.', 'Install Rust with rustup: https://rustup.rs')
  if (process.platform === 'linux' && !which('cc')) {
    throw new StepError('Rust needs a C linker, and there is no cc on PATH.', 'On Debian or Ubuntu: apt-get install gcc libc6-dev')
  }
  return version.replace('cargo ', '')
}

async function addWasmTarget() {
  const sysroot = capture('rustc', '--print', 'sysroot')
  if (sysroot && existsSync(join(sysroot, 'lib', 'rustlib', wasmTarget))) return 'there already'
  if (!which('rustup')) throw new StepError(`This Rust has no target ${wasmTarget}, and there is no rustup to add it.`, 'Install Rust with rustup: https://rustup.rs')
  await run('rustup', ['target', 'add', wasmTarget])
}

/** The tool must be of the very version of the crate: Cargo.lock says which that is. */
function wasmBindgenVersion() {
  const lock = readIfThere(join(root, 'Cargo.lock')) ?? ''
  const version = /name = "wasm-bindgen"\r?\nversion = "(.+)"/.exec(lock)?.[1]
  if (!version) throw new StepError('Cargo.lock does not name a version of wasm-bindgen.', 'Write it anew: cargo update --workspace')
  return version
}

async function installTools() {
  try {
    // Without TLS: it speaks to the driver of a browser on this machine, and to nobody else.
    await step('wasm-bindgen', () => cargoInstall('wasm-bindgen-cli', 'wasm-bindgen', wasmBindgenVersion(), '--no-default-features'))
    await step('wasm-pack', () => cargoInstall('wasm-pack', 'wasm-pack', wasmPackVersion))
  } finally {
    rmSync(toolsTarget, { recursive: true, force: true })
  }
}

/** What tools have in common is compiled once. */
const toolsTarget = cache('tools')

/** The version that a program tells behind its name. @param {string} program */
const versionOf = program => capture(program, '--version')?.split(/\s/)[1]

/**
 * A tool from crates.io, of one version. It runs for seconds: what the compiler would take to make it faster is not worth it.
 * @param {string} crate @param {string} program @param {string} version @param {string[]} options
 */
export async function cargoInstall(crate, program, version, ...options) {
  if (versionOf(program) === version) return `${version}, there already`
  const install = (/** @type {string[]} */ ...how) =>
    // Away from the workspace, whose settings are for our own crates.
    run('cargo', ['install', ...how, ...options, '--force', crate, '--version', `=${version}`], {
      cwd: homedir(),
      env: { CARGO_TARGET_DIR: toolsTarget, CARGO_PROFILE_RELEASE_OPT_LEVEL: '0' },
    })
  try {
    await install('--locked')
  } catch {
    // The tool's own lock may name a package that its registry has withdrawn since, or that a mirror has not got: then
    // any that fits its requirements. A tool that cannot be built at all fails the second time with the true reason.
    say(`${crate} cannot be built from its own lock file; building it from the newest packages that fit it.`)
    await install()
  }
  if (versionOf(program) !== version) {
    throw new StepError(`Another ${program} stands before the one just installed: ${which(program)}`, `Remove it, or put ~/.cargo/bin before it on PATH.`)
  }
  return version
}

async function installPackages() {
  const files = ['package.json', 'package-lock.json'].map(name => readFileSync(join(root, name)))
  const wanted = files.reduce((hash, file) => hash.update(file), createHash('sha256').update(process.version)).digest('hex')
  const stamp = join(root, 'node_modules', '.installed-for')
  if (readIfThere(stamp) === wanted) return 'there already'
  // No package needs a script of its own to be installed, and none may run one.
  await run('npm', ['ci', '--ignore-scripts', '--no-audit', '--no-fund'], {
    env: { PLAYWRIGHT_SKIP_BROWSER_DOWNLOAD: '1' },
    hint: 'If package.json was edited: npm install writes package-lock.json anew. If the registry cannot be reached: try again online.',
  })
  writeFileSync(stamp, wanted)
}

/** @returns {string | undefined} */
export function findChrome() {
  if (process.env.CHROME) {
    const chrome = which(process.env.CHROME)
    if (!chrome) throw new StepError(`CHROME=${process.env.CHROME} is no program.`, 'Set CHROME to a Chromium or Chrome, or unset it.')
    return chrome
  }
  return [
    'chromium',
    'chromium-browser',
    'google-chrome',
    'google-chrome-stable',
    '/Applications/Chromium.app/Contents/MacOS/Chromium',
    '/Applications/Google Chrome.app/Contents/MacOS/Google Chrome',
  ]
    .map(which)
    .find(Boolean)
}

/**
 * Chromium without a window: the same engine, without the browser's own pages around the tested one, which keep the processor as busy
 * as that does.
 */
const findHeadlessShell = () => ['chromium-headless-shell', 'chrome-headless-shell'].map(which).find(Boolean)

/** What drives the pages of tests: the headless shell where there is one, unless a browser is named. @returns {string | undefined} */
export const findHeadless = () => (process.env.CHROME ? undefined : findHeadlessShell()) ?? findChrome()

export function findChromeDriver() {
  return which(process.env.CHROMEDRIVER) ?? which('chromedriver') ?? which(process.env.CHROMEWEBDRIVER && join(process.env.CHROMEWEBDRIVER, 'chromedriver'))
}

async function installBrowser() {
  if (!findChrome() || !findChromeDriver()) await aptInstall('chromium', 'chromium-driver')
  const [chrome, driver] = [findChrome(), findChromeDriver()]
  if (!chrome || !driver) throw new StepError(`There is still no ${chrome ? 'ChromeDriver' : 'Chromium'} on PATH.`, browserHint)
  const [ofChrome, ofDriver] = [version(chrome), version(driver)]
  if (ofChrome.split('.')[0] !== ofDriver.split('.')[0]) {
    throw new StepError(`${chrome} is ${ofChrome} but ${driver} is ${ofDriver}: the two must be of the same major version.`, browserHint)
  }
  return `${chrome} ${ofChrome}`
}

const version = (/** @type {string} */ program) => /\d+(\.\d+)+/.exec(capture(program, '--version') ?? '')?.[0] ?? 'of unknown version'

/** Only time depends on it: where it cannot be had, Chromium itself does its work. */
async function installHeadlessShell() {
  if (process.env.CHROME) return 'not needed: CHROME names the browser'
  if (!findHeadlessShell()) await aptInstall('chromium-headless-shell').catch(() => {})
  const shell = findHeadlessShell()
  return shell ? `${shell} ${version(shell)}` : 'cannot be had here: Chromium itself drives the pages, which takes longer'
}

const browserHint =
  'The tests need Chromium (or Chrome) and the ChromeDriver of the same version, both on PATH.\n' +
  'On Debian: apt-get install chromium chromium-driver\n' +
  'Elsewhere: install both, or name them in the variables CHROME and CHROMEDRIVER.'

/** Debian's packages, where that is allowed. @param {string[]} packages */
export async function aptInstall(...packages) {
  const missing = `What is in Debian’s ${packages.join(', ')} is missing here`
  if (!which('apt-get')) throw new StepError(`${missing}, and there is no apt-get.`, browserHint)
  const isRoot = process.getuid?.() === 0
  if (!isRoot && capture('sudo', '-n', 'true') === undefined) throw new StepError(`${missing}, and installing it needs root.`, browserHint)
  const apt = (/** @type {string[]} */ ...args) => {
    const words = ['env', 'DEBIAN_FRONTEND=noninteractive', 'apt-get', '-q', ...args]
    return isRoot ? run(words[0], words.slice(1), { hint: browserHint }) : run('sudo', ['-n', ...words], { hint: browserHint })
  }
  await apt('update')
  await apt('install', '-y', '--no-install-recommends', ...packages)
}

if (isMain(import.meta)) await main(() => setUp({ browser: process.argv.includes('--browser') }))
