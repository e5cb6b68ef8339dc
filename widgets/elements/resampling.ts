import { FigureElement } from './base'
import { Count } from './count'
import { register } from './parameters'

/** w17.2, when to resample: three filters on one log, their ancestry, and a count over many seeds. */
export class FastslamResampling extends FigureElement {
  readonly #count = new Count(name => this.getParameter(name))

  constructor() {
    super()
    this.addPanel(this.#count.element)
    this.addEventListener('fastslam-change', () => this.#count.check())
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback()
    this.#count.stop()
  }
}

register('fastslam-resampling', FastslamResampling)
