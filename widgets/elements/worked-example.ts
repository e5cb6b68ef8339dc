import { FigureElement } from './base'

/** One update by hand: every number of it, to be changed. */
export class FastslamWorkedExample extends FigureElement {}

if (!customElements.get('fastslam-worked-example')) customElements.define('fastslam-worked-example', FastslamWorkedExample)
