// Pages of others that a figure is put into: a course site on another origin, and what a learning system leaves of pasted code.
import { createServer } from 'node:http'
import type { AddressInfo } from 'node:net'
import type { Page } from '@playwright/test'
import { singlePrograms } from '../../scripts/registry.mjs'

/** Names of all figures that run on the page itself; that of logs has tests of its own. */
export const FIGURES = singlePrograms

/** Of a test that is breadth: `npm test` leaves it to `npm run test:all`, which runs it in a unit. */
export const breadth = { tag: '@breadth' }

/** Of one that needs programs of several single figures, which its unit makes. */
export const programsMade = { tag: ['@breadth', '@programs'] }

/** Figures that stand for all of them in `npm test`: grids with a drive of its own, landmarks with handles, and the one beside a worker. */
const REPRESENTATIVES = ['lap', 'proposal', 'log']

/** For a test that every figure has: one of those that stand for the others, or breadth. */
export const breadthOf = (figure: string): { tag?: string } => (REPRESENTATIVES.includes(figure.replace('fastslam-', '')) ? {} : breadth)

/** Attributes with which the figures that compute longest are live in a tenth of the time, where their numbers do not matter. */
const QUICK: Record<string, string> = { joint: ' particles="20"', smoothing: ' particles="4"' }

/** The element of a figure, quickly there. */
export const quick = (name: string): string => `<fastslam-${name}${QUICK[name] ?? ''}></fastslam-${name}>`

/** A course's own site, on another origin: it serves one page with this in its body, and nothing else. */
export async function openHost(page: Page, body: string, head = '', headers: Record<string, string> = {}): Promise<void> {
  const html = `<!doctype html><html lang="en"><head><title>Course</title><link rel="icon" href="data:," />${head}</head><body>${body}</body></html>`
  const server = createServer((_, response) => response.writeHead(200, { 'Content-Type': 'text/html', ...headers }).end(html))
  await new Promise<void>(done => server.listen(0, '127.0.0.1', done))
  page.once('close', () => server.close())
  await page.goto(`http://127.0.0.1:${(server.address() as AddressInfo).port}/course`)
}

/** A page on another origin is where this test meant to go. */
export function forgiveHost(complaints: string[]): void {
  complaints.splice(0, Infinity, ...complaints.filter(line => !/^left the site: http:\/\/127\.0\.0\.1:\d+\/course$/.test(line)))
}

/** What the editors of learning systems leave of HTML: iframes, with these attributes only. */
export function sanitised(html: string): string {
  const kept = ['src', 'width', 'height', 'allowfullscreen', 'sandbox']
  return [...html.matchAll(/<iframe\b([^>]*)>\s*<\/iframe>/g)]
    .map(([, attributes]) => {
      const pairs = [...attributes!.matchAll(/([\w-]+)(?:="([^"]*)")?/g)].filter(([, name]) => kept.includes(name!))
      return `<iframe ${pairs.map(([, name, value]) => (value === undefined ? name : `${name}="${value}"`)).join(' ')}></iframe>`
    })
    .join('')
}

/** A page of our own site with this in its body and nothing else; `#…` of a link may follow. */
export async function openCourse(page: Page, body: string, { link = '', lang = 'en' } = {}): Promise<void> {
  const html = `<!doctype html><html lang="${lang}"><head><title>Course</title><meta name="viewport" content="width=device-width" /><link rel="icon" href="data:," /><script type="module" src="fastslam.js"></script></head><body>${body}</body></html>`
  // For whoever opens a link to it as well.
  await page.context().route('**/course', route => route.fulfill({ contentType: 'text/html', body: html }))
  await page.goto(`./course${link}`)
}

/** A page that has one figure and nothing else, as wide as the chapter's text; the chapter around it would take twice the time. */
export const openAlone = (page: Page, tag: string, link = ''): Promise<void> =>
  openCourse(page, `<main style="max-width: 832px; margin: auto"><${tag}></${tag}></main>`, { link })
