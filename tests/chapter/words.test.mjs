// The chapter is to be finished: what is read without unfolding anything is as long as a chapter of a textbook, and whole by itself.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import { visit } from 'unist-util-visit'
import { renderChapter } from '../../scripts/chapter/chapter.mjs'
import { total, wordsOf } from '../../scripts/chapter/count.mjs'
import { root } from '../../scripts/lib.mjs'
import { chapterWords } from '../../scripts/words.mjs'

test('the chapter has 14 000 words at most without unfolding anything, and no section of it is empty until something is unfolded', async () => {
  const counts = await chapterWords()
  assert.ok(counts.length > 30)
  const { open, whole } = total(counts)
  assert.ok(open <= 14_000, `${open} words are open`)
  assert.ok(whole <= 24_000, `${whole} words in all`)
  // A heading, and at least a sentence under it; terms are a list by themselves.
  for (const { id, open } of counts) assert.ok(open >= 15 || id === 'glossary', `#${id} has ${open} words that are open`)
})

/** @typedef {import('hast').Element} Element */

/** @param {import('hast').Nodes[]} nodes @param {(element: Element) => boolean} wanted @returns {Element[]} */
function all(nodes, wanted) {
  /** @type {Element[]} */
  const found = []
  visit({ type: 'root', children: /** @type {Element[]} */ (nodes) }, 'element', element => void (wanted(element) && found.push(element)))
  return found
}
const isOf = (/** @type {string} */ name) => (/** @type {Element} */ { properties }) => [properties.className ?? []].flat().includes(name)
const idOf = (/** @type {Element} */ section) => String(/** @type {Element} */ (section.children[0]).properties.id)

test('every section ends with two lines to take away and two questions, and a recap has 200 words at most', async () => {
  const { pages } = await renderChapter(root)
  const [chapter, practice] = ['index.html', 'practice.html'].map(name => all(pages[name]?.body ?? [], ({ tagName }) => tagName === 'section'))
  const without = ['exercises', 'references', 'glossary', 'notation']
  const parts = (/** @type {Element} */ section) => section.children.flatMap(child => (child.type === 'element' ? [child] : []))
  /** @type {string[]} */
  const asked = []
  let ends = 0
  for (const section of chapter ?? []) {
    const takeaways = parts(section).filter(isOf('takeaway'))
    ends += takeaways.length
    if (takeaways.length === 0) continue
    // What a section ends with stands at its end, before the section in it or after it that follows.
    const at = parts(section).indexOf(/** @type {Element} */ (takeaways[0]))
    const [link] = all([/** @type {Element} */ (parts(section)[at + 1])], ({ tagName }) => tagName === 'a')
    const [page, id = ''] = String(link?.properties.href).split('#')
    assert.equal(page, 'practice.html', idOf(section))
    asked.push(id)
  }
  // Those of the second rank, or where these have parts of their own to ask about, the parts.
  const of = (chapter ?? []).filter(section => /^h2$/.test(/** @type {Element} */ (section.children[0]).tagName) && !without.includes(idOf(section)))
  for (const section of of) assert.ok(all([section], isOf('takeaway')).length > 0, `#${idOf(section)} has nothing to take away`)
  for (const section of all(of.filter(section => idOf(section) === 'mathematics'), ({ tagName }) => tagName === 'section').slice(1)) {
    if (!without.includes(idOf(section))) assert.equal(all([section], isOf('takeaway')).length, 1, idOf(section))
  }
  const checks = (practice ?? []).filter(section => idOf(section).startsWith('check-'))
  assert.deepEqual(checks.map(idOf), asked, 'the questions, in the order of the chapter')
  assert.ok(ends === asked.length && ends >= 15, `${ends} sections`)
  for (const section of checks) assert.equal(all([section], isOf('check')).length, 2, idOf(section))
  const recaps = wordsOf({ type: 'root', children: pages['practice.html']?.body ?? [] }).filter(({ id }) => id.startsWith('recap-'))
  assert.equal(recaps.length, 2)
  for (const { id, whole } of recaps) assert.ok(whole <= 200, `#${id} has ${whole} words`)
})
