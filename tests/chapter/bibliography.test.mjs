// The works as files to download.
import assert from 'node:assert/strict'
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import { test } from 'node:test'
import { toBibtex, toCsl } from '../../scripts/chapter/bibliography.mjs'
import { root } from '../../scripts/lib.mjs'

/** @type {(import('../../scripts/chapter/bibliography.mjs').Work)[]} */
const works = JSON.parse(readFileSync(join(root, 'www', 'references.json'), 'utf8'))

test('BibTeX has each kind of work with its fields, and no letter that TeX would take for a command', () => {
  const text = toBibtex([
    { id: 'a1', type: 'article-journal', title: 'A & B', author: [{ family: 'Schön', given: 'T. B.' }, { literal: 'The Collaboration' }], issued: { 'date-parts': [[2005]] }, 'container-title': 'J', volume: '3', issue: '1–3', page: '5–10', DOI: '10.1/x_y', note: 'Read it.', checked: 'so' },
    { id: 'b', type: 'book', title: 'C', editor: [{ family: 'Last', given: 'F.' }], issued: { 'date-parts': [[2026]] }, publisher: 'P', URL: 'https://example.org/a%20b' },
    { id: 'c', type: 'report', title: 'D', issued: { 'date-parts': [[2014]] }, publisher: 'College', number: 'N-1' },
  ])
  assert.equal(
    text,
    '@article{a1,\n  author = {Schön, T. B. and {The Collaboration}},\n  title = {{A \\& B}},\n  journal = {J},\n  volume = {3},\n  number = {1–3},\n  pages = {5--10},\n  year = {2005},\n  doi = {10.1/x_y},\n}\n\n' +
      '@book{b,\n  editor = {Last, F.},\n  title = {{C}},\n  publisher = {P},\n  year = {2026},\n  url = {https://example.org/a%20b},\n}\n\n' +
      '@techreport{c,\n  title = {{D}},\n  number = {N-1},\n  institution = {College},\n  year = {2014},\n}\n',
  )
})

test('every work of the chapter is in both files, and says in the source alone how it was compared', () => {
  for (const { id, checked } of works) assert.ok(checked, `${id} does not say how it was compared with other records`)
  assert.deepEqual([...toBibtex(works).matchAll(/^@\w+\{(\w+),$/gm)].map(([, id]) => id), works.map(({ id }) => id))
  assert.deepEqual(JSON.parse(toCsl(works)), works.map(({ checked: _, ...work }) => work))
})
