// What the scripts of tests conclude from what they see.
import assert from 'node:assert/strict'
import { spawnSync } from 'node:child_process'
import { readdirSync, readFileSync } from 'node:fs'
import { join } from 'node:path'
import { test } from 'node:test'
import { stripVTControlCharacters } from 'node:util'
import { itemsIn, judgeItems } from '../../scripts/items.mjs'
import { run } from '../../scripts/lib.mjs'
import { judge, judgeAll } from '../../scripts/sizes.mjs'
import { counted } from '../../scripts/tally.mjs'

const scripts = join(import.meta.dirname, '..', '..', 'scripts')

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

test('what a tool answers is kept apart from what it tells on the way, and no script reads the two as one', async () => {
  const tool = "process.stdout.write('{\"a\":'); process.stderr.write('1 of 2\\n'); setTimeout(() => console.log('2}'), 50)"
  const { output, answer } = await run(process.execPath, ['-e', tool])
  assert.deepEqual(JSON.parse(answer), { a: 2 })
  assert.match(output, /1 of 2/)
  for (const file of readdirSync(scripts, { recursive: true, encoding: 'utf8' }).filter(name => name.endsWith('.mjs'))) {
    assert.doesNotMatch(readFileSync(join(scripts, file), 'utf8'), /JSON\.parse\(\s*\(?(?:await run\([^;]*\)\)\.)?output\b/, file)
  }
})

test('a script that looks at a site without a browser to be had says so and ends, and each looks at it by the same door', () => {
  const source = 'import { main } from "./scripts/lib.mjs"; import { withSite } from "./scripts/browser.mjs"; main(() => withSite({ folder: "www" }, async () => {}))'
  const { status, stdout, stderr } = spawnSync(process.execPath, ['--input-type=module', '-e', source], { cwd: join(scripts, '..'), env: { ...process.env, CHROME: '/no/browser' }, encoding: 'utf8', timeout: 60_000 })
  assert.equal(status, 1, 'it went on')
  assert.match(stdout + stderr, /CHROME=\/no\/browser is no program/)
  const starts = readdirSync(scripts).filter(file => file.endsWith('.mjs') && /startServer\(/.test(readFileSync(join(scripts, file), 'utf8')))
  assert.deepEqual(starts, ['browser.mjs', 'serve.mjs', 'start.mjs'])
})

test('a size over its target is marked, and one more than 1 % above its baseline refused', async () => {
  const budget = { target: 50_000, baseline: 60_000 }
  const plain = async (/** @type {number} */ bytes) => stripVTControlCharacters(await judge('all', bytes, budget))
  assert.equal(await plain(50_000), '✓ all 50.0 KB of 50.0 KB')
  assert.equal(await plain(60_600), '✗ all 60.6 KB, 10.6 KB over its target of 50.0 KB')
  await assert.rejects(plain(60_601), /Too heavy: all has 60\.6 KB, more than 1 % above its baseline of 60\.0 KB/)
  await assert.rejects(judge('a thing that is in no table', 1), /has no line for a thing/)
  await assert.rejects(judgeAll([['chapter', 9e9], ['poster', 1], ['text', 9e9]]), /Too heavy: chapter.*\nToo heavy: text/)
})

test('the public items of a crate are counted by kind, and neither more nor fewer than were written down pass', () => {
  const list = (/** @type {string} */ kind, /** @type {string[]} */ ...names) => `<h3 id="${kind}">${kind}</h3><ul class="all-items">${names.map(name => `<li><a href="${name}.html">${name}</a></li>`).join('')}</ul>`
  const items = itemsIn(`<h3><a href="#structs">Crate Items</a></h3><ul><li><a href="#structs">Structs</a></li></ul>${list('structs', 'Path', 'map::Grid')}${list('traits', 'Motion')}</section>`)
  assert.deepEqual(items, { structs: 2, traits: 1 })
  assert.equal(judgeItems(items, 3), '3 public items: 2 structs, 1 traits')
  assert.throws(() => judgeItems(items, 2), /has 3 public items \(2 structs, 1 traits\), 1 more/)
  assert.throws(() => judgeItems(items, 4), /and 4 stand in/)
})
