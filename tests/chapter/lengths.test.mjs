// No source file is so long that nobody finds anything in it.
import assert from 'node:assert/strict'
import { existsSync, readFileSync } from 'node:fs'
import { join } from 'node:path'
import { test } from 'node:test'
import { capture, root } from '../../scripts/lib.mjs'

const most = 400

/** Files that are longer still, with their lines: a number here may become smaller, and a file that is no longer over the limit leaves the list. @type {Record<string, number>} */
const longer = {
  'widgets/elements/figure.css': 464,
}

/** What is wrong with these lengths. @param {Map<string, number>} lengths @param {Record<string, number>} excused */
function tooLong(lengths, excused) {
  const left = Object.keys(excused).filter(file => (lengths.get(file) ?? 0) <= most)
  const long = [...lengths].filter(([file, lines]) => lines > (excused[file] ?? most))
  return [
    ...long.map(([file, lines]) => `${file} has ${lines} lines, of ${excused[file] ?? most} at the most: divide it along its ideas`),
    ...left.map(file => `${file} is not over ${most} lines any more: take it off the list`),
  ]
}

test(`no source file has more than ${most} lines, but for a few that may only become shorter`, () => {
  const sources = ['widgets', 'lab', 'src', 'www', 'scripts'].flatMap(folder => ['rs', 'ts', 'css', 'mjs'].map(kind => `${folder}/*.${kind}`))
  const files = capture('git', 'ls-files', '--cached', '--others', '--exclude-standard', '-z', '--', ...sources) ?? assert.fail('git tells no files')
  const there = files.split('\0').filter(file => file !== '' && existsSync(join(root, file)))
  assert.ok(there.length > 300, `${there.length} files`)
  const lengths = new Map(there.map(file => [file, readFileSync(join(root, file), 'utf8').split('\n').length - 1]))
  assert.deepEqual(tooLong(lengths, longer), [])
})

test('a file that has become longer, one more that is too long, and one that is not so any more are each told', () => {
  const excused = { 'a.rs': 500 }
  assert.deepEqual(tooLong(new Map([['a.rs', 500], ['b.ts', most]]), excused), [])
  assert.deepEqual(tooLong(new Map([['a.rs', 401]]), excused), [])
  assert.match(tooLong(new Map([['a.rs', 501]]), excused).join(), /^a\.rs has 501 lines, of 500 at the most/)
  assert.match(tooLong(new Map([['a.rs', 500], ['b.ts', 401]]), excused).join(), /^b\.ts has 401 lines, of 400 at the most/)
  for (const lengths of [new Map([['a.rs', 400]]), new Map()]) assert.match(tooLong(lengths, excused).join(), /^a\.rs is not over 400 lines any more/)
})
