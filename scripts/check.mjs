// npm run check: format, lints, types and spelling, and the links and the HTML of the built pages, without running a test.
import { existsSync, readdirSync, rmSync } from 'node:fs'
import { homedir } from 'node:os'
import { join } from 'node:path'
import { build } from './build.mjs'
import { audit, checkCrates } from './dependencies.mjs'
import { checkItems } from './items.mjs'
import { isMain, main, npmBin, root, run, step, StepError } from './lib.mjs'
import { chapterPrograms } from './registry.mjs'

/** The checks, as [name, action]: the tests run them as well. @type {[string, () => Promise<unknown>][]} */
export const checks = [
  ['Format (cargo fmt)', () => run('cargo', ['fmt', '--all', '--check'], { hint: 'cargo fmt --all puts it right.' })],
  ['Lints (clippy)', () => run('cargo', ['clippy', '--workspace', '--all-targets', '--', '-D', 'warnings'])],
  ['Lints of a crate by itself (clippy)', clippyAlone],
  ['Lints for WebAssembly (clippy)', clippyWasm],
  ['Documentation (cargo doc)', () => run('cargo', ['doc', '--workspace', '--no-deps', '--all-features'], { env: { RUSTDOCFLAGS: '-D warnings' } })],
  ['Public items of the filters', checkItems],
  ['What the packages of the crates hold (cargo package --list)', listPackages],
  ['Licences and sources of crates', checkCrates],
  ['Types (TypeScript)', checkTypes],
  ['Spelling (cspell)', () => run(npmBin('cspell'), ['--no-progress', '--config', join(root, 'cspell.json')], { hint: 'A word of the field goes into www/words.txt.' })],
  // Imported late: set-up may be what installs the packages that they stand on.
  ['Links', async () => (await import('./site.mjs')).checkLinks()],
  ['HTML (html-validate)', async () => (await import('./site.mjs')).checkHtml()],
]

/** In the workspace a crate has the features that any other crate asks of it: what only they use is seen by these runs alone. */
async function clippyAlone() {
  for (const crate of ['fastslam', 'fastslam-log', 'fastslam-lab']) await run('cargo', ['clippy', '-p', crate, '--lib', '--', '-D', 'warnings'])
}

/** Code behind cfg(target_arch = "wasm32") is seen by these runs alone, and by the last of them what a program carries that only another needs. */
async function clippyWasm() {
  const clippy = (/** @type {string[]} */ ...what) => run('cargo', ['clippy', ...what, '--target', 'wasm32-unknown-unknown', '--', '-D', 'warnings'])
  await clippy('-p', 'fastslam-widgets', '-p', 'browser', '--all-targets')
  for (const program of chapterPrograms) await clippy('-p', 'fastslam-widgets', '--lib', '--no-default-features', '--features', `single-threaded,${program}`)
}

const crates = ['fastslam', 'fastslam-log', 'fastslam-lab', 'fastslam-figures-catalogue', 'fastslam-figures-kit', 'fastslam-widgets', 'fastslam-cli']

async function listPackages() {
  for (const crate of crates) {
    const { output } = await run('cargo', ['package', '--list', '--allow-dirty', '--package', crate])
    const packed = output.trim().split(/\s+/)
    const missing = ['README.md', 'LICENSE-APACHE', 'LICENSE-MIT'].filter(file => !packed.some(path => path.endsWith(file)))
    if (missing.length > 0) throw new StepError(`The package ${crate} is without ${missing.join(', ')}.`)
    const other = packed.filter(file => !/\.rs$|^(src|tests|fonts|words)\/|^[^/]+$/.test(file))
    if (other.length > 0) throw new StepError(`The package ${crate} holds what no crate needs: ${other.join(', ')}.`)
  }
}

/**
 * Packs the crates, and builds each from its package alone, with the others out of a registry that cargo makes for the purpose.
 * What they depend on besides is there from the lints: the network is not asked.
 */
export async function buildPackages() {
  // What a registry has, Cargo takes for unchangeable: it would build the crates as they were packed the last time.
  const target = join(root, 'target', 'published')
  const sources = join(process.env.CARGO_HOME ?? join(homedir(), '.cargo'), 'registry', 'src')
  // A registry in a folder, as the one for the purpose, has no host in its name.
  const folders = existsSync(sources) ? readdirSync(sources).filter(name => name.startsWith('-')).map(name => join(sources, name)) : []
  for (const folder of [...folders, join(target, 'debug', '.fingerprint')]) {
    const ours = existsSync(folder) ? readdirSync(folder).filter(name => name.startsWith('fastslam')) : []
    for (const name of ours) rmSync(join(folder, name), { recursive: true })
  }
  const packages = crates.flatMap(crate => ['--package', crate])
  // Nothing of it is run.
  const env = { CARGO_PROFILE_DEV_OPT_LEVEL: '0', CARGO_PROFILE_DEV_DEBUG: '0' }
  const { output } = await run('cargo', ['package', '--offline', '--allow-dirty', '--target-dir', target, ...packages], { env })
  if (/^warning/m.test(output)) throw new StepError('Packing the crates gives warnings: see above.')
}

async function checkTypes() {
  for (const project of ['.', 'scripts', 'tests/e2e', 'tests/clients']) await run(npmBin('tsc'), ['--noEmit', '-p', join(root, project)])
}

if (isMain(import.meta)) {
  await main(async () => {
    // The elements are typed against what wasm-pack writes, and the links are those of the pages.
    await build()
    for (const [name, action] of checks) await step(name, action)
    await step('Crates built from their packages (cargo package)', buildPackages)
    await step('Known holes of npm packages (npm audit)', audit)
  })
}
