// node scripts/host.mjs ADDRESS: tries a site where it is hosted. What its server says of the files is compared with what other pages need, and
// a figure is opened as its own page, as an element of a page on another origin, and in a sandboxed frame there.
import { createServer } from 'node:http'
import { asAddress } from './address.mjs'
import { launchChromium } from './browser.mjs'
import { green, isMain, main, red, StepError } from './lib.mjs'

/** @typedef {{ what: string, well: boolean, says: string }} Finding */

/**
 * What the server says. `needed`: without it figures do not work on other pages; the rest makes them quicker, or work on isolated pages.
 * @param {string} address of the site's folder @returns {Promise<(Finding & { needed: boolean })[]>}
 */
export async function headersAt(address) {
  const get = async (/** @type {string} */ file) => {
    const response = await fetch(address + file, { headers: { 'Accept-Encoding': 'br, gzip' } }).catch(error => {
      throw new StepError(`${address}${file} cannot be fetched: ${error.message}`)
    })
    if (!response.ok) throw new StepError(`${address}${file}: the server answered ${response.status}.`, 'Is this the folder of the site, with all of dist/ in it?')
    return { headers: response.headers, text: await response.text() }
  }
  const page = await get('embed.html')
  const script = await get('fastslam.js')
  const hashed = /src="\.\/(fastslam-[\w-]{8}\.js)"/.exec(page.text)?.[1]
  if (!hashed) throw new StepError(`${address}embed.html is not the page of frames.`)
  const shared = await get(hashed)
  const wasm = await get(/fastslam-page-[\w-]{8}\.wasm/.exec(shared.text)?.[0] ?? '')
  const fixed = await get('custom-elements.json')
  const is = (/** @type {string} */ what, /** @type {{ headers: Headers }} */ { headers }, /** @type {string} */ name, /** @type {RegExp} */ wanted, needed = false) => {
    const says = headers.get(name) ?? '(nothing)'
    return { what: `${what}: ${name}`, well: wanted.test(says), says, needed }
  }
  const hidden = page.headers.get('x-frame-options')
  return [
    is('scripts', script, 'Content-Type', /^(text|application)\/javascript/, true),
    is('scripts', shared, 'Access-Control-Allow-Origin', /^\*$/, true),
    is('programs', wasm, 'Access-Control-Allow-Origin', /^\*$/, true),
    { what: 'frames: X-Frame-Options', well: hidden === null, says: hidden ?? '(nothing)', needed: true },
    is('programs', wasm, 'Content-Type', /^application\/wasm/),
    is('programs', wasm, 'Content-Encoding', /^(br|gzip|zstd|deflate)$/),
    is('names with a hash', shared, 'Cache-Control', /immutable|max-age=\d{6}/),
    { ...is('other names', fixed, 'Cache-Control', /^(?!.*(immutable|max-age=\d{5}))/), what: 'other names: Cache-Control, not for long' },
    is('scripts', shared, 'Cross-Origin-Resource-Policy', /^cross-origin$/),
    is('frames', page, 'Cross-Origin-Embedder-Policy', /^(require-corp|credentialless)$/),
  ]
}

/** Whether a figure lives on its own page, on a page of another origin, and in a frame there. @param {string} address @returns {Promise<Finding[]>} */
async function figuresAt(address) {
  const host = createServer((request, response) => {
    const body =
      request.url === '/element'
        ? `<script type="module" src="${address}fastslam.js"></script><fastslam-proposal v="3"></fastslam-proposal>`
        : `<iframe src="${address}embed.html?figure=proposal&amp;v=3" width="900" height="700" sandbox="allow-scripts"></iframe>`
    response.writeHead(200, { 'Content-Type': 'text/html' }).end(`<!doctype html><html lang="en"><title>Course</title><link rel="icon" href="data:,">${body}</html>`)
  })
  const browser = await launchChromium()
  try {
    await new Promise(done => host.listen(0, '127.0.0.1', () => done(undefined)))
    const other = `http://127.0.0.1:${/** @type {import('node:net').AddressInfo} */ (host.address()).port}`
    const findings = []
    for (const [what, page] of [['a page of its own', `${address}embed-proposal.html`], ['an element on another origin', `${other}/element`], ['a sandboxed frame on another origin', `${other}/frame`]]) {
      const tab = await browser.newPage()
      await tab.goto(String(page))
      const inside = String(page).endsWith('/frame') ? tab.frameLocator('iframe') : tab
      const lives = await inside.locator('fastslam-proposal .stage.live').waitFor({ timeout: 20_000 }).then(() => true, () => false)
      findings.push({ what: `a figure as ${what}`, well: lives, says: lives ? 'lives' : 'does not come to life' })
      await tab.close()
    }
    return findings
  } finally {
    await browser.close()
    host.close()
  }
}

if (isMain(import.meta)) {
  await main(async () => {
    const address = asAddress(process.argv[2] ?? '')
    if (!address) throw new StepError('Which site?', 'node scripts/host.mjs https://course.example/fastslam/')
    const headers = await headersAt(address)
    const figures = await figuresAt(address)
    for (const { what, well, says } of [...headers, ...figures]) console.log(`${well ? green('✓') : red('✗')} ${what}: ${says}`)
    if (figures.some(({ well }) => !well)) throw new StepError('Figures do not live everywhere.', 'What the server should send: embed/#headers')
  })
}
