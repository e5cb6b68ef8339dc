// What the dialect becomes.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import { Letters } from '../../scripts/chapter/fonts.mjs'
import { Numbers } from '../../scripts/chapter/numbers.mjs'
import { curly } from '../../scripts/chapter/quotes.mjs'
import { total, wordsOf } from '../../scripts/chapter/count.mjs'
import { serialize } from '../../scripts/chapter/page.mjs'
import { book, html, told } from './book.mjs'

const number = (/** @type {number} */ value, unit = 'm') => ({ value, unit, made: 'by a test' })

test('a number is set with the figures that count, its unit, a true minus and thin spaces', () => {
  const numbers = new Numbers({ small: number(0.0613), cm: number(0.194), ess: number(1.5709, ''), steps: number(91, ''), bytes: number(1234567, 'B'), minus: number(-2.5), share: number(0.4287, '1'), tiny: number(0.012, '') })
  const text = (/** @type {string} */ key, /** @type {object} */ options = {}) => numbers.text(key, options)
  assert.equal(text('small'), '0.061\u00a0m')
  assert.equal(text('cm'), '0.19\u00a0m')
  assert.equal(text('cm', { digits: 3, unit: false }), '0.194')
  assert.equal(text('ess'), '1.57')
  assert.equal(text('steps'), '91')
  assert.equal(text('bytes'), '1\u202f234\u202f567\u00a0B')
  assert.equal(text('minus'), '−2.50\u00a0m')
  assert.equal(text('share', { percent: true }), '43\u00a0%')
  assert.equal(text('tiny', { percent: true }), '1.2\u00a0%')
  assert.equal(text('nothing'), undefined)
})

test('whatever is read of the numbers counts as used', () => {
  const numbers = new Numbers({ a: number(1), b: number(2), c: number(3) })
  numbers.text('a')
  void numbers.all['b']
  assert.deepEqual(numbers.unused(), ['c'])
})

test('equations, figures and the rest are counted, and an empty link names them', async () => {
  const text = await html(
    '## A {#a}\n\n[](#eq-x) [](#eq-y) [](#fig-a) [](#thm-a) [](#der-a) [](#ex-a) [](#a) [own](#a)\n\n:::equation{#eq-x}\n$$x$$\n:::\n\n:::equation{#eq-y}\n$$y$$\n:::\n\n' +
      ':::figure{#fig-a tag="fastslam-lap" alt="a" seed="4"}\nCaption.\n:::\n\n:::theorem[T]{#thm-a}\nx\n:::\n\n:::derivation[D]{#der-a}\nx\n:::\n\n::::exercise[E]{#ex-a kind="k" level="1"}\nx\n::::',
  )
  for (const name of ['(17.1)', '(17.2)', 'Figure\u00a017.1', 'Theorem\u00a017.1', 'Derivation\u00a017.1', 'Exercise\u00a01', 'A', 'own']) assert.ok(text.includes(`>${name}</a>`), name)
  assert.match(text, /<fastslam-lap v="latest" seed="4"><picture>/)
  assert.match(text, /width="120" height="60"/)
})

test('citations are part of the sentence, or in parentheses of the writer’s own', async () => {
  const works = { 'www/references.json': JSON.stringify([
    { id: 'a', title: 'A', author: [{ family: 'Rao' }, { family: 'Blackwell' }], issued: { 'date-parts': [[1945]] }, DOI: '10.1/x' },
    { id: 'b', title: 'B', author: [{ family: 'One' }, { family: 'Two' }, { family: 'Three' }], issued: { 'date-parts': [[2007]] }, note: 'Read it.' },
    { id: 'c', title: 'C', editor: [{ family: 'Last', given: 'F.' }, { family: 'Least' }], issued: { 'date-parts': [[2026]] } },
  ]) }
  const text = (await html('## A {#a}\n\n[@b, §IV] says, as proven ([@a; @b]); One and others [-@b]; [@c].\n\n::references', works)).replace(/<[^>]*>/g, '')
  assert.match(text, /One et al\. \(2007, §IV\) says, as proven \(Rao and Blackwell 1945; One et al\. 2007\); One and others \(2007\); Last and Least \(2026\)\./)
  assert.match(text, /Last, F\.; Least \(eds\.\) \(2026\)\. C/)
  assert.match(text, /Read it\./)
})

test('a listing shows items with their comments, and an algorithm links to a line in it or to the repository', async () => {
  const others = { 'src/a.rs': 'struct B;\n\nimpl B {\n    /// First.\n    fn all(&self) -> u32 {\n        let x = "1"; // why\n        2\n    }\n}\n\nfn two() {}\n' }
  const text = await html('## A {#a}\n\n:::algorithm[A]{#alg-a}\n1. one :line[one]{src="src/a.rs#all:let x"}\n   1. two :line[two]{src="src/a.rs#two"}\n:::\n\n::listing{#lst-a src="src/a.rs#B+B::all" caption="C"}', others)
  const shown = text.replace(/<\/?span[^>]*>/g, '')
  assert.match(shown, /<code>struct B;\n\n\/\/\/ First\.\nfn all\(&amp;self\) -> u32 {\n    let x = "1"; \/\/ why\n    2\n}\n<\/code>/)
  assert.match(text, /<span id="lst-a-6"> *<span class="k">let<\/span>/)
  assert.match(text, /<li data-line="one">.*href="#lst-a-6"/)
  assert.match(text, /<li data-line="two">.*href="https:\/\/example\.org\/repo\/blob\/main\/src\/a\.rs#L11"/)
})

test('the question of a prediction and the caption of a listing are sentences like any other', async () => {
  const others = { 'src/a.rs': 'fn all() {}\n' }
  const text = await html('## A {#a}\n\n:::predict{question="Is \'it\' $x$ or `y`?"}\nz\n:::\n\n::listing{#lst-a src="src/a.rs#all" caption="The `a` of $x$."}', others)
  assert.match(text, /Is ‘it’ <math><mi>x<\/mi><\/math> or <code>y<\/code>\? <input/)
  assert.match(text, /The <code>a<\/code> of <span class="w"><math>/)
})

test('a page has nothing that the content security policy forbids', async () => {
  const text = await html('## A {#a}\n\n$$\\begin{aligned} a &= \\hat b \\\\ &= \\begin{pmatrix} 1 & 2 \\end{pmatrix} \\end{aligned}$$\n\n```rust\nlet x = 1;\n```\n\n| a |\n|--:|\n| 1 |')
  assert.match(text, /<mtable/)
  assert.ok(!/ style=|<script| on[a-z]+=| align=/.test(text), text)
})

test('what touches a formula stays on its line', async () => {
  assert.match(await html('## A {#a}\n\nall ($x$), and'), /all <span class="w">\(<math>.*<\/math>\),<\/span> and/)
})

test('what goes deeper is folded under a line that says what it is, and a link leads into it', async () => {
  const text = await html('## A {#a}\n\n[](#eq-x)\n\n::::deeper[Why $x$ *is*]\n:::equation{#eq-x}\n$$x$$\n:::\n::::')
  assert.match(text, /<details class="deeper"><summary>Deeper: <span class="title">Why .*<em>is<\/em><\/span><\/summary><div class="fold">\s*<div class="eq[^>]* id="eq-x"/)
})

test('a question has its answer folded below it: each choice its reason, a number what its text lets one compute, a state of a figure its goal', async () => {
  const others = {
    'www/data/numbers.json': JSON.stringify({ 'a.b': number(0.5), 'a.c': number(2) }),
    ...told({ one: '', two: 'Do it.' }),
  }
  const text = await html(
    '## A {#a}\n\n:::choice[Why $x$?]{#q1}\n- [ ] This.\n\n  Not it.\n- [x] *That.*\n\n  It is.\n:::\n\n:::count[How many?]{#q2 is="10 * sqrt(a.c / a.b) + 2 ** 10" within="0.01" unit="m"}\nOf :num[a.b] and :num[a.c].\n:::\n\n' +
      ':::reach[Do it.]{#q3 figure="fig-a" tag="fastslam-lap" challenge="two"}\nDone.\n:::',
    others,
  )
  assert.match(text, /<fieldset class="check" id="q1"><legend>Why .*<label><input type="radio" name="q1"> <span><b>A<\/b> This\.<\/span><\/label><label>.*<b>B<\/b> <em>That\./)
  assert.match(text, /<details class="answer"><summary>Answer<\/summary><div class="fold"><ul><li>\s*<p><b>A: no\.<\/b> Not it\.<\/p>\s*<\/li><li class="right">\s*<p><b>B: yes\.<\/b> It is/)
  assert.match(text, /<fieldset class="check" id="q2" data-is="1044" data-within="0.01">.*<input type="text" inputmode="decimal" autocomplete="off"> m<\/label>.*<p><b>1044\u00a0m\.<\/b> Of 0\.50\u00a0m/s)
  assert.match(text, /<fieldset class="check" id="q3" data-tag="fastslam-lap" data-challenge="two">.*href="\.\/index\.html#fig-a"/)
})

test('what unfolds from another page is a link until then, and the page says how many minutes it takes', async () => {
  const words = 'word '.repeat(1990)
  const text = await html(`## A {#a}\n\n${words} :minutes[open] and :minutes[whole]\n\n:::deeper[B]\n${words}\n:::\n\n:::takeaway\n- One.\n- Two.\n:::\n\n::unfold[More of $x$]{from="practice.html#b"}`)
  assert.match(text, /word\s+10 and 20<\/p>/)
  assert.match(text, /<div class="takeaway"><p><b>To take away<\/b><\/p>\s*<ul>/)
  assert.match(text, /<details class="deeper elsewhere"><summary>More of .*<div class="fold"><p><a href="practice\.html#b">More of .*,<\/span> on a page of its own<\/a><\/p><\/div>/)
})

test('solutions are on a page of their own, a fold leads to each, and links between the pages follow', async () => {
  const exercise = (/** @type {string} */ id, /** @type {string} */ text) => `::::::exercise[On *${id}*]{#ex-${id} kind="k" level="1"}\nSee [](#eq-y).\n\n:::::solution\n${text}\n:::::\n::::::\n\n`
  const equation = (/** @type {string} */ id) => `::::equation{#eq-${id}}\n$$${id}$$\n::::\n\n`
  const { pages } = await book(`## A {#a}\n\n${equation('x')}${exercise('b', `${equation('y')}Of [](#eq-x), [](#eq-z) and [lap](#fastslam-lap?v=1).`)}${exercise('c', equation('z'))}`)
  const [chapter = '', solutions = ''] = ['index.html', 'solutions.html'].map(name => serialize(pages[name]?.body ?? []))
  assert.match(chapter, /<details class="solution elsewhere"><summary>Solution<\/summary><div class="fold"><p><a href="solutions\.html#solution-ex-b">Solution, on a page of its own<\/a><\/p><\/div>/)
  assert.match(chapter, /See <a class="eqref" href="solutions\.html#eq-y">\(17\.2\)<\/a>/)
  assert.ok(!chapter.includes('id="eq-y"') && chapter.includes('id="eq-x"'))
  assert.match(solutions, /<section><h2 id="solution-ex-b"><a href="\.\/index\.html#ex-b"><b>Exercise 1<\/b> <span class="title">On <em>b<\/em><\/span><\/a><\/h2>\s*<div class="eq" id="eq-y">/)
  for (const link of ['./index.html#eq-x', '#eq-z', './index.html#fastslam-lap?v=1']) assert.ok(solutions.includes(` href="${link}"`), link)
  assert.ok(!('solutions.html' in (await book('## A {#a}\n\n::::exercise[E]{#ex-a kind="k" level="1"}\nx\n::::')).pages))
})

test('words are counted by section, once: those that are open, and with them those that unfold', async () => {
  const caption = ':::figure{#fig-a tag="fastslam-lap" alt="no word"}\nNot one.\n:::'
  const { pages } = await book(`## A b {#a}\n\none $x$ (two)\n\n${caption}\n\n:::deeper[three]\nfour five\n:::\n\n### C {#c}\n\n:::table{#tab-a caption="not"}\n| six |\n|---|\n| — |\n:::`)
  const counts = wordsOf({ type: 'root', children: pages['index.html']?.body ?? [] })
  // A line that is pressed begins with “Deeper”.
  assert.deepEqual(counts, [{ id: 'a', open: 6, whole: 8 }, { id: 'c', open: 2, whole: 2 }])
  assert.deepEqual(total(counts), { id: 'all', open: 8, whole: 10 })
})

test('typewriter quotes become typographic ones', () => {
  assert.equal(curly(`"It's 'so'," (he said) "and the rest".`, ''), '“It’s ‘so’,” (he said) “and the rest”.')
  assert.equal(curly('" it', 'x'), '” it')
})

test('a corner of a table without words is no header, and a formula in one is named', async () => {
  assert.match(await html('## A {#a}\n\n| | $M$ |\n|---|---|\n| 1 | 2 |'), /<tr>\s*<td><\/td>\s*<th scope="col" aria-label="𝑀"><math>/)
})

test('headings are sections, and the contents list them', async () => {
  const { pages } = await book('## A {#a}\n\nx\n\n### B {#b}\n\ny\n\n#### C\n\nz\n\n## D {#d}')
  const text = JSON.stringify(pages['index.html'])
  assert.match(await html('## A {#a}\n\n### B {#b}\n\ny\n\n## D {#d}'), /<section><h2 id="a">[^]*<section><h3 id="b">[^]*<p>y<\/p>\n<\/section><\/section><section><h2 id="d">/)
  assert.match(text, /"#c"/)
})

test('every letter is counted to the face it is set in, a lone variable as mathematical italic', async () => {
  const { pages } = await book('## Ah {#a}\n\nt *i* **ß** `m` $x = \\sqrt{h}$')
  const letters = new Letters()
  letters.collect(pages['index.html']?.body ?? [])
  const { text, italic, bold, math, mono } = letters.sets
  assert.ok(['A', 't'].every(letter => text.has(letter)) && italic.has('i') && bold.has('ß') && mono.has('m'))
  assert.ok(['𝑥', 'ℎ', '=', '√'].every(letter => math.has(letter)))
  assert.ok(!math.has('x') && !text.has('ß'))
})
