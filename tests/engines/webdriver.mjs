// A browser driven by WebDriver (https://www.w3.org/TR/webdriver2/), the protocol that Chromium, Firefox and WebKitGTK have in common as Debian
// packages them. Playwright drives only builds of Firefox and WebKit of its own, which are not to be had from a package registry. The package
// selenium-webdriver would do, but is 20 MB, mostly programs that look for drivers, for the few calls below; the package webdriver is 47 MB.
import { mkdtempSync, rmSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { StepError } from '../../scripts/lib.mjs'
import { freePort, serve } from '../clients/server.mjs'

/**
 * @typedef {object} Driver what speaks WebDriver for a browser
 * @property {(port: number) => [program: string, ...args: string[]]} command
 * @property {Record<string, string>} [env]
 * @property {object} capabilities
 */

/** A page's element, as WebDriver names it. @typedef {{ readonly 'element-6066-11e4-a52e-4f735466cecf': string }} Element */

/** How long a function may run in a page [ms]: mapping the example of the log takes longest. */
const SCRIPT_TIMEOUT = 120_000

/** Keys without a character of their own. */
export const KEYS = { left: '\ue012', right: '\ue014' }

export class Browser {
  #session = ''

  /** @param {string} name @param {string} address of the driver @param {() => Promise<void>} end */
  constructor(name, address, end) {
    this.name = name
    this.address = address
    this.end = end
  }

  /** Starts a browser, without a window that a person would see. @param {string} name @param {Driver} driver */
  static async start(name, { command, env, capabilities }) {
    const port = await freePort()
    const [program, ...args] = command(port)
    const address = `http://127.0.0.1:${port}`
    // Not all of them take away what they have laid down.
    const folder = mkdtempSync(join(tmpdir(), 'fastslam-engine-'))
    const stop = await serve(program, args, folder, `${address}/status`, { ...env, TMPDIR: folder })
    const browser = new Browser(name, address, async () => {
      await stop()
      rmSync(folder, { recursive: true, force: true, maxRetries: 5 })
    })
    try {
      const session = await browser.#call('POST', '/session', { capabilities: { alwaysMatch: { timeouts: { script: SCRIPT_TIMEOUT }, ...capabilities } } })
      browser.#session = `/session/${session.sessionId}`
      browser.name = `${name} ${session.capabilities.browserVersion}`
      return browser
    } catch (error) {
      await browser.end()
      throw error
    }
  }

  async close() {
    await this.#call('DELETE', '').catch(() => {}) // a browser that has crashed has no session to end
    await this.end()
  }

  /**
   * Opens an address in a viewport of this very size [css px].
   * @param {string} url @param {{ width: number, height: number }} viewport
   */
  async open(url, { width, height }) {
    await this.#call('POST', '/url', { url })
    const inner = () => this.run(async () => ({ width: innerWidth, height: innerHeight, dpr: devicePixelRatio }))
    // WebDriver sets the size of the window. What of it is not the page can only be measured.
    for (let [tries, outer] = [0, { width, height }]; ; tries++) {
      await this.#call('POST', '/window/rect', outer)
      const is = await inner()
      if (is.width === width && is.height === height && is.dpr === 1) return
      if (tries === 20) throw new StepError(`${this.name} shows ${is.width} × ${is.height} css px, ${is.dpr} device px each, instead of ${width} × ${height}.`)
      outer = { width: outer.width + width - is.width, height: outer.height + height - is.height }
    }
  }

  /**
   * Runs a function in the page, which must stand by itself, and resolves to what it does.
   * @template {any[]} Args @template Result
   * @param {(...args: Args) => Promise<Result>} action @param {Args} args
   * @returns {Promise<Result>}
   */
  async run(action, ...args) {
    const script = `const [done, ...args] = [...arguments].reverse(); (${action})(...args.reverse()).then(value => done({ value }), error => done({ error: String(error) }))`
    const { value, error } = await this.#call('POST', '/execute/async', { script, args })
    if (error !== undefined) throw new StepError(`In ${this.name}: ${error}`)
    return value
  }

  /** Drags from an element's middle to its right end: a slider there has its largest value, however wide its thumb is. @param {Element} element */
  async dragToEnd(element) {
    const width = await this.run(async (/** @type {any} */ element) => element.getBoundingClientRect().width, element)
    const move = (/** @type {number} */ x) => ({ type: 'pointerMove', duration: 0, origin: element, x, y: 0 })
    const actions = [move(0), { type: 'pointerDown', button: 0 }, move(Math.floor(width / 2)), { type: 'pointerUp', button: 0 }]
    await this.#call('POST', '/actions', { actions: [{ type: 'pointer', id: 'mouse', parameters: { pointerType: 'mouse' }, actions }] })
  }

  /** Presses a key where the focus is. @param {string} key */
  async press(key) {
    const actions = ['keyDown', 'keyUp'].map(type => ({ type, value: key }))
    await this.#call('POST', '/actions', { actions: [{ type: 'key', id: 'keys', actions }] })
  }

  /** @param {string} method @param {string} path @param {object} [body] @returns {Promise<any>} */
  async #call(method, path, body) {
    const answer = await fetch(this.address + this.#session + path, { method, headers: { 'Content-Type': 'application/json' }, body: body && JSON.stringify(body) })
    const { value } = await answer.json()
    if (value?.error) throw new StepError(`${this.name} does not ${method} ${path}: ${value.error}. ${value.message}`)
    return value
  }
}
