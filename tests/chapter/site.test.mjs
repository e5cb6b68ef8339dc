// What a site says of where it is, the ways between its pages, and the links on paper.
import assert from 'node:assert/strict'
import { existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { PassThrough } from 'node:stream'
import { test } from 'node:test'
import { parse } from 'yaml'
import { asAddress, askForSite } from '../../scripts/address.mjs'
import { embedCodes, writePages } from '../../scripts/frames.mjs'
import { fillFolds } from '../../scripts/folds.mjs'
import { root } from '../../scripts/lib.mjs'
import { forPaper, withAuthor } from '../../scripts/pdf.mjs'
import { atHome, unreached } from '../../scripts/site.mjs'
import { serialize } from '../../scripts/chapter/page.mjs'
import { book } from './book.mjs'

/** @param {Record<string, string | Buffer>} files @param {(folder: string) => unknown} use */
async function inFolder(files, use) {
  const folder = mkdtempSync(join(tmpdir(), 'site-'))
  try {
    for (const [path, content] of Object.entries(files)) {
      mkdirSync(join(folder, path, '..'), { recursive: true })
      writeFileSync(join(folder, path), content)
    }
    await use(folder)
  } finally {
    rmSync(folder, { recursive: true })
  }
}

const link = (/** @type {string} */ href) => `<a href="${href}">x</a>`

test('a page that no way leads to from index.html is found, and a text that leads to a frame without a figure', async () => {
  const pages = {
    'index.html': link('sub/#a') + link('#here') + link('https://example.org/alone.html') + '<img src="alone.html">',
    'sub/index.html': link('../embed.html?v=3&figure=lap') + link('../page.html?x=1'),
    'page.html': link('page.html'),
    'embed.html': '',
  }
  await inFolder(pages, folder => assert.deepEqual(unreached(folder), []))
  await inFolder({ ...pages, 'alone.html': link('index.html'), 'sub/island.html': link('../alone.html') }, folder =>
    assert.deepEqual(unreached(folder), ['alone.html: no way leads there from index.html', 'sub/island.html: no way leads there from index.html']),
  )
  for (const bare of ['embed.html', './embed.html?universes=3', '../embed.html#x']) {
    await inFolder({ ...pages, 'page.html': link(bare) }, folder => assert.deepEqual(unreached(folder), [`page.html: ${bare} is a frame without a figure`]))
  }
})

const png = Buffer.concat([Buffer.from('89504e470d0a1a0a0000000d49484452', 'hex'), Buffer.from([0, 0, 0, 120, 0, 0, 0, 60])])
const built = {
  'embed.html': '<title>A figure</title><div id="figure"></div>',
  'assets/fastslam-lap-light-12345678.png': png,
  'assets/fastslam-lap-dark-12345678.png': png,
}
const lap = { tag: 'fastslam-lap', name: 'lap', title: 'One “lap” & more', describe: 'It drives.', version: 8 }

test('a site that knows its address says it in canonical links and oEmbed, whose code is pinned; one that does not leaves them out', async () => {
  const codes = await embedCodes()
  await inFolder(built, folder => {
    writePages(folder, 'https://course.example/17/', [lap], codes)
    const html = readFileSync(join(folder, 'embed-lap.html'), 'utf8')
    assert.match(html, /<link rel="canonical" href="https:\/\/course\.example\/17\/embed-lap\.html" \/>/)
    assert.match(html, /<link rel="alternate" type="application\/json\+oembed" href="\.\/oembed\/lap\.json"/)
    assert.match(html, /og:image" content="https:\/\/course\.example\/17\/assets\/fastslam-lap-light-12345678\.png"/)
    const oembed = JSON.parse(readFileSync(join(folder, 'oembed', 'lap.json'), 'utf8'))
    assert.equal(oembed.provider_url, 'https://course.example/17/')
    assert.match(oembed.html, new RegExp(`^<iframe src="https://course\\.example/17/embed\\.html\\?figure=lap&amp;v=8" .*height="${oembed.height}"`))
    assert.deepEqual([oembed.version, oembed.type, oembed.width, oembed.thumbnail_width, oembed.thumbnail_height], ['1.0', 'rich', 900, 120, 60])
  })
  await inFolder(built, folder => {
    writePages(folder, '', [lap], codes)
    const html = readFileSync(join(folder, 'embed-lap.html'), 'utf8')
    assert.match(html, /<fastslam-lap fit><picture>/)
    assert.match(html, /og:title/)
    assert.doesNotMatch(html, /canonical|oembed|og:image|https?:/)
    assert.ok(!existsSync(join(folder, 'oembed')))
  })
})

test('an address is taken as somebody writes it, and one that is none is refused', () => {
  for (const text of ['https://course.example/17', ' https://course.example/17/ ', 'https://course.example/17/index.html?x#y']) assert.equal(asAddress(text), 'https://course.example/17/')
  assert.equal(asAddress('https://course.example'), 'https://course.example/')
  assert.equal(asAddress(' '), '')
  for (const bad of ['course.example/17', 'ftp://course.example/', 'https://']) assert.throws(() => asAddress(bad), /FASTSLAM_SITE/)
})

test('whoever builds on a terminal is asked where the site will be, unless that is said; elsewhere nobody is', async () => {
  const before = { ...process.env }
  const ask = async (/** @type {string} */ answer, /** @type {Record<string, string>} */ env, isTTY = true) => {
    delete process.env.FASTSLAM_SITE
    delete process.env.CI
    Object.assign(process.env, env)
    const [input, output] = [0, 1].map(() => Object.assign(new PassThrough(), { isTTY }))
    if (!input || !output) return []
    input.end(`${answer}\n`)
    await askForSite({ input, output })
    return [String(output.read() ?? '').includes('Where will the site be?'), process.env.FASTSLAM_SITE]
  }
  try {
    assert.deepEqual(await ask('https://course.example/17', {}), [true, 'https://course.example/17/'])
    assert.deepEqual(await ask('', {}), [true, ''])
    assert.deepEqual(await ask('', { FASTSLAM_SITE: 'https://a.example/' }), [false, 'https://a.example/'])
    assert.deepEqual(await ask('', { FASTSLAM_SITE: '' }), [false, ''])
    assert.deepEqual(await ask('', { CI: '1' }), [false, undefined])
    assert.deepEqual(await ask('', {}, false), [false, undefined])
    await assert.rejects(ask('nowhere', {}), /FASTSLAM_SITE=nowhere/)
  } finally {
    for (const name of ['FASTSLAM_SITE', 'CI']) delete process.env[name]
    Object.assign(process.env, before)
  }
})

test('what names the machine of the build is found in whatever is text', async () => {
  const files = { 'index.html': 'https://localhost.example/ and localhost', 'a.json': '"http://localhost:8017/"', 'assets/b.js': '"//127.0.0.1/"', 'chapter.pdf': '/URI (http://localhost:4/)' }
  await inFolder(files, folder => assert.deepEqual(atHome(folder).sort(), ['a.json: says localhost', 'assets/b.js: says localhost', 'chapter.pdf: says localhost']))
})

test('on paper a place is a place of the paper, and what is live or on another page is on the site, or is no link', () => {
  const text = 'See <a href="#eq-x">(17.1)</a>, <a class="x" href="#fastslam-em?v=1&amp;predict=on">predict</a>, <a href="model.html#cite">Cite</a>, <a href="embed/">Embed</a>, <a href="https://doi.org/1">a work</a>.<p class="address">Live: #fig-lap</p><img loading="lazy">'
  const links = (/** @type {string} */ html) => [...html.matchAll(/href="([^"]*)"/g)].map(match => match[1])
  const site = 'https://course.example/17/'
  assert.deepEqual(links(forPaper(text, site)), ['#eq-x', `${site}#fastslam-em?v=1&amp;predict=on`, `${site}model.html#cite`, `${site}embed/`, 'https://doi.org/1', `${site}#fig-lap`])
  assert.match(forPaper(text, site), />https:\/\/course\.example\/17\/#fig-lap</)
  assert.deepEqual(links(forPaper(text, '')), ['#eq-x', 'https://doi.org/1'])
  assert.match(forPaper(text, ''), /<a class="x">predict<\/a>, <a>Cite<\/a>/)
  assert.doesNotMatch(forPaper(text, ''), /address|lazy/)
})

test('what unfolds from another page is there in a file that can fetch nothing, with its styles, and its links lead within the page', async () => {
  const fold = '<details class="deeper elsewhere"><summary>A</summary><div class="fold"><p><a href="practice.html#b">A (on a page of its own)</a></p></div></details>'
  const solution = '<details class="solution elsewhere"><summary>B</summary><div class="fold"><p><a href="solutions.html#s">On a page of its own</a></p></div></details>'
  const practice = '<head><link rel="stylesheet" href="./a.css"><link rel="stylesheet" href="./b.css"></head><section><h2 id="a">A</h2>no</section><section><h2 id="b"><a href="#b">B</a></h2><p>yes <a href="./index.html#c">c</a></p></section>'
  await inFolder({ 'practice.html': practice }, folder => {
    const html = fillFolds(`<head><link rel="stylesheet" href="./a.css"></head>${fold}${fold}`, folder)
    const filled = fold.replace(/<p>.*<\/p>/, '<p>yes <a href="#c">c</a></p>')
    assert.equal(html, `<head><link rel="stylesheet" href="./a.css"><link rel="stylesheet" href="./b.css"></head>${filled}${filled}`)
    assert.throws(() => fillFolds(fold.replace('#b', '#d'), folder), /no section #d/)
    // And links to what was on the other page.
    writeFileSync(join(folder, 'solutions.html'), '<section><h2 id="s">S</h2><p id="q">so</p></section>')
    assert.equal(fillFolds(`<a href="solutions.html#q">1</a><a href="other.html#q">2</a>${solution}`, folder), `<a href="#q">1</a><a href="other.html#q">2</a>${solution.replace(/<p>.*<\/p>/, '<p id="q">so</p>')}`)
  })
})

test('from the head and the foot of every page of text ways lead to those for teachers, to embedding and to citing', async () => {
  const { pages } = await book('## A {#a}', { 'www/model.md': '## For teachers {#model}\n\n### How to cite {#cite}\n\n::citation\n', 'CITATION.cff': readFileSync(join(root, 'CITATION.cff')) })
  /** @type {Record<string, string>} */
  const html = { ...Object.fromEntries(Object.entries(pages).map(([name, { body }]) => [name, serialize(body)])), 'embed/index.html': readFileSync(join(root, 'www', 'embed', 'index.html'), 'utf8') }
  assert.deepEqual(Object.keys(html), ['index.html', 'model.html', 'embed/index.html'])
  for (const [name, page] of Object.entries(html)) {
    for (const part of ['header', 'footer']) {
      const inside = new RegExp(`<${part}>[^]*</${part}>`).exec(page)?.[0] ?? ''
      const ways = [...inside.matchAll(/<a href="([^"]*)"[^>]*>([^<]*)</g)].map(([, href, text]) => `${text}: ${new URL(String(href), `https://x/${name}`).pathname}${new URL(String(href), `https://x/${name}`).hash}`)
      for (const way of ['For teachers: /model.html', 'Embed: /embed/', 'Cite: /model.html#cite']) assert.ok(ways.includes(way), `${part} of ${name}: ${way}`)
    }
  }
  const { title, version } = parse(readFileSync(join(root, 'CITATION.cff'), 'utf8'))
  assert.ok(html['model.html']?.includes(`title = {{${title}}}`) && html['model.html'].includes(`version = {${version}}`))
})

test('every example of a code in README and in the documents says its version', () => {
  const texts = ['README.md', 'www/model.md', 'www/embed/index.html', ...readdirSync(join(root, 'widgets'), { recursive: true, encoding: 'utf8' }).filter(file => /^(\w+\/)?README\.md$/.test(file)).map(file => `widgets/${file}`)]
  let count = 0
  for (const file of texts) {
    const text = readFileSync(join(root, file), 'utf8').replaceAll('&lt;', '<').replaceAll('&amp;', '&').replaceAll('&gt;', '>')
    // Those with attributes: a bare tag is a name.
    for (const [code] of [...text.matchAll(/<fastslam-[a-z-]+ [a-z][^>]*>/g), ...text.matchAll(/embed\.html\?figure=[^"`<\s]*/g), ...text.matchAll(/\bFastslam[A-Z]\w*\([^)]*\)/g)]) {
      count++
      assert.match(code, /[ ?&(]v=/, `${file}: ${code}`)
    }
  }
  assert.ok(count >= 8, `${count} examples`)
})

test('a PDF says who wrote it, and every place that its new table names is where it says', () => {
  const made = '%PDF-1.4\n1 0 obj\n<</Title (T)\n/Producer (Skia)>>\nendobj\n2 0 obj\n<</Type /Catalog>>\nendobj\n'
  const pdf = Buffer.from(`${made}xref\n0 3\n…\ntrailer\n<</Size 3\n/Root 2 0 R\n/Info 1 0 R>>\nstartxref\n${made.length}\n%%EOF\n`, 'latin1')
  const text = withAuthor(pdf, 'The authors').toString('latin1')
  const from = (/** @type {RegExp} */ place) => text.slice(Number(text.slice(pdf.length).match(place)?.[1]))
  assert.match(from(/^(\d{10}) 00000 n $/m), /^1 0 obj\n<<\/Title \(T\)\n\/Producer \(Skia\)\n\/Author \(The authors\)>>\nendobj/)
  assert.match(from(/startxref\n(\d+)/), /^xref\n1 1\n/)
  assert.match(from(/\/Prev (\d+)/), /^xref\n0 3\n/)
  assert.throws(() => withAuthor(Buffer.from('%PDF'), 'x'), /no author/)
})
