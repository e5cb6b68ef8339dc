// The tests in WebAssembly, in headless Chromium, by wasm-pack: a step of npm test. `node scripts/wasm-tests.mjs --include-ignored NAME` runs one that is breadth.
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import { cache, isMain, main, root, run, step } from './lib.mjs'
import { findChrome, findChromeDriver } from './setup.mjs'
import { counted, inWords } from './tally.mjs'

/** The command, in the Chromium that set-up found, which need not be the one ChromeDriver would choose. @param {string[]} args of the tests @returns {Parameters<typeof run>} */
export function wasmTests(...args) {
  const settings = JSON.parse(readFileSync(join(root, 'tests', 'browser', 'webdriver.json'), 'utf8'))
  settings['goog:chromeOptions'].binary = findChrome()
  const capabilities = cache('webdriver.json')
  mkdirSync(cache(), { recursive: true })
  writeFileSync(capabilities, JSON.stringify(settings))
  const driver = findChromeDriver() ?? 'chromedriver'
  const command = ['test', '--headless', '--chrome', '--chromedriver', driver, 'tests/browser', '--profile', 'browser', ...(args.length > 0 ? ['--', ...args] : [])]
  return ['wasm-pack', command, { env: { WASM_BINDGEN_TEST_WEBDRIVER_JSON: capabilities, WASM_BINDGEN_TEST_TIMEOUT: '600', WASM_BINDGEN_TEST_DRIVER_TIMEOUT: '60' } }]
}

if (isMain(import.meta)) {
  await main(() =>
    step('Tests in WebAssembly, in Chromium', async () => {
      const { output } = await run(...wasmTests(...process.argv.slice(2)))
      const counts = counted(output)
      console.log(`${counts?.passed ?? 0} passed, ${counts?.failed ?? 0} failed, ${counts?.skipped ?? 0} skipped`)
      return counts && inWords(counts)
    }),
  )
}
