// What follows from the registry of the figures is as its rows say.
import assert from 'node:assert/strict'
import { existsSync } from 'node:fs'
import { join } from 'node:path'
import { test } from 'node:test'
import { root } from '../../scripts/lib.mjs'
import { programs, staleLists } from '../../scripts/registry.mjs'

test('features, modules and the list of README are those of the rows of the registry', () => {
  assert.deepEqual([...staleLists().keys()], [], 'npm run build writes them')
})

test('every figure has a picture in both themes, for where it cannot run', () => {
  const pictures = [...programs.keys()].flatMap(tag => [`${tag}-light.png`, `${tag}-dark.png`])
  assert.deepEqual(pictures.filter(file => !existsSync(join(root, 'widgets', 'pictures', file))), [], 'UPDATE_GOLDENS=1 cargo test -p figures paints those of PICTURES in tests/figures/src/lib.rs')
})
