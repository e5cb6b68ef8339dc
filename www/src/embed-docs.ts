// The page on embedding: a figure to set up, what can be done with it in class (wishes.ts), and tables of all there is, made from the
// manifest of the elements.
import type { FigureElement } from '../../widgets/elements/figure-element'
import { h, write } from '../../widgets/elements/dom'
import { frameQuery } from '../../widgets/elements/embed-code'
import type { FigureDetail, NoticeDetail } from '../../widgets/elements/events'
import { FIGURES } from '../../widgets/elements/generated/figures'
import '../../widgets/elements/index'
import { OPTIONS } from '../../widgets/elements/options'
import { takePrintKey } from '../../widgets/elements/paper'
import { noFigure } from '../../widgets/elements/parameters'
import { asked, askedTag, configure } from './asked'
import { Wishes } from './wishes'

export interface Described {
  name: string
  description?: string
  type?: { text: string }
  default?: string
  kind?: string
}
export interface Declaration {
  tagName: string
  summary: string
  attributes: Described[]
  members: Described[]
  events: Described[]
  readouts: Described[]
  predictions?: Described[]
  challenges: Described[]
  cssParts: Described[]
  cssProperties: Described[]
}

takePrintKey()

const home = new URL('../', location.href).href
const form = document.querySelector<HTMLFormElement>('#editor')!
const preview = document.querySelector('#preview')!

/** Where the figure stands beside the fields, as high as the window; else below them. */
const beside = matchMedia('(min-width: 68rem)')

/** A field for an attribute, with what it does; empty means that it is left away. */
function field({ name, description, type, default: value }: Described): HTMLElement {
  const words = [...(type?.text ?? '').matchAll(/'([^']*)'/g)].map(match => match[1]!)
  const choices = type?.text === 'boolean' ? ['on', 'off'] : type?.text.includes('number') ? [] : words
  const told = { name, 'aria-describedby': `about-${name}` }
  const input = choices.length > 0 ? h('select', told, new Option(`${value ?? choices[0]} (default)`, ''), ...choices.map(word => new Option(word, word))) : h('input', { ...told, placeholder: value ?? '', autocomplete: 'off' })
  return h('div', { class: 'field' }, h('label', {}, h('span', { class: 'name' }, name), input), h('small', { id: `about-${name}` }, description ?? ''))
}

/** Opens a state of the gallery. */
type Open = (figure: string, challenge: string) => void

function edit(declarations: Declaration[], kept: readonly [string, string] | undefined): Open {
  const choose = h('select', { name: 'figure' }, ...declarations.map(({ tagName, summary }) => new Option(summary, tagName)))
  const fields = h('fieldset', { 'aria-label': 'Attributes of the figure' })
  /** What is wrong with what is written here: the figure tells its author, and not its readers. */
  const notice = h('p', { class: 'notice', role: 'alert' })
  let figure: FigureElement
  const declared = () => declarations.find(({ tagName }) => tagName === choose.value)!
  const inputs = () => fields.querySelectorAll<HTMLInputElement | HTMLSelectElement>('[name]')

  /** Gives an attribute, or takes it away, also where the figure was moved and no attribute said so. */
  const give = (name: string, value: string) => {
    figure.setAttribute(name, value)
    if (value === '') figure.removeAttribute(name)
    for (const input of inputs()) if (input.name === name && input.value !== value) input.value = value
    write(notice, '') // unless it is refused again
    wishes.print()
  }
  const wishes = new Wishes(home, { figure: () => figure, declared, give }, kept)

  /** The fields follow the figure, except for the one that is being written. */
  const follow = (event: Event) => {
    if (event.currentTarget !== figure) return
    const { by, phase } = (event as CustomEvent<FigureDetail>).detail
    if (by === 'playback' || phase === 'running') return // nobody asked for that step
    const state = new URLSearchParams(figure.state)
    for (const input of inputs()) if (!(input.name in OPTIONS) && input !== document.activeElement) input.value = state.get(input.name) ?? ''
    wishes.print()
  }
  const begin = (first = false) => {
    const { tagName, attributes } = declared()
    const own = attributes.filter(({ name }) => !(name in OPTIONS))
    const common = attributes.filter(({ name }) => name in OPTIONS && name !== 'v' && name !== 'fit') // of the place here, and not of the code
    figure = document.createElement(tagName) as FigureElement
    figure.setAttribute('v', 'latest') // this page goes with its figures; the code says of which version it is
    if (first) configure(figure)
    // What is copied here opens here.
    else history.replaceState(undefined, '', `?${frameQuery({ tag: tagName, attributes: [] })}${location.hash}`)
    figure.toggleAttribute('fit', beside.matches)
    fields.replaceChildren(h('p', { class: 'what' }, 'Parameters'), ...own.map(field), h('p', { class: 'what' }, 'Options'), ...common.map(field))
    for (const input of inputs()) input.value = figure.getAttribute(input.name) ?? ''
    for (const name of ['fastslam-step', 'fastslam-change'] as const) figure.addEventListener(name, follow)
    figure.addEventListener('fastslam-notice', event => write(notice, (event as CustomEvent<NoticeDetail>).detail.text))
    write(notice, '')
    preview.replaceChildren(figure)
    wishes.begin()
  }
  beside.addEventListener('change', () => figure.toggleAttribute('fit', beside.matches))
  choose.addEventListener('change', () => begin())
  fields.addEventListener('input', event => {
    const { name, value } = event.target as HTMLInputElement
    give(name, value)
  })
  form.addEventListener('submit', event => event.preventDefault())
  const unknown = asked && !askedTag ? [h('p', { role: 'alert', class: 'hint' }, `${noFigure(asked)} These are the figures:`)] : []
  const all = h('details', { class: 'all' }, h('summary', {}, 'All attributes'), fields)
  form.replaceChildren(...unknown, h('label', { class: 'choose' }, h('span', { class: 'name' }, 'Figure'), choose), notice, wishes.element, all)
  if (askedTag) choose.value = askedTag
  begin(true)

  return (name, challenge) => {
    if (choose.value !== `fastslam-${name}`) {
      choose.value = `fastslam-${name}`
      begin()
    }
    form.scrollIntoView({ block: 'start' })
    void figure.challenge(challenge)
  }
}

function table(caption: string, heads: string[], rows: (string | HTMLElement)[][]): HTMLElement[] {
  const cells = (row: (string | HTMLElement)[]) => h('tr', {}, ...row.map((cell, i) => (i === 0 ? h('th', { scope: 'row' }, cell) : h('td', {}, cell))))
  return [h('h3', {}, caption), h('table', {}, h('thead', {}, h('tr', {}, ...heads.map(head => h('th', { scope: 'col' }, head)))), h('tbody', {}, ...rows.map(cells)))]
}

function list(declarations: Declaration[]): void {
  const reference = document.querySelector('#reference')!
  const code = (text: string) => h('code', {}, text)
  const attributes = (all: Described[]) => all.map(({ name, type, default: value, description }) => [code(name), code(type?.text ?? ''), code(value ?? ''), description ?? ''])
  const terms = (what: string, all: Described[]) => (all.length > 0 ? table(what, ['Name', 'What it is'], all.map(({ name, description }) => [code(name), description ?? ''])) : [])
  const common = declarations[0]!.cssParts.filter(({ name }) => declarations.every(({ cssParts }) => cssParts.some(part => part.name === name)))
  for (const { tagName, summary, attributes: all, readouts, challenges, predictions = [], cssParts } of declarations) {
    const own = cssParts.filter(({ name }) => !common.some(part => part.name === name))
    // Each has parts of its own to show.
    const rows = attributes(all.filter(({ name }) => name === 'show' || !(name in OPTIONS)))
    reference.append(h('details', {}, h('summary', {}, code(`<${tagName}>`), ` ${summary}`), ...table('Attributes', ['Attribute', 'Values', 'Default', 'What it does'], rows), ...terms('Readouts', readouts), ...terms('Challenges', challenges), ...terms('Predictions', predictions), ...terms('Parts of its own', own)))
  }
  const { attributes: every, members, events, cssProperties } = declarations[0]!
  const methods = members.filter(({ kind }) => kind === 'method')
  const properties = members.filter(({ name, kind }) => kind === 'field' && !FIGURES[declarations[0]!.tagName]!.parameters.some(parameter => parameter.replace(/-(.)/g, (_, letter: string) => letter.toUpperCase()) === name))
  reference.append(
    ...table('Attributes of every figure', ['Attribute', 'Values', 'Default', 'What it does'], attributes(every.filter(({ name }) => name !== 'show' && name in OPTIONS))),
    ...table('Methods, properties and events', ['Name', 'What it does'], [
      ...methods.map(({ name, description }) => [code(`${name}()`), description ?? '']),
      ...properties.map(({ name, description }) => [code(name), description ?? '']),
      ...events.map(({ name, description }) => [code(name), description ?? '']),
    ]),
    h('p', {}, 'Every parameter is a property too, its name without dashes: ', code('range-std'), ' is ', code('rangeStd'), '. For style sheets: the properties ', ...cssProperties.flatMap(({ name }, i) => [i > 0 ? ', ' : '', code(name)]), ' and, by ', code('::part()'), ', these parts.'),
    ...terms('Parts of every figure', common),
  )
}

let open: (open: Open) => void
const ready = new Promise<Open>(resolve => (open = resolve))
// Who presses before all is there is not left without an answer.
for (const button of document.querySelectorAll<HTMLButtonElement>('#gallery button')) button.addEventListener('click', async () => (await ready)(button.dataset['figure']!, button.dataset['challenge']!))

const get = async (file: string): Promise<unknown> => (await fetch(new URL(file, home))).json()
const manifest = (await get('custom-elements.json')) as { modules: { declarations: Declaration[] }[] }
const versions = (await get('v/versions.json').catch(() => ({}))) as Record<string, string>
open!(edit(manifest.modules[0]!.declarations, Object.entries(versions).at(-1)))
list(manifest.modules[0]!.declarations)
