// Figures that are told wholly by their program: they need a class, and no line of code.
import { ComparedFigure } from './compared-figure'
import { FigureElement } from './figure-element'
import { FIGURES } from './generated/figures'
import { register } from './parameters'

type ElementClass = new (...given: any[]) => FigureElement

/** Registers a tag with a class that has nothing of its own. */
export function define<Base extends ElementClass>(tag: string, base: Base): Base {
  const figure = class extends base {}
  register(tag, figure)
  return figure
}

/** Those with code of their own, by its file. */
const OWN = import.meta.glob('./fastslam-*.ts')

/** Registers one figure, and loads nothing that belongs to another. */
export async function load(tag: string): Promise<void> {
  const own = OWN[`./${tag}.ts`]
  if (own) return void (await own())
  const { counted, compared } = FIGURES[tag]!
  define(tag, counted ? (await import('./counted-figure')).CountedFigure : compared ? ComparedFigure : FigureElement)
}
