// No source file is so long that nobody finds anything in it.
import assert from 'node:assert/strict'
import { existsSync, readFileSync } from 'node:fs'
import { join } from 'node:path'
import { test } from 'node:test'
import { capture, root } from '../../scripts/lib.mjs'

const most = 400

/** What is wrong with these lengths. @param {[file: string, lines: number][]} lengths */
const tooLong = lengths => lengths.filter(([, lines]) => lines > most).map(([file, lines]) => `${file} has ${lines} lines, of ${most} at the most: divide it along its ideas`)

test(`no source file has more than ${most} lines`, () => {
  const sources = ['widgets', 'lab', 'src', 'www', 'scripts'].flatMap(folder => ['rs', 'ts', 'css', 'mjs'].map(kind => `${folder}/*.${kind}`))
  const files = capture('git', 'ls-files', '--cached', '--others', '--exclude-standard', '-z', '--', ...sources) ?? assert.fail('git tells no files')
  const there = files.split('\0').filter(file => file !== '' && existsSync(join(root, file)))
  assert.ok(there.length > 300, `${there.length} files`)
  assert.deepEqual(tooLong(there.map(file => [file, readFileSync(join(root, file), 'utf8').split('\n').length - 1])), [])
})

test('one that is longer is told', () => {
  assert.deepEqual(tooLong([['a.rs', most]]), [])
  assert.match(tooLong([['a.rs', most], ['b.ts', most + 1]]).join(), /^b\.ts has 401 lines, of 400 at the most/)
})
