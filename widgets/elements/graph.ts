import { ComparedFigure } from './compared-figure'
import { register } from './parameters'

/** One map that bends: a pose graph on the logs of lap and ring, a false edge to drag, and what repairs it. */
export class FastslamGraph extends ComparedFigure {}

register('fastslam-graph', FastslamGraph)
