// No circles between files: those that use each other in a circle can only be read, moved and tested together.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import { circles, folders, named, picture, usesIn } from '../../scripts/imports.mjs'

for (const folder of folders) {
  test(`no files of ${folder} use each other in a circle`, () => {
    const uses = usesIn(folder)
    assert.ok([...uses.values()].some(others => others.size > 0))
    assert.deepEqual(circles(uses), [])
  })
}

/** @param {Record<string, string[]>} all of each file, those that it uses */
const uses = all => new Map(Object.entries(all).map(([file, others]) => [file, new Set(others)]))

test('a circle is found, and a chain is none', () => {
  assert.deepEqual(circles(uses({ a: ['b', 'd'], b: ['c'], c: ['a'], d: [] })), ['a b c'])
  assert.deepEqual(circles(uses({ a: ['b', 'c'], b: ['c'], c: [] })), [])
  assert.deepEqual(named('super::{one::{self, Two}, three as four}'), [['super', 'one', 'self'], ['super', 'one', 'Two'], ['super', 'three']])
})

test('a picture has a folder as one thing with an arrow for all that it uses, and circles in red', () => {
  const files = uses({ 'a/b': ['a/c', 'd'], 'a/c': ['d', 'e'], d: [], e: ['a/c'] })
  const [all, within] = [picture(files), picture(files, 'a/')]
  assert.deepEqual(all.nodes.map(({ name, attributes: { label, color } }) => [name, label, color]), [['a/', 'a/ 2', 'red'], ['d', undefined, undefined], ['e', undefined, 'red']])
  assert.deepEqual(all.edges.map(({ tail, head, attributes: { color } }) => [tail, head, color]), [['a/', 'd', undefined], ['a/', 'e', 'red'], ['e', 'a/', 'red']])
  assert.deepEqual(within.edges.map(({ tail, head }) => [tail, head]), [['b', 'c']])
})
