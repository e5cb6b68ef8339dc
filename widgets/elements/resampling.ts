import { ComparedFigure } from './compared-figure'
import { CountStudy, type Counted } from './count-study'
import { register } from './parameters'

/** In how many runs each policy still has the right wing when the evidence comes: always on the course of the two wings. */
const WINGS: Counted = {
  tag: 'fastslam-resampling',
  job: 'wings',
  title: 'count_title',
  settings: ['particles', 'threshold', 'odometry', 'range', 'scheme'],
  rows: [
    { name: 'never', column: 1 },
    { name: 'every_step', column: 3 },
    { name: 'selective', column: 5 },
  ],
}

/** w17.2, when to resample: three filters on one log, their ancestry, and a count over many seeds. */
export class FastslamResampling extends ComparedFigure {
  readonly #study = new CountStudy(WINGS, name => this.getParameter(name), this.words)

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
