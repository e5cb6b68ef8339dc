// The bank of questions for lecturers: what each has, that its numbers are measured ones, and that learning systems read it.
import assert from 'node:assert/strict'
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import { test } from 'node:test'
import { parse } from 'gift-pegjs'
import { aimsIn, askedIn } from '../../scripts/chapter/bank.mjs'
import { toGift, toMoodle } from '../../scripts/chapter/exports.mjs'
import { renderChapter } from '../../scripts/chapter/chapter.mjs'
import { serialize } from '../../scripts/chapter/page.mjs'
import { root } from '../../scripts/lib.mjs'
import { book, wrong } from './book.mjs'

const aims = '## T {#t}\n\n| Figure | A student can … | Needs |\n|---|---|---|\n| [One lap](#model-lap) | say $x$ | all |\n\n### L {#model-lap}\n'
const bank = (/** @type {string} */ questions) => ({
  'www/model.md': aims,
  'www/bank.md': `## B {#bank}\n\n::goal{of="lap"}\n\n${questions}`,
  'www/data/numbers.json': JSON.stringify({ 'a.b': { value: 0.5, unit: 'm', made: 'by a test' } }),
})
const chapter = '## A {#a}\n\n:num[a.b]'
const count = ':::count[How {far}: $\\frac{1}{2}$ = ~?]{#q1 level="2" section="a" is="4 * a.b" within="0.1" unit="m"}\nAs [there, $y$](./index.html#a?x=1&y=2).\n:::'

test('a question of the bank has its number, its level and its section, below the goal that it tests', async () => {
  const { pages } = await book(chapter, bank(`${count}\n\n${count.replace('q1', 'q2')}`))
  const asked = askedIn(pages['bank.html']?.body ?? [])
  assert.deepEqual(asked.map(({ id, number, level, goal, figure, section }) => ({ id, number, level, goal, figure, section })), [1, 2].map(number => ({ id: `q${number}`, number, level: 2, goal: 'lap', figure: 'One lap', section: 'a' })))
  const html = serialize(pages['bank.html']?.body ?? [])
  assert.match(html, /<b>Goal\.<\/b> A student can say .*<math>.*href="\.\/model\.html#model-lap"/)
  assert.match(html, /<legend><b>2\.<\/b> How .*<\/legend><p class="kind"><span class="level" role="img" aria-label="level 2 of 3">●●○<\/span> <a href="\.\/index\.html#a">A<\/a><\/p><label>/)
  assert.equal(askedIn(pages['index.html']?.body ?? []).length, 0)
})

for (const [name, from, to, expected] of /** @type {[string, string, string, RegExp][]} */ ([
  ['level', 'level="2"', 'level="4"', /bank\.md:5: .*level from 1 to 3/],
  ['section', 'section="a"', 'section="b"', /bank\.md:5: the chapter has no section b/],
  ['goal', 'of="lap"', 'of="lop"', /bank\.md:3: www\/model\.md has no goal of lop, only of lap/],
])) {
  test(`a question of the bank without its ${name} is said`, async () => {
    const files = bank(count)
    assert.deepEqual(await wrong(chapter, files), [])
    const said = await wrong(chapter, { ...files, 'www/bank.md': files['www/bank.md'].replace(from, to) })
    assert.match(said[0] ?? '', expected)
  })
}

test('a measured number is the answer wherever the bank goes, and what means something to GIFT or XML is text', async () => {
  const { pages, downloads } = await book(chapter, bank(count))
  const asked = askedIn(pages['bank.html']?.body ?? [])
  const [, question] = parse(downloads['bank.gift.txt'] ?? '')
  assert.ok(question?.type === 'Numerical')
  assert.deepEqual(question.choices, { type: 'range', number: 2, range: 0.2 })
  assert.equal(question.stem.text, '<p>How {far}: \\(\\frac{1}{2}\\) = ~? (in m)</p>')
  assert.equal(question.globalFeedback?.text, '<p>As there, \\(y\\) (index.html#a?x=1&amp;y=2).</p>')
  assert.match(toGift(asked, 'https://a.example/b/'), /As <a href\\="https\\:\/\/a\.example\/b\/index\.html\\#a\?x\\=1&amp;y\\=2">there, \\\\\(y\\\\\)<\/a>/)
  assert.match(toMoodle(asked, ''), /<answer fraction="100" format="moodle_auto_format"><text>2<\/text>.*<tolerance>0\.2<\/tolerance>/)
  assert.match(toMoodle(asked, ''), /&lt;p&gt;As there, \\\(y\\\) \(index\.html#a\?x=1&amp;amp;y=2\)\.&lt;\/p&gt;/)
})

const { pages, downloads } = await renderChapter(root)
const asked = askedIn(pages['bank.html']?.body ?? [])

test('the bank has forty questions over all figures and sections, each right in one way, with a reason for every choice', () => {
  assert.equal(asked.length, 40)
  assert.equal(new Set(asked.map(({ id }) => id)).size, 40)
  const goals = [...new Set(asked.map(({ goal }) => goal))]
  const all = [...aimsIn(readFileSync(join(root, 'www', 'model.md'), 'utf8')).keys()]
  assert.deepEqual(goals, all, 'every figure with a goal, in the order of the page for teachers')
  for (const goal of goals) assert.ok(asked.filter(question => question.goal === goal).length >= 3, goal)
  assert.deepEqual([1, 2, 3].filter(level => asked.filter(question => question.level === level).length < 5), [], 'levels that are rare')
  for (const question of asked) {
    if ('choices' in question) {
      assert.equal(question.choices.length, 3, question.id)
      assert.equal(question.choices.filter(({ right }) => right).length, 1, question.id)
      for (const { reason } of question.choices) assert.ok(reason.length > 0, question.id)
    } else assert.ok(question.reason.length > 0, question.id)
  }
  // Nobody learns that the right one is always the same.
  const places = asked.flatMap(question => ('choices' in question ? [question.choices.findIndex(({ right }) => right)] : []))
  for (const place of [0, 1, 2]) assert.ok(places.filter(other => other === place).length >= 4, `answer ${place + 1}: ${places}`)
})

test('the bank asks about every section of the chapter that Practice asks about, and asks nothing that Practice does', () => {
  const practice = readFileSync(join(root, 'www', 'practice.md'), 'utf8')
  const text = readFileSync(join(root, 'www', 'bank.md'), 'utf8')
  const questions = (/** @type {string} */ source) => [...source.matchAll(/^:::(?:choice|count|reach)\[(.*?)\]\{#/gm)].map(([, question]) => question)
  assert.equal(questions(text).length, 40)
  assert.deepEqual(questions(text).filter(question => questions(practice).includes(question)), [])
  const challenges = (/** @type {string} */ source) => [...source.matchAll(/tag="([\w-]+)" challenge="([\w-]+)"/g)].map(([, tag, challenge]) => `${tag} ${challenge}`)
  assert.deepEqual(challenges(text).filter(challenge => challenges(practice).includes(challenge)), [])
  // Parts of a section stand for it.
  const parts = { opening: ['lap'], conditioning: ['two-consequences', 'two-cautions'], algorithms: ['box-unknown'], implementation: ['copy-on-write', 'log-weights'], numbers: ['more-particles-is-not-monotone', 'your-log'] }
  const sections = new Set(asked.map(({ section }) => section))
  const wanted = [...practice.matchAll(/^### Questions: .* \{#check-([\w-]+)\}/gm)].map(([, id = '']) => id)
  assert.ok(wanted.length >= 15)
  for (const id of wanted) assert.ok([id, ...(parts[/** @type {keyof typeof parts} */ (id)] ?? [])].some(part => sections.has(part)), id)
})

test('a parser of GIFT that is not ours reads all forty, with the answers of the page', () => {
  const read = parse(downloads['bank.gift.txt'] ?? '')
  const questions = read.filter(({ type }) => type !== 'Category')
  assert.deepEqual(questions.map(({ id }) => id), asked.map(({ id }) => id))
  assert.equal(read.length - questions.length, new Set(asked.map(({ goal }) => goal)).size)
  questions.forEach((question, i) => {
    const own = asked[i]
    assert.ok(own)
    assert.deepEqual(question.tags?.slice(0, 2), [`level ${own.level}`, `goal ${own.goal}`])
    if ('choices' in own) {
      assert.ok(question.type === 'MC', own.id)
      assert.deepEqual(question.choices.map(({ isCorrect }) => isCorrect), own.choices.map(({ right }) => right))
      for (const { feedback } of question.choices) assert.ok((feedback?.text.length ?? 0) > 8, own.id)
    } else if ('value' in own) {
      assert.ok(question.type === 'Numerical' && !Array.isArray(question.choices), own.id)
      const { number = NaN, range = NaN } = /** @type {{ number?: number, range?: number }} */ (question.choices)
      assert.ok(Math.abs(number - own.value) <= 1e-5 * Math.abs(own.value), own.id)
      assert.ok(range > 0 && range < 0.2 * Math.abs(own.value), own.id)
    } else assert.equal(question.type, 'Essay', own.id)
  })
})

test('half of the numbers that it asks for are measured ones, by their names', () => {
  const formulas = [...readFileSync(join(root, 'www', 'bank.md'), 'utf8').matchAll(/ is="([^"]*)"/g)].map(([, formula = '']) => formula)
  assert.ok(2 * formulas.filter(formula => /[a-z]\.[a-z]/.test(formula)).length >= formulas.length)
})
