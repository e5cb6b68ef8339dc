// Every line of README on the command line is run, with few seeds and particles and with small files in place of the reader's. A unit of
// breadth: `cargo build` comes first.
import assert from 'node:assert/strict'
import { spawnSync } from 'node:child_process'
import { copyFileSync, existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { after, test } from 'node:test'
import { capture, root } from '../../scripts/lib.mjs'

const lines = [...readFileSync(join(root, 'README.md'), 'utf8').matchAll(/^cargo run --release --bin (fastslam\S*) -- (.+)$/gm)].map(([, name, line]) => [String(name), String(line)])
const programs = join(JSON.parse(capture('cargo', 'metadata', '--no-deps', '--format-version', '1') ?? '{}').target_directory, 'debug')

const folder = mkdtempSync(join(tmpdir(), 'readme-'))
after(() => rmSync(folder, { recursive: true }))

copyFileSync(join(root, 'tests', 'figures', 'golden', 'tiny.clf'), join(folder, 'tiny.clf'))
mkdirSync(join(folder, 'recording'))
copyFileSync(join(root, 'tests', 'bags', 'odometry-zstd.mcap'), join(folder, 'recording', 'bag.mcap'))
// Of one drive: scans that the second part repeats are left out.
for (const [part, bag] of ['plain.bag', 'lz4.bag'].entries()) copyFileSync(join(root, 'tests', 'bags', bag), join(folder, `PART_${part}.bag`))
writeFileSync(join(folder, 'robot.toml'), 'particles = 4\n')
writeFileSync(join(folder, 'noise.toml'), 'range-std = 0.2\n')
writeFileSync(join(folder, 'graph.g2o'), 'VERTEX_SE2 0 0 0 0\nVERTEX_XY 1 2 1\nVERTEX_SE2 2 1 0 0\nEDGE_SE2 0 2 1.1 0 0 100 0 0 100 0 400\nEDGE_SE2_XY 2 1 1 1 100 0 100\n')
// A car that drives straight on, past one tree.
const times = Array.from({ length: 20 }, (_, k) => k / 2)
writeFileSync(join(folder, 'DRS.txt'), times.map(time => `${time},2,0\n`).join(''))
writeFileSync(join(folder, 'GPS.txt'), times.map(time => `${time},${2 * time},0\n`).join(''))
writeFileSync(join(folder, 'SIGHTINGS.txt'), times.slice(1, 10).map(time => `${time} ${Math.hypot(20 - 2 * time, 5)} ${Math.atan2(5, 20 - 2 * time)} 1\n`).join(''))

/** What is asked of the reader, and what only takes time. @type {[RegExp, string][]} */
const smaller = [
  [/--seeds \d+/, '--seeds 2'],
  [/--particles 100\b/, '--particles 4'],
  [/--sweeps \d+/, '--sweeps 2'],
  [/--length 120/, '--length 60'],
  [/FILE\.clf\.gz/, 'tiny.clf'],
  [/FOLDER --scan-topic \/front\/scan/, 'recording --scan-topic /scan'],
  [/FILE\.g2o/, 'graph.g2o'],
  [/\bFOLDER\b/, '.'],
  [/\.\.\/shared\//, join(root, '..', 'shared', '/')],
]

assert.ok(lines.length > 10, 'README has lines on the command line')
for (const [name = '', line = ''] of lines) {
  const words = smaller.reduce((text, [found, by]) => text.replace(found, by), line).split(' ')
  const shared = words.find(word => word.includes('/shared/'))
  const skip = shared && !existsSync(shared) && !existsSync(`${shared}-landmarks.dat`) ? `${shared} is not there` : false
  test(`${name} ${line}`, { skip }, () => {
    const { status, stderr, error } = spawnSync(join(programs, name), words, { cwd: folder, encoding: 'utf8' })
    assert.equal(error, undefined)
    assert.equal(status, 0, stderr)
  })
}
