// Registers every figure; one file a tag.
export { FigureElement, type FigureDetail } from './base'
export { FastslamConditioning } from './conditioning'
export { FastslamLap } from './lap'
export { FastslamProposal } from './proposal'
export { FastslamWorkedExample } from './worked-example'
