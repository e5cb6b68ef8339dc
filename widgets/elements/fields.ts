// The control of a parameter: a slider with its box, a box, a list, a tick, a button; and what all of them are made of.
import { h, icon, write } from './dom'
import { stride } from './handles'
import type { ParamSpec } from './shell'
import type { Words } from './words'

/** The parameter with its place in the row of playback. */
export const SEED = 'seed'

/** One control: shows a value, whoever changed it. */
export interface Field {
  element: HTMLElement
  show(value: string): void
  /** Takes a new range: how many universes there are to choose from depends on the setup. */
  limit?(spec: ParamSpec): boolean
}

/** How numbers are written in boxes; the program writes all others. */
export interface NumberStyle {
  comma: boolean
}

let made = 0 // ids must be unique in a shadow root only, but a counter over the page is simpler to trust


export function fieldFor(spec: ParamSpec, words: Words, style: NumberStyle, change: (value: string) => void): Field {
  if (spec.name === SEED) return seedField(spec, words, style, change)
  if (spec.kind === 'flag') return flagField(spec, change)
  if (spec.kind === 'toggle') return toggleField(spec, change)
  if (spec.kind === 'number' && spec.choices.length > 0) return wordField(spec, style, change)
  if (spec.kind === 'choice' || spec.choices.length > 0) return choiceField(spec, change)
  return spec.slider ? sliderField(spec, words, style, change) : numberField(spec, style, change)
}

function toggleField(spec: ParamSpec, change: (value: string) => void): Field {
  const element = h(
    'button',
    { type: 'button', class: 'toggle', part: 'button toggle', name: spec.name, title: spec.help, 'aria-pressed': 'false' },
    spec.title,
  )
  const pressed = () => element.ariaPressed === 'true'
  element.addEventListener('click', () => change(pressed() ? 'off' : 'on'))
  return {
    element,
    show: value => element.setAttribute('aria-pressed', String(value === 'on')),
    // What it does, and so its name, can depend on the state.
    limit: ({ title }) => (write(element, title), false),
  }
}

function flagField(spec: ParamSpec, change: (value: string) => void): Field {
  const input = h('input', { type: 'checkbox', name: spec.name })
  input.addEventListener('change', () => change(input.checked ? 'on' : 'off'))
  return {
    element: h('label', { class: 'flag', part: 'control', title: spec.help }, input, spec.title),
    show: value => void (input.checked = value === 'on'),
  }
}

function choiceField(spec: ParamSpec, change: (value: string) => void): Field {
  const input = select(
    undefined,
    spec.choices.map(c => [c.value, c.title]),
    change,
  )
  input.name = spec.name
  const words = spec.choices.length
  return {
    element: h('label', { class: 'choice', part: 'control', title: spec.help }, h('span', { class: 'name' }, spec.title), input),
    show: value => void (input.value = value),
    // A whole number with named values (universe: the best, or any one) is a list of the names, then the numbers from 0:
    // what is below 0 is another spelling of a name.
    limit({ kind, min, max }) {
      const least = Math.max(min, 0)
      if (kind !== 'integer' || input.length === words + max - least + 1) return false
      input.length = words
      for (let i = least; i <= max; i++) input.add(new Option(String(i)))
      return true
    },
  }
}

function sliderField(spec: ParamSpec, words: Words, style: NumberStyle, change: (value: string) => void): Field {
  const stops = geometricStops(spec)
  const box = numberBox(spec, style, change)
  box.id = `box-${++made}`
  const range = h('input', { type: 'range', name: spec.name, 'aria-label': words.say('slider', { title: spec.title }) })
  Object.assign(range, stops ? { min: 0, max: stops.length - 1, step: 1 } : { min: spec.min, max: spec.max, step: spec.step })
  const describe = (value: string) => range.setAttribute('aria-valuetext', `${written(value, style)} ${spec.unit}`.trim())
  range.addEventListener('input', () => change(stops ? String(stops[range.valueAsNumber]) : range.value))
  return {
    element: h(
      'div',
      { class: 'slider', part: 'control', title: spec.help },
      h('label', { class: 'name', for: box.id }, spec.title),
      h('span', { class: 'value' }, box, h('span', { class: 'unit' }, spec.unit)),
      range,
    ),
    show(value) {
      showNumber(box, value, style)
      range.value = stops ? String(nearest(stops, Number(value))) : value
      describe(value)
    },
    limit: spec => limit(box, spec) && (stops !== undefined || limit(range, spec)),
  }
}

/** A number without a slider: for figures that have many. */
function numberField(spec: ParamSpec, style: NumberStyle, change: (value: string) => void): Field {
  const box = numberBox(spec, style, change)
  return {
    element: h(
      'label',
      { class: 'number', part: 'control', title: spec.help },
      h('span', { class: 'name' }, spec.title),
      h('span', { class: 'value' }, box, h('span', { class: 'unit' }, spec.unit)),
    ),
    show: value => showNumber(box, value, style),
    limit: spec => limit(box, spec),
  }
}

/** A number, or a word instead, which is an empty box. */
function wordField(spec: ParamSpec, style: NumberStyle, change: (value: string) => void): Field {
  const word = spec.choices[0]!.value
  const field = numberField(spec, style, value => change(value || word))
  const box = field.element.querySelector('input')!
  box.placeholder = '?'
  return { ...field, show: value => (value === word ? void (box.value = '') : field.show(value)) }
}

/** True if the range is another one. */
function limit(input: HTMLInputElement, { min, max }: ParamSpec): boolean {
  if (input.min === String(min) && input.max === String(max)) return false
  Object.assign(input, { min, max })
  return true
}

function seedField(spec: ParamSpec, words: Words, style: NumberStyle, change: (value: string) => void): Field {
  const box = numberBox(spec, style, change)
  const roll = button('dice', words.say('reroll'), () => {
    // Short seeds are easier to read out in a classroom; they are as good as long ones.
    let seed: number
    do seed = Math.floor(Math.random() * 10_000)
    while (String(seed) === box.value)
    change(String(seed))
  })
  return {
    element: h(
      'span',
      { class: 'seed', part: 'seed', title: spec.help },
      h('label', {}, h('span', { class: 'name' }, spec.title), box),
      roll,
    ),
    show: value => void (box.value = value),
  }
}

/** What is in a box, as the program reads numbers: with a point, also where a comma was typed. */
function read(box: HTMLInputElement): string {
  return box.value.replace(',', '.')
}

export function written(number: string, { comma }: NumberStyle): string {
  return comma ? number.replace('.', ',') : number
}

function showNumber(box: HTMLInputElement, value: string, style: NumberStyle): void {
  box.value = written(value, style)
  box.ariaValueNow = box.type === 'text' ? value : null // a box of numbers tells it by itself
}

function numberBox(spec: ParamSpec, style: NumberStyle, change: (value: string) => void): HTMLInputElement {
  const box = h('input', {
    type: 'number',
    class: 'number-box',
    name: spec.name,
    inputmode: spec.kind === 'integer' ? 'numeric' : 'decimal',
    autocomplete: 'off',
  })
  // `any`: a typed value need not lie on the slider's steps. The shell judges it, and says why it refuses one.
  Object.assign(box, { min: spec.min, max: spec.max, step: spec.kind === 'integer' ? '1' : 'any' })
  box.addEventListener('change', () => change(read(box)))
  // By the parameter's own steps: those of `any` would be 1.
  box.addEventListener('keydown', event => {
    const up = event.key === 'ArrowUp' ? 1 : event.key === 'ArrowDown' ? -1 : 0
    if (!up || event.ctrlKey || event.metaKey) return
    event.preventDefault()
    const steps = spec.kind === 'integer' ? Math.max(1, stride(event)) : stride(event)
    const value = Math.min(Number(box.max), Math.max(Number(box.min), Number(read(box)) + up * steps * spec.step))
    if (Number.isNaN(value)) return
    showNumber(box, String(Number(value.toPrecision(12))), style) // 0.3, not 0.30000000000000004
    change(read(box))
  })
  return box
}

export function select(name: string | undefined, options: [string, string][], change: (value: string) => void): HTMLSelectElement {
  const element = h(
    'select',
    name ? { 'aria-label': name, title: name } : {},
    ...options.map(([value, text]) => h('option', { value }, text)),
  )
  element.addEventListener('change', () => change(element.value))
  return element
}

export function button(name: Parameters<typeof icon>[0], title: string, act: () => void, part = ''): HTMLButtonElement {
  const element = h('button', { type: 'button', part: `button ${part}`.trim(), class: part }, icon(name))
  label(element, title)
  element.addEventListener('click', act)
  return element
}

export function label(element: HTMLElement, text: string): void {
  element.title = text
  element.setAttribute('aria-label', text)
}

/** Counts that span decades (1 … 256) move by ratio, so that 4, 8 and 16 are as far apart as 64, 128 and 256. */
function geometricStops(spec: ParamSpec): number[] | undefined {
  if (spec.kind !== 'integer' || spec.min < 1 || spec.max < 64 * spec.min) return undefined
  const stops = new Set<number>()
  for (let value: number = spec.min; value < spec.max; value *= 2 ** (1 / 8)) stops.add(Math.round(value))
  return [...stops.add(spec.max)]
}

function nearest(stops: number[], value: number): number {
  let best = 0
  stops.forEach((stop, i) => {
    if (Math.abs(stop - value) < Math.abs(stops[best]! - value)) best = i
  })
  return best
}
