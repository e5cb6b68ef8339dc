// Every control is made from the shell's list of parameters, so a figure gets its controls by declaring parameters.
import { h, icon, redraw, write } from './dom'
import type { ParamSpec } from './shell'
import { stride } from './handles'
import { PLAY, PLAYBACK } from './options'
import type { Words } from './words'

/** What the controls may ask of the figure. */
export interface Actions {
  playPause(): void
  step(): void
  stepBack(): void
  seek(step: number): void
  /** To the first step; everything that was set stays. */
  rewind(): void
  /** To all that the page's author gave. */
  reset(): void
  rate(stepsPerSecond: number): void
  /** The value as a reader typed it; the figure refuses it or shows it. */
  change(name: string, value: string): void
}

/** One control: shows a value, whoever changed it. */
interface Field {
  element: HTMLElement
  show(value: string): void
  /** Takes a new range: how many universes there are to choose from depends on the setup. */
  limit?(spec: ParamSpec): boolean
}

const RATES = [1.5, 3, 6, 12, 24] // [steps/s]; 6 is called 1×: a lap in a quarter of a minute
const NORMAL_RATE = 6

// These two have their place in the row of transport controls.
const SEED = 'seed'
const STEP = 'step'

/** How numbers are written in boxes; the program writes all others. */
interface NumberStyle {
  comma: boolean
}

let made = 0 // ids must be unique in a shadow root only, but a counter over the page is simpler to trust

export class Controls {
  readonly transport: HTMLElement
  readonly settings: HTMLDetailsElement
  readonly view: HTMLElement
  private readonly fields = new Map<string, Field>()
  private readonly shown = new Map<string, string>()
  private readonly rewind: HTMLButtonElement
  private readonly play: HTMLButtonElement
  private readonly back: HTMLButtonElement
  private readonly forth: HTMLButtonElement
  private readonly scrub: HTMLInputElement
  private readonly position: HTMLElement
  private readonly style: NumberStyle = { comma: false }
  private readonly rate: HTMLSelectElement
  private readonly playback: HTMLElement[] // all that a figure without steps has no use for
  private readonly named: [HTMLElement, string[]][] // parts of the row of playback, and the names that `controls` has for each
  private readonly rows: HTMLElement[] // what controls stand in, from within

  constructor(
    specs: ParamSpec[],
    private readonly words: Words,
    actions: Actions,
  ) {
    this.rewind = button('rewind', words.say('rewind'), actions.rewind, 'rewind')
    this.play = button('play', words.say('play'), actions.playPause, 'play primary')
    this.back = button('back', words.say('step_back'), actions.stepBack, 'step-back')
    this.forth = button('step', words.say('step'), actions.step, 'step')
    const reset = button('reset', words.say('reset'), actions.reset, 'reset')
    this.scrub = h('input', { type: 'range', class: 'scrub', part: 'scrub', min: '0', step: '1', 'aria-label': words.say('step_shown') })
    this.scrub.addEventListener('input', () => actions.seek(this.scrub.valueAsNumber))
    this.position = h('span', { class: 'position' })
    const rate = select(
      words.say('speed'),
      RATES.map(rate => [String(rate), `${rate / NORMAL_RATE}×`]),
      v => actions.rate(Number(v)),
    )
    this.rate = rate
    rate.value = String(NORMAL_RATE)
    const extras = h('span', { class: 'extras' }, rate)
    const timeline = h('span', { class: 'timeline' }, this.scrub, this.position)
    const buttons = h('span', { class: 'buttons' }, this.rewind, this.back, this.play, this.forth)
    this.playback = [this.rewind, this.back, this.play, this.forth, timeline, rate]
    this.named = [...[this.rewind, this.back, this.forth, rate, reset].map((part): [HTMLElement, string[]] => [part, [PLAYBACK]]), [this.play, [PLAYBACK, PLAY]], [timeline, [PLAYBACK, STEP]]]
    this.transport = h(
      'div',
      { class: 'transport', part: 'transport', role: 'group', 'aria-label': words.say('playback') },
      buttons,
      timeline,
      extras,
    )

    const grid = h('div', { class: 'grid' })
    const boxes = h('div', { class: 'boxes' })
    this.settings = h('details', { class: 'settings', part: 'settings' }, h('summary', {}, words.say('settings')), grid, boxes)
    this.view = h('div', { class: 'view', part: 'view', role: 'group', 'aria-label': words.say('drawn') })
    const toggles: HTMLElement[] = []
    const choices: HTMLElement[] = [] // after the sliders, so that the grid has even rows
    for (const spec of specs) {
      if (spec.name === STEP) continue
      const field = fieldFor(spec, words, this.style, value => actions.change(spec.name, value))
      this.fields.set(spec.name, field)
      for (const input of field.element.querySelectorAll<HTMLElement>('input, select')) input.title = spec.help // read out after the name
      if (spec.name === SEED) extras.append(field.element)
      else if (spec.kind === 'toggle') toggles.push(field.element)
      else if (spec.group === 'view') this.view.append(field.element)
      else if (spec.kind === 'choice') choices.push(field.element)
      else if (field.element.matches('.number')) boxes.append(field.element)
      else grid.append(field.element)
    }
    extras.append(reset)
    this.view.prepend(...toggles)
    grid.append(...choices)
    this.settings.hidden = !grid.hasChildNodes() && !boxes.hasChildNodes()
    this.rows = [buttons, extras, this.transport, grid, boxes, this.settings, this.view]
  }

  /** Takes the place of those in another language, and stands as they do. */
  replace(before: Controls): void {
    for (const part of ['transport', 'settings', 'view'] as const) before[part].replaceWith(this[part])
    this.settings.open = before.settings.open
    this.rate.value = before.rate.value
  }

  /** `force` puts a control back that the reader has set to a refused value. */
  showValues(specs: ParamSpec[], values: Record<string, string>, force?: string): void {
    for (const spec of specs) {
      const { name } = spec
      const field = this.fields.get(name)
      if (!field) continue
      const value = values[name] ?? ''
      const changed = field.limit?.(spec) || this.shown.get(name) !== value || name === force
      if (!changed) continue // a box that is being typed into is left alone until its value changes under it
      this.shown.set(name, value)
      field.show(value)
    }
  }

  /** Numbers in boxes with a comma or a point, from the next {@link showValues} on. */
  writeComma(comma: boolean): void {
    if (comma === this.style.comma) return
    this.style.comma = comma
    this.shown.clear()
    // A box of numbers writes them as the browser's language has it, so those with decimals become boxes of text.
    for (const { element } of this.fields.values()) {
      for (const box of element.querySelectorAll<HTMLInputElement>('input[inputmode=decimal]')) {
        box.type = comma ? 'text' : 'number'
        box.role = comma ? 'spinbutton' : null
      }
    }
    for (const option of this.rate.options) option.text = written(`${Number(option.value) / NORMAL_RATE}×`, this.style)
  }

  /** Parameters that are the author's alone: their controls show the value and do nothing. */
  lock(names: Set<string>): void {
    for (const [name, { element }] of this.fields) {
      const inputs = element.matches('button') ? [element as HTMLButtonElement] : element.querySelectorAll<HTMLInputElement>('input, select, button')
      for (const input of inputs) input.disabled = names.has(name)
    }
    this.scrub.disabled = names.has(STEP)
  }

  /** The controls that readers see: all, or those of these names. */
  offer(names?: Set<string>): void {
    const show = (element: HTMLElement, on: boolean) => element.classList.toggle('left-out', !on)
    const has = (...any: string[]) => !names || any.some(name => names.has(name))
    for (const [name, { element }] of this.fields) show(element, has(name) || (name === SEED && has(PLAYBACK)))
    for (const [part, any] of this.named) show(part, has(...any))
    for (const row of this.rows) show(row, [...row.children].some(child => !child.matches('.left-out, summary, .ask')))
    // What an author picks is in sight.
    this.settings.classList.toggle('bare', names !== undefined)
    if (names) this.settings.open = true
  }

  /** The step shown; the handle of the scrubber is left to the hand that moves it until the step that it asked for is shown. */
  showPosition(step: number, target: number, last: number, playing: boolean): void {
    const steps = last > 0
    for (const element of this.playback) element.hidden = !steps
    this.transport.setAttribute('aria-label', this.words.say(steps ? 'playback' : 'start_over'))
    this.scrub.max = String(last)
    if (step === target) this.scrub.value = String(step)
    this.scrub.setAttribute('aria-valuetext', this.words.say('step_of', { step, last }))
    write(this.position, `${step} / ${last}`)
    this.rewind.disabled = this.back.disabled = step <= 0
    this.forth.disabled = step >= last
    const name = this.words.say(playing ? 'pause' : 'play')
    if (this.play.title !== name) {
      redraw(this.play.firstElementChild!, playing ? 'pause' : 'play')
      label(this.play, name)
    }
  }

  showBusy(busy: boolean): void {
    this.position.classList.toggle('busy', busy)
  }

  enable(on: boolean): void {
    for (const part of [this.transport, this.settings, this.view]) part.inert = !on
  }
}

function fieldFor(spec: ParamSpec, words: Words, style: NumberStyle, change: (value: string) => void): Field {
  if (spec.name === SEED) return seedField(spec, words, style, change)
  if (spec.kind === 'flag') return flagField(spec, change)
  if (spec.kind === 'toggle') return toggleField(spec, change)
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
  return { element, show: value => element.setAttribute('aria-pressed', String(value === 'on')) }
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

function written(number: string, { comma }: NumberStyle): string {
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

function select(name: string | undefined, options: [string, string][], change: (value: string) => void): HTMLSelectElement {
  const element = h(
    'select',
    name ? { 'aria-label': name, title: name } : {},
    ...options.map(([value, text]) => h('option', { value }, text)),
  )
  element.addEventListener('change', () => change(element.value))
  return element
}

function button(name: Parameters<typeof icon>[0], title: string, act: () => void, part = ''): HTMLButtonElement {
  const element = h('button', { type: 'button', part: `button ${part}`.trim(), class: part }, icon(name))
  label(element, title)
  element.addEventListener('click', act)
  return element
}

function label(element: HTMLElement, text: string): void {
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
