// What scripts need of the figures' registry before any program is built.
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import { root, StepError } from './lib.mjs'

const rows = [...readFileSync(join(root, 'widgets', 'src', 'registry.rs'), 'utf8').matchAll(/^ {4}"([a-z-]+)": [\w:]+, (Page|Own),/gm)]
if (rows.length === 0) throw new StepError('widgets/src/registry.rs has no row that scripts/registry.mjs can read.')

/** The program of each figure on a page that has many, by tag: `page`, or where it is in no other, its own. */
export const programs = new Map(rows.map(([, name = '', where]) => /** @type {[string, string]} */ ([`fastslam-${name}`, where === 'Page' ? 'page' : name])))

/** What the chapter loads, each a feature of the crate: the programs of its figures, and the one that reads bags for the figure of logs. */
export const chapterPrograms = [...new Set(programs.values()), 'bags']

/** What a page loads that has one or two figures: a program for each of those that `page` has. */
export const singlePrograms = rows.flatMap(([, name = '', where]) => (where === 'Page' ? [name] : []))

/** Of these, the one that stands for all in npm test: breadth makes the others. */
export const singlesTested = ['proposal']

/** Programs that a figure uses besides its own: bags are read for logs, and the laps behind the points of a chart are run again. @type {Record<string, string[] | undefined>} */
export const alsoUsed = { log: ['bags'], universes: ['lap'] }

/** Where a program is. @param {string} program */
export const programFile = program => join(root, 'widgets', 'pkg', `fastslam-${program}.wasm`)
