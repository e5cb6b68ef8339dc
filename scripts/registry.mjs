// What scripts need of the figures' registry before any program is built, and the lists of other files that follow from its rows.
import { readFileSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import { root, StepError } from './lib.mjs'

const rows = [...readFileSync(join(root, 'widgets', 'src', 'registry.rs'), 'utf8').matchAll(/^ {4}"([a-z-]+)": (\w+)::\w+, (Page|Own),/gm)].map(([, name = '', module = '', where]) => ({ name, module, onPage: where === 'Page' }))
if (rows.length === 0) throw new StepError('widgets/src/registry.rs has no row that scripts/registry.mjs can read.')

/** The program of each figure on a page that has many, by tag: `page`, or where it is in no other, its own. */
export const programs = new Map(rows.map(({ name, onPage }) => [`fastslam-${name}`, onPage ? 'page' : name]))

/** What the chapter loads, each a feature of the crate: the programs of its figures, and the one that reads and writes files of other programs for the figure of logs. */
export const chapterPrograms = [...new Set(programs.values()), 'files']

/** What a page loads that has one or two figures: a program for each of those that `page` has. */
export const singlePrograms = rows.filter(({ onPage }) => onPage).map(({ name }) => name)

/** Of these, the one that stands for all in npm test: breadth makes the others. */
export const singlesTested = ['proposal']

/** Programs that a figure uses besides its own: the figure of logs reads and writes files of other programs by another one, and the laps behind the points of a chart are run again. @type {Record<string, string[] | undefined>} */
export const alsoUsed = { log: ['files'], universes: ['lap'] }

/**
 * One program with all that a figure uses, for a file that carries it along: what its parts share, half of each, stands in it once. Its name
 * is those of its features, joined by +. @param {string} name of the figure
 */
export const wholeOf = name => [name, ...(alsoUsed[name] ?? [])].join('+')

/** Such programs, where they are made of several parts. */
export const wholePrograms = Object.keys(alsoUsed).map(wholeOf)

/** Names of the programs that stand in this one. @param {string} program */
export const partsOf = program => program.split('+')

/** Where a program is: those that no page loads lie apart. @param {string} program */
export const programFile = program => join(root, 'widgets', 'pkg', program.includes('+') ? 'offline' : '', `fastslam-${program}.wasm`)

/** Each list with the file it is in, what is there, and what the rows make of it. @type {[string, RegExp, () => string][]} */
const lists = [
  ['widgets/Cargo.toml', /(?<=^# A program for each figure.*\n)(?:[a-z-]+ = \[\]\n)*/m, () => rows.map(({ name }) => `${name} = []\n`).join('')],
  ['widgets/Cargo.toml', /^page = .*/m, () => `page = [${[...singlePrograms, 'vignettes'].map(name => `"${name}"`).join(', ')}]`],
  ['widgets/src/lib.rs', /(?<=^\/\/ The figures.*\n)(?:pub mod \w+;\n)*/m, () => rows.map(({ module }) => `pub mod ${module};\n`).sort().join('')],
  ['README.md', /(?<=^ {2}and as easily ).*?(?=\.$)/m, () => rows.filter(({ name }) => name !== 'lap').map(({ name }) => `\`<fastslam-${name}>\``).join(', ').replace(/, (?=[^,]*$)/, ' or ')],
]

/** Files whose lists are not those of the rows, as they should be. @param {string} [folder] of the repository @returns {Map<string, string>} */
export function staleLists(folder = root) {
  const texts = new Map(lists.map(([file]) => [file, readFileSync(join(folder, file), 'utf8')]))
  for (const [file, there, wanted] of lists) {
    const text = texts.get(file) ?? ''
    if (!there.test(text)) throw new StepError(`${file} has no place for the list of figures.`, `scripts/registry.mjs looks for ${there}.`)
    texts.set(file, text.replace(there, wanted))
  }
  return new Map([...texts].filter(([file, text]) => text !== readFileSync(join(folder, file), 'utf8')))
}

/** Writes them: the features of Cargo.toml are read before anything could be asked of Rust. */
export function writeLists() {
  const stale = staleLists()
  for (const [file, text] of stale) writeFileSync(join(root, file), text)
  return stale.size > 0 ? `written into ${[...stale.keys()].join(', ')}` : `${rows.length} figures`
}
