// Light or dark, and the same two with high contrast. The attribute `theme` decides; else the colours that the page says it has around the
// figure, by `color-scheme`; and where it says nothing, the reader's system. Forced colours are the system's, whatever was asked for.
// And letters that a reader has spaced by a style of their own: they take more lines than there are otherwise.
import { printing } from './paper'

const dark = matchMedia('(prefers-color-scheme: dark)')
const contrast = matchMedia('(prefers-contrast: more)')
const forced = matchMedia('(forced-colors: active)')

export const reducedMotion = matchMedia('(prefers-reduced-motion: reduce)')

export type ThemeName = `${'' | 'contrast-'}${'light' | 'dark'}`

export class Theme {
  #name: ThemeName = 'light'
  #looked = false
  readonly #listeners: (() => void)[] = []

  /** Around the edge of the figure are the colours of the page; its own colours are those of the body. */
  constructor(
    private readonly figure: HTMLElement,
    private readonly edge: HTMLElement,
    private readonly body: HTMLElement,
    changed: () => void,
  ) {
    this.onChange(changed)
    // A page tells nobody that it is switched to its dark colours; but what the edge inherits goes on its way then (figure.css).
    edge.addEventListener('transitionend', ({ target }) => target === edge && this.look())
  }

  /** Has something done whenever the colours are others. */
  onChange(listener: () => void): void {
    this.#listeners.push(listener)
  }

  get name(): ThemeName {
    if (!this.#looked) this.look()
    return this.#name
  }

  get shade(): 'light' | 'dark' {
    return this.name.endsWith('dark') ? 'dark' : 'light'
  }

  /** Looks in the frame that shows the figure first: by then all figures of the page stand, and its styles are computed once for all of them. */
  observe(signal: AbortSignal): void {
    for (const query of [dark, contrast, forced]) query.addEventListener('change', () => this.look(), { signal })
    this.#looked = false
    requestAnimationFrame(() => !signal.aborted && this.look())
  }

  /** Looks around. */
  look(): void {
    this.#looked = true
    const silent = getComputedStyle(this.figure).colorScheme === 'normal'
    const { color, letterSpacing, wordSpacing } = getComputedStyle(this.edge)
    this.body.classList.toggle('spaced', letterSpacing !== 'normal' || wordSpacing !== '0px')
    const isDark = silent && !forced.matches ? dark.matches : isLight(color)
    const shade = isDark && !printing ? 'dark' : 'light'
    this.body.classList.toggle('dark', shade === 'dark')
    const name: ThemeName = contrast.matches || forced.matches ? `contrast-${shade}` : shade
    if (name === this.#name) return
    this.#name = name
    for (const listener of this.#listeners) listener()
  }
}

/** Whether a colour, which is a grey, is light: that of letters, on a dark page. */
function isLight(colour: string): boolean {
  const [r = 0, g = 0, b = 0] = (colour.match(/[\d.]+/g) ?? []).map(Number)
  return 0.299 * r + 0.587 * g + 0.114 * b > 127
}
