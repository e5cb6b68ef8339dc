import { ComparedFigure } from './compared-figure'
import { CountStudy } from './count-study'
import { COUNTED } from './generated/counted'

/**
 * A figure with a count over many seeds below it, which the page runs in the background.
 *
 * @csspart count - What runs over many seeds, and the button that starts it.
 * @csspart stop - Ends that.
 */
export class CountedFigure extends ComparedFigure {
  readonly #study = new CountStudy(this.localName, COUNTED[this.localName]!, name => this.getParameter(name), this.words)

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
