// npm run pdf: the chapter on paper, through Chromium: dist/chapter.pdf, the worksheets and the deck. Their links lead to where the site will be: `-- --url https://…`, else
// FASTSLAM_SITE or the homepage of package.json. Without an address, what is on other pages is text.
import { existsSync, readdirSync, readFileSync, statSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import { asAddress, askForSite, site, wholeLinks } from './address.mjs'
import { withSite } from './browser.mjs'
import { build, dist } from './build.mjs'
import { fillFolds } from './folds.mjs'
import { isMain, kilobytes, main, root, step, StepError } from './lib.mjs'
import { setUp } from './setup.mjs'

/**
 * The page as it goes to paper: all pictures at once, and each link whole. Places in the text are places in the PDF; what is live, and other
 * pages, are on the site, or nowhere.
 * @param {string} html @param {string} address of the site, or empty
 */
export function forPaper(html, address) {
  const page = html
    .replaceAll(' loading="lazy"', '') // paper does not scroll
    .replace(/<noscript>[^]*?<\/noscript>/, '')
    .replace(/<p class="address">Live: (#[^<]*)<\/p>/g, (_, anchor) => (address ? `<p class="address">Live: <a href="./${anchor}">${address}${anchor}</a></p>` : ''))
  return wholeLinks(page, address, link => /^#.*\?/.test(link))
}

/**
 * Adds who wrote it to what a PDF says of itself, which Chromium leaves out: its entry once more, after the end, as PDF has it for changes.
 * @param {Buffer} pdf @param {string} author
 */
export function withAuthor(pdf, author) {
  const text = pdf.toString('latin1')
  const [, size, rest] = /trailer\s*<<\/Size (\d+)([^]*?)>>\s*startxref\s*\d+\s*%%EOF\s*$/.exec(text) ?? []
  const info = /\/Info (\d+) 0 R/.exec(rest ?? '')?.[1]
  const before = text.match(/startxref\s*(\d+)\s*%%EOF\s*$/)?.[1]
  const entry = new RegExp(`\\n${info} 0 obj\\s*<<([^]*?)>>\\s*endobj`).exec(text)?.[1]
  if (!info || !before || entry === undefined) throw new StepError('Chromium’s PDF is not made as it was: no author can be added.')
  const added = `\n${info} 0 obj\n<<${entry}\n/Author (${author})>>\nendobj\n`
  const at = String(pdf.length + 1).padStart(10, '0')
  const table = `xref\n${info} 1\n${at} 00000 n \ntrailer\n<</Size ${size}${rest}\n/Prev ${before}>>\nstartxref\n${pdf.length + added.length}\n%%EOF\n`
  return Buffer.concat([pdf, Buffer.from(added + table, 'latin1')])
}

/** Who is to be cited. */
const author = () => /^ *- name: "(.*)"$/m.exec(readFileSync(join(root, 'CITATION.cff'), 'utf8'))?.[1] ?? ''

/** @param {string} address of the live chapter, or empty @param {string} [folder] */
export async function makePdf(address, folder = dist) {
  const path = join(folder, 'chapter.pdf')
  return withSite({ folder }, async ({ server, browser }) => {
    // Without script nothing moves, and each figure is its golden picture.
    const page = await browser.newPage({ javaScriptEnabled: false })
    await page.route(server.url, async route => {
      const response = await route.fetch()
      await route.fulfill({ response, body: forPaper(fillFolds(await response.text(), folder), address) })
    })
    await page.goto(server.url, { waitUntil: 'networkidle' })
    writeFileSync(path, withAuthor(await page.pdf({ preferCSSPageSize: true, printBackground: true, outline: true, tagged: true }), author()))
  })
  return `${path}, ${kilobytes(statSync(path).size)}`
}

/** Pages whose figures stand on paper in states of their own, which no picture has: they run. @param {string} file */
const runs = file => /^(worksheet-.*|deck)\.html$/.test(file)

/**
 * Worksheets and the deck, each beside its page. A figure prints the link of its state, so the pages are served under the address of the site.
 * @param {string} address of the site, or empty @param {string} [folder] @param {(file: string) => boolean} [isWanted] @param {string} [target] where the files go
 */
export async function makeSheets(address, folder = dist, isWanted = runs, target = folder) {
  const files = readdirSync(folder).filter(isWanted)
  await withSite({ folder }, async ({ server, browser }) => {
    const home = address || server.url
    const page = await browser.newPage({ viewport: { width: 1366, height: 768 } })
    await page.route(`${home}**`, async route => {
      const response = await route.fetch({ url: server.url + route.request().url().slice(home.length) })
      const isPage = files.some(file => route.request().url() === home + file)
      await route.fulfill({ response, ...(isPage && { body: wholeLinks(await response.text(), address) }) })
    })
    for (const file of files) {
      await page.goto(home + file)
      for (const figure of await page.locator('figure > :defined:not(figcaption)').all()) {
        // A slide is in sight once it is gone to.
        await figure.evaluate(element => void (location.hash = element.closest('.slide')?.id ?? ''))
        await figure.scrollIntoViewIfNeeded()
        // A log waits until its reader asks for it, and is its picture.
        await figure.locator('.stage.live, .idle').first().waitFor({ state: 'attached' })
        await figure.evaluate(async (element, isNowhere) => {
          if (element.shadowRoot?.querySelector('.live')) await /** @type {import('../widgets/elements/figure-element').FigureElement} */ (element).settled()
          if (isNowhere) element.shadowRoot?.querySelector('.paper')?.remove()
        }, !address)
      }
      const pdf = await page.pdf({ preferCSSPageSize: true, printBackground: true, tagged: true })
      writeFileSync(join(target, file.replace(/html$/, 'pdf')), withAuthor(pdf, author()))
    }
  })
  return `${files.length} files`
}

if (isMain(import.meta)) {
  await main(async () => {
    const given = process.argv.includes('--url') ? process.argv[process.argv.indexOf('--url') + 1] : undefined
    if (given === undefined) await askForSite()
    await setUp({ browser: true })
    if (!existsSync(join(dist, 'index.html'))) await build()
    const address = given === undefined ? site() : asAddress(given)
    await step('PDF', () => makePdf(address))
    await step('PDF of the worksheets and the deck', () => makeSheets(address))
  })
}
