// Every number of a recorded log in the chapter is measured again, to the bit. A unit of breadth: `cargo build` comes first.
import assert from 'node:assert/strict'
import { join } from 'node:path'
import { test } from 'node:test'
import { capture } from '../../scripts/lib.mjs'
import { absent, measure, recorded, sha256 } from '../../scripts/recorded.mjs'

const program = join(JSON.parse(capture('cargo', 'metadata', '--no-deps', '--format-version', '1') ?? '{}').target_directory, 'debug', 'fastslam')

for (const [key, number] of Object.entries(recorded())) {
  const log = absent(number)
  test(`${key} is what its command measures`, { skip: log ? `${log} is not in ../shared/data` : false }, () => {
    assert.deepEqual(Object.fromEntries(Object.keys(number.logs).map(name => [name, sha256(name)])), number.logs)
    assert.equal(measure(number, program), number.value)
  })
}
