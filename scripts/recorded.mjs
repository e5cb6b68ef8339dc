// npm run recorded: measures the chapter's numbers of recorded logs (www/data/logs.json) and draws its picture of one (www/data/intel.png), natively.
// cspell:ignore FLASER IHDR PLTE IDAT IEND
// The logs are not shipped: they are read from ../shared/data, and what is kept says by SHA-256 which they were.
import { spawnSync } from 'node:child_process'
import { createHash } from 'node:crypto'
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { crc32, deflateSync } from 'node:zlib'
import { capture, isMain, main, root, run, step, StepError } from './lib.mjs'
import { setUp } from './setup.mjs'

/**
 * A number of recorded logs. `made` is the command that measures it, run where the logs are, and `at` the way to the number in what that prints;
 * with `seeds` it is the median of so many runs, with seeds from 1.
 * @typedef {{ value: number, unit: string, made: string, at: string, seeds?: number, logs: Record<string, string> }} Recorded
 */

export const data = join(root, '..', 'shared', 'data')
const www = join(root, 'www', 'data')
const file = join(www, 'logs.json')

/** @returns {Record<string, Recorded>} */
export const recorded = () => JSON.parse(readFileSync(file, 'utf8'))

/** @param {string} log its name */
export const sha256 = log => createHash('sha256').update(readFileSync(join(data, log))).digest('hex')

/** The first of the logs that is not there. @param {Recorded} number */
export const absent = ({ logs }) => Object.keys(logs).find(log => !existsSync(join(data, log)))

/** What was printed, by command: several numbers come from one. @type {Map<string, string>} */
const outputs = new Map()

/** What the command line prints where the logs are. @param {string} program @param {string[]} words */
function printed(program, words) {
  const before = outputs.get(words.join(' '))
  if (before !== undefined) return before
  const { status, stdout, stderr, error } = spawnSync(program, words, { cwd: data, encoding: 'utf8', maxBuffer: Infinity })
  if (status !== 0) throw new StepError(`fastslam ${words.join(' ')} failed: ${error?.message ?? stderr}`)
  outputs.set(words.join(' '), stdout)
  return stdout
}

/** Measures a number anew. @param {Recorded} number @param {string} program */
export function measure({ made, at, seeds }, program) {
  const values = Array.from({ length: seeds ?? 1 }, (_, k) => {
    const words = [...made.split(' ').slice(1), ...(seeds ? ['--seed', String(k + 1)] : [])]
    const value = at.split('.').reduce((/** @type {any} */ part, key) => part?.[key], JSON.parse(printed(program, words)))
    if (typeof value !== 'number') throw new StepError(`${made} prints no number ${at}.`)
    return value
  })
  return values.sort((a, b) => a - b)[Math.floor(values.length / 2)] ?? NaN
}

/** Beams of 180° that meet something, and a pose [m, rad], of each scan of a CARMEN log. @param {string} text */
function scansOf(text) {
  const lines = text.split('\n').filter(line => line.startsWith('FLASER '))
  return lines.map(line => {
    const [count = 0, ...rest] = line.split(' ').slice(1).map(Number)
    const [x = 0, y = 0, heading = 0] = rest.slice(count)
    return { ranges: rest.slice(0, count), pose: [x, y, heading] }
  })
}

/** The poses of a path in TUM format. @param {string} text */
const posesOf = text => text.trim().split('\n').filter(line => !line.startsWith('#')).map(line => {
  const [, x = 0, y = 0, , , , sin = 0, cos = 1] = line.split(' ').map(Number)
  return [x, y, 2 * Math.atan2(sin, cos)]
})

/** Longest side of a half, and the room between the two [px]. */
const [side, gap] = [560, 40]
/** Beams longer than this [m] are left out: of all that was seen, they are scattered most. */
const reach = 8

/**
 * All that was seen, as dots where these poses have it, and the path: columns and rows of colours, 0 for none, 1 to 3 for dots, 4 for the path.
 * @param {{ ranges: number[] }[]} scans @param {number[][]} poses
 */
function half(scans, poses) {
  const dots = scans.flatMap(({ ranges }, k) => {
    const [x = 0, y = 0, heading = 0] = poses[k] ?? []
    const seen = ranges.map((range, beam) => ({ range, angle: heading + ((beam - 90) * Math.PI) / 180 })).filter(({ range }) => range < reach)
    return seen.map(({ range, angle }) => [x + range * Math.cos(angle), y + range * Math.sin(angle)])
  })
  const [low, high] = [Math.min, Math.max].map(end => [0, 1].map(axis => [...dots, ...poses].map(place => place[axis] ?? 0).reduce((a, b) => end(a, b))))
  const [[left = 0, bottom = 0] = [], [right = 0, top = 0] = []] = [low, high]
  const scale = (side - 1) / Math.max(right - left, top - bottom)
  const at = (/** @type {number[]} */ [x = 0, y = 0]) => [Math.floor((x - left) * scale), Math.floor((top - y) * scale)]
  /** @type {Map<string, number>} */
  const pixels = new Map()
  for (const dot of dots) {
    const key = at(dot).join()
    pixels.set(key, Math.min(3, (pixels.get(key) ?? 0) + 1))
  }
  poses.slice(1).forEach((to, k) => {
    const from = poses[k] ?? to
    for (let part = 0; part <= 1; part += 0.02) pixels.set(at(to.map((end, axis) => (from[axis] ?? 0) + part * (end - (from[axis] ?? 0)))).join(), 4)
  })
  return { pixels, columns: Math.ceil((right - left) * scale) + 1, rows: Math.ceil((top - bottom) * scale) + 1 }
}

/** Grey and red that can be seen on light and on dark ground, on none. Red, green, blue, opacity. */
const colours = [[0, 0, 0, 0], [118, 124, 134, 110], [118, 124, 134, 180], [118, 124, 134, 255], [214, 84, 40, 255]]

/** A PNG with a palette. @param {number} columns @param {Uint8Array[]} rows */
function png(columns, rows) {
  const chunk = (/** @type {string} */ name, /** @type {Uint8Array} */ bytes) => {
    const body = Buffer.concat([Buffer.from(name), bytes])
    const [length, check] = [Buffer.alloc(4), Buffer.alloc(4)]
    length.writeUInt32BE(bytes.length)
    check.writeUInt32BE(crc32(body))
    return Buffer.concat([length, body, check])
  }
  const head = Buffer.alloc(13)
  head.writeUInt32BE(columns)
  head.writeUInt32BE(rows.length, 4)
  head.set([8, 3], 8)
  const bytes = deflateSync(Buffer.concat(rows.flatMap(row => [Buffer.from([0]), row])), { level: 9 })
  const palette = Buffer.from(colours.flatMap(colour => colour.slice(0, 3)))
  const opacity = Buffer.from(colours.map(colour => colour[3] ?? 0))
  const signature = Buffer.from('89504e470d0a1a0a', 'hex')
  return Buffer.concat([signature, chunk('IHDR', head), chunk('PLTE', palette), chunk('tRNS', opacity), chunk('IDAT', bytes), chunk('IEND', Buffer.alloc(0))])
}

/** Left what raw odometry makes of the scans, right what the mapper does. @param {string} program */
export function draw(program) {
  const folder = mkdtempSync(join(tmpdir(), 'recorded-'))
  try {
    const path = join(folder, 'path.tum')
    printed(program, ['log', 'intel.clf', '--trajectory', path])
    const scans = scansOf(readFileSync(join(data, 'intel.clf'), 'utf8'))
    const [left, right] = [scans.map(({ pose }) => pose), posesOf(readFileSync(path, 'utf8'))].map(poses => half(scans, poses))
    if (!left || !right) throw new StepError('There is nothing to draw.')
    const [columns, height] = [left.columns + gap + right.columns, Math.max(left.rows, right.rows)]
    const rows = Array.from({ length: height }, () => new Uint8Array(columns))
    for (const [{ pixels, rows: own }, from] of /** @type {const} */ ([[left, 0], [right, left.columns + gap]])) {
      for (const [key, colour] of pixels) {
        const [x = 0, y = 0] = key.split(',').map(Number)
        const row = rows[y + Math.floor((height - own) / 2)]
        if (row) row[from + x] = colour
      }
    }
    const bytes = png(columns, rows)
    writeFileSync(join(www, 'intel.png'), bytes)
    return `${columns} × ${height} px, ${(bytes.length / 1000).toFixed(1)} KB`
  } finally {
    rmSync(folder, { recursive: true })
  }
}

if (isMain(import.meta)) {
  await main(async () => {
    await setUp()
    await step('The command line', () => run('cargo', ['build', '--release', '--bin', 'fastslam']))
    const program = join(JSON.parse(capture('cargo', 'metadata', '--no-deps', '--format-version', '1') ?? '{}').target_directory, 'release', 'fastslam')
    const all = recorded()
    for (const [key, number] of Object.entries(all)) {
      await step(key, () => {
        const without = absent(number)
        if (without) return `${without} is not there: kept as it was`
        number.logs = Object.fromEntries(Object.keys(number.logs).map(log => [log, sha256(log)]))
        number.value = measure(number, program)
        return String(number.value)
      })
    }
    writeFileSync(file, `{\n${Object.entries(all).map(([key, number]) => `${JSON.stringify(key)}: ${JSON.stringify(number)}`).join(',\n')}\n}\n`)
    if (existsSync(join(data, 'intel.clf'))) await step('The picture', () => draw(program))
  })
}
