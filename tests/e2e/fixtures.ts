// `test` for every spec: on top of what it asserts itself, a test fails if the page wrote an error or a warning to the console,
// threw, or asked for anything that is not of the site.
import { expect, test as base } from '@playwright/test'

export { expect }

/**
 * [ms] With which the browser tells late, as one on a busy machine does, what is in sight and what has arrived:
 * `FASTSLAM_LATE=150 npx playwright test …`. (Sizes are told within the frame that changes them, on any machine.)
 */
const LATE = Number(process.env.FASTSLAM_LATE ?? 0)

function tellLate(late: number): void {
  window.IntersectionObserver = class extends IntersectionObserver {
    #ready: IntersectionObserverEntry[] = []
    constructor(told: IntersectionObserverCallback, options?: IntersectionObserverInit) {
      super(entries => {
        this.#ready.push(...entries)
        setTimeout(() => this.#ready.length && told(this.takeRecords(), this), late)
      }, options)
    }
    override takeRecords(): IntersectionObserverEntry[] {
      return [...this.#ready.splice(0), ...super.takeRecords()]
    }
  }
  const fetched = window.fetch
  window.fetch = async (...asked) => {
    const response = await fetched(...asked)
    await new Promise(done => setTimeout(done, late))
    return response
  }
}

export const test = base.extend<{ complaints: string[] }>({
  complaints: [
    async ({ context, baseURL }, use) => {
      if (LATE) await context.addInitScript(tellLate, LATE)
      const complaints: string[] = []
      const site = new URL(baseURL!).origin
      context.on('console', message => {
        if (['error', 'warning'].includes(message.type())) complaints.push(`console ${message.type()}: ${message.text()}`)
      })
      context.on('weberror', error => complaints.push(`uncaught: ${error.error().stack ?? error.error()}`))
      context.on('request', request => {
        const url = new URL(request.url())
        if (url.protocol.startsWith('http') && url.origin !== site) complaints.push(`left the site: ${url}`)
      })
      context.on('response', response => {
        if (response.status() >= 400) complaints.push(`${response.status()}: ${response.url()}`)
      })
      await use(complaints)
      expect(complaints, 'complaints of the page').toEqual([])
    },
    { auto: true },
  ],
})
