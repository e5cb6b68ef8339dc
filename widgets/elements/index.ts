// Registers every figure; one file a tag.
export { FigureElement, type FigureDetail } from './base'
export { FastslamLap } from './lap'
