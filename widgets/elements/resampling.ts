import { FigureElement } from './figure-element'
import { ResamplingStudy } from './resampling-study'
import { register } from './parameters'

/** w17.2, when to resample: three filters on one log, their ancestry, and a count over many seeds. */
export class FastslamResampling extends FigureElement {
  readonly #study = new ResamplingStudy(name => this.getParameter(name), this.words)

  constructor() {
    super()
    this.folds.append(this.#study.element)
    this.addEventListener('fastslam-change', () => this.#study.check())
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback()
    this.#study.stop()
  }
}

register('fastslam-resampling', FastslamResampling)
