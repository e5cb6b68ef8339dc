// What the scripts of tests conclude from what they see.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import { judge } from '../../scripts/size.mjs'
import { counted } from '../../scripts/tally.mjs'

test('every runner’s tests are counted, and whatever is not a success at once counts as failed', () => {
  const of = (/** @type {string} */ output) => {
    const { passed, failed, skipped, reasons } = counted(output) ?? assert.fail('nothing was counted')
    return [passed, failed, skipped, ...reasons]
  }
  const cargo = (/** @type {number} */ passed, /** @type {number} */ failed) => `test result: ${failed ? 'FAILED' : 'ok'}. ${passed} passed; ${failed} failed; 1 ignored; 0 measured; 2 filtered out; finished in 0.1s\n`
  assert.deepEqual(of(cargo(3, 0) + cargo(2, 1)), [5, 1, 0])
  assert.deepEqual(of(`test oracle ... skipped: there is no Python\n${cargo(3, 0)}`), [2, 0, 1, 'there is no Python'])
  assert.deepEqual(of('# tests 33\n# pass 28\n# fail 2\n# cancelled 0\n# skipped 2\n# todo 1\n'), [28, 2, 3])
  assert.deepEqual(of('  2 failed\n    lap.spec.ts:3:1 › it plays\n  1 flaky\n  1 interrupted\n  4 did not run\n  3 skipped\n  40 passed (1.2m)\n'), [40, 8, 3])
  assert.deepEqual(of('✓ 00-a-fault\n7 passed, 1 failed, 0 skipped\n'), [7, 1, 0])
  assert.equal(counted('error: could not compile `fastslam` (lib test) due to 1 previous error\n'), undefined)
})

test('a size over its target is told, and one over its limit refused', () => {
  const budget = { target: 50_000, limit: 60_000 }
  assert.equal(judge('all', 50_000, budget), 'all 50.0 KB of 50.0 KB')
  assert.equal(judge('all', 60_000, budget), 'all 60.0 KB of 50.0 KB, 10.0 KB more than the target')
  assert.throws(() => judge('all', 60_001, budget), /Too heavy: all 60\.0 KB/)
})
