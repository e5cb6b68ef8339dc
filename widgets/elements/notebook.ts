// The figures in notebooks and in MyST: a module in anywidget's format, which is served by one file.
// Every trait of the model that names a parameter or an option is the figure's; readouts and the step go back.
import type { FigureDetail } from './events'
import type { FigureElement } from './figure-element'
import { FIGURES } from './generated/figures'
import './index'
import { OPTIONS } from './options'
import { noFigure, tagOf, toText } from './parameters'

/** What anywidget, marimo and MyST give: MyST only ever reads. */
interface Model {
  get(name: string): unknown
  set(name: string, value: unknown): void
  save_changes(): void
  on(name: string, listener: (...told: never[]) => void): void
  off(name: string, listener: (...told: never[]) => void): void
}

/** Names in Python have no dashes. */
const trait = (name: string) => name.replaceAll('-', '_')

function render({ model, el }: { model: Model; el: HTMLElement }): () => void {
  const asked = String(model.get('figure') ?? '')
  const tag = tagOf(asked)
  if (!tag) {
    const names = Object.keys(FIGURES).map(name => name.slice('fastslam-'.length))
    el.append(Object.assign(document.createElement('p'), { textContent: `${noFigure(asked)} There are ${names.join(', ')}.` }))
    return () => el.replaceChildren()
  }
  const known = FIGURES[tag]!
  const figure = document.createElement(tag) as FigureElement
  const ended = new AbortController()
  const off: (() => void)[] = []
  const listen = (name: string, listener: (...told: never[]) => void) => {
    model.on(name, listener)
    off.push(() => model.off(name, listener))
  }

  /** Values that the figure has told, so that they do not come back to it as orders. */
  const told: Record<string, unknown> = {}
  const same = (a: unknown, b: unknown) => a === b || (typeof a === typeof b && JSON.stringify(a) === JSON.stringify(b))
  const give = (name: string, value: unknown) => {
    if (value === undefined || value === null) return
    if (name in OPTIONS) figure.setAttribute(name, Array.isArray(value) ? value.join(' ') : toText(value))
    else figure.setParameter(name, value)
  }
  for (const name of [...known.parameters, ...Object.keys(OPTIONS)]) {
    // In MyST a name may be spelt as the attribute.
    give(name, model.get(trait(name)) ?? model.get(name))
    listen(`change:${trait(name)}`, () => {
      const value = model.get(trait(name))
      if (!same(value, told[name])) give(name, value)
    })
  }
  listen('msg:custom', ((message: { do?: string }) => {
    if (message.do === 'play' || message.do === 'pause' || message.do === 'reset') figure[message.do]()
  }) as (...told: never[]) => void)

  const tell = ({ detail }: CustomEvent<FigureDetail>) => {
    for (const name of known.parameters) {
      const value = figure.getParameter(name)
      told[name] = value
      if (!same(model.get(trait(name)), value)) model.set(trait(name), value)
    }
    model.set('readouts', Object.fromEntries(detail.readouts.map(({ name, value }) => [name, value])))
    model.save_changes()
  }
  // MyST has no one to tell.
  if (model.get('readouts') !== undefined) {
    figure.addEventListener('fastslam-step', event => tell(event as CustomEvent<FigureDetail>), { signal: ended.signal })
    figure.addEventListener('fastslam-change', event => tell(event as CustomEvent<FigureDetail>), { signal: ended.signal })
  }
  el.append(figure)
  return () => {
    ended.abort()
    off.forEach(stop => stop())
    figure.remove()
  }
}

export * from './index'
export default { render }
