// What follows from the registry of the figures is as its rows say.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import { staleLists } from '../../scripts/registry.mjs'

test('features, modules and the list of README are those of the rows of the registry', () => {
  assert.deepEqual([...staleLists().keys()], [], 'npm run build writes them')
})
