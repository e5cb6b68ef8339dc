// A figure as it stands, for other places: its link, and the codes that put it into another page.
import { embedCode, type CodeName, type FigureMarkup } from './embed-code'
import type { Figure } from './figure'
import { homeAddress } from './files'
import { FIGURES } from './generated/figures'
import { linkTo } from './link'
import { OPTIONS } from './options'
import { fromText, toText } from './parameters'

/** The address of this page with the figure’s whole state. */
export function linkOf(figure: Figure): string {
  return linkTo(figure.element, linkable(figure) + (figure.view.labIsOpen ? '&lab=open' : ''), homeAddress())
}

/** The code that puts it into another page; undefined where that would need an address it does not have. */
export function codeOf(figure: Figure, name: CodeName): string | undefined {
  const home = homeAddress()
  if (!home && (name === 'iframe' || name === 'myst')) return undefined
  return embedCode(name, markupOf(figure), home, figure.view.title, figure.words.say('no_script'))
}

/** What its author would write for it as it stands. */
export function markupOf(figure: Figure): FigureMarkup {
  const { element, view } = figure
  const options = Object.keys(OPTIONS).filter(option => !['fit', 'v', 'lab'].includes(option) && element.hasAttribute(option))
  const lab: [string, string][] = view.labIsOpen ? [['lab', 'open']] : []
  const state = new URLSearchParams(linkable(figure))
  const version = state.get('v') ?? '1' // as links have it
  state.delete('v')
  return { tag: element.localName, attributes: [['v', version], ...state, ...lab, ...options.map((name): [string, string] => [name, element.getAttribute(name)!])] }
}

/** The state; of a figure that has none yet, what its author gave. */
function linkable({ element, life, view }: Figure): string {
  if (life.state || life.host) return life.state
  const { parameters } = FIGURES[element.localName]!
  const usual = (name: string) => fromText(view.specs.find(spec => spec.name === name)?.default)
  const given = parameters.map((name): [string, unknown] => [name, life.get(name)]).filter(([name, value]) => value !== undefined && value !== usual(name))
  return String(new URLSearchParams([['v', life.settings.version], ...given.map(([name, value]) => [name, toText(value)])]))
}
