import { ComparedFigure } from './compared-figure'
import { register } from './parameters'

/** EM mapping on a corridor of nameless doors: the path computed in both directions, one map decided; beside it, particles on the same log. */
export class FastslamEm extends ComparedFigure {}

register('fastslam-em', FastslamEm)
