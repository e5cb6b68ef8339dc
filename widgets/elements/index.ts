// Registers every figure; one file a tag.
export { FigureElement, type FigureDetail } from './base'
export { FastslamConditioning } from './conditioning'
export { FastslamLap } from './lap'
export { FastslamLog } from './log'
export { FastslamProposal } from './proposal'
export { FastslamResampling } from './resampling'
export { FastslamWorkedExample } from './worked-example'
