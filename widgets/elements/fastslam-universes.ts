import { FigureElement } from './figure-element'
import { register } from './parameters'
import { UniversesAgain } from './universes-again'

/**
 * How many universes are enough: laps that end well over M, what a rule makes of them, and the depletion; every point can be run again.
 *
 * @csspart count - What runs over many seeds, and the button that starts it.
 * @csspart stop - Ends that.
 * @csspart again - Runs the laps of a point again.
 */
export class FastslamUniverses extends FigureElement {
  readonly #again = new UniversesAgain(name => this.getParameter(name), this.words)

  constructor() {
    super()
    this.folds.append(this.#again.element)
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback()
    this.#again.stop()
  }
}

register('fastslam-universes', FastslamUniverses)
