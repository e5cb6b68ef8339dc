// What servers say of the site's files: our own, the one that a host's settings make, and what the trial of a host makes of it.
import assert from 'node:assert/strict'
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { createServer } from 'node:http'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { test } from 'node:test'
import { headersAt } from '../../scripts/host.mjs'
import { root } from '../../scripts/lib.mjs'
import { isHashed, startServer } from '../../scripts/serve.mjs'

const files = {
  'embed.html': '<script type="module" src="./fastslam-abcdefgh.js"></script>',
  'fastslam.js': '',
  'fastslam-abcdefgh.js': '"fastslam-page-ABCDEFGH.wasm"',
  'fastslam-page-ABCDEFGH.wasm': '',
  'custom-elements.json': '{}',
}

test('names with a hash are told from names that only look so', () => {
  for (const path of ['assets/page-index-DSbVjNjm.css', 'assets/fastslam-lap-dark-D7DfVhoQ.png', 'fastslam-TJVWEwgn.js', 'fastslam-worked-example-K-_x8aB2.wasm']) assert.ok(isHashed(`/site/${path}`), path)
  for (const path of ['custom-elements.json', 'embed-proposal.png', 'embed-universes.html', 'fastslam.js', 'fastslam-anywidget.js', 'oembed/worked-example.json', 'index.html']) assert.ok(!isHashed(`/site/${path}`), path)
})

test('our own server sends all that other pages need, and a bare one is told what is missing', async () => {
  const folder = mkdtempSync(join(tmpdir(), 'fastslam-'))
  for (const [name, text] of Object.entries(files)) writeFileSync(join(folder, name), text)
  const server = await startServer({ folder })
  const bare = createServer((request, response) => response.writeHead(200, { 'Content-Type': 'text/plain' }).end(files[/** @type {keyof typeof files} */ (request.url?.slice(1))]))
  await new Promise(done => bare.listen(0, '127.0.0.1', () => done(undefined)))
  try {
    const bad = (/** @type {Awaited<ReturnType<typeof headersAt>>} */ found) => found.filter(({ well }) => !well).map(({ what }) => what)
    assert.deepEqual(bad(await headersAt(server.url)), [])
    const { port } = /** @type {import('node:net').AddressInfo} */ (bare.address())
    assert.deepEqual((await headersAt(`http://127.0.0.1:${port}/`)).filter(({ well, needed }) => needed && !well).map(({ what }) => what), ['scripts: Content-Type', 'scripts: Access-Control-Allow-Origin', 'programs: Access-Control-Allow-Origin'])
    await assert.rejects(headersAt(`http://127.0.0.1:${port}/nowhere/`), /not the page of frames/)
  } finally {
    await server.close()
    bare.close()
    rmSync(folder, { recursive: true })
  }
})

test('our own server compresses files before anybody asks for them, and says which cannot be read', async () => {
  const folder = mkdtempSync(join(tmpdir(), 'fastslam-'))
  writeFileSync(join(folder, 'program.wasm'), 'a program '.repeat(99))
  const server = await startServer({ folder })
  try {
    await server.prepare(['program.wasm'])
    const response = await fetch(`${server.url}program.wasm`, { headers: { 'Accept-Encoding': 'br' } })
    assert.equal(response.headers.get('Content-Encoding'), 'br')
    assert.equal(await response.text(), 'a program '.repeat(99))
    await assert.rejects(server.prepare(['program.wasm', 'gone.wasm']), /no such file.*gone\.wasm/)
  } finally {
    await server.close()
    rmSync(folder, { recursive: true })
  }
})

test('what comes along for hosts, and what the page on hosting shows, sends each header that the trial looks for', () => {
  const sources = { '.htaccess': readFileSync(join(root, 'www', 'public', '.htaccess'), 'utf8'), _headers: readFileSync(join(root, 'www', 'public', '_headers'), 'utf8'), 'hosting.md': readFileSync(join(root, 'www', 'hosting.md'), 'utf8') }
  for (const [name, text] of Object.entries(sources)) {
    for (const header of [/Access-Control-Allow-Origin"?:? "?\*/, /Cross-Origin-Resource-Policy"?:? "?cross-origin/, /Cross-Origin-Embedder-Policy"?:? "?(require-corp|\$)/, /Cache-Control.*immutable|immutable/]) assert.match(text, header, name)
  }
})
