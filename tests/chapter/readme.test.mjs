// What README promises is run: each command of its tables by a unit of breadth, which is told here if one is missing.
import assert from 'node:assert/strict'
import { readdirSync, readFileSync } from 'node:fs'
import { join } from 'node:path'
import { test } from 'node:test'
import { root } from '../../scripts/lib.mjs'
import { grounds, shareOf, shares, takes, touched, units } from '../breadth.mjs'

const text = readFileSync(join(root, 'README.md'), 'utf8')

test('every command in the tables of README is run by a unit of breadth', () => {
  const commands = [...text.matchAll(/^\| `([^`]+)` \|/gm)].map(([, command]) => String(command)).filter(command => /^(npm|wasm-pack) /.test(command))
  assert.ok(commands.length > 8)
  for (const command of commands) assert.ok(units.some(unit => unit.command.includes(command)), `no unit runs ${command}`)
})

test('every file with tests of breadth is run by a unit', () => {
  const specs = join(root, 'tests', 'e2e')
  const broad = readdirSync(specs).filter(file => file.endsWith('.spec.ts') && /\bbreadth(Of|But)?\b/.test(readFileSync(join(specs, file), 'utf8')))
  assert.ok(broad.length > 20)
  assert.deepEqual(broad.filter(file => !units.some(({ command }) => command.includes('--grep @breadth') && command.includes(`/${file}`))), [])
})

test('each unit of breadth says what it stands on, and a change finds the units to run before it lands', () => {
  assert.deepEqual(units.filter(({ name }) => !grounds.some(([names]) => names.test(name))).map(({ name }) => name), [])
  assert.deepEqual(grounds.filter(([names]) => !units.some(({ name }) => names.test(name))), [])
  const named = (/** @type {string[]} */ ...files) => touched(files).map(({ name }) => name)
  assert.deepEqual(named('tests/e2e/walk.spec.ts').filter(name => !/^(page|programs|readme-offline)/.test(name)), [])
  assert.deepEqual(named('tests/factrs/src/lib.rs'), ['factrs'])
  assert.deepEqual(named('CHANGELOG.md'), [])
  for (const [file, unit] of [['README.md', 'readme-command-line'], ['src/log/lib.rs', 'logs'], ['widgets/elements/mapping.ts', 'page-logs'], ['tests/readme/site.test.mjs', 'readme-build'], ['scripts/single.mjs', 'readme-offline']]) {
    assert.ok(named(String(file)).includes(String(unit)), `${file} touches ${unit}`)
  }
})

test('units of breadth have names of their own and take six minutes at most, and every one has its turn', () => {
  assert.equal(new Set(units.map(({ name }) => name)).size, units.length)
  for (const { name, seconds } of units) assert.ok(seconds > 0 && seconds <= 360, name)
  assert.deepEqual(shares.flat().map(({ name }) => name).sort(), units.map(({ name }) => name).sort())
  for (const share of shares) assert.ok(takes(share) <= 720)
  // Three hours later it is the next share's turn; the same commit has always the same.
  const turns = shares.map((_, k) => shareOf(1_800_000_000 + k * 3 * 3600).number)
  assert.deepEqual(turns.toSorted((a, b) => a - b), shares.map((_, k) => k))
  assert.deepEqual(shareOf(1_800_000_000), shareOf(1_800_000_000))
  // And each unit is the first of its share in turn, so that none is always left for later.
  const share = shares[0] ?? []
  const firsts = share.map((_, round) => shareOf(3 * 3600 * (round * shares.length)).units[0]?.name)
  assert.deepEqual(firsts.sort(), share.map(({ name }) => name).sort())
})
