import { ComparedFigure } from './compared-figure'
import { register } from './parameters'

/** What the past looks like afterwards: the ancestry that a filter leaves, and paths that a smoother draws. */
export class FastslamSmoothing extends ComparedFigure {}

register('fastslam-smoothing', FastslamSmoothing)
