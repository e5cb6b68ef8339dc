// Worksheets: one text, two pages. What answers stands on the one with solutions only.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import { toString } from 'mdast-util-to-string'
import { visit } from 'unist-util-visit'
import { renderChapter } from '../../scripts/chapter/chapter.mjs'
import { serialize } from '../../scripts/chapter/page.mjs'
import { root } from '../../scripts/lib.mjs'
import { book, told, wrong } from './book.mjs'

const chapter = '## A {#a}\n\n:num[a.b]'
const files = {
  'www/model.md': '## T {#t}\n\n| Figure | A student can … | Needs |\n|---|---|---|\n| [One lap](#model-lap) | say it | all |\n\n### L {#model-lap}\n',
  'www/data/numbers.json': JSON.stringify({ 'a.b': { value: 0.5, unit: 'm', made: 'by a test' } }),
  ...told({ one: 'Do it.' }),
  'www/bank.md':
    '## B {#bank}\n\n::goal{of="lap"}\n\n:::choice[Why?]{#q1 level="1" section="a"}\n- [ ] This.\n\n  Not it.\n- [x] That.\n\n  It is.\n:::\n\n:::count[How far?]{#q2 level="2" section="a" is="4 * a.b" within="0.1" unit="m"}\nFour halves.\n:::\n\n' +
    ':::reach[Do it.]{#q3 level="3" section="a" figure="fig-a" tag="fastslam-lap" challenge="one"}\nDone.\n:::',
  'www/worksheet-20.md': '## W {#w}\n\n::name{minutes="20"}\n\n:::state{tag="fastslam-lap" step="3"}\nA state.\n:::\n\n::ask{of="q1"}\n\n::ask{of="q2"}\n\n::ask{of="q3"}\n\n:::write[Say why.]{lines="2"}\nBecause of :num[a.b].\n:::',
}

test('a sheet for students has room where the one with solutions has answers', async () => {
  const { pages } = await book(chapter, files)
  const [sheet = '', solved = ''] = ['worksheet-20', 'worksheet-20-solutions'].map(name => /<main[^>]*>([^]*)<\/main>/.exec(serialize(pages[`${name}.html`]?.body ?? []))?.[1])
  assert.match(sheet, /Name <span class="blank long"><\/span> Date <span class="blank"><\/span> 20 minutes/)
  for (const page of [sheet, solved]) {
    assert.match(page, /<figure class="wide state"><fastslam-lap v="latest" step="3"><\/fastslam-lap><figcaption>/)
    for (const text of ['<b>1.</b> Why?', '<b>2.</b> How far?', '<b>3.</b> Do it.', '<b>4.</b> Say why.', 'aria-label="level 3 of 3"']) assert.ok(page.includes(text), text)
    assert.match(page, /Answer <span class="blank"><\/span> m<\/p>/)
  }
  const answers = [/<li class="right">That\.<div class="reason">\s*<p><b>Right\.<\/b> It is/, /<b>No\.<\/b> Not it/, /<b>2\u00a0m\.<\/b> Four halves/, /<div class="solved">\s*<p>Done\./, /Because of 0\.50\u00a0m/]
  for (const answer of answers) {
    assert.match(solved, answer)
    assert.doesNotMatch(sheet, answer)
  }
  assert.doesNotMatch(sheet, /right|reason|solved/)
  assert.match(sheet, /<div class="room" aria-hidden="true"><div><\/div><div><\/div><\/div>/)
})

for (const [name, from, to, expected] of /** @type {[string, string, string, RegExp][]} */ ([
  ['a question that the bank does not have', '::ask{of="q1"}', '::ask{of="q9"}', /worksheet-20\.md:9: the bank has no question q9/],
  ['an open question without an answer', 'Because of :num[a.b].\n', '', /worksheet-20\.md:15: :::write has no answer/],
  ['a state of no figure of ours', 'tag="fastslam-lap"', 'tag="lap"', /worksheet-20\.md:5: :::state has no tag of ours/],
])) {
  test(`${name} is said`, async () => {
    assert.deepEqual(await wrong(chapter, files), [])
    assert.match((await wrong(chapter, { ...files, 'www/worksheet-20.md': files['www/worksheet-20.md'].replace(from, to) }))[0] ?? '', expected)
  })
}

test('tasks have their place in a worksheet only', async () => {
  assert.match((await wrong(`${chapter}\n\n::ask{of="q1"}`, files))[0] ?? '', /01-text\.md:5: ::ask has its place in a worksheet/)
})

test('each plan has a worksheet of bank and open questions, and the same tasks with solutions', async () => {
  const { pages } = await renderChapter(root)
  for (const minutes of [20, 45, 90]) {
    const [sheet, solved] = [`worksheet-${minutes}.html`, `worksheet-${minutes}-solutions.html`].map(name => {
      /** @type {string[]} */
      const tasks = []
      /** @type {string[]} */
      const classes = []
      visit({ type: 'root', children: pages[name]?.body ?? [] }, 'element', element => {
        const own = [element.properties.className ?? []].flat().map(String)
        classes.push(...own)
        if (own.includes('task')) tasks.push(toString(element.children[0]))
      })
      return { tasks, count: (/** @type {string} */ one) => classes.filter(other => other === one).length }
    })
    assert.ok(sheet && solved)
    assert.deepEqual(sheet.tasks, solved.tasks)
    assert.ok(sheet.tasks.length >= 7, `${minutes}: ${sheet.tasks.length} tasks`)
    assert.ok(sheet.count('room') >= 3 && sheet.count('boxes') >= 2 && sheet.count('state') >= 3, `${minutes}`)
    assert.equal(sheet.count('solved') + sheet.count('right') + sheet.count('reason'), 0)
    assert.equal(solved.count('solved') + solved.count('boxes'), solved.tasks.length)
    assert.equal(solved.count('right'), solved.count('boxes'))
  }
})
