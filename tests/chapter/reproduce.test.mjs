// What the comparison of two builds finds.
import assert from 'node:assert/strict'
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { test } from 'node:test'
import { differences } from '../../scripts/reproduce.mjs'

test('two builds that differ by a byte, a length or a file are told apart, and where', () => {
  const folder = mkdtempSync(join(tmpdir(), 'reproduce-'))
  try {
    const [here, there] = ['here', 'there'].map(name => join(folder, name))
    assert.ok(here && there)
    for (const one of [here, there]) {
      mkdirSync(join(one, 'assets'), { recursive: true })
      writeFileSync(join(one, 'index.html'), 'the same')
      writeFileSync(join(one, 'assets', 'a.wasm'), Buffer.from([0, 1, 2, 255]))
    }
    assert.deepEqual(differences(here, there), [])
    writeFileSync(join(there, 'assets', 'a.wasm'), Buffer.from([0, 1, 3, 255]))
    writeFileSync(join(there, 'index.html'), 'the same\n')
    writeFileSync(join(there, 'new.js'), '')
    const said = differences(here, there)
    assert.deepEqual(said.map(line => line.replace(/: "[^]*$/, '')), ['assets/a.wasm: 4 and 4 bytes, apart from byte 2', 'index.html: 8 and 9 bytes, apart from byte 8', 'new.js: only there'])
  } finally {
    rmSync(folder, { recursive: true })
  }
})
