import { FigureElement } from './figure-element'
import type { Frame } from './host'
import { MatrixInputs } from './matrix-inputs'
import css from './matrix-inputs.css?inline'
import { register } from './parameters'

const sheet = new CSSStyleSheet()
sheet.replaceSync(css)

const BESIDE = 832 // [px] from here on the controls stand beside the picture (figure.css)
const LARGER = 1.5 // letters of the presentation size, over normal ones: all that is beside the picture would be higher than it

/** One update by hand: a picture to drag in, the numbers that decide, and each that they begin with in its matrix. */
export class FastslamWorkedExample extends FigureElement {
  #inputs?: MatrixInputs
  readonly #widths = new ResizeObserver(() => this.#fold())

  constructor() {
    super()
    this.shadowRoot!.adoptedStyleSheets.push(sheet)
  }

  override connectedCallback(): void {
    super.connectedCallback()
    this.#widths.observe(this)
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback()
    this.#widths.disconnect()
  }

  /** The controls have been made, in another language again. */
  protected override introduced(): void {
    super.introduced()
    this.#inputs = new MatrixInputs(this.controls!, this.words.say('numbers_to_change'))
    this.#fold()
  }

  protected override present(frame: Frame): void {
    super.present(frame)
    this.#inputs?.mirror()
    const every = frame.values['all-steps'] === 'on' || /\bsteps\b/.test(this.getAttribute('show') ?? '')
    if (every === this.body.classList.contains('every')) return
    this.body.classList.toggle('every', every)
    // The picture may be higher now: it is measured anew.
    this.canvas.disconnect()
    this.canvas.observe()
  }

  #fold(): void {
    const beside = this.getAttribute('size') === 'presentation' ? LARGER * BESIDE : BESIDE
    this.#inputs?.fold(this.clientWidth < beside && !this.body.matches('.some-controls'))
  }
}

register('fastslam-worked-example', FastslamWorkedExample)
