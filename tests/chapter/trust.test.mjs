// What SECURITY.md, CONTRIBUTING.md and the page on privacy and accessibility claim has to be there: tests, files, keys of storage.
import assert from 'node:assert/strict'
import { existsSync, readdirSync, readFileSync } from 'node:fs'
import { join } from 'node:path'
import { test } from 'node:test'
import { root } from '../../scripts/lib.mjs'

const read = (/** @type {string[]} */ ...path) => readFileSync(join(root, ...path), 'utf8')
const trust = read('www', 'trust.md')

test('every file that the documents name is there, and every test that they quote', () => {
  let quoted = 0
  for (const file of ['SECURITY.md', 'CONTRIBUTING.md', 'www/trust.md']) {
    const text = read(file)
    for (const [, path = ''] of text.matchAll(/`((?:tests|scripts|www|widgets)\/[\w./-]+)`/g)) if (!/NAME/.test(path)) assert.ok(existsSync(join(root, path)), `${file} names ${path}`)
    for (const [, spec = '', title = ''] of text.matchAll(/`(\w[\w-]*\.spec\.ts)`: \*([^*]+)\*/g)) {
      assert.ok(read('tests', 'e2e', spec).includes(title), `${file}: ${spec} has no test “${title}”`)
      quoted++
    }
  }
  assert.ok(quoted > 10, `${quoted} tests are quoted`)
})

test('no script of ours keeps anything under a key that the statement on privacy does not name, and none writes a cookie', () => {
  const keys = new Set([...trust.matchAll(/^\| `([\w-]+:?)…?` \|/gm)].map(([, key]) => key))
  assert.deepEqual([...keys], ['fastslam-challenges', 'fastslam-guess:', 'fastslam-check:'])
  const sources = ['widgets/elements', 'widgets/scorm', 'www/src', 'www/public'].flatMap(folder =>
    readdirSync(join(root, folder), { recursive: true, encoding: 'utf8' }).filter(file => /\.(ts|js)$/.test(file) && !file.startsWith('generated')).map(file => join(folder, file)),
  )
  const keeping = sources.filter(file => /(local|session)Storage\b|indexedDB|document\.cookie|caches\.open/.test(read(file)))
  assert.deepEqual(keeping.sort(), ['widgets/elements/reached.ts', 'www/src/kept.ts'], 'whoever keeps something is named in www/trust.md')
  assert.ok(read('widgets/elements/reached.ts').includes("'fastslam-challenges'") && read('www/src/guesses.ts').includes('`fastslam-guess:'))
  const users = sources.filter(file => /from '.*\/kept'/.test(read(file)))
  assert.deepEqual(users.sort(), ['www/src/checks.ts', 'www/src/guesses.ts'], 'whose keys those are')
  assert.ok(read('www/src/checks.ts').includes('`fastslam-check:'))
  for (const file of sources) assert.doesNotMatch(read(file), /\bcookie\b/, file)
})
