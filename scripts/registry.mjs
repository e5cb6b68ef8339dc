// What scripts need of the figures' registry before any program is built.
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import { root, StepError } from './lib.mjs'

const rows = [...readFileSync(join(root, 'widgets', 'src', 'registry.rs'), 'utf8').matchAll(/Entry::of::<\w+>\("([a-z-]+)", Program::(\w+)/g)]
if (rows.length === 0) throw new StepError('widgets/src/registry.rs has no row that scripts/registry.mjs can read.')

/** The program of each figure, by tag. */
export const programs = new Map(rows.map(([, tag = '', program = '']) => /** @type {[string, string]} */ ([tag, program.toLowerCase()])))

/** Names of all programs, each a feature of the crate: those of the figures, and the one that reads bags for the figure of logs. */
export const programNames = [...new Set(programs.values()), 'bags']

/** Where a program is. @param {string} program */
export const programFile = program => join(root, 'widgets', 'pkg', `fastslam-${program}.wasm`)
