// What runners of tests count and how long each test took, whichever runner it was; and the table at the end of a run.
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import { bold, cache, ended, processorSeconds, readIfThere, root } from './lib.mjs'

/** @typedef {{ passed: number, failed: number, skipped: number }} Counts */

/** Of this run so far. @type {Counts} */
export const total = { passed: 0, failed: 0, skipped: 0 }

/** @type {{ name: string, seconds: number }[]} */
const times = []

/** What is counted, and why tests were skipped. `undefined` where no runner has said anything. @param {string} output @returns {Counts & { reasons: string[] } | undefined} */
export function counted(output) {
  const plain = [...output.matchAll(/^(\d+) passed, (\d+) failed, (\d+) skipped$/gm)].at(-1)
  if (plain) {
    const [passed = 0, failed = 0, skipped = 0] = plain.slice(1).map(Number)
    return { passed, failed, skipped, reasons: [] }
  }
  const sum = (/** @type {RegExp[]} */ ...lines) => lines.flatMap(line => [...output.matchAll(line)]).reduce((all, [, number]) => all + Number(number), 0)
  // cargo, Node's own runner (TAP) and Playwright. What cargo ignores is breadth, which has a turn of its own.
  let passed = sum(/^test result: .*?(\d+) passed/gm, /^# pass (\d+)$/gm, /^ {2}(\d+) passed\b/gm)
  let skipped = sum(/^# (?:skipped|todo) (\d+)$/gm, /^ {2}(\d+) skipped$/gm)
  const failed = sum(/^test result: .*?(\d+) failed/gm, /^# fail (\d+)$/gm, /^ {2}(\d+) (?:failed|flaky|interrupted|did not run)\b/gm)
  // A test in Rust that lacks what it needs (a log that may not be shipped, Python) cannot tell cargo so: it prints a line
  // `skipped: why` and returns.
  const reasons = [...output.matchAll(/^(?:test .*\.\.\. )?skipped: (.*)$/gm)].map(([, why]) => String(why))
  passed -= reasons.length
  skipped += reasons.length
  return passed + failed + skipped > 0 ? { passed, failed, skipped, reasons } : undefined
}

/** Adds up. @param {Counts} counts */
export function add({ passed, failed, skipped }) {
  total.passed += passed
  total.failed += failed
  total.skipped += skipped
}

/** @param {Counts & { reasons: string[] }} counts */
export const inWords = ({ passed, failed, skipped, reasons }) =>
  [`${passed} passed`, ...(failed > 0 ? [`${failed} failed`] : []), ...(skipped > 0 ? [`${skipped} skipped`] : []), ...reasons].join(', ')

/** The times that cargo's tests tell with `--report-time`. @param {string} output */
export function timeCargo(output) {
  for (const [, name = '', seconds] of output.matchAll(/^test (.+?) \.\.\. (?:.*)?<([\d.]+)s>$/gm)) times.push({ name, seconds: Number(seconds) })
}

/** The times in Playwright's report. */
export function timePlaywright() {
  const of = (/** @type {any} */ suite) => {
    for (const { title, tests } of suite.specs ?? []) {
      const seconds = tests.flatMap((/** @type {any} */ test) => test.results).reduce((/** @type {number} */ sum, /** @type {any} */ { duration }) => sum + duration / 1000, 0)
      times.push({ name: `${suite.file}: ${title}`, seconds })
    }
    for (const inner of suite.suites ?? []) of(inner)
  }
  for (const suite of JSON.parse(readIfThere(cache('e2e.json')) ?? '{}').suites ?? []) of(suite)
}

/** A test that takes longer says why in tests/slow.json [s]. */
const long = 20

/** Prints the steps with what they took, the dearest tests, and why some are long. */
export function printTable() {
  const number = (/** @type {number | undefined} */ seconds) => (seconds === undefined ? '–' : seconds.toFixed(1)).padStart(10)
  console.log(bold('\n   seconds  processor  step'))
  for (const { title, seconds, processor } of ended) if (seconds >= 0.5) console.log(`${number(seconds)} ${number(processor)}  ${title}`)
  console.log(`${number(performance.now() / 1000)} ${number(processorSeconds())}  all`)
  const dearest = times.toSorted((a, b) => b.seconds - a.seconds)
  if (dearest.length === 0) return
  console.log(bold('\n   seconds  the ten dearest tests'))
  for (const { name, seconds } of dearest.slice(0, 10)) console.log(`${number(seconds)}  ${name}`)
  const reasons = JSON.parse(readFileSync(join(root, 'tests', 'slow.json'), 'utf8'))
  for (const { name, seconds } of dearest.filter(({ seconds }) => seconds > long)) console.log(`${number(seconds)}  ${name}: ${reasons[name] ?? `over ${long} s, and tests/slow.json does not say why`}`)
}

/** The line that every runner of ours ends with. */
export const closingLine = () => `${total.passed} passed, ${total.failed} failed, ${total.skipped} skipped`
