import { ComparedFigure } from './compared-figure'
import { register } from './parameters'

/** w17.3, proposals compared: two sample clouds, the true posterior, and a landmark to drag. */
export class FastslamProposal extends ComparedFigure {}

register('fastslam-proposal', FastslamProposal)
