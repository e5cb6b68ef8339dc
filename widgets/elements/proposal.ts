import { FigureElement } from './base'

/** w17.3, proposals compared: two sample clouds, the true posterior, and a landmark to drag. */
export class FastslamProposal extends FigureElement {}

if (!customElements.get('fastslam-proposal')) customElements.define('fastslam-proposal', FastslamProposal)
