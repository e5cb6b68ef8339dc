// Registers every figure; one file a tag.
export type { FigureDetail } from './events'
export { FigureElement } from './figure-element'
export { FastslamConditioning } from './conditioning'
export { FastslamLap } from './lap'
export { FastslamLog } from './log'
export { FastslamProposal } from './proposal'
export { FastslamResampling } from './resampling'
export { FastslamWorkedExample } from './worked-example'
