// npm run pdf: the chapter on paper, through Chromium: dist/chapter.pdf. Its links lead to where the site will be: `-- --url https://…`, else
// FASTSLAM_SITE or the homepage of package.json. Without an address, what is on other pages is text.
import { existsSync, statSync } from 'node:fs'
import { join } from 'node:path'
import { asAddress, askForSite, site, wholeLinks } from './address.mjs'
import { launchChromium } from './browser.mjs'
import { build, dist } from './build.mjs'
import { isMain, kilobytes, main, step } from './lib.mjs'
import { startServer } from './serve.mjs'
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

/** @param {string} address of the live chapter, or empty @param {string} [folder] */
export async function makePdf(address, folder = dist) {
  const server = await startServer({ folder })
  const browser = await launchChromium()
  const path = join(folder, 'chapter.pdf')
  try {
    // Without script nothing moves, and each figure is its golden picture.
    const page = await browser.newPage({ javaScriptEnabled: false })
    await page.route(server.url, async route => {
      const response = await route.fetch()
      await route.fulfill({ response, body: forPaper(await response.text(), address) })
    })
    await page.goto(server.url, { waitUntil: 'networkidle' })
    await page.pdf({ path, preferCSSPageSize: true, printBackground: true, outline: true, tagged: true })
  } finally {
    await browser.close()
    await server.close()
  }
  return `${path}, ${kilobytes(statSync(path).size)}`
}

if (isMain(import.meta)) {
  await main(async () => {
    const given = process.argv.includes('--url') ? process.argv[process.argv.indexOf('--url') + 1] : undefined
    if (given === undefined) await askForSite()
    await setUp({ browser: true })
    if (!existsSync(join(dist, 'index.html'))) await build()
    await step('PDF', () => makePdf(given === undefined ? site() : asAddress(given)))
  })
}
