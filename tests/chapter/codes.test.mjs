// Links to figures and the code that is pasted into other pages, without a browser.
import assert from 'node:assert/strict'
import { join } from 'node:path'
import { test } from 'node:test'
import { runnerImport } from 'vite'
import { embedCodes } from '../../scripts/frames.mjs'
import { root } from '../../scripts/lib.mjs'

const home = 'https://example.org/17/'

test('code escapes what a value and a title hold', async () => {
  const { embedCode } = await embedCodes()
  /** @type {import('../../widgets/elements/embed-code').FigureMarkup} */
  const figure = { tag: 'fastslam-lap', attributes: [['walls', '"<b>&'], ['seed', '3'], ['truth', 'on']] }
  const code = (/** @type {import('../../widgets/elements/embed-code').CodeName} */ name) => embedCode(name, figure, home, 'A “lap”, "seen" & <more>')
  assert.equal(code('element').split('\n')[1], '<fastslam-lap walls="&quot;&lt;b>&amp;" seed="3" truth="on"></fastslam-lap>')
  assert.match(code('iframe'), / src="https:\/\/example\.org\/17\/embed\.html\?figure=lap&amp;walls=%22%3Cb%3E%26&amp;seed=3&amp;truth=on" /)
  assert.match(code('iframe'), / title="A “lap”, &quot;seen&quot; &amp; &lt;more>" /)
  assert.match(code('myst'), /\n {2}"walls": "\\"<b>&",\n/)
  assert.match(code('python'), /\nFastslamLap\(walls="\\"<b>&", seed=3, truth=True\)$/)
})

test('a link leads back to its figure, whatever the id, and to no other', async () => {
  const { module } = await runnerImport(join(root, 'widgets', 'elements', 'link.ts'), { configFile: false, logLevel: 'silent' })
  const { linkTo, linkedQuery } = /** @type {typeof import('../../widgets/elements/link')} */ (module)
  const element = (/** @type {string} */ id) => /** @type {Element} */ ({ id, localName: 'fastslam-lap' })
  const go = (/** @type {string} */ address) => Object.assign(globalThis, { location: new URL(address) })
  for (const id of ['lap', 'a?b#c', '50 %', 'Übung']) {
    go(`${home}?page=2#old`)
    const link = linkTo(element(id), 'v=4&walls=a%20b')
    assert.ok(link.startsWith(`${home}?page=2#`), link)
    go(link)
    assert.equal(linkedQuery(element(id)), 'v=4&walls=a%20b')
    assert.equal(linkedQuery(element('other')), undefined)
  }
})
