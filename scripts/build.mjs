// Builds the chapter: the widgets to WebAssembly (widgets/pkg), then the pages around them (dist).
import { createHash } from 'node:crypto'
import { copyFileSync, existsSync, mkdirSync, readdirSync, readFileSync, renameSync, rmSync, statSync, writeFileSync } from 'node:fs'
import { basename, dirname, join } from 'node:path'
import { fileURLToPath } from 'node:url'
import { askForSite } from './address.mjs'
import { tellFigures, writeNames } from './elements.mjs'
import { writeFrames } from './frames.mjs'
import { checkGlue, gluePaths } from './glue.mjs'
import { programFile, programNames } from './registry.mjs'
import { setUp } from './setup.mjs'
import { cache, capture, isMain, main, npmBin, readIfThere, root, run, step, StepError } from './lib.mjs'

/** Where the site is built; deliberate faults are built elsewhere. */
export const dist = process.env.FASTSLAM_DIST ?? join(root, 'dist')
const wasm = 'fastslam_widgets_bg.wasm'

/** The features Rust's target has by default, and SIMD of fixed width. Nothing that may change a bit: no fast-math, no relaxed SIMD. */
const features = [
  '--enable-simd',
  '--enable-bulk-memory',
  '--enable-bulk-memory-opt',
  '--enable-nontrapping-float-to-int',
  '--enable-sign-ext',
  '--enable-mutable-globals',
  '--enable-multivalue',
  '--enable-reference-types',
]

const optimiser = [...features, '-O3', '--strip-debug']

/**
 * What pages load: the program of the figures that run on the page itself, that of the one that maps logs, in a worker, and that which
 * reads bags for it. One after the other, so that what they share is compiled once. All use the same glue.
 */
export async function buildPrograms() {
  const made = (/** @type {string} */ program) => cache('programs', program)
  for (const program of programNames) {
    await step(basename(programFile(program)), async () => {
      await wasmPack(made(program), program, 'page')
      mkdirSync(dirname(programFile(program)), { recursive: true })
      copyFileSync(join(made(program), wasm), programFile(program))
      return optimise(programFile(program))
    })
  }
  await step('Glue of the programs', () => {
    for (const path of gluePaths) copyFileSync(join(made(gluedAs), basename(path)), path)
    for (const program of programNames) checkGlue(programFile(program))
  })
}

/** The one program that exports all that any of them does. */
const gluedAs = 'bags'

/** What programs are made from. */
const sources = ['Cargo.toml', 'Cargo.lock', 'src', 'lab', 'widgets/Cargo.toml', 'widgets/build.rs', 'widgets/README.md', 'widgets/src', 'widgets/words', 'widgets/fonts']

/** A fingerprint of all that programs are made from, and with. */
function madeFrom() {
  const hash = createHash('sha256').update([capture('rustc', '-Vv'), capture('wasm-bindgen', '-V'), process.env.RUSTFLAGS].join('\n'))
  for (const source of sources) {
    const path = join(root, source)
    const files = statSync(path).isDirectory() ? readdirSync(path, { recursive: true, encoding: 'utf8' }).sort().map(file => join(path, file)) : [path]
    for (const file of files) if (statSync(file).isFile()) hash.update(file.slice(root.length)).update(readFileSync(file))
  }
  return hash.digest('hex')
}

/**
 * Compiles a program, unless it is there as these sources give it: Cargo keeps one library of the widgets for each profile, whatever its
 * features, and would compile all of them anew each time.
 * @param {string} folder @param {string} features @param {string} profile of Cargo.toml
 */
async function wasmPack(folder, features, profile) {
  const args = ['build', 'widgets', '--target', 'web', '--profile', profile, '--no-pack', '--out-dir', folder, '--no-default-features', '--features', `single-threaded,${features}`]
  const [stamp, wanted] = [join(folder, 'made-from'), `${args.join(' ')} ${madeFrom()}`]
  if (readIfThere(stamp) === wanted && existsSync(join(folder, wasm))) return
  rmSync(stamp, { force: true })
  await run('wasm-pack', args)
  writeFileSync(stamp, wanted)
}

/** A program that dies on request, for one test of the browser and never for a page. */
export const troubleWasm = cache('trouble', wasm)

/** Built as the tests in WebAssembly are, so that both stand on the same compiled crates. */
export const buildTrouble = () => step('A program that dies on request', () => wasmPack(dirname(troubleWasm), 'page,log,bags,trouble', 'browser'))

export async function buildPages() {
  await step('Pages', async () => {
    await run(npmBin('vite'), ['build', '--config', join(root, 'scripts', 'vite.config.mjs'), '--logLevel', 'warn'])
    for (const file of ['index.html', 'embed.html', 'fastslam.js']) {
      if (!existsSync(join(dist, file))) throw new StepError(`The build did not write dist/${file}.`)
    }
    return 'in dist/'
  })
  await step('Frames, oEmbed and the files for other pages', writeFrames)
}

export async function build() {
  await setUp()
  // The compiler of the one has a core to spare while the other links.
  await Promise.all([buildPrograms(), step('What the figures tell of themselves', () => tellFigures())])
  await step('Names of the figures', writeNames)
  await buildPages()
}

/** wasm-opt takes far longer than an incremental build: what it made of the same input is kept, of each program once. @param {string} file */
async function optimise(file) {
  const input = readFileSync(file)
  const hash = createHash('sha256')
  for (const other of [fileURLToPath(import.meta.url), join(root, 'node_modules', 'binaryen', 'package.json')]) hash.update(readFileSync(other))
  const folder = cache('wasm-opt', basename(file))
  const kept = join(folder, hash.update(input).digest('hex'))
  if (!existsSync(kept)) {
    rmSync(folder, { recursive: true, force: true })
    mkdirSync(folder, { recursive: true })
    const part = `${kept}.part`
    await run(npmBin('wasm-opt'), [...optimiser, file, '-o', part])
    renameSync(part, kept)
  }
  copyFileSync(kept, file)
  return `${kilobytes(input.length)} → ${kilobytes(statSync(file).size)}`
}

/** @param {number} bytes */
export const kilobytes = bytes => `${(bytes / 1000).toFixed(1)} KB`

// `-- --pages`: the pages alone, from programs that are there.
if (isMain(import.meta)) {
  await main(async () => {
    await askForSite()
    await (process.argv.includes('--pages') ? buildPages() : build())
  })
}
