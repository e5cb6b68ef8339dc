// Registers every figure.
export type * from './details'
export { FigureElement } from './figure-element'
export * from './generated/elements'
