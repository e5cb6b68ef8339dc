import { ComparedFigure } from './compared-figure'
import { register } from './parameters'

/** What if the map were sampled too: the same filter with a map that is drawn with the path, and with one that is computed. */
export class FastslamJoint extends ComparedFigure {
  protected readonly compared = { readouts: () => ['ess_sampled', 'ess_computed', 'removed'], panels: 'n-eff' }
}

register('fastslam-joint', FastslamJoint)
