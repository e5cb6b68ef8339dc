import { FigureElement } from './figure-element'
import type { Frame } from './host'
import { MatrixInputs } from './matrix-inputs'
import css from './matrix-inputs.css?inline'
import { register } from './parameters'

const sheet = new CSSStyleSheet()
sheet.replaceSync(css)

/**
 * One update by hand: a picture to drag in, the numbers that decide, and each that they begin with in its matrix.
 *
 * @csspart inputs - The numbers to change, as matrices.
 */
export class FastslamWorkedExample extends FigureElement {
  #inputs?: MatrixInputs

  constructor() {
    super()
    this.shadowRoot!.adoptedStyleSheets.push(sheet)
  }

  /** The controls have been made, in another language again. */
  protected override introduced(): void {
    super.introduced()
    this.#inputs = new MatrixInputs(this.controls!)
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
}

register('fastslam-worked-example', FastslamWorkedExample)
