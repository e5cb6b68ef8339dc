import { ComparedFigure } from './compared-figure'
import { register } from './parameters'

/** w17.1, the Apartment lap: every particle's own map, path and robot. */
export class FastslamLap extends ComparedFigure {
  protected readonly compared = { readouts: () => ['rms_best', 'ess', 'lineage'], panels: 'map' }
}

register('fastslam-lap', FastslamLap)
