// npm run pdf: the chapter on paper, through Chromium: dist/chapter.pdf. `-- --url https://…` is the address that its figures' links name;
// without it, that of package.json's homepage, or the page's own file name.
import { existsSync, readFileSync, statSync } from 'node:fs'
import { join } from 'node:path'
import { launchChromium } from './browser.mjs'
import { build, dist, kilobytes } from './build.mjs'
import { isMain, main, root, step } from './lib.mjs'
import { startServer } from './serve.mjs'
import { setUp } from './setup.mjs'

/** @param {string} site where the live chapter is @param {string} [folder] */
export async function makePdf(site, folder = dist) {
  const server = await startServer({ folder })
  const browser = await launchChromium()
  const path = join(folder, 'chapter.pdf')
  try {
    // Without script nothing moves, and each figure is its golden picture.
    const page = await browser.newPage({ javaScriptEnabled: false })
    await page.route(server.url, async route => {
      const response = await route.fetch()
      const html = (await response.text())
        // Paper does not scroll: all pictures now.
        .replaceAll(' loading="lazy"', '')
        .replace(/<noscript>[^]*?<\/noscript>/, '')
        .replace(/(<p class="live">Live: )<a href="(#[^"]*)">[^<]*/g, (_, label, anchor) => `${label}<a href="${site}${anchor}">${site}${anchor}`)
      await route.fulfill({ response, body: html })
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
    const { homepage } = JSON.parse(readFileSync(join(root, 'package.json'), 'utf8'))
    await setUp({ browser: true })
    if (!existsSync(join(dist, 'index.html'))) await build()
    await step('PDF', () => makePdf(given ?? homepage ?? 'index.html'))
  })
}
