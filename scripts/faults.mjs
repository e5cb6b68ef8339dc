// npm run test:faults: shows that the tests can fail. Each patch in tests/faults is a deliberate fault. Above its diff stand a sentence on
// what is broken and, after `$`, the one command of npm test that must turn red; a check that is not a test also has, after `>`, what it
// must say. The patch is applied, the command is run, and the patch is taken back. `-- NAME …` tries the faults whose names begin so.
// A fault is not found where the command stays green, where it breaks without a test that fails, or where the patch no longer applies.
// `-- --without NAME …` leaves the patches out: each command must be green, or its red would say nothing.
import { existsSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { delimiter, dirname, join } from 'node:path'
import { aboutFailures, cache, capture, main, readIfThere, root, run, step, StepError } from './lib.mjs'
import { add, closingLine, counted, printTable, total } from './tally.mjs'

const folder = join(root, 'tests', 'faults')

/** @typedef {{ name: string, what: string, command: string, says: string | undefined, path: string, files: string[] }} Fault */

/** @param {string} file @returns {Fault} */
function read(file) {
  const [path, name] = [join(folder, file), file.replace(/\.patch$/, '')]
  const text = readFileSync(path, 'utf8')
  const [, what = '', command = '', says] = /^(.+)\n\$ (.+)\n(?:> (.+)\n)?/.exec(text) ?? []
  if (command === '') throw new StepError(`${file} does not begin with a sentence and, on the next line, \`$ command\`.`)
  return { name, what, command, says, path, files: [...text.matchAll(/^\+\+\+ b\/(.+)$/gm)].map(([, file]) => String(file)) }
}

/** What is built with a fault is built apart from all else, so that the next run of npm test builds nothing anew. */
const apart = {
  PATH: [join(root, 'node_modules', '.bin'), process.env.PATH].join(delimiter),
  FASTSLAM_DIST: cache('faults', 'dist'),
  CARGO_TARGET_DIR: join(root, 'target', 'faults'),
  // Each fault compiles anew what it is in, which takes far longer than the few tests that are run.
  CARGO_PROFILE_TEST_OPT_LEVEL: '0',
  CARGO_PROFILE_TEST_CODEGEN_UNITS: '256',
  CARGO_INCREMENTAL: '1',
  CARGO_PROFILE_TEST_DEBUG: 'false',
  CARGO_TERM_COLOR: 'never',
}

/** The patch that is applied now is noted in this file, so that one that a killed run has left is taken back by the next. */
const applied = cache('faults', 'applied')

/** @param {string} path */
async function apply(path) {
  await run('git', ['apply', path], { quiet: true })
  mkdirSync(dirname(applied), { recursive: true })
  writeFileSync(applied, path)
}

/** Takes back the patch that is applied, if one is. */
function undo() {
  const path = readIfThere(applied)
  if (path === undefined) return
  if (existsSync(path)) capture('git', 'apply', '--reverse', path)
  rmSync(applied)
}

process.on('exit', undo)
for (const signal of ['SIGINT', 'SIGTERM', 'SIGHUP']) process.on(signal, () => process.exit(1))

/** Runs the command of a fault. @param {Fault} fault */
async function attempt({ command }) {
  const red = (/** @type {{ output?: string }} */ { output }) => ({ green: false, output: String(output ?? '') })
  return run('sh', ['-c', command], { env: apart, quiet: true }).then(({ output }) => ({ green: true, output }), red)
}

/** @param {Fault} fault */
async function find(fault) {
  const { what, command, says, path, files } = fault
  if (capture('git', 'diff', '--quiet', 'HEAD', '--', ...files) === undefined) throw new StepError(`There are changes of yours in ${files.join(', ')}: commit them first.`)
  await apply(path).catch(() => {
    throw new StepError(`The patch no longer applies: ${what}`, 'Make the same fault in the code of today.')
  })
  try {
    const { green, output } = await attempt(fault)
    if (green) throw new StepError(`Nothing turned red: ${what}`, command)
    if (says !== undefined) {
      if (!output.includes(says)) throw Object.assign(new StepError(`The command broke, and did not say “${says}”: ${what}`, aboutFailures(output)), { output })
      return what
    }
    const failed = counted(output)?.failed ?? 0
    if (failed === 0) throw Object.assign(new StepError(`The command broke, and no test failed: ${what}`, aboutFailures(output)), { output })
    return `${what} (${failed} red)`
  } finally {
    undo()
  }
}

/** @param {Fault} fault */
async function leaveOut(fault) {
  const { green, output } = await attempt(fault)
  if (!green) throw Object.assign(new StepError('Without the fault it is not green.', aboutFailures(output)), { output })
  const { passed = 0 } = counted(output) ?? {}
  if (fault.says === undefined && passed === 0) throw new StepError('Not one test was run.', fault.command)
  return `${passed} green`
}

await main(async () => {
  undo()
  const words = process.argv.slice(2)
  const [without, wanted] = [words.includes('--without'), words.filter(word => word !== '--without')]
  const faults = readdirSync(folder).filter(file => file.endsWith('.patch')).sort().map(read).filter(({ name }) => wanted.length === 0 || wanted.some(word => name.startsWith(word)))
  if (faults.length === 0) throw new StepError(`There is no fault of such a name in tests/faults: ${wanted.join(', ')}`)
  for (const fault of faults) {
    const found = await step(fault.name, () => (without ? leaveOut(fault) : find(fault))).then(() => true, () => false)
    add({ passed: Number(found), failed: Number(!found), skipped: 0 })
  }
  printTable()
  console.log(closingLine())
  if (total.failed > 0) process.exitCode = 1
})
