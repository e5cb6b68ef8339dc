import { ComparedFigure } from './compared-figure'
import { CountStudy, type Counted } from './count-study'
import { register } from './parameters'

/** In how many runs each filter ends where the robot is, with the end of every ride drawn. */
const RIGHT: Counted = {
  tag: 'fastslam-doors',
  job: 'doors',
  title: 'count_doors',
  settings: ['ride', 'proposal', 'price', 'range', 'gate', 'policy', 'threshold', ...[1, 2, 3, 4, 5, 6, 7].map(door => `door-${door}`)],
  rows: [
    { name: 'ekf_slam', column: 1, expected: 5 },
    { name: 'm_25', column: 2 },
    { name: 'm_100', column: 3 },
    { name: 'm_400', column: 4 },
  ],
}

/** Six identical doors: particles that each decide which one they see, and EKF-SLAM, which decides once for all. */
export class FastslamDoors extends ComparedFigure {
  readonly #study = new CountStudy(RIGHT, name => this.getParameter(name), this.words)

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

register('fastslam-doors', FastslamDoors)
