// What runs in the page of a browser. Each function is sent there as its text, so it stands by itself.

/**
 * @typedef {HTMLElement & { readonly state: string, settled(): Promise<void>, example(): Promise<void> }} Figure
 * @typedef {object} Seen what a reader has of a figure
 * @property {string} sentence the line over the picture, and the picture in words
 * @property {[name: string, value: string][]} readouts
 * @property {[width: number, height: number]} size of the picture [device px]
 * @property {number[]} rows of the picture, a fingerprint of each
 * @property {string} state as a link has it
 */

/**
 * Puts a figure into the page, in place of the one before, and waits until it is live; that of logs until it has mapped its example.
 * @param {string} tag @param {Record<string, string>} attributes @param {boolean} [example]
 */
export async function show(tag, attributes, example = false) {
  await customElements.whenDefined(tag)
  const figure = /** @type {Figure} */ (document.createElement(tag))
  for (const [name, value] of Object.entries(attributes)) figure.setAttribute(name, value)
  document.querySelector('main')?.replaceChildren(figure)
  const root = /** @type {ShadowRoot} */ (figure.shadowRoot)
  const text = (/** @type {string} */ selector) => root.querySelector(selector)?.textContent?.trim() ?? ''
  if (example) await figure.example()
  while (example ? !text('[part=sentence]').includes('All scans are mapped') : !root.querySelector('.stage.live')) {
    if (text('[role=alert]')) throw new Error(`${tag}: ${text('[role=alert]')}`)
    await new Promise(requestAnimationFrame)
  }
}

/** Gives the figure in the page other colours. @param {string} theme */
export async function paintIn(theme) {
  document.querySelector('main')?.firstElementChild?.setAttribute('theme', theme)
}

/** What is to be seen of the figure in the page, once all is shown that was asked of it. @returns {Promise<Seen>} */
export async function look() {
  const figure = /** @type {Figure} */ (document.querySelector('main')?.firstElementChild)
  await figure.settled()
  const root = /** @type {ShadowRoot} */ (figure.shadowRoot)
  const canvas = /** @type {HTMLCanvasElement} */ (root.querySelector('[part=canvas]'))
  const { width, height } = canvas
  const { data } = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d')).getImageData(0, 0, width, height)
  const pixels = new Uint32Array(data.buffer)
  const rows = Array.from({ length: height }, (_, y) => pixels.subarray(y * width, (y + 1) * width).reduce((hash, pixel) => Math.imul(hash ^ pixel, 16777619), 2166136261))
  const written = (/** @type {Element} */ row) => [...row.querySelectorAll('dd > span')].map(part => part.textContent).join(' ')
  const readouts = [...root.querySelectorAll('[part=readout]')].map(row => /** @type {[string, string]} */ ([row.getAttribute('data-name'), written(row)]))
  const sentence = ['[part=sentence]', '.described'].map(selector => root.querySelector(selector)?.textContent ?? '').join(' ')
  return { sentence, readouts, size: [width, height], rows, state: figure.state }
}

/** A part of the figure in the page, scrolled into view. @param {string} selector @returns {Promise<any>} an element, as WebDriver names it */
export async function find(selector) {
  const part = document.querySelector('main')?.firstElementChild?.shadowRoot?.querySelector(selector)
  if (!part) throw new Error(`the figure has no ${selector}`)
  part.scrollIntoView({ block: 'center' })
  return part
}

/** Gives the keyboard to a part of the figure in the page. @param {string} selector */
export async function focus(selector) {
  const part = document.querySelector('main')?.firstElementChild?.shadowRoot?.querySelector(selector)
  if (!(part instanceof HTMLElement)) throw new Error(`the figure has no ${selector}`)
  part.focus()
}
