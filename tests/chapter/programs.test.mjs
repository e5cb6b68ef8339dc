// What is in the programs that were built, by the names that their functions keep until the last step.
import assert from 'node:assert/strict'
import { existsSync, readFileSync } from 'node:fs'
import { join } from 'node:path'
import { test } from 'node:test'
import { cache } from '../../scripts/lib.mjs'
import { singlePrograms } from '../../scripts/registry.mjs'

const built = (/** @type {string} */ program) => join(cache('programs', program), 'fastslam_widgets_bg.wasm')

test('no program of a figure has a second parser of numbers, whose table of powers does not shrink', context => {
  // Those that read logs meet numbers of all 17 digits.
  const programs = ['page', ...singlePrograms].filter(program => existsSync(built(program)))
  if (programs.length === 0) return context.skip('no program was built')
  assert.deepEqual(programs.filter(program => readFileSync(built(program)).includes('dec2flt')), [])
})
