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
  const element = code('element').split('\n')[1] ?? ''
  assert.ok(element.startsWith('<fastslam-lap walls="&quot;&lt;b>&amp;" seed="3" truth="on"><p slot="no-script"><a href="https://example.org/17/embed-lap.html">'), element)
  assert.ok(element.includes(' alt="A “lap”, &quot;seen&quot; &amp; &lt;more>" ') && element.endsWith('</p></fastslam-lap>'), element)
  assert.match(code('iframe'), / src="https:\/\/example\.org\/17\/embed\.html\?figure=lap&amp;walls=%22%3Cb%3E%26&amp;seed=3&amp;truth=on" /)
  assert.match(code('iframe'), / title="A “lap”, &quot;seen&quot; &amp; &lt;more>" /)
  assert.match(code('myst'), /\n {2}"walls": "\\"<b>&",\n/)
  assert.match(code('python'), /\nFastslamLap\(walls="\\"<b>&", seed=3, truth=True\)$/)
})

test('a link leads back to its figure, whatever the id, and to no other', async () => {
  const { module } = await runnerImport(join(root, 'widgets', 'elements', 'link.ts'), { configFile: false, logLevel: 'silent' })
  const { linkTo, linkedQuery } = /** @type {typeof import('../../widgets/elements/link')} */ (module)
  const element = (/** @type {string} */ id) => /** @type {Element} */ ({ id, localName: 'fastslam-lap' })
  const go = (/** @type {string} */ address) => Object.assign(globalThis, { location: new URL(address), document: { getElementById: (/** @type {string} */ id) => id === 'old' || null } })
  for (const id of ['lap', 'a?b#c', '50 %', 'Übung']) {
    go(`${home}?page=2#old`)
    const link = linkTo(element(id), 'v=4&walls=a%20b', '')
    assert.ok(link.startsWith(`${home}?page=2#`), link)
    go(link)
    assert.equal(linkedQuery(element(id)), 'v=4&walls=a%20b')
    assert.equal(linkedQuery(element('other')), undefined)
  }
})

test('the address is the host’s: a copied link keeps its path, its query and its route, and opens again there', async () => {
  const element = (id = '') => /** @type {Element} */ (/** @type {unknown} */ ({ id, localName: 'fastslam-lap', getRootNode: () => ({ querySelectorAll: () => [] }) }))
  const state = 'v=4&walls=a%20b&step=3'
  /** A page that is opened at this address: routes are remembered from there. @param {string} address */
  const open = async address => {
    Object.assign(globalThis, { location: new URL(address), document: { getElementById: (/** @type {string} */ id) => id === 'section' || null } })
    const { module } = await runnerImport(join(root, 'widgets', 'elements', 'link.ts'), { configFile: false, logLevel: 'silent' })
    return /** @type {typeof import('../../widgets/elements/link')} */ (module)
  }
  for (const address of [
    'https://site.example/',
    'https://site.example/lesson/3',
    'https://site.example/?page=2&x=a+b%20c',
    'https://site.example/?/lesson/3',
    'https://site.example/lesson#section',
    'https://site.example/#/lesson/3',
    'https://site.example/course?lang=de#/lesson/3?tab=1',
    'https://site.example/#!lesson',
    'https://site.example/#lesson?part=2',
    'file:///stick/lap.html',
  ]) {
    for (const id of ['', 'a?b#c &=%25', 'Übung']) {
      const link = (await open(address)).linkTo(element(id), state, '')
      const [host = '', route = ''] = address.replace('#section', '').split('#')
      assert.ok(link.startsWith(host), `${link} keeps ${host}`)
      if (route) assert.ok(link.endsWith(`#${route}`), `${link} keeps ${route}`)
      const again = await open(link)
      assert.equal(again.linkedQuery(element(id)), state, link)
      assert.equal(again.linkedQuery(element('other')), undefined, link)
      // From where the link has led, another one, to the same place.
      const next = again.linkTo(element(id), 'v=4', '')
      assert.equal(next.split('fastslam=').length, link.split('fastslam=').length, next)
      assert.equal((await open(next)).linkedQuery(element(id)), 'v=4', next)
    }
  }
  const routed = await open((await open('https://site.example/#/lesson/3')).linkTo(element(), state, ''))
  location.hash = '#/lesson/4'
  assert.equal(routed.linkedQuery(element()), undefined, 'another lesson has figures of its own')
})

test('a page for frames, or one without an address, is no place to come to: its links lead to the chapter', async () => {
  const element = /** @type {Element} */ ({ id: 'mine', localName: 'fastslam-lap' })
  const { module } = await runnerImport(join(root, 'widgets', 'elements', 'link.ts'), { configFile: false, logLevel: 'silent' })
  const { linkTo } = /** @type {typeof import('../../widgets/elements/link')} */ (module)
  for (const address of [`${home}embed.html?figure=lap&v=4`, `${home}embed-lap.html`, 'about:srcdoc']) {
    Object.assign(globalThis, { location: new URL(address) })
    assert.equal(linkTo(element, 'v=4', home), `${home}#fastslam-lap?v=4`)
  }
})
