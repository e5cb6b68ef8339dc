// Assignments, without a browser: how an answer is judged and scored, and what an address may hold.
import assert from 'node:assert/strict'
import { join } from 'node:path'
import { test } from 'node:test'
import { runnerImport } from 'vite'
import { root } from '../../scripts/lib.mjs'

const load = async (/** @type {string[]} */ ...path) => (await runnerImport(join(root, 'www', 'src', ...path), { configFile: false, logLevel: 'silent' })).module
const { answered, decode, encode, isRight, NOTHING, scoreOf, sound } = /** @type {typeof import('../../www/src/task/task')} */ (await load('task', 'task.ts'))
const { imsManifest } = /** @type {typeof import('../../www/src/ims-manifest')} */ (await load('ims-manifest.ts'))
const { originsOf } = /** @type {typeof import('../../www/src/tell')} */ (await load('tell.ts'))

/** @typedef {import('../../www/src/task/task').Task} Task */
/** @type {Task} */
const number = { text: 'How many?', kind: 'number', answer: 0.3, tolerance: 0.1, unit: 'm', tries: 3, cost: 30 }
/** @type {Task} */
const choice = { text: '“Which”, wohl?', kind: 'choice', choices: ['a & b', '<c>'], right: 1, predict: true }
/** @type {Task} */
const reach = { text: 'Reach it', kind: 'reach', goal: { name: 'ess', is: 'most', value: '2', title: 'N_eff' } }

test('a task comes back from an address as it was, in letters that no address changes', () => {
  for (const task of [number, choice, reach, /** @type {Task} */ ({ text: 'Why? 😀', kind: 'text', explain: 'So.' })]) {
    assert.deepEqual(decode(encode(task)), task)
    assert.match(encode(task), /^[\w-]+$/)
  }
})

test('an address that holds no whole task holds none', () => {
  const half = encode(number)
  const bad = ['', 'not base64!', half.slice(0, half.length / 2), encode(/** @type {any} */ (null)), encode(/** @type {any} */ ({ ...number, kind: 'essay' }))]
  for (const text of bad) assert.equal(decode(text), undefined, text)
  for (const change of [{ text: ' ' }, { text: 'x'.repeat(2001) }, { answer: 'many' }, { answer: null }, { tolerance: -1 }]) assert.equal(sound({ ...number, ...change }), undefined, JSON.stringify(change))
  for (const change of [{ choices: ['one'] }, { right: 2 }, { right: 0.5 }, { choices: 'ab' }]) assert.equal(sound({ ...choice, ...change }), undefined, JSON.stringify(change))
  for (const change of [{ goal: undefined }, { goal: { ...reach.goal, is: 'about' } }, { goal: { ...reach.goal, value: '' } }]) assert.equal(sound({ ...reach, ...change }), undefined, JSON.stringify(change))
  // What cannot be is left out; what is asked stays.
  assert.deepEqual(sound({ ...number, tries: 0, cost: 500, harm: 'x' }), { text: 'How many?', kind: 'number', answer: 0.3, tolerance: 0.1, unit: 'm' })
  assert.equal(sound({ ...reach, predict: true })?.predict, undefined)
})

test('a number is right within its tolerance, whoever rounds it, with a point or a comma', () => {
  for (const given of ['0.3', '0,2', '0.4', ' .35 ']) assert.equal(isRight(number, given), true, given)
  for (const given of ['0.41', '-0.3', 'three', '']) assert.equal(isRight(number, given), false, given)
  assert.equal(isRight({ ...number, answer: 0.1 + 0.2, tolerance: 0 }, '0.3'), true)
})

test('a state is reached at its bound, and not by what is no number', () => {
  const is = (/** @type {any} */ goal, /** @type {string} */ given) => isRight({ ...reach, goal: { .../** @type {any} */ (reach.goal), ...goal } }, given)
  assert.deepEqual([is({}, '2'), is({}, '2.01'), is({}, ''), is({}, 'on')], [true, false, false, false])
  assert.deepEqual([is({ is: 'least' }, '2'), is({ is: 'least' }, '1.9')], [true, false])
  assert.deepEqual([is({ is: 'equal', value: 'never' }, 'never'), is({ is: 'equal', value: '2.0' }, '2'), is({ is: 'equal' }, '3')], [true, true, false])
})

test('a wrong try costs what it costs, the last one all; after the answer was shown nothing counts, and that is told', () => {
  const wrong = answered(number, NOTHING, '7')
  assert.deepEqual([wrong.result, wrong.progress.over, scoreOf(number, wrong.progress)], ['wrong', false, undefined])
  const right = answered(number, wrong.progress, '0.3')
  assert.deepEqual([right.result, right.progress.over, scoreOf(number, right.progress)], ['right', true, 70])
  const again = answered(number, right.progress, '7')
  assert.deepEqual([again.result, again.progress.after, again.progress.last, scoreOf(number, again.progress)], ['after', 1, '0.3', 70])
  let progress = NOTHING
  for (let i = 0; i < 3; i++) progress = answered(number, progress, '7').progress
  assert.deepEqual([progress.over, progress.right, scoreOf(number, progress)], [true, false, 0])
  const late = answered(number, progress, '0.3')
  assert.deepEqual([late.result, late.progress.right, scoreOf(number, late.progress)], ['after', false, 0])
})

test('a prediction is kept and not judged; a text is handed in once, without points', () => {
  const first = answered(choice, NOTHING, '1')
  assert.deepEqual([first.result, first.progress], ['kept', { ...NOTHING, predicted: '1' }])
  assert.equal(answered(choice, first.progress, '0').result, 'wrong')
  /** @type {Task} */
  const text = { text: 'Why?', kind: 'text' }
  const handed = answered(text, NOTHING, 'Because.')
  assert.deepEqual([handed.result, handed.progress.over, scoreOf(text, handed.progress)], ['kept', true, undefined])
})

test('a manifest names what it starts and all that is in it, and escapes what a title holds', () => {
  const manifest = imsManifest({ identifier: 'fastslam-lap-1', title: 'A & "B" <c>', start: 'index.html', files: ['index.html', 'assets/a.js'], mastery: 70 })
  assert.match(manifest, /<title>A &#38; &#34;B&#34; &#60;c&#62;<\/title>\n {8}<adlcp:masteryscore>70</)
  assert.match(manifest, /href="index.html">\n {6}<file href="index.html" \/>\n {6}<file href="assets\/a.js" \/>/)
  assert.doesNotMatch(imsManifest({ identifier: 'x', title: 'x', start: 'index.html', files: [] }), /mastery/)
})

test('a frame tells whole origins alone: no star, no path, no other scheme', () => {
  assert.deepEqual(originsOf(['https://lms.example, http://127.0.0.1:8080/', '* null https://lms.example/course file:///x javascript:alert(1)']), ['https://lms.example', 'http://127.0.0.1:8080'])
})
