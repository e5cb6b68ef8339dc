import { ComparedFigure } from './compared-figure'
import { register } from './parameters'

/** What if the map were sampled too: the same filter with a map that is drawn with the path, and with one that is computed. */
export class FastslamJoint extends ComparedFigure {}

register('fastslam-joint', FastslamJoint)
