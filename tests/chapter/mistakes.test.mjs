// Whatever a writer can get wrong is said with file, line and what is wrong. Every test also holds that the same text without the mistake is fine.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import { told, wrong } from './book.mjs'

const numbers = (/** @type {string[]} */ ...keys) => ({
  'www/data/numbers.json': `{\n${keys.map(key => `"${key}": {"made": "by a test", "unit": "m", "value": 0.5}`).join(',\n')}\n}`,
})
const works = (/** @type {string[]} */ ...ids) => ({
  'www/references.json': `[\n${ids.map(id => `{"id": "${id}", "title": "On ${id}", "author": [{"family": "Rao"}], "issued": {"date-parts": [[1945]]}}`).join(',\n')}\n]`,
})
const rust = { 'src/a.rs': 'fn body() {\n    let x = 1;\n}\n\nstruct A;\n\nimpl A {\n    fn twin() {}\n}\n\nfn twin() {}\n' }
const challenges = told({ one: '', two: '' })
const small = { 'widgets/pictures/vignette-a-light.png': '.'.repeat(24), 'widgets/pictures/vignette-a-dark.png': '' }
const file = 'www/chapter/01-text.md'

/** @type {[name: string, good: string, bad: string, expected: RegExp, others?: Record<string, string>][]} */
const mistakes = [
  ['a dead reference', '## A {#a}\n\nSee [](#a).', '## A {#a}\n\nSee [](#b).', /01-text\.md:3: .*#b/],
  ['a reference to an equation that is not there', '## A {#a}\n\n:::equation{#eq-x}\n$$x$$\n:::\n\n[](#eq-x)', '## A {#a}\n\n[](#eq-x)', /:3: .*#eq-x/],
  ['an anchor that is there twice', '## A {#a}\n\n### B {#b}', '## A {#a}\n\n### B {#a}', /:3: .*#a is there twice/],
  ['a section without an anchor', '## A {#a}', '## A', /:1: .*“A” has no anchor/],
  ['a figure without an anchor', '## A {#a}\n\n:::figure{#fig-a tag="fastslam-lap" alt="a"}\nA.\n:::', '## A {#a}\n\n:::figure{tag="fastslam-lap" alt="a"}\nA.\n:::', /:3: :::figure has no anchor/],
  ['a figure without words for its picture', '## A {#a}\n\n:::figure{#fig-a tag="fastslam-lap" alt="a"}\nA.\n:::', '## A {#a}\n\n:::figure{#fig-a tag="fastslam-lap"}\nA.\n:::', /:3: .*alt/],
  ['a figure that has no picture', '## A {#a}\n\n:::figure{#fig-a tag="fastslam-lap" alt="a"}\nA.\n:::', '## A {#a}\n\n:::figure{#fig-a tag="fastslam-none" alt="a"}\nA.\n:::', /:3: .*fastslam-none-light\.png/],
  ['a vignette without words for its picture', '## A {#a}\n\n:::vignette{which="a" alt="a"}\nA.\n:::', '## A {#a}\n\n:::vignette{which="a"}\nA.\n:::', /:3: :::vignette has no alt/, small],
  ['a vignette that has no picture', '## A {#a}\n\n:::vignette{which="a" alt="a"}\nA.\n:::', '## A {#a}\n\n:::vignette{which="b" alt="a"}\nA.\n:::', /:3: .*vignette-b-light\.png/, small],
  ['a vignette with more than a line below it', `## A {#a}\n\n:::vignette{which="a" alt="a"}\n${'word '.repeat(25)}\n:::`, `## A {#a}\n\n:::vignette{which="a" alt="a"}\n${'word '.repeat(26)}\n:::`, /:3: the caption of a vignette has 25 words at most, and not 26/, small],
  ['a challenge that the figure does not have', '## A {#a}\n\n:::figure{#fig-a tag="fastslam-lap" alt="a"}\n:chip[A]{#one} :chip[B]{#two}\n:::', '## A {#a}\n\n:::figure{#fig-a tag="fastslam-lap" alt="a"}\n:chip[A]{#one} :chip[B]{#three}\n:::', /:4: fastslam-lap has no challenge three, only one, two/, challenges],
  ['a caption that leaves a challenge out', '## A {#a}\n\n:::figure{#fig-a tag="fastslam-lap" alt="a"}\nA.\n:::', '## A {#a}\n\n:::figure{#fig-a tag="fastslam-lap" alt="a"}\n:chip[B]{#two}\n:::', /:3: the caption has the challenges two, and fastslam-lap has one, two/, challenges],
  ['a challenge that belongs to no figure', '## A {#a}\n\n:::figure{#fig-a tag="fastslam-lap" alt="a"}\n:chip[A]{#one} :chip[B]{#two}\n:::', '## A {#a}\n\n:chip[A]{#one}', /:3: :chip has its place in the caption/, challenges],
  ['a missing number', '## A {#a}\n\n:num[a.b]', '## A {#a}\n\n:num[a.b] and :num[a.c]', /:3: .*no number a\.c/, numbers('a.b')],
  ['an option that a number does not have', '## A {#a}\n\n:num[a.b]{digits=1}', '## A {#a}\n\n:num[a.b]{digit=1}', /:3: .*no option digit/, numbers('a.b')],
  ['a directive that nobody knows', '## A {#a}\n\n:::margin\nx\n:::', '## A {#a}\n\n:::marginal\nx\n:::', /:3: there is no directive :::marginal/],
  ['a text directive that nobody knows', '## A {#a}\n\nOf 1:n.', '## A {#a}\n\nOf :number[a.b].', /:3: there is no directive :number/],
  ['a container that was closed too early', '## A {#a}\n\n::::exercise[A]{#ex-a kind="k" level="1"}\n:::hint\nx\n:::\n::::', '## A {#a}\n\n:::exercise[A]{#ex-a kind="k" level="1"}\n:::hint\nx\n:::\ny\n:::', /stray :::/],
  ['an unknown work', '## A {#a}\n\n[@rao] says.', '## A {#a}\n\n[@rao] says, and [@blackwell].', /:3: .*no work blackwell/, works('rao')],
  ['an unknown term', '## A {#a}\n\n:term[x]{#ess}', '## A {#a}\n\n:term[x]{#ess} and :term[y]{#why}', /:3: .*no entry why/, { 'www/glossary.md': '## ess: sample size\n\nText.\n' }],
  ['a listing of an item that is not in the source', '## A {#a}\n\n::listing{#lst-a src="src/a.rs#body"}', '## A {#a}\n\n::listing{#lst-a src="src/a.rs#legs"}', /:3: .*src\/a\.rs has no .*legs/, rust],
  ['a listing of a file that is not there', '## A {#a}\n\n::listing{#lst-a src="src/a.rs#body"}', '## A {#a}\n\n::listing{#lst-a src="src/b.rs#body"}', /:3: .*no file src\/b\.rs/, rust],
  ['a listing of one of two items', '## A {#a}\n\n::listing{#lst-a src="src/a.rs#A::twin"}', '## A {#a}\n\n::listing{#lst-a src="src/a.rs#twin"}', /:3: .*more than one twin/, rust],
  ['a line of an item that does not have it', '## A {#a}\n\n:::algorithm[A]{#alg-a}\n1. do :line[a]{src="src/a.rs#body:let x"}\n:::', '## A {#a}\n\n:::algorithm[A]{#alg-a}\n1. do :line[a]{src="src/a.rs#body:let y"}\n:::', /:4: .*no line of body contains let y/, rust],
  ['a line of an algorithm that links to nowhere', '## A {#a}\n\n:::algorithm[A]{#alg-a}\n1. do :line[a]{src="src/a.rs#body"}\n:::', '## A {#a}\n\n:::algorithm[A]{#alg-a}\n1. do :line[a]{src="src/a.rs#legs"}\n:::', /:4: .*legs/, rust],
  ['an algorithm for a figure that is not there', '## A {#a}\n\n:::algorithm[A]{#alg-a}\n1. do\n:::', '## A {#a}\n\n:::algorithm[A]{#alg-a figure="fig-a"}\n1. do\n:::', /:3: .*#fig-a/],
  ['TeX that is none', '## A {#a}\n\n$\\frac12$', '## A {#a}\n\n$\\fraction12$', /:3: TeX: .*\\fraction/],
  ['a fold that does not say what is in it', '## A {#a}\n\n:::deeper[B]\nx\n:::', '## A {#a}\n\n:::deeper\nx\n:::', /:3: :::deeper has no title/],
  ['a choice without a reason for an answer', '## A {#a}\n\n:::choice[Q]{#q}\n- [ ] x\n\n  y\n- [x] z\n\n  y\n:::', '## A {#a}\n\n:::choice[Q]{#q}\n- [ ] x\n\n  y\n- [x] z\n:::', /:3: :::choice has a reason/],
  ['a choice with two right answers', '## A {#a}\n\n:::choice[Q]{#q}\n- [ ] x\n\n  y\n- [x] z\n\n  y\n:::', '## A {#a}\n\n:::choice[Q]{#q}\n- [x] x\n\n  y\n- [x] z\n\n  y\n:::', /:3: :::choice has one right answer/],
  ['a question that is none', '## A {#a}\n\n:::count[Q]{#q is="1" within="0.1"}\nx\n:::', '## A {#a}\n\n:::count{#q is="1" within="0.1"}\nx\n:::', /:3: :::count has no question/],
  ['a question that cannot be linked', '## A {#a}\n\n:::count[Q]{#q is="1" within="0.1"}\nx\n:::', '## A {#a}\n\n:::count[Q]{is="1" within="0.1"}\nx\n:::', /:3: :::count has no anchor/],
  ['a number without a tolerance', '## A {#a}\n\n:::count[Q]{#q is="1" within="0.1"}\nx\n:::', '## A {#a}\n\n:::count[Q]{#q is="1"}\nx\n:::', /:3: :::count has a tolerance/],
  ['a number of what is no calculation', '## A {#a}\n\n:::count[Q]{#q is="1 + exp(2)" within="0.1"}\nx\n:::', '## A {#a}\n\n:::count[Q]{#q is="process.exit(2)" within="0.1"}\nx\n:::', /:3: is="process\.exit\(2\)"|no number process\.exit/],
  ['a number of what cannot be read', '## A {#a}\n\n:::count[Q]{#q is="1 + 2" within="0.1"}\nx\n:::', '## A {#a}\n\n:::count[Q]{#q is="1 + (2" within="0.1"}\nx\n:::', /:3: is="1 \+ \(2" is no calculation/],
  ['a number of a measured one that is not there', '## A {#a}\n\n:::count[Q]{#q is="2 * a.b" within="0.1"}\n:num[a.b]\n:::', '## A {#a}\n\n:::count[Q]{#q is="2 * a.c" within="0.1"}\n:num[a.b]\n:::', /:3: .*no number a\.c/, numbers('a.b')],
  ['a goal that the figure does not have', '## A {#a}\n\n:::reach[Q]{#q figure="f" tag="fastslam-lap" challenge="three"}\nx\n:::', '## A {#a}\n\n:::reach[Q]{#q figure="f" tag="fastslam-lap" challenge="one"}\nx\n:::', /:3: fastslam-lap has no goal one, only three/, told({ one: '', three: 'Do it.' })],
  ['a fold of another page that does not say where', '## A {#a}\n\n::unfold[B]{from="page.html#b"}', '## A {#a}\n\n::unfold[B]{from="page.html"}', /:3: ::unfold says where/],
  ['a section to take three lines away from', '## A {#a}\n\n:::takeaway\n- x\n- y\n:::', '## A {#a}\n\n:::takeaway\n- x\n- y\n- z\n:::', /:3: :::takeaway is a list of two lines/],
  ['a time to read that is of nothing', '## A {#a}\n\n:minutes[open]', '## A {#a}\n\n:minutes[half]', /:3: :minutes is of what is open or of the whole/],
  ['HTML', '## A {#a}\n\n<!-- a remark -->', '## A {#a}\n\n<div>x</div>', /:3: HTML has no place/],
  ['a still picture that is not there', '## A {#a}', '## A {#a}\n\n:::picture{#fig-a src="a.png" alt="b"}\nc\n:::', /:3: there is no picture www\/data\/a\.png/],
  ['an exercise without a level', '## A {#a}\n\n::::exercise[A]{#ex-a kind="k" level="2"}\nx\n::::', '## A {#a}\n\n::::exercise[A]{#ex-a kind="k"}\nx\n::::', /:3: .*level/],
]

for (const [name, good, bad, expected, others = {}] of mistakes) {
  test(`${name} is said`, async () => {
    assert.deepEqual(await wrong(good, others), [])
    const lines = await wrong(bad, others)
    assert.match(lines.join('\n'), expected)
    assert.ok(lines.every(line => line.startsWith(`${file}:`)), lines.join('\n'))
  })
}

test('a number, a work or a term that nobody uses is said, with its line in the list', async () => {
  const lines = await wrong('## A {#a}\n\n:num[a.b] [@rao]', { ...numbers('a.b', 'a.c'), ...works('rao', 'blackwell'), 'www/glossary.md': '\n## ess: x\n\nText.\n' })
  assert.deepEqual(lines, [
    'www/data/numbers.json:3: no page uses the number a.c',
    'www/references.json:3: nobody cites blackwell',
    'www/glossary.md:2: nobody uses the term ess',
  ])
})

test('so is a number of a recorded log, in the list of its own', async () => {
  const { 'www/data/numbers.json': ofLogs } = numbers('logs.a', 'logs.b')
  const lines = await wrong('## A {#a}\n\n:num[logs.b] :num[a.b]', { ...numbers('a.b'), 'www/data/logs.json': ofLogs })
  assert.deepEqual(lines, ['www/data/logs.json:2: no page uses the number logs.a'])
})

test('all mistakes are said at once', async () => {
  assert.equal((await wrong('## A\n\n[](#b) [](#c)\n\n:::what\n:::')).length, 4)
})
