// npm run numbers: measures every number of the chapter natively (some minutes), writes www/data, and leaves out of numbers.json what no page uses.
// `-- --only PREFIX` measures some of them again, `-- --threads N` uses fewer processors, `-- --unused` only leaves out what has come out of use.
import { spawn } from 'node:child_process'
import { existsSync, readdirSync, readFileSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import { renderLapTable } from './chapter/lap-table.mjs'
import { isMain, main, root, run, step, StepError } from './lib.mjs'
import { setUp } from './setup.mjs'

const www = join(root, 'www')
const file = join(www, 'data', 'numbers.json')
/** Of recorded logs, by scripts/recorded.mjs. */
const logs = join(www, 'data', 'logs.json')

/** Keys that the Markdown of the pages names, and those that their lap table reads. @param {Record<string, { value: number }>} numbers */
function usedIn(numbers) {
  const texts = readdirSync(www, { recursive: true, encoding: 'utf8' })
    .filter(name => name.endsWith('.md'))
    .map(name => readFileSync(join(www, name), 'utf8'))
  const used = new Set(texts.flatMap(text => [...text.matchAll(/:num\[([^\]]+)\]/g)].map(([, key]) => String(key))))
  if (texts.some(text => /^:+lap-table/m.test(text))) {
    renderLapTable(new Proxy(numbers, { get: (all, key) => used.add(String(key)) && Reflect.get(all, key) }))
  }
  return used
}

/** A number that no page uses fails the build of the pages, so none is kept: a prose that begins to use one measures it again. */
function leaveOutUnused() {
  if (!existsSync(file)) throw new StepError('There is no www/data/numbers.json.', 'npm run numbers makes it.')
  const lines = readFileSync(file, 'utf8').split('\n')
  const numbers = JSON.parse(lines.join('\n'))
  const used = usedIn(numbers)
  if (used.size === 0) return 'no page uses any number yet, so all are kept'
  const keyOf = (/** @type {string} */ line) => /^"([^"]+)":/.exec(line)?.[1]
  const kept = lines.filter(line => used.has(keyOf(line) ?? ''))
  writeFileSync(file, `{\n${kept.map(line => line.replace(/,$/, '')).join(',\n')}\n}\n`)
  const ofLogs = JSON.parse(readFileSync(logs, 'utf8'))
  const missing = [...used].filter(key => !(key in numbers || key in ofLogs))
  const out = Object.keys(numbers).length - kept.length
  if (missing.length > 0) throw new StepError(`The prose uses numbers that are not there: ${missing.join(', ')}.`, 'npm run numbers -- --only KEY measures one that src/experiment/numbers knows.')
  return `${kept.length} numbers kept, ${out} that no page uses left out`
}

/** With its own progress bar on the terminal. @param {string[]} args @returns {Promise<void>} */
function measure(args) {
  return new Promise((resolve, reject) => {
    const child = spawn('cargo', ['run', '--release', '--quiet', '--bin', 'fastslam-lab', '--', 'numbers', ...args], { cwd: root, stdio: 'inherit' })
    child.on('error', error => reject(new StepError(`cargo could not be started: ${error.message}`)))
    child.on('close', code => (code === 0 ? resolve() : reject(new StepError('The numbers were not measured.'))))
  })
}

if (isMain(import.meta)) {
  await main(async () => {
    const args = process.argv.slice(2)
    if (!args.includes('--unused')) {
      await setUp()
      await step('The command line', () => run('cargo', ['build', '--release', '--bin', 'fastslam-lab']))
      await step('The numbers of the chapter', () => measure(args))
    }
    await step('What the pages use', leaveOutUnused)
  })
}
