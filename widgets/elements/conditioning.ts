import { FigureElement } from './base'

/** w17.4, the graphical model: what conditioning on the path does to the covariance. */
export class FastslamConditioning extends FigureElement {}

if (!customElements.get('fastslam-conditioning')) customElements.define('fastslam-conditioning', FastslamConditioning)
