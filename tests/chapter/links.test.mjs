// The check of links finds what leads nowhere, and nothing else.
import assert from 'node:assert/strict'
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { test } from 'node:test'
import { brokenLinks } from '../../scripts/site.mjs'
import { serialize } from '../../scripts/chapter/page.mjs'
import { book } from './book.mjs'

test('links to files, places and states of figures are followed; those to nowhere are said', () => {
  const folder = mkdtempSync(join(tmpdir(), 'site-'))
  try {
    mkdirSync(join(folder, 'sub'))
    const good = '<a href="#a"></a><a href="sub/#b"></a><a href="#fastslam-lap?seed=3"></a><a href="https://example.org/"></a><img src="p.png">'
    const bad = '<a href="#z"></a><a href="sub/#z"></a><a href="none.html"></a><a href="#fastslam-none?seed=3"></a><a href="http://example.org/"></a><img src="q.png">'
    writeFileSync(join(folder, 'p.png'), '')
    writeFileSync(join(folder, 'sub', 'index.html'), '<p id="b"></p>')
    writeFileSync(join(folder, 'index.html'), `<p id="a"></p><fastslam-lap></fastslam-lap>${good}`)
    assert.deepEqual(brokenLinks(folder), { wrong: [], count: 5 })
    writeFileSync(join(folder, 'index.html'), `<p id="a"></p><p id="a"></p><fastslam-lap></fastslam-lap>${good}${bad}`)
    assert.deepEqual(brokenLinks(folder).wrong.map(line => line.split(' ')[1]), ['the', '#z:', 'sub/#z:', 'none.html', '#fastslam-none?seed=3:', 'http://example.org/', 'q.png'])
    writeFileSync(join(folder, 'index.html'), '<a href="http://localhost:1/sub/#b"></a><a href="http://localhost:1/none.html"></a>')
    assert.deepEqual(brokenLinks(folder, 'http://localhost:1/').wrong, ['index.html: none.html leads to no file'])
  } finally {
    rmSync(folder, { recursive: true })
  }
})

test('the neighbours of the chapter come from its front matter', async () => {
  const front = '---\ntitle: T\nnumber: 17\nlead: L\nprevious: { title: Before, href: ../16/ }\nnext: { title: After, href: ../18/ }\n---\n'
  const { pages } = await book('## A {#a}', { 'www/chapter/00-title.md': front })
  assert.match(serialize(pages['index.html']?.body ?? []), /<a href="\.\.\/16\/" rel="prev"><small>Previous<\/small> Before<\/a><a href="\.\.\/18\/" rel="next">/)
  const without = await book('## A {#a}')
  assert.ok(!serialize(without.pages['index.html']?.body ?? []).includes('rel="'))
})
