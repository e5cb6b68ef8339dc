// The canvas of a figure: how much room there is for the picture, how large it becomes, and its pixels.
import type { Action } from './action'
import { h } from './dom'
import { expected, release, reserve } from './heights'
import type { Picture } from './host'
import type { Layout } from './shell'
import type { Theme } from './theme'

const FONT_SCALE = 1.5 // letters and lines of the presentation size, over the normal one
const PICTURE_SHARE = 0.6 // of a frame's height, which the picture takes if the rest has to be scrolled
const MAX_PIXELS = 6e6 // a canvas beyond this is painted coarser: no screen shows the difference, every phone feels it

/** Whose stage or picture it is. */
const canvases = new WeakMap<Element, Canvas>()

/** One for all: what is asked of any of them is asked before something is written to one, so that the page is laid out once and not for each. */
const sizes = new ResizeObserver(entries => {
  const changed = new Set(entries.map(({ target }) => canvases.get(target)!))
  const written = [...changed].map(canvas => canvas.resize(entries))
  for (const write of written) write()
})

export class Canvas {
  readonly element = h('canvas', { part: 'canvas', role: 'img', 'aria-labelledby': 'title', 'aria-describedby': 'described' })
  #room = 0 // [css px] for the picture, sideways
  #natural: number | undefined // [css px] high, if nothing had to fit
  #highest = Infinity // [css px], so that picture and controls are on one screen
  #size = { css: 0, width: 0, height: 0 }
  #reserves = true // keeps the place free that the figure will take

  constructor(
    private readonly figure: HTMLElement,
    private readonly body: HTMLElement,
    private readonly stage: HTMLElement,
    private readonly theme: Theme,
    private readonly resized: () => void,
  ) {}

  observe(): void {
    for (const element of this.#observed) canvases.set(element, this)
    sizes.observe(this.stage)
    try {
      sizes.observe(this.element, { box: 'device-pixel-content-box' })
    } catch {
      sizes.observe(this.element) // Safari
    }
  }

  disconnect(): void {
    for (const element of this.#observed) sizes.unobserve(element)
  }

  get #observed(): Element[] {
    return [this.stage, this.element]
  }

  /** The figure is there, or will not come: it takes what it takes. */
  release(): void {
    this.#reserves = false
    release(this.body)
  }

  /** Whether the picture takes what height there is, rather than all of the width. */
  get fits(): boolean {
    return (this.figure.hasAttribute('fit') && this.figure.getAttribute('fit') !== 'off') || this.figure.matches(':fullscreen')
  }

  /** What the picture is to be painted for. */
  get size(): Action & { do: 'size' } {
    const height = this.fits ? Math.floor(Math.max(this.body.offsetHeight - this.#around, PICTURE_SHARE * this.body.offsetHeight)) : this.#highest
    const fontScale = this.figure.getAttribute('size') === 'presentation' ? FONT_SCALE : 1
    const { css, width, height: high } = this.#size
    return { do: 'size', name: this.theme.name, at: [this.#room, height, fontScale, css, width, high] }
  }

  /** Height [css px] that shows all of the figure at its present width, the picture as large as it would like to be. */
  get naturalHeight(): number {
    return Math.ceil(this.#around + Math.min(this.#natural ?? this.stage.offsetHeight, this.#highest))
  }

  /** Takes the size that the picture wants; the observer of sizes then asks for the paint. */
  place({ width, height, natural }: Layout): void {
    this.#natural = natural
    this.stage.style.setProperty('--_width', width === undefined ? '100%' : `${width}px`)
    const css = `${height}px`
    if (this.element.style.height === css) return
    this.element.style.height = css
    this.stage.style.setProperty('--_height', css)
    this.stage.parentElement!.style.setProperty('--_high', css)
  }

  show({ width, height, pixels }: Picture): void {
    const context = this.element.getContext('2d', { alpha: false })!
    if (this.element.width !== width) this.element.width = width
    if (this.element.height !== height) this.element.height = height
    // The view is made now and dropped now: the next call into wasm may grow the memory and detach it.
    const bytes = pixels()
    context.putImageData(new ImageData(bytes, width, height), 0, 0)
    // The figure's frame takes the painted background, so that the two cannot drift apart.
    this.body.style.setProperty('--_paper', `rgb(${bytes[0]} ${bytes[1]} ${bytes[2]})`)
    this.stage.classList.add('live')
  }

  /** Its size now, for whoever cannot wait until the observer tells it. */
  measure(): void {
    const { width, height } = getComputedStyle(this.element)
    const css = { width: parseFloat(width), height: parseFloat(height) }
    if (css.width > 0) this.#measure(css)
  }

  /** All of the figure but its picture [css px]. */
  get #around(): number {
    // The stage to a fraction of a pixel: were it rounded, a picture beside half a pixel would grow and shrink for ever.
    const stage = parseFloat(getComputedStyle(this.stage).height) || 0
    return this.body.scrollHeight + this.body.offsetHeight - this.body.clientHeight - stage
  }

  /** Takes what is new of its sizes; what is to be written of it afterwards. */
  resize(entries: ResizeObserverEntry[]): () => void {
    const height = this.#reserves ? expected(this.figure) : undefined
    this.#highest = parseFloat(getComputedStyle(this.stage).getPropertyValue('--_highest')) || Infinity
    this.#room = entries.findLast(({ target }) => target === this.stage)?.contentRect.width ?? this.#room
    const entry = entries.findLast(({ target }) => target === this.element)
    if (entry) this.#measure(entry.contentRect, entry.devicePixelContentBoxSize?.[0])
    return () => {
      if (height !== undefined) reserve(this.body, height)
      this.resized()
    }
  }

  #measure(css: { width: number; height: number }, box?: ResizeObserverSize): void {
    let [width, height] = [Math.round(css.width * devicePixelRatio), Math.round(css.height * devicePixelRatio)]
    // To the very pixel where the browser tells it; but emulated screens tell css pixels here.
    if (box && Math.abs(box.inlineSize - width) < 2) [width, height] = [box.inlineSize, box.blockSize]
    const shrink = Math.min(1, Math.sqrt(MAX_PIXELS / (width * height)))
    this.#size = { css: css.width, width: Math.floor(width * shrink), height: Math.floor(height * shrink) }
  }
}
