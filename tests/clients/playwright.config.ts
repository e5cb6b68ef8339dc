// The packages in the clients that courses use: JupyterLab, marimo and React, as npm and pip install them.
import { defineConfig } from '@playwright/test'
import { chromiumFlags } from '../../scripts/browser.mjs'
import { cache } from '../../scripts/lib.mjs'
import { findHeadless } from '../../scripts/setup.mjs'

export default defineConfig({
  testDir: '.',
  outputDir: cache('clients'),
  forbidOnly: Boolean(process.env.CI),
  workers: 1,
  retries: 0,
  timeout: 240_000,
  expect: { timeout: 30_000 },
  reporter: [['list'], ['json', { outputFile: cache('clients.json') }]],
  use: {
    browserName: 'chromium',
    viewport: { width: 1280, height: 1000 },
    contextOptions: { reducedMotion: 'reduce' },
    launchOptions: { executablePath: findHeadless(), args: chromiumFlags },
    screenshot: 'only-on-failure',
  },
})
