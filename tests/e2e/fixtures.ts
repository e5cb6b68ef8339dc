// `test` for every spec: on top of what it asserts itself, a test fails if the page wrote an error or a warning to the console,
// threw, or asked for anything that is not of the site.
import { expect, test as base } from '@playwright/test'

export { expect }

export const test = base.extend<{ complaints: string[] }>({
  complaints: [
    async ({ context, baseURL }, use) => {
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
