// Who doubts a number finds the code that made it.
import assert from 'node:assert/strict'
import { existsSync, readFileSync } from 'node:fs'
import { join } from 'node:path'
import { test } from 'node:test'
import { root } from '../../scripts/lib.mjs'

/** Sources that are named in the sentences on how numbers were made, and are not there. @param {Record<string, { made: string }>} numbers */
const lost = numbers => {
  const named = new Set(Object.values(numbers).flatMap(({ made }) => made.match(/[\w/-]+\.rs\b/g) ?? []))
  return { named: named.size, missing: [...named].filter(file => !existsSync(join(root, file))) }
}

test('the sources that made the numbers are where their sentences say', () => {
  const { named, missing } = lost(JSON.parse(readFileSync(join(root, 'www', 'data', 'numbers.json'), 'utf8')))
  assert.ok(named > 5, `${named} sources`)
  assert.deepEqual(missing, [])
})

test('one that has moved is told', () => {
  assert.deepEqual(lost({ a: { made: 'a lap (src/lap.rs)' }, b: { made: 'by README.md' } }), { named: 1, missing: ['src/lap.rs'] })
})
