import { FigureElement } from './base'

/** w17.1, the Apartment lap: every particle's own map, path and robot. */
export class FastslamLap extends FigureElement {}

if (!customElements.get('fastslam-lap')) customElements.define('fastslam-lap', FastslamLap)
