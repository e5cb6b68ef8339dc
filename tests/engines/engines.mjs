// The browsers that are compared: how each is installed where it is missing, and driven.
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import { root, which } from '../../scripts/lib.mjs'
import { aptInstall, cargoInstall, findChrome, findChromeDriver } from '../../scripts/setup.mjs'

/**
 * @typedef {object} Engine
 * @property {string} title
 * @property {string} takes what its installation takes
 * @property {() => Promise<void>} install
 * @property {() => import('./webdriver.mjs').Driver} driver
 */

const geckodriverVersion = '0.37.1'

/** As the tests in WebAssembly have it, from the packages of npm run setup. @type {Engine} */
export const CHROMIUM = {
  title: 'Chromium',
  takes: 'Debian’s packages chromium and chromium-driver',
  async install() {
    if (!findChrome() || !findChromeDriver()) await aptInstall('chromium', 'chromium-driver')
  },
  driver() {
    const capabilities = JSON.parse(readFileSync(join(root, 'tests', 'browser', 'webdriver.json'), 'utf8'))
    capabilities['goog:chromeOptions'].binary = findChrome()
    return { command: port => [findChromeDriver() ?? 'chromedriver', `--port=${port}`], capabilities }
  },
}

/** @type {Record<string, Engine>} */
export const ENGINES = {
  firefox: {
    title: 'Firefox',
    takes: 'Debian’s package firefox-esr, by apt-get as root, and geckodriver, by cargo install',
    async install() {
      if (!which('firefox-esr')) await aptInstall('firefox-esr')
      await cargoInstall('geckodriver', 'geckodriver', geckodriverVersion)
    },
    driver: () => ({
      command: port => ['geckodriver', '--port', String(port)],
      capabilities: { 'moz:firefoxOptions': { binary: which('firefox-esr'), args: ['-headless'] } },
    }),
  },
  webkit: {
    title: 'WebKitGTK',
    takes: 'Debian’s packages webkit2gtk-driver, xvfb and xauth, by apt-get as root',
    async install() {
      // With a screen to draw on: it has no mode without one.
      if (!which('WebKitWebDriver') || !which('xvfb-run') || !which('xauth')) await aptInstall('webkit2gtk-driver', 'xvfb', 'xauth')
    },
    driver: () => ({
      command: port => ['xvfb-run', '--auto-servernum', '--server-args=-screen 0 1400x1200x24', 'WebKitWebDriver', `--port=${port}`],
      // Containers and CI have no graphics card, nor the right to make a sandbox.
      env: { WEBKIT_DISABLE_SANDBOX_THIS_IS_DANGEROUS: '1', WEBKIT_DISABLE_COMPOSITING_MODE: '1', LIBGL_ALWAYS_SOFTWARE: '1' },
      capabilities: {},
    }),
  },
}
