// Pages of others that a figure is put into: a course site on another origin, and what a learning system leaves of pasted code.
import type { Page } from '@playwright/test'

export const FIGURES = ['lap', 'conditioning', 'proposal', 'worked-example', 'resampling']

/** Opens a page of another site (the same server by its other name) with this in its body, and the origin of the figures. */
export async function openHost(page: Page, site: string, body: string, head = ''): Promise<void> {
  const elsewhere = site.replace('localhost', '127.0.0.1')
  await page.route(`${elsewhere}course`, route =>
    route.fulfill({ contentType: 'text/html', body: `<!doctype html><html lang="en"><head><title>Course</title>${head}</head><body>${body}</body></html>` }),
  )
  await page.goto(`${elsewhere}course`)
}

/** What is said of a page on another origin is no complaint of ours, as long as nothing else is asked for there. */
export function forgiveHost(complaints: string[]): void {
  complaints.splice(0, Infinity, ...complaints.filter(line => !/^left the site: http:\/\/127\.0\.0\.1:\d+\/(course|favicon\.ico)$/.test(line) && !/favicon/.test(line)))
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
