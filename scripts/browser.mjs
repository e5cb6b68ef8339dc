// The Chromium that set-up found, driven by Playwright, for scripts and for the end-to-end tests.
import { createRequire } from 'node:module'
import { StepError } from './lib.mjs'
import { startServer } from './serve.mjs'
import { findChrome } from './setup.mjs'

/** Nothing in the background, so that it asks for no host but ours; /dev/shm is small in containers. */
export const chromiumFlags = [
  '--disable-gpu',
  '--disable-dev-shm-usage',
  '--disable-background-networking',
  '--no-first-run',
  '--disable-component-update',
  '--disable-sync',
]

export async function launchChromium() {
  const executablePath = findChrome()
  if (!executablePath) throw new StepError('There is no Chromium on PATH.', 'npm run setup installs it where it can, and says what to do where it cannot.')
  // Required late: set-up imports no package, and may be what installs this one.
  const { chromium } = /** @type {typeof import('@playwright/test')} */ (createRequire(import.meta.url)('@playwright/test'))
  return chromium.launch({ executablePath, args: chromiumFlags })
}

/**
 * What comes of looking at a site with Chromium. Server and browser end with it, however it ends: where there is no browser, a server that
 * was left running kept the script from ever saying so.
 * @template T @param {Parameters<typeof startServer>[0]} site
 * @param {(seen: { server: Awaited<ReturnType<typeof startServer>>, browser: import('@playwright/test').Browser }) => Promise<T>} look
 */
export async function withSite(site, look) {
  const server = await startServer(site)
  try {
    const browser = await launchChromium()
    try {
      return await look({ server, browser })
    } finally {
      await browser.close()
    }
  } finally {
    await server.close()
  }
}
