// Numbers to be changed where they stand in mathematics: in the entries of vectors and matrices.
import type { Controls } from './controls'
import { h, write } from './dom'
import type { Extra } from './extra'
import type { Figure } from './figure'
import type { Frame } from './host'
import css from './matrix-inputs.css?inline'
import type { ParamSpec } from './shell'

const sheet = new CSSStyleSheet()
sheet.replaceSync(css)

/** The name of a parameter; `=name` for an entry that is the same as another; or what is always written there. */
type Entry = string

/** A symbol, and vectors or matrices row by row: one, or one of each particle. */
interface Equation {
  symbol: string
  matrices: Entry[][][]
  /** Whether its parameters are standard deviations, and the matrix has their squares. */
  squared?: boolean
}

const EQUATIONS: Equation[] = [
  { symbol: 'μ', matrices: [[['mu-x'], ['mu-y']]] },
  { symbol: 'Σ', matrices: [[['sigma-xx', 'sigma-xy'], ['=sigma-xy', 'sigma-yy']]] },
  { symbol: 'Q', matrices: [[['range-std', '0'], ['0', 'bearing-std']]], squared: true },
  { symbol: 'x', matrices: [1, 2].map(slot => [[`x${slot}`], [`y${slot}`], [`theta${slot}`]]) },
  { symbol: 'z', matrices: [1, 2].map(slot => [[`r${slot}`], [`phi${slot}`]]) },
]

/**
 * @csspart inputs - The numbers to change, as matrices.
 */
export class MatrixInputs implements Extra {
  #mirrors: [HTMLElement, HTMLInputElement][] = []

  constructor(private readonly figure: Figure) {
    figure.view.style(sheet)
  }

  /** Takes the boxes out of the controls and stands in their place: the noise of the sensor in first sight, the others in the Lab, with
      Reset, which would have a row for itself, at their end. */
  mount(controls: Controls): void {
    const { main, lab, transport } = controls
    this.#mirrors = []
    const [mean, covariance, noise, ...ofParticles] = EQUATIONS.map(equation => this.#equation(equation, controls)) as [HTMLElement, HTMLElement, HTMLElement]
    const heads = h('div', { class: 'equation', 'aria-hidden': 'true' }, h('i'), ...[1, 2].map(slot => h('span', { class: 'of' }, String(slot))))
    const fields = this.figure.view.specs.map(({ name, kind }) => ({ kind, field: controls.field(name) }))
    const left = (of: ParamSpec['kind']) => fields.flatMap(({ kind, field }) => (kind === of && field?.parentElement === main ? field : []))
    const equations = h('div', { class: 'equations in-lab', part: 'inputs' }, mean, covariance, heads, ...ofParticles, ...left('number'))
    main.replaceChildren(noise, lab, equations, h('div', { class: 'last in-lab' }, ...left('flag'), transport))
  }

  frame({ values }: Frame): void {
    // Entries that are the same as others.
    for (const [entry, box] of this.#mirrors) write(entry, box.value)
    const { element, view } = this.figure
    const every = values['all-steps'] === 'on' || /\bsteps\b/.test(element.getAttribute('show') ?? '')
    if (every === view.body.classList.contains('every')) return
    view.body.classList.toggle('every', every)
    // The picture may be higher now: it is measured anew.
    view.canvas.disconnect()
    view.canvas.observe()
  }

  #equation({ symbol, matrices, squared }: Equation, controls: Controls): HTMLElement {
    const { specs } = this.figure.view
    const units = (matrices.at(-1) ?? []).map(row => h('span', { class: 'unit' }, specs.find(({ name }) => row.includes(name))?.unit ?? ''))
    const filled = matrices.map(rows => {
      const matrix = h('span', { class: squared ? 'matrix squared' : 'matrix' }, ...rows.flat().map(entry => this.#entry(entry, controls)))
      matrix.style.setProperty('--_columns', String(rows[0]!.length))
      return matrix
    })
    return h('div', { class: 'equation', role: 'group', 'aria-label': symbol }, h('i', { 'aria-hidden': 'true' }, symbol), ...filled, h('span', { class: 'units', 'aria-hidden': 'true' }, ...units))
  }

  #entry(entry: Entry, controls: Controls): HTMLElement {
    const box = (name: string) => controls.field(name)?.querySelector('input')
    const spec = this.figure.view.specs.find(({ name }) => name === entry)
    if (spec) {
      box(entry)!.ariaLabel = spec.title
      return controls.field(entry)!
    }
    const same = entry.startsWith('=') ? box(entry.slice(1)) : undefined
    const fixed = h('span', { class: 'fixed' }, same ? '' : entry)
    if (same) this.#mirrors.push([fixed, same])
    return fixed
  }
}
