// Every control is made from the shell's list of parameters, so a figure gets its controls by declaring parameters.
import { h, redraw, write } from './dom'
import { button, fieldFor, label, SEED, select, written, type Field, type NumberStyle } from './fields'
import { PLAY, PLAYBACK } from './options'
import { NORMAL_RATE } from './playback'
import type { ParamSpec, Room } from './shell'
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
  /** Opens the Lab, or closes it. */
  lab(): void
  /** The value as a reader typed it; the figure refuses it or shows it. */
  change(name: string, value: string): void
}

const RATES = [1.5, 3, NORMAL_RATE, 12, 24] // [steps/s]; 6 is called 1×: a lap in a quarter of a minute

const STEP = 'step' // has its place in the row of playback, as the seed has

export class Controls {
  readonly transport: HTMLElement
  /** The controls that matter, in first sight, and below them those of the Lab. */
  readonly main: HTMLElement
  /** Opens the Lab: all that is not in first sight. */
  readonly lab: HTMLButtonElement
  /** The others, folded away. */
  readonly settings: HTMLDetailsElement
  private readonly fields = new Map<string, Field>()
  private readonly shown = new Map<string, string>()
  private offered: Set<string> | undefined // what an author picks; undefined for all
  private readonly rewind: HTMLButtonElement
  private readonly play: HTMLButtonElement
  private readonly back: HTMLButtonElement
  private readonly forth: HTMLButtonElement
  private readonly scrub: HTMLInputElement
  private readonly position: HTMLElement
  private readonly extras: HTMLElement // seed, speed and Reset, in the row of playback
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
    this.extras = h('span', { class: 'extras' }, rate)
    const timeline = h('span', { class: 'timeline' }, this.scrub, this.position)
    const buttons = h('span', { class: 'buttons' }, this.rewind, this.back, this.play, this.forth)
    this.playback = [this.rewind, this.back, this.play, this.forth, timeline, rate]
    this.named = [...[this.rewind, this.back, this.forth, rate, reset].map((part): [HTMLElement, string[]] => [part, [PLAYBACK]]), [this.play, [PLAYBACK, PLAY]], [timeline, [PLAYBACK, STEP]]]
    this.transport = h(
      'div',
      { class: 'transport', part: 'transport', role: 'group', 'aria-label': words.say('playback') },
      buttons,
      timeline,
      this.extras,
    )

    this.main = h('div', { class: 'main', part: 'controls', role: 'group', 'aria-label': words.say('controls') })
    const grid = h('div', { class: 'grid' })
    this.lab = h('button', { type: 'button', class: 'lab', part: 'button lab', title: words.say('lab_help'), 'aria-expanded': 'false' }, words.say('lab'))
    this.lab.addEventListener('click', actions.lab)
    this.settings = h('details', { class: 'settings', part: 'settings' }, h('summary', {}, words.say('settings')), grid)
    const rest = document.createDocumentFragment()
    for (const spec of [...specs].sort((a, b) => Number(b.sight) - Number(a.sight))) {
      if (spec.name === STEP || spec.kind === 'text') continue
      const field = fieldFor(spec, words, this.style, value => actions.change(spec.name, value))
      this.fields.set(spec.name, field)
      for (const input of field.element.querySelectorAll<HTMLElement>('input, select')) input.title = spec.help // read out after the name
      const place = spec.name === SEED ? this.extras : spec.sight ? this.main : spec.folded ? grid : rest
      place.append(field.element)
    }
    this.main.append(this.lab, rest)
    this.extras.append(reset)
    this.settings.hidden = !grid.hasChildNodes()
    this.rows = [buttons, this.extras, this.transport, grid, this.settings, this.main]
  }

  /** The control of a parameter, for whoever gives it another place. */
  field(name: string): HTMLElement | undefined {
    return this.fields.get(name)?.element
  }

  /** Takes the place of those in another language, and stands as they do. */
  replace(before: Controls): void {
    for (const part of ['transport', 'main', 'settings'] as const) before[part].replaceWith(this[part])
    for (const { element } of before.fields.values()) element.remove() // also what stood in the picture
    this.settings.open = before.settings.open
    this.rate.value = before.rate.value
  }

  /** `force` puts a control back that the reader has set to a refused value. */
  showValues(specs: ParamSpec[], values: Record<string, string>, force?: string): void {
    for (const spec of specs) {
      const { name } = spec
      const field = this.fields.get(name)
      if (!field) continue
      field.element.hidden = !spec.applies && !this.offered?.has(name)
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

  /** Brings those into first sight that are left to a reader who takes up a challenge. */
  free(specs: ParamSpec[], names: string[]): void {
    for (const { name, sight } of specs) this.fields.get(name)?.element.classList.toggle('in-lab', !sight && !names.includes(name))
  }

  /** The controls that readers see: all, or those of these names. */
  offer(names?: Set<string>): void {
    this.offered = names
    const show = (element: HTMLElement, on: boolean) => element.classList.toggle('left-out', !on)
    const has = (...any: string[]) => !names || any.some(name => names.has(name))
    for (const [name, { element }] of this.fields) show(element, has(name) || (name === SEED && has(PLAYBACK)))
    for (const [part, any] of this.named) show(part, has(...any))
    for (const row of this.rows) show(row, [...row.children].some(child => !child.matches('.left-out, summary, .ask, .lab')))
    // What an author picks is in sight.
    this.settings.classList.toggle('bare', names !== undefined)
    if (names) this.settings.open = true
  }

  /** Puts controls where the picture has room for them, in a layer that lies over it; the others are among their own. */
  stand(rooms: Room[], layer: HTMLElement): void {
    const order = [...this.fields.values()].map(({ element }) => element)
    for (const [name, { element }] of this.fields) {
      const area = rooms.find(({ parameter }) => parameter === name)?.area
      if (area) {
        if (element.parentElement !== layer) layer.append(element)
        Object.assign(element.style, { left: `${area.x}px`, top: `${area.y}px`, width: `${area.w}px`, height: `${area.h}px` })
      } else if (element.parentElement === layer) {
        element.removeAttribute('style')
        const next = order.slice(order.indexOf(element) + 1).find(other => other.parentElement === this.main)
        this.main.insertBefore(element, next ?? null)
      }
    }
  }

  /** The step shown; the handle of the scrubber is left to the hand that moves it until the step that it asked for is shown. */
  showPosition(step: number, target: number, last: number, playing: boolean, note = ''): void {
    const steps = last > 0
    for (const element of this.playback) element.hidden = !steps
    this.transport.classList.toggle('stepless', !steps)
    this.transport.setAttribute('aria-label', this.words.say(steps ? 'playback' : 'start_over'))
    this.scrub.max = String(last)
    if (step === target) this.scrub.value = String(step)
    this.scrub.setAttribute('aria-valuetext', this.words.say('step_of', { step, last }))
    write(this.position, `${step} / ${last}${note}`)
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

  /** What is set stays for a while; what is only drawn may change. */
  freeze(on: boolean): void {
    const set = [...this.fields.values()].map(({ element }) => element).filter(element => element.parentElement === this.main && !element.matches('.flag'))
    for (const part of [...set, this.settings, this.extras]) part.inert = on
  }

  /** At the button that plays. */
  focus(): void {
    this.play.focus()
  }

  enable(on: boolean): void {
    for (const part of [this.transport, this.main, this.settings]) part.inert = !on
  }
}

