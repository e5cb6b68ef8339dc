import { FigureElement } from './figure-element'
import { register } from './parameters'

/** One update by hand: every number of it, to be changed. */
export class FastslamWorkedExample extends FigureElement {}

register('fastslam-worked-example', FastslamWorkedExample)
