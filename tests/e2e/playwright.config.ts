// The browser tests of the whole page: the Chromium of the machine, against the built dist/ behind our own server.
import { defineConfig } from '@playwright/test'
import { cache } from '../../scripts/lib.mjs'
import { chromiumFlags } from '../../scripts/browser.mjs'
import { findHeadless } from '../../scripts/setup.mjs'

export default defineConfig({
  testDir: '.',
  outputDir: cache('e2e'),
  globalSetup: './server.ts',
  forbidOnly: Boolean(process.env.CI),
  fullyParallel: true,
  // Two a core: half of the time a page waits for something. A flaky test is a bug of ours, so there is no second try.
  workers: 4,
  retries: 0,
  // What a busy machine takes longer for is no failure.
  timeout: 180_000,
  expect: { timeout: 60_000 },
  reporter: [['list'], ['json', { outputFile: cache('e2e.json') }]],
  use: {
    // Set by server.ts, which runs before the workers read this file.
    baseURL: process.env.FASTSLAM_URL,
    browserName: 'chromium',
    // A worker keeps its page, which is reset between two tests: what it has compiled of the programs need not be compiled for each.
    reuseContext: true,
    viewport: { width: 1280, height: 800 },
    launchOptions: {
      executablePath: findHeadless(),
      args: chromiumFlags,
    },
    screenshot: 'only-on-failure',
    // A trace takes a snapshot of the whole chapter at each action, which doubles the time; `--trace on` brings it back.
    trace: 'off',
  },
})
