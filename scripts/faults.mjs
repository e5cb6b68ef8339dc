// npm run test:faults: shows that the tests can fail. Each patch in tests/faults is a deliberate fault, and names the one command of npm
// test that must turn red; it is applied, the command is run, and the patch is taken back. `-- NAME …` tries those whose names begin so.
// A fault is not found where the command stays green, where it breaks without a test that fails, or where the patch no longer applies.
import { readdirSync, readFileSync } from 'node:fs'
import { delimiter, join } from 'node:path'
import { cache, capture, main, root, run, step, StepError } from './lib.mjs'
import { add, closingLine, counted, printTable, total } from './tally.mjs'

const folder = join(root, 'tests', 'faults')

/** @typedef {{ name: string, what: string, command: string, path: string, files: string[] }} Fault */

/** @param {string} file @returns {Fault} */
function read(file) {
  const [path, name] = [join(folder, file), file.replace(/\.patch$/, '')]
  const text = readFileSync(path, 'utf8')
  const [, what = '', command = ''] = /^(.+)\n\$ (.+)\n/.exec(text) ?? []
  if (command === '') throw new StepError(`${file} does not begin with a sentence and, on the next line, \`$ command\`.`)
  return { name, what, command, path, files: [...text.matchAll(/^\+\+\+ b\/(.+)$/gm)].map(([, file]) => String(file)) }
}

/** Undoes the patch that is applied now, if one is. */
let undo = () => {}
process.on('exit', () => undo())
for (const signal of ['SIGINT', 'SIGTERM']) process.on(signal, () => process.exit(1))

/** @param {Fault} fault */
async function find({ what, command, path, files }) {
  if (capture('git', 'diff', '--quiet', 'HEAD', '--', ...files) === undefined) throw new StepError(`There are changes of yours in ${files.join(', ')}: commit them first.`)
  await run('git', ['apply', path], { hint: `The patch no longer applies: make the same fault in the code of today (${what}).` })
  undo = () => {
    undo = () => {}
    capture('git', 'apply', '--reverse', path)
  }
  try {
    const env = { PATH: [join(root, 'node_modules', '.bin'), process.env.PATH].join(delimiter), FASTSLAM_DIST: cache('faults', 'dist') }
    const { green, output } = await run('sh', ['-c', command], { env, quiet: true }).then(({ output }) => ({ green: true, output }), ({ output }) => ({ green: false, output: String(output) }))
    if (green) throw new StepError(`Nothing turned red: ${what}`, command)
    const failed = counted(output)?.failed ?? 0
    if (failed === 0) throw Object.assign(new StepError(`The command broke, and no test failed: ${what}`, command), { output })
    return `found by ${failed} test${failed > 1 ? 's' : ''}: ${what}`
  } finally {
    undo()
  }
}

await main(async () => {
  const wanted = process.argv.slice(2)
  const faults = readdirSync(folder).filter(file => file.endsWith('.patch')).sort().map(read).filter(({ name }) => wanted.length === 0 || wanted.some(word => name.startsWith(word)))
  if (faults.length === 0) throw new StepError(`There is no fault of such a name in tests/faults: ${wanted.join(', ')}`)
  for (const fault of faults) {
    const found = await step(fault.name, () => find(fault)).then(() => true, () => false)
    add({ passed: Number(found), failed: Number(!found), skipped: 0 })
  }
  printTable()
  console.log(closingLine())
  if (total.failed > 0) process.exitCode = 1
})
