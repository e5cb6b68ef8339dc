// Builds the chapter: the widgets to WebAssembly (widgets/pkg), then the pages around them (dist).
import { createHash } from 'node:crypto'
import { copyFileSync, existsSync, mkdirSync, readdirSync, readFileSync, renameSync, rmSync, statSync, writeFileSync } from 'node:fs'
import { basename, dirname, join } from 'node:path'
import { fileURLToPath } from 'node:url'
import { askForSite } from './address.mjs'
import { tellFigures, writeNames } from './elements.mjs'
import { writeFrames } from './frames.mjs'
import { checkGlue, gluePaths } from './glue.mjs'
import { chapterPrograms, partsOf, programFile, singlePrograms, wholePrograms, writeLists } from './registry.mjs'
import { setUp } from './setup.mjs'
import { withoutUnasked } from './unasked.mjs'
import { cache, capture, isMain, kilobytes, main, npmBin, readIfThere, root, run, step, StepError } from './lib.mjs'

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

/** A large function that is called from one place stays one: in the other's midst, its variables take longer numbers. */
const optimiser = [...features, '-O3', '--one-caller-inline-max-function-size=30', '--strip-debug', '--strip-producers', '--strip-target-features']

/**
 * What pages load: the programs of the chapter, and of those of single figures the ones that are asked for. What is there of the others
 * stays where it is of these sources; what is not, or has the name of no program, goes, as pages ship what is there. One after the other, so that
 * what they share is compiled once. All use the same glue.
 * @param {string[]} singles @param {string[]} [shared] those of several figures
 */
export async function buildPrograms(singles = [], shared = chapterPrograms) {
  const others = [...singlePrograms, ...wholePrograms]
  const pkg = dirname(programFile(gluedAs))
  const kept = [...chapterPrograms, ...others.filter(isMade)].map(programFile)
  mkdirSync(pkg, { recursive: true })
  for (const file of readdirSync(pkg, { recursive: true, encoding: 'utf8' })) if (file.endsWith('.wasm') && !kept.includes(join(pkg, file))) rmSync(join(pkg, file))
  for (const program of [...shared, ...singles]) await step(basename(programFile(program)), () => buildProgram(program))
  await step('Glue of the programs', () => {
    for (const path of gluePaths) copyFileSync(join(folderOf(gluedAs), basename(path)), path)
    for (const program of [...chapterPrograms, ...others.filter(program => existsSync(programFile(program)))]) checkGlue(programFile(program))
  })
}

/** Where a program is made. @param {string} program */
const folderOf = program => cache('programs', program)

/** @param {string} program */
async function buildProgram(program) {
  await wasmPack(folderOf(program), pageArgs(program))
  return optimise(program)
}

/** The program that asks most of JavaScript; all export the same. */
const gluedAs = 'page'

/** What programs are made from. */
const sources = ['.cargo/config.toml', 'Cargo.toml', 'Cargo.lock', 'src', 'lab', 'widgets/Cargo.toml', 'widgets/build.rs', 'widgets/README.md', 'widgets/src', 'widgets/words', 'widgets/kit']

/** @type {string | undefined} */
let sourcesSeen

/** A fingerprint of all that programs are made from, and with; taken once, however many programs ask. */
const madeFrom = () => (sourcesSeen ??= fingerprint())

function fingerprint() {
  const hash = createHash('sha256').update([capture('rustc', '-Vv'), capture('wasm-bindgen', '-V'), process.env.RUSTFLAGS].join('\n'))
  for (const source of sources) {
    const path = join(root, source)
    const files = statSync(path).isDirectory() ? readdirSync(path, { recursive: true, encoding: 'utf8' }).sort().map(file => join(path, file)) : [path]
    for (const file of files) if (statSync(file).isFile()) hash.update(file.slice(root.length)).update(readFileSync(file))
  }
  return hash.digest('hex')
}

/** @param {string} folder @param {string} features @param {string} profile of Cargo.toml @param {string[]} [more] of Cargo's arguments */
const wasmPackArgs = (folder, features, profile, more = []) => ['build', 'widgets', '--target', 'web', '--profile', profile, '--no-pack', '--out-dir', folder, '--no-default-features', '--features', `single-threaded,${features}`, ...more]

/** @type {string[] | undefined} */
let placesUnnamed

/** For what is published: panics name files, and from any folder and any home the same sources have to give the same bytes. */
const unnamed = () => (placesUnnamed ??= ['--config', `target.wasm32-unknown-unknown.rustflags=${JSON.stringify(remapped())}`])

/** Flags of the compiler by which a program names no place of this machine. */
export function remapped() {
  /** @type {{ source: string | null, manifest_path: string }[]} */
  const crates = JSON.parse(capture('cargo', 'metadata', '--locked', '--format-version', '1') ?? '{"packages":[]}').packages
  const registries = new Set(crates.flatMap(({ source, manifest_path }) => (source ? [dirname(dirname(manifest_path))] : [])))
  return [[root, '.'], ...[...registries].map(folder => [folder, 'crates'])].map(([from, to]) => `--remap-path-prefix=${from}=${to}`)
}

/** Of a program of the page's. @param {string} program */
const pageArgs = program => wasmPackArgs(folderOf(program), partsOf(program).join(), 'page', unnamed())

/** Of a program as these sources give it. @param {string[]} args of wasm-pack */
const stampOf = args => `${args.join(' ')} ${madeFrom()}`

/** @param {string} folder */
const stampIn = folder => join(folder, 'made-from')

/** Whether a program of the page's is there as these sources give it. @param {string} program */
const isMade = program => readIfThere(stampIn(folderOf(program))) === stampOf(pageArgs(program))

/**
 * Compiles a program, unless it is there as these sources give it: Cargo keeps one library of the widgets for each profile, whatever its
 * features, and would compile all of them anew each time.
 * @param {string} folder @param {string[]} args of wasm-pack
 */
async function wasmPack(folder, args) {
  const [stamp, wanted] = [stampIn(folder), stampOf(args)]
  if (readIfThere(stamp) === wanted && existsSync(join(folder, wasm))) return
  rmSync(stamp, { force: true })
  await run('wasm-pack', args)
  writeFileSync(stamp, wanted)
}

/** A program that dies on request, for one test of the browser and never for a page. */
export const troubleWasm = cache('trouble', wasm)

/** Built as the tests in WebAssembly are, so that both stand on the same compiled crates. */
export const buildTrouble = () => step('A program that dies on request', () => wasmPack(dirname(troubleWasm), wasmPackArgs(dirname(troubleWasm), 'page,log,files,trouble', 'browser')))

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

/**
 * The site.
 * @param {string[]} singles figures that get a program of their own, beside that of the chapter
 * @param {{ offline?: boolean }} [made] whether files for offline use are made of it, which carry other programs where a figure uses two
 */
export async function build(singles = [], { offline = false } = {}) {
  const there = [...chapterPrograms, ...singles]
  const wholes = offline ? wholePrograms.filter(program => there.includes(partsOf(program)[0] ?? '')) : []
  await setUp()
  await step('Lists of the figures', writeLists)
  // The compiler of the one has a core to spare while the other links.
  await Promise.all([buildPrograms([...singles, ...wholes]), step('What the figures tell of themselves', () => tellFigures())])
  await step('Names of the figures', writeNames)
  await buildPages()
}

/**
 * wasm-opt takes far longer than an incremental build: what it made of the same input is kept, of each program once. Nothing else is put where
 * pages look for programs: a build that was broken off left an unoptimised one there, half as heavy again, which the next build shipped.
 * @param {string} program
 */
async function optimise(program) {
  const file = programFile(program)
  const input = readFileSync(join(folderOf(program), wasm))
  const hash = createHash('sha256')
  for (const other of [fileURLToPath(import.meta.url), join(root, 'scripts', 'unasked.mjs'), join(root, 'node_modules', 'binaryen', 'package.json')]) hash.update(readFileSync(other))
  const folder = cache('wasm-opt', basename(file))
  const kept = join(folder, hash.update(input).digest('hex'))
  if (!existsSync(kept)) {
    rmSync(folder, { recursive: true, force: true })
    mkdirSync(folder, { recursive: true })
    const part = `${kept}.part`
    writeFileSync(part, await withoutUnasked(input, program))
    await run(npmBin('wasm-opt'), [...optimiser, part, '-o', part])
    renameSync(part, kept)
  }
  mkdirSync(dirname(file), { recursive: true })
  copyFileSync(kept, file)
  return `${kilobytes(input.length)} → ${kilobytes(statSync(file).size)}`
}

/** The figures that the command line names for programs of their own: `--singles` for all, `--singles lap,em` for these. @param {string[]} otherwise */
export function singlesAsked(otherwise = []) {
  const at = process.argv.indexOf('--singles')
  if (at < 0) return otherwise
  const names = process.argv[at + 1]?.match(/^[a-z].*/)?.[0].split(',') ?? singlePrograms
  const unknown = names.find(name => !singlePrograms.includes(name))
  if (unknown !== undefined) throw new StepError(`No figure named ${unknown} can have a program of its own.`, `There are: ${singlePrograms.join(', ')}`)
  return names
}

// `-- --pages`: the pages alone, from programs that are there. `-- --singles`: with a program for each figure, for those who load one.
if (isMain(import.meta)) {
  await main(async () => {
    await askForSite()
    await (process.argv.includes('--pages') ? buildPages() : build(singlesAsked()))
  })
}
