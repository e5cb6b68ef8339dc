// The deck: a figure a slide, with a question of the bank.
import assert from 'node:assert/strict'
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import { test } from 'node:test'
import { aimsIn } from '../../scripts/chapter/bank.mjs'
import { serialize } from '../../scripts/chapter/page.mjs'
import { root } from '../../scripts/lib.mjs'
import { book, wrong } from './book.mjs'

const chapter = '## A {#a}\n\nx'
const files = {
  'www/model.md': '## T {#t}\n\n| Figure | A student can … | Needs |\n|---|---|---|\n| [One lap](#model-lap) | say it | all |\n\n### L {#model-lap}\n',
  'www/bank.md': '## B {#bank}\n\n::goal{of="lap"}\n\n:::choice[Open [it](./index.html#a): why?]{#q1 level="1" section="a"}\n- [ ] This.\n\n  Not it.\n- [x] That.\n\n  It is.\n:::\n\n:::count[How far?]{#q2 level="2" section="a" is="4" within="0.1" unit="m"}\nFour.\n:::',
  'www/deck.md': '## D {#d}\n\n:::slide[One]{#s1 tag="fastslam-lap" ask="q1" step="3"}\nLook here.\n:::\n\n:::slide[Two]{#s2 tag="fastslam-lap" ask="q2" size="normal"}\nAnd here.\n:::',
}

test('a slide has its title, its question with the answer folded, what to look for, and its figure with letters for a projector', async () => {
  const { pages } = await book(chapter, files)
  const html = serialize(pages['deck.html']?.body ?? [])
  assert.match(html, /<section class="slide" id="s1"><h2>One<\/h2><div class="says"><p class="question">Open <span>it<\/span>: why\?<\/p><ol><li>This\.<\/li><li>That\.<\/li><\/ol>/)
  assert.match(html, /<details><summary>Answer<\/summary><div class="fold">\s*<p><b>B\.<\/b> It is\.<\/p>/)
  assert.match(html, /<div class="look">\s*<p>Look here\.<\/p>.*<figure><fastslam-lap v="latest" fit="on" size="presentation" chips="off" step="3"><\/fastslam-lap><\/figure><\/section>/s)
  assert.match(html, /<b>4\u00a0m\.<\/b> Four\..*size="normal"/s)
})

for (const [name, from, to, expected] of /** @type {[string, string, string, RegExp][]} */ ([
  ['a slide that asks nothing', 'ask="q1"', 'ask="q9"', /deck\.md:3: the bank has no question q9/],
  ['a slide without an anchor', '{#s1 ', '{', /deck\.md:3: :::slide has no anchor/],
  ['a slide that does not say what to look for', 'Look here.\n', '', /deck\.md:3: :::slide does not say what to look for/],
])) {
  test(`${name} is said`, async () => {
    assert.deepEqual(await wrong(chapter, files), [])
    assert.match((await wrong(chapter, { ...files, 'www/deck.md': files['www/deck.md'].replace(from, to) }))[0] ?? '', expected)
  })
}

test('each figure that has a goal has a slide, with a question on that goal', () => {
  const [deck = '', model = ''] = ['deck', 'model'].map(name => readFileSync(join(root, 'www', `${name}.md`), 'utf8'))
  const slides = [...deck.matchAll(/^:::slide\[.*?\]\{.*?tag="fastslam-([\w-]+)" ask="bank-([\w-]+)"/gm)].map(([, figure = '', ask = '']) => [figure === 'worked-example' ? 'by-hand' : figure, ask])
  assert.deepEqual(slides.map(([figure]) => figure).sort(), [...aimsIn(model).keys()].sort())
  for (const [figure = '', ask = ''] of slides) assert.ok(ask.startsWith(`${figure}-`), `${figure} asks ${ask}`)
})
