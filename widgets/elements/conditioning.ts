import { FigureElement } from './figure-element'
import { register } from './parameters'

/** w17.4, the graphical model: what conditioning on the path does to the covariance. */
export class FastslamConditioning extends FigureElement {}

register('fastslam-conditioning', FastslamConditioning)
