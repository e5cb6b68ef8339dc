import { ComparedFigure } from './compared-figure'
import { register } from './parameters'

/** What the past looks like afterwards: the ancestry that a filter leaves, and paths that a smoother draws. */
export class FastslamSmoothing extends ComparedFigure {
  protected readonly compared = { readouts: () => ['early_after', 'early_before', 'distinct_after'], panels: 'curves' }
}

register('fastslam-smoothing', FastslamSmoothing)
