import { FigureElement } from './figure-element'
import { register } from './parameters'

/** w17.1, the lap: every particle's own map, path and robot. */
export class FastslamLap extends FigureElement {}

register('fastslam-lap', FastslamLap)
