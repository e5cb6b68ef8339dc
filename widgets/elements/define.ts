// A figure's class is the element with the extras that it has: those that follow from its row of the registry, and those that a file of its
// own names.
import type { Extra } from './extra'
import type { ExtraClass } from './figure'
import { FigureElement } from './figure-element'
import { FIGURES } from './generated/figures'
import { register } from './parameters'
import { Seeds } from './seeds'

/** Registers a tag, with what its figure has besides what all have. */
export function define(tag: string, ...own: ExtraClass<any>[]): typeof FigureElement {
  const { program, compared } = FIGURES[tag]!
  const all: ExtraClass<any>[] = compared ? [...own, Seeds] : own
  const figure = class extends FigureElement {
    static override heavy = program !== 'page'
    static override extras = all
  }
  for (const kind of all) for (const name of kind.offers ?? []) Object.defineProperty(figure.prototype, name, { configurable: true, writable: true, value: offered(kind, name) })
  register(tag, figure)
  return figure
}

/** A method of an extra, as one of the element. */
function offered(kind: ExtraClass<any>, name: string) {
  return function (this: FigureElement, ...given: unknown[]): unknown {
    const extra = this.extra(kind) as Extra & Record<string, (...given: unknown[]) => unknown>
    return extra[name]!(...given)
  }
}

/** Those with a file of their own. */
const OWN = import.meta.glob('./fastslam-*.ts')

/** Registers one figure, and loads nothing that belongs to another. */
export async function load(tag: string): Promise<void> {
  const own = OWN[`./${tag}.ts`]
  if (own) await own()
  else define(tag, ...(FIGURES[tag]!.counted ? [(await import('./count-study')).CountStudy] : []))
}
