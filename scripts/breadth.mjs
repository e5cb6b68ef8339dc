// npm run test:all: npm test, then breadth: the units of tests/breadth.mjs, one after the other. The last line is the total of all.
//   -- --unit NAME   that unit (may be given several times)      -- --turn K   the units of share K
//   -- --share       the share whose turn it is, as CI does       -- --list     what there is
//   -- --due         when the turn of each share comes
//   -- --touched REV the units that stand on what has changed since a revision, HEAD~1 if none is named: those to run before it lands
// Whose turn it is follows from the date of the last commit, so that the same commit always runs the same share.
import { delimiter, join } from 'node:path'
import { build } from './build.mjs'
import { aboutFailures, bold, cache, capture, main, readIfThere, red, root, run, step, StepError } from './lib.mjs'
import { singlesTested } from './registry.mjs'
import { setUp } from './setup.mjs'
import { add, closingLine, counted, inWords, printTable, total } from './tally.mjs'
import { shareOf, shares, takes, touched, turn, units } from '../tests/breadth.mjs'

/** A share takes no longer than that, however slow the machine [s]. */
const most = 12 * 60

/** @typedef {import('../tests/breadth.mjs').Unit} Unit */

/** How many times its usual seconds a unit is expected to take, by what npm test took just now. */
const pace = () => Number(readIfThere(cache('pace')) ?? 1)

/** @type {{ title: string, about: string }[]} */
const failures = []

/** @param {Unit} unit */
async function runUnit({ name, command }) {
  const env = { PATH: [join(root, 'node_modules', '.bin'), process.env.PATH].join(delimiter) }
  const before = total.failed
  try {
    await step(name, async () => {
      const { output } = await run('sh', ['-c', command], { env }).catch(error => {
        add(counted(error.output ?? '') ?? { passed: 0, failed: 1, skipped: 0 })
        throw error
      })
      // A command without tests has done what it says it does.
      const counts = counted(output) ?? { passed: 1, failed: 0, skipped: 0, reasons: [] }
      add(counts)
      if (counts.passed + counts.skipped === 0) throw Object.assign(new StepError(`no test was run by it: ${command}`), { output })
      if (counts.failed > 0) throw Object.assign(new StepError(`${counts.failed} failed, and yet the command ended well: ${command}`), { output })
      return inWords(counts)
    })
  } catch (error) {
    const { message, output } = /** @type {Error & { output?: string }} */ (error)
    failures.push({ title: name, about: output === undefined ? message : aboutFailures(output) })
    if (total.failed === before) total.failed++
  }
}

/** Runs what fits into the time of a share, and tells what is left for later. @param {Unit[]} wanted */
async function runShare(wanted) {
  const started = performance.now()
  let [slower, usual] = [pace(), 0]
  const [ran, left] = [/** @type {string[]} */ ([]), /** @type {string[]} */ ([])]
  for (const unit of wanted) {
    const elapsed = (performance.now() - started) / 1000
    // After a minute, what the share itself has taken tells more than the tests before it.
    if (usual > 60) slower = elapsed / usual
    if (elapsed + unit.seconds * slower > most) left.push(unit.name)
    else {
      await runUnit(unit)
      usual += unit.seconds
      ran.push(unit.name)
    }
  }
  console.log(bold(`\nBreadth run: ${ran.join(', ') || 'nothing'}`))
  console.log(`Left for later, as this run is ${slower.toFixed(1)} times as slow as usual: ${left.join(', ') || 'nothing'}`)
}

/** The values of an option that may be given several times. @param {string} option */
const given = option => process.argv.flatMap((word, i) => (word === option ? [process.argv[i + 1] ?? ''] : []))

/** @param {string} name */
function unitNamed(name) {
  const unit = units.find(unit => unit.name === name)
  if (!unit) throw new StepError(`There is no unit ${name}.`, `There are: ${units.map(({ name }) => name).join(', ')}`)
  return unit
}

/** What is to come: CI runs a share of each commit, so none is run in turns without one. */
function tellDue() {
  const now = Math.floor(Date.now() / 1000 / turn) * turn
  for (const k of shares.keys()) console.log(`${new Date((now + k * turn) * 1000).toISOString().slice(0, 16)}Z  share ${shareOf(now + k * turn).number}: ${shareOf(now + k * turn).units.map(({ name }) => name).join(', ')}`)
  console.log(`A commit runs the share of its own date. A unit waits ${(shares.length * turn) / 3600} h for its next turn, and longer where no commit falls into that.`)
}

/** @param {string} revision */
function tellTouched(revision) {
  const changed = capture('git', 'diff', '--name-only', revision)
  if (changed === undefined) throw new StepError(`git knows no revision ${revision}.`)
  const found = touched(changed.split('\n').filter(Boolean))
  for (const { name, seconds } of found) console.log(`${String(seconds).padStart(4)} s  ${name}`)
  console.log(found.length === 0 ? 'No unit stands on what has changed.' : `${(takes(found) / 60).toFixed(1)} min: npm run test:all -- ${found.map(({ name }) => `--unit ${name}`).join(' ')}`)
}

await main(async () => {
  if (process.argv.includes('--due')) return tellDue()
  if (process.argv.includes('--touched')) return tellTouched(given('--touched')[0] || 'HEAD~1')
  if (process.argv.includes('--list')) {
    for (const [k, share] of shares.entries()) for (const { name, seconds, command } of share) console.log(`${k}  ${String(seconds).padStart(4)} s  ${name.padEnd(28)}  ${command}`)
    console.log(`${units.length} units of ${(takes(units) / 60).toFixed(1)} min, in ${shares.length} shares`)
    return
  }
  const [names, turns, share] = [given('--unit'), given('--turn').map(Number), process.argv.includes('--share')]
  const wrong = turns.find(turn => !shares[turn])
  if (wrong !== undefined) throw new StepError(`There is no share ${wrong}: they are numbered from 0 to ${shares.length - 1}.`)
  const wanted = [...names.map(unitNamed), ...turns.flatMap(turn => shares[turn] ?? [])]
  const all = wanted.length === 0 && !share
  if (all) await runUnit({ name: 'npm test', seconds: 0, command: 'npm test' })
  else {
    await setUp({ browser: true })
    await build(singlesTested)
  }
  if (share) {
    const due = shareOf(Number(capture('git', 'log', '-1', '--format=%ct')))
    console.log(bold(`\nBreadth: share ${due.number} of ${shares.length}, by the date of the last commit`))
    await runShare(due.units)
  } else for (const unit of all ? units : wanted) await runUnit(unit)

  printTable()
  for (const { title, about } of failures) console.log(`\n${red(bold(title))}\n${about}`)
  if (failures.length > 0) console.log(red(bold(`\nFailed: ${failures.map(({ title }) => title).join('; ')}`)))
  console.log(closingLine())
  if (failures.length > 0) process.exitCode = 1
})
