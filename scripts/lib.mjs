// What every script needs: named steps with their time, running tools with visible progress, finding tools.
// Only Node's own modules: these lines run before any package is installed.
import { AsyncLocalStorage } from 'node:async_hooks'
import { spawn, spawnSync } from 'node:child_process'
import { accessSync, constants, createWriteStream, mkdirSync, readFileSync, statSync } from 'node:fs'
import { homedir } from 'node:os'
import { delimiter, dirname, isAbsolute, join } from 'node:path'
import { fileURLToPath } from 'node:url'

export const root = dirname(dirname(fileURLToPath(import.meta.url)))

/** What to do where a disk is full. */
const roomHint = 'rm -rf target .cache takes away all that was built here, and the next run builds it anew.'

/** What the build writes for. Styles: the year of popovers, which no figure can do without, so that light-dark() need not be spelt out for older browsers. */
export const targets = { target: 'es2022', cssTarget: ['chrome125', 'firefox125', 'safari17.5'] }

/** Everything the scripts keep between runs, besides target/ and node_modules/. @param {string[]} parts */
export const cache = (...parts) => join(root, '.cache', ...parts)

// rustup writes PATH into shell profiles, which a shell opened earlier (or CI) has not read.
process.env.PATH = [process.env.PATH, join(process.env.CARGO_HOME ?? join(homedir(), '.cargo'), 'bin')].join(delimiter)

const terminal = process.stdout.isTTY && !process.env.CI
/** Whether all that the tools print is shown as it comes; without, their last line is, and of what failed the lines about it. */
const live = Boolean(process.env.VERBOSE)

/** @param {number} code */
const ansi = code => (/** @type {string} */ text) => (terminal && !process.env.NO_COLOR ? `\x1b[${code}m${text}\x1b[0m` : text)
export const bold = ansi(1)
export const dim = ansi(2)
export const red = ansi(31)
export const green = ansi(32)

/** A step that cannot go on: says what is wrong and, in `hint`, what would put it right. */
export class StepError extends Error {
  /** @param {string} message @param {string} [hint] */
  constructor(message, hint) {
    super(message)
    this.hint = hint
  }
}

/**
 * The step that what runs now belongs to: several may be under way.
 * @typedef {{ title: string, started: number, log: import('node:fs').WriteStream, path: string }} Step
 * @type {AsyncLocalStorage<Step>}
 */
const underWay = new AsyncLocalStorage()

/** Steps that have ended, in their order, for the table at the end. `processor` is undefined where others ran beside it. @type {{ title: string, seconds: number, processor: number | undefined }[]} */
export const ended = []

/** Steps begun and ended so far: whether a step was alone can be told from them. */
const counts = { begun: 0, running: 0 }

/** Seconds of processor that this process and the programs it has waited for have taken; undefined where the system does not tell. */
export function processorSeconds() {
  // After the name in parentheses, which may hold anything: utime, stime, cutime and cstime are the 12th to 15th field [1/100 s].
  const fields = readIfThere('/proc/self/stat')?.split(') ').at(-1)?.split(' ').slice(11, 15)
  return fields?.reduce((sum, ticks) => sum + Number(ticks) / 100, 0)
}

/** @param {number} bytes */
export const kilobytes = bytes => `${(bytes / 1000).toFixed(1)} KB`

/** @param {number} since */
const elapsed = since => {
  const seconds = (performance.now() - since) / 1000
  return seconds < 60 ? `${seconds.toFixed(1)} s` : `${Math.floor(seconds / 60)} min ${Math.round(seconds % 60)} s`
}

/** Prints lines of a step that stay. @param {string} text */
export function say(text) {
  clear()
  console.log(text)
}

/** Takes the line of progress away. */
function clear() {
  if (terminal && !live) process.stdout.write('\r\x1b[2K')
}

/** One line of progress: on a terminal it is overwritten by the next. @param {string} line */
function status(line) {
  // eslint-disable-next-line no-control-regex -- colours of the tools, which would be cut in the middle
  const plain = line.replace(/\x1b\[[0-9;]*m/g, '')
  if (!terminal) return console.log(plain.slice(0, 160))
  clear()
  process.stdout.write(dim(plain.slice(0, (process.stdout.columns ?? 80) - 3)))
}

/** How often a step tells how far it is, in ms: a log of CI keeps every line. */
const statusEvery = terminal ? 200 : 30_000

/** What tools print where something failed: cargo and its tests, Node's tests, Playwright, and scripts. */
const failure = /\bFAILED\b|panicked at|^error|^\w*Error\b|^\s*not ok\b|^\s+\d+\) .*›|✗|✘/

/** The lines of a tool that failed which tell of it, each with those after it; else its last. @param {string} output */
export function aboutFailures(output) {
  const [after, most] = [20, 400]
  const lines = output.trimEnd().split('\n')
  const shown = new Set(lines.flatMap((line, at) => (failure.test(line) ? Array.from({ length: after }, (_, more) => at + more) : [])))
  const about = shown.size > 0 ? lines.filter((_, at) => shown.has(at)) : lines.slice(-80)
  return about.slice(0, most).join('\n')
}

/**
 * Runs one named step: prints its name, its progress, and how long it took. What `action` returns as a string is shown beside
 * the name. A failure is printed here and thrown on. Steps may run side by side.
 * @param {string} title
 * @param {() => unknown} action
 */
export async function step(title, action) {
  const path = cache('logs', `${title.toLowerCase().replace(/[^a-z0-9]+/g, '-')}.log`)
  mkdirSync(dirname(path), { recursive: true })
  const log = createWriteStream(path).on('error', ({ message }) => {
    explain(new StepError(`${path} cannot be written: ${message}`, roomHint))
    process.exit(1)
  })
  const started = performance.now()
  const before = { processor: processorSeconds(), begun: ++counts.begun, alone: ++counts.running === 1 }
  if (live || !terminal) console.log(bold(`▸ ${title}`))
  else status(`▸ ${title} …`)
  try {
    const note = await underWay.run({ title, started, log, path }, async () => action())
    clear()
    console.log(`${green('✓')} ${title} ${dim(`(${elapsed(started)})`)}${typeof note === 'string' ? `  ${note}` : ''}`)
  } catch (error) {
    clear()
    console.log(`${red('✗')} ${bold(title)} ${dim(`(${elapsed(started)})`)}`)
    explain(error)
    throw error
  } finally {
    log.end()
    counts.running--
    const [now, alone] = [processorSeconds(), before.alone && counts.begun === before.begun]
    const processor = alone && now !== undefined && before.processor !== undefined ? now - before.processor : undefined
    ended.push({ title, seconds: (performance.now() - started) / 1000, processor })
  }
}

/** Errors that have been explained, so that they are not once more further out. */
const explained = new WeakSet()

/** @param {unknown} error */
function explain(error) {
  if (error instanceof Object) {
    if (explained.has(error)) return
    explained.add(error)
  }
  if (!(error instanceof StepError)) {
    console.error(error)
    return
  }
  const indent = (/** @type {string} */ text) => text.replace(/^/gm, '  ')
  console.log(red(indent(error.message)))
  if (error.hint) console.log(indent(error.hint))
}

/**
 * Runs a tool to its end, its output going to the terminal (or, on one, its last line) and to the step's log.
 * @param {string} command
 * @param {string[]} args
 * @param {{ cwd?: string, env?: Record<string, string>, hint?: string, quiet?: boolean }} [options] `quiet`: a failure is not printed
 * @returns {Promise<{ output: string, answer: string }>} all it printed, for readers, and what went to standard output alone, for programs:
 * a tool may tell of its progress in between at any time
 */
export function run(command, args, { cwd = root, env = {}, hint, quiet = false } = {}) {
  return new Promise((resolve, reject) => {
    const shown = [command, ...args].map(word => (isAbsolute(word) ? word.replace(root + '/', '') : word)).join(' ')
    if (live) console.log(dim(`  $ ${shown}`))
    const current = underWay.getStore()
    current?.log.write(`$ ${shown}\n`)
    let [output, answer] = ['', '']
    const child = spawn(command, args, { cwd, env: { ...process.env, ...env }, stdio: ['ignore', 'pipe', 'pipe'] })
    for (const stream of [child.stdout, child.stderr]) {
      stream.setEncoding('utf8')
      stream.on('data', chunk => {
        output += chunk
        if (stream === child.stdout) answer += chunk
        current?.log.write(chunk)
        if (live) process.stdout.write(chunk)
      })
    }
    const ticker = live
      ? undefined
      : setInterval(() => {
          const last = output.trimEnd().split(/[\r\n]/).at(-1)
          if (current) status(`▸ ${current.title} (${elapsed(current.started)})  ${last}`)
        }, statusEvery)
    child.on('error', error => {
      clearInterval(ticker)
      reject(new StepError(`${command} could not be started: ${error.message}`, hint))
    })
    child.on('close', (code, signal) => {
      clearInterval(ticker)
      if (code === 0) return resolve({ output, answer })
      if (!live && !quiet) say(aboutFailures(output))
      const error = new StepError(
        `${shown}: ${signal ? `ended by ${signal}` : `exit status ${code}`}`,
        hint ?? (current ? `All it printed: ${current.path}` : undefined),
      )
      reject(Object.assign(error, { output }))
    })
  })
}

/** What a tool prints, trimmed; undefined if it is missing or fails. @param {string} command @param {string[]} args */
export function capture(command, ...args) {
  const { status, stdout } = spawnSync(command, args, { cwd: root, encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'], maxBuffer: Infinity })
  return status === 0 ? stdout.trim() : undefined
}

/** Where a program is, by name on PATH or by path; undefined if nowhere. @param {string | undefined} name */
export function which(name) {
  if (!name) return undefined
  const places = name.includes('/') ? [name] : (process.env.PATH ?? '').split(delimiter).map(folder => join(folder, name))
  return places.find(place => {
    try {
      accessSync(place, constants.X_OK)
      return statSync(place).isFile()
    } catch {
      return false
    }
  })
}

/** A program of an npm package of ours. @param {string} name */
export const npmBin = name => join(root, 'node_modules', '.bin', name)

/** A file's text, or undefined if there is none. @param {string} path */
export function readIfThere(path) {
  try {
    return readFileSync(path, 'utf8')
  } catch {
    return undefined
  }
}

/** Whether the script is the one that was started, rather than imported. @param {ImportMeta} meta */
export const isMain = meta => process.argv[1] === fileURLToPath(meta.url)

/** Runs a script's main function. @param {() => Promise<void>} action */
export async function main(action) {
  try {
    await action()
  } catch (error) {
    explain(error)
    process.exitCode = 1
  }
}
