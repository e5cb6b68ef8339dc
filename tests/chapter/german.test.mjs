// Pages in German: they ask, answer and show what the pages in English do, and say it in German.
import assert from 'node:assert/strict'
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import { test } from 'node:test'
import { parse } from 'gift-pegjs'
import { askedIn } from '../../scripts/chapter/bank.mjs'
import { renderChapter } from '../../scripts/chapter/chapter.mjs'
import { serialize } from '../../scripts/chapter/page.mjs'
import { root } from '../../scripts/lib.mjs'
import { book, wrong } from './book.mjs'

const chapter = '## A {#a}\n\n:num[a.b]'
const files = {
  'www/model.md': '## T {#t}\n\n| Figure | A student can … | Needs |\n|---|---|---|\n| [One lap](#model-lap) | say it | all |\n\n### L {#model-lap}\n',
  'www/data/numbers.json': JSON.stringify({ 'a.b': { value: 0.5, unit: 'm', made: 'by a test' } }),
  'www/bank.md':
    '## B {#bank}\n\nOf [it](./index.html#a).\n\n::goal{of="lap"}\n\n:::choice[Why?]{#q1 level="1" section="a"}\n- [ ] This.\n\n  Not it.\n- [x] That.\n\n  It is.\n:::\n\n:::count[How far is :num[a.b]?]{#q2 level="2" section="a" is="2.5 * a.b" within="0.1" digits="2" unit="m"}\nSo far.\n:::',
  'www/bank-de.md':
    '## F {#bank}\n\nVon [ihm](./index.html#a).\n\n::goal[es sagen]{figure="Runde"}\n\n:::choice[Warum?]{#q1}\n- [ ] Dies.\n\n  Nein.\n- [x] Das.\n\n  Ja.\n:::\n\n:::count[Wie weit sind :num[a.b]?]\nSo weit.\n:::',
  'www/worksheet-20.md': '## W {#w}\n\n::name{minutes="20"}\n\n:::state{tag="fastslam-lap" step="3"}\nA state.\n:::\n\n::ask{of="q1"}\n\n:::write[Say why.]{lines="2"}\nSo.\n:::',
  'www/worksheet-20-de.md': '## W {#w}\n\n::name\n\n:::state\nEin Zustand.\n:::\n\n::ask\n\n:::write[Warum?]\nDarum.\n:::',
}

test('a page in German has what it does not say from the one in English, numbers with a comma, and each leads to the other', async () => {
  const { pages, downloads } = await book(chapter, files)
  const html = (/** @type {string} */ name) => serialize(pages[name]?.body ?? [])
  const [english, german] = ['bank.html', 'bank-de.html'].map(name => askedIn(pages[name]?.body ?? []))
  const facts = (/** @type {import('../../scripts/chapter/bank.mjs').Asked[]} */ asked = []) => asked.map(one => [one.id, one.level, one.goal, one.section, 'value' in one && [one.value, one.within, one.unit]])
  assert.deepEqual(facts(german), facts(english))
  assert.match(html('bank-de.html'), /<b>Ziel\.<\/b> Sie können es sagen .*Wie weit sind 0,50\u00a0m\?.*<summary>Antwort<\/summary>.*<b>1,25\u00a0m\.<\/b> So weit/s)
  assert.match(html('bank.html'), /<a href="bank-de\.html" lang="de" hreflang="de">Deutsch<\/a>/)
  assert.match(html('bank-de.html'), /<a href="bank\.html" lang="en" hreflang="en">English<\/a>/)
  assert.match(html('worksheet-20-de.html'), /Name <span class="blank long"><\/span> Datum <span class="blank"><\/span> 20 Minuten.*<fastslam-lap v="latest" step="3">.*<b>1\.<\/b> Warum\?/s)
  assert.match(html('worksheet-20-de-solutions.html'), /<b>Richtig\.<\/b> Ja/)
  assert.match(downloads['bank-de.gift.txt'] ?? '', /\$CATEGORY: \$course\$\/top\/FastSLAM \(deutsch\)\/Runde[^]*\[tag:Schwierigkeit 1\]/)
  assert.doesNotMatch(html('index.html'), /Deutsch/)
})

for (const [name, file, from, to, expected] of /** @type {[string, keyof typeof files, string, string, RegExp][]} */ ([
  ['another question', 'www/bank-de.md', '{#q1}', '{#q9}', /bank-de\.md:7: id="q9", and the original has q1/],
  ['another right answer', 'www/bank-de.md', '- [ ] Dies.\n\n  Nein.\n- [x] Das.', '- [x] Dies.\n\n  Nein.\n- [ ] Das.', /right answers are not those of the original/],
  ['another number', 'www/bank-de.md', ':num[a.b]', '0,5', /numbers are not those of the original/],
  ['another link', 'www/bank-de.md', '#a', '#b', /links are not those of the original/],
  ['another anchor', 'www/bank-de.md', '{#bank}', '{#b}', /anchors are not those of the original/],
  ['a task less', 'www/worksheet-20-de.md', '::ask\n\n', '', /write stands where the original has ask/],
  ['nothing at its end', 'www/worksheet-20-de.md', ':::write[Warum?]\nDarum.\n:::', '', /1 directives of the original are missing/],
])) {
  test(`a translation with ${name} is said`, async () => {
    assert.deepEqual(await wrong(chapter, files), [])
    const said = (await wrong(chapter, { ...files, [file]: String(files[file]).replace(from, to) })).join('\n')
    assert.match(said, expected)
  })
}

const { pages, downloads } = await renderChapter(root)
const names = Object.keys(pages).filter(name => name.includes('-de'))

test('bank, deck and worksheets are there in German, without a word of English that the builder wrote or a point in a number', () => {
  assert.deepEqual(names.sort(), ['bank-de', 'deck-de', ...[20, 45, 90].flatMap(minutes => [`worksheet-${minutes}-de`, `worksheet-${minutes}-de-solutions`])].map(name => `${name}.html`).sort())
  for (const name of names) {
    const text = serialize(pages[name]?.body ?? []).replace(/<a [^>]*lang="en".*?<\/a>/g, '').replace(/<[^>]+>/g, ' ').replace(/(FastSLAM )?\b[12]\.0\b(?!\d)|WCAG.*|CC BY 4\.0|QTI 2\.1|copy on write|Apache-2\.0/g, '')
    assert.doesNotMatch(text, /\b(the|and|answer|is|of|with|Right|Next|Goal|Contents)\b/i, name)
    assert.deepEqual(text.match(/\d\.\d/g) ?? [], [], name)
  }
})

test('the bank in German is read by a parser that is not ours, and has the answers of the one in English', () => {
  const questions = (/** @type {string} */ file) => parse(downloads[file] ?? '').filter(({ type }) => type !== 'Category')
  const answers = (/** @type {string} */ file) => questions(file).map(one => [one.id, one.type, one.type === 'MC' ? one.choices.map(({ isCorrect }) => isCorrect) : one.type === 'Numerical' ? one.choices : ''])
  assert.equal(questions('bank-de.gift.txt').length, 40)
  assert.deepEqual(answers('bank-de.gift.txt'), answers('bank.gift.txt'))
  assert.match(downloads['bank-de.xml'] ?? '', /<tag><text>Schwierigkeit 2<\/text><\/tag>/)
})

test('what pages in German call a task or a button, a figure calls so in German', () => {
  const words = readFileSync(join(root, 'widgets', 'words', 'de.json'), 'utf8')
  const asked = [...serialize(pages['bank-de.html']?.body ?? []).matchAll(/Nehmen Sie in der Abbildung die Aufgabe <em>(.*?)<\/em>/g)].map(([, name = '']) => name)
  assert.equal(asked.length, 5)
  for (const name of [...asked, 'Auf den Pfad bedingen', 'Vorschlagsverteilung', 'Labor', 'Startwerte']) assert.ok(words.includes(`"${name}"`), name)
})
