// Where the site will be: canonical links, oEmbed and the links on paper need whole addresses, which nothing in dist/ can know.
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import { createInterface } from 'node:readline/promises'
import { root, StepError } from './lib.mjs'

/** The folder of the site, with a slash at its end: `FASTSLAM_SITE`, else the homepage of package.json; empty where nobody has said. @returns {string} */
export const site = () => asAddress(process.env.FASTSLAM_SITE ?? JSON.parse(readFileSync(join(root, 'package.json'), 'utf8')).homepage ?? '')

/** @param {string} text as somebody has written it @returns {string} */
export function asAddress(text) {
  if (text.trim() === '') return ''
  if (!URL.canParse(text.trim())) throw new StepError(`FASTSLAM_SITE=${text}: not an address.`, 'For example FASTSLAM_SITE=https://course.example/fastslam/')
  const { protocol, origin, pathname } = new URL(text.trim())
  if (!/^https?:$/.test(protocol)) throw new StepError(`FASTSLAM_SITE=${text}: an address begins with https:// or http://.`)
  return `${origin}${pathname.replace(/(\/index\.html|\/*)$/, '/')}`
}

/**
 * Asks whoever builds for others, where somebody can answer and nobody has. The answer holds for this run.
 * @param {{ input: NodeJS.ReadableStream & { isTTY?: boolean }, output: NodeJS.WritableStream & { isTTY?: boolean } }} [terminal]
 */
export async function askForSite({ input, output } = { input: process.stdin, output: process.stdout }) {
  if (site() || process.env.FASTSLAM_SITE !== undefined || process.env.CI || !input.isTTY || !output.isTTY) return
  const lines = createInterface({ input, output })
  try {
    const answer = await lines.question('Where will the site be? Its address, or nothing to leave out what needs one (FASTSLAM_SITE answers for good): ')
    process.env.FASTSLAM_SITE = asAddress(answer)
  } finally {
    lines.close()
  }
}

/**
 * Links of a page that leaves the site, made whole: those to its other pages, and those that `isElsewhere` besides. Without an address they are
 * text, and the ways between pages in head and foot are left out.
 * @param {string} html @param {string} address @param {(link: string) => boolean} [isElsewhere]
 */
export function wholeLinks(html, address, isElsewhere = () => false) {
  const ways = address ? html : html.replace(/<span>(?: · <a [^>]*>[^<]*<\/a>)+<\/span>/g, '')
  return ways.replace(/(<a\b[^>]*?) href="([^"]*)"/g, (whole, before, link) => {
    if (/^([a-z]+:|#)/i.test(link) && !isElsewhere(link)) return whole
    return address ? `${before} href="${new URL(link.replaceAll('&amp;', '&'), address).href.replaceAll('&', '&amp;')}"` : before
  })
}
