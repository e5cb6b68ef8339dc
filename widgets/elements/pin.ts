// The run that is pinned: what it was, and the card that shows it beside the one of now. Its curves are in the picture.
import { h, write } from './dom'
import type { Frame } from './host'
import type { ParamSpec, Readout } from './shell'
import type { Words } from './words'

/** All that is kept of a run: the page's own, so that it outlives the program. */
export interface Pinned {
  /** As a link has it. */
  state: string
  step: number
  last: number
  values: Record<string, string>
  readouts: Readout[]
  sentence: string
  gist: Frame['gist']
  /** Width of the picture [css px]. */
  css: number
}

export interface PinActions {
  back(): void
  unpin(): void
  /** Whether its picture is to be seen in place of the one of now. */
  peek(on: boolean): void
}

const THUMB = 76 // [css px] high, at most

export class PinCard {
  readonly element = h('div', { class: 'pin-card', part: 'pinned', role: 'group' })
  /** The pinned picture in the place of the one of now. */
  readonly overlay = h('div', { class: 'peek', hidden: '' })
  readonly #picture = h('canvas', { role: 'img' })
  readonly #badge = h('span', { class: 'badge' })
  readonly #thumb = h('canvas', { 'aria-hidden': 'true' })
  readonly #peek = h('button', { type: 'button', class: 'thumb', part: 'button', 'aria-pressed': 'false' })
  readonly #differs = h('p', { class: 'differs' })
  readonly #table = h('table', { role: 'table' })
  readonly #back = h('button', { type: 'button', part: 'button go-back' })
  readonly #unpin = h('button', { type: 'button', part: 'button unpin' })
  #pinned: Pinned | undefined
  #now: Frame | undefined
  #names: string[] = [] // of the readouts that are compared
  #comma = false

  constructor(
    private readonly words: Words,
    actions: PinActions,
  ) {
    this.#peek.append(this.#thumb)
    this.overlay.append(this.#picture, this.#badge)
    this.element.append(this.#peek, h('div', { class: 'told' }, this.#differs, this.#table), h('div', { class: 'acts' }, this.#back, this.#unpin))
    const kept = () => this.#peek.ariaPressed === 'true'
    this.#peek.addEventListener('click', () => actions.peek(!kept()))
    // A mouse only passes over it.
    this.#peek.addEventListener('pointerenter', event => event.pointerType === 'mouse' && (this.overlay.hidden = false))
    this.#peek.addEventListener('pointerleave', event => event.pointerType === 'mouse' && (this.overlay.hidden = !kept()))
    this.overlay.addEventListener('click', () => actions.peek(false))
    this.#back.addEventListener('click', () => actions.back())
    this.#unpin.addEventListener('click', () => actions.unpin())
    words.always(() => {
      write(this.#back, words.say('pin_back'))
      write(this.#unpin, words.say('unpin'))
      this.#peek.ariaLabel = this.#peek.title = words.say('pin_peek')
      this.#write()
    })
  }

  /** Shows a run as the pinned one, or none. */
  hold(pinned: Pinned | undefined): void {
    this.#pinned = pinned
    this.peek(false)
    this.#write()
  }

  /** Takes the picture that a canvas shows as that of the pinned run. */
  take(canvas: HTMLCanvasElement): void {
    const { gist, css } = this.#pinned!
    const scale = canvas.width / css
    copy(canvas, this.#picture, [0, 0, canvas.width, canvas.height])
    copy(canvas, this.#thumb, [gist.x, gist.y, gist.w, gist.h].map(length => Math.round(length * scale)) as Area)
    const width = Math.min(gist.w * (THUMB / gist.h), 2 * THUMB)
    Object.assign(this.#thumb.style, { width: `${width}px`, height: `${(width * gist.h) / gist.w}px` })
  }

  peek(on: boolean): void {
    this.overlay.hidden = !on
    this.#peek.setAttribute('aria-pressed', String(on))
  }

  /** Says the pinned run beside the one of now. */
  compare(now: Frame, names: string[], comma: boolean): void {
    this.#comma = comma
    this.#now = now
    this.#names = names
    this.#write()
  }

  #write(): void {
    const [pinned, now] = [this.#pinned, this.#now]
    if (!pinned || !now) return
    const { words } = this
    const step = { step: pinned.step, now: now.step }
    const at = pinned.last > 0 ? words.say('pinned_at', step) : words.say('pinned')
    const differences = differing(now.specs, pinned.values, now.values, words, this.#comma)
    const then = pinned.last > 0 && pinned.step !== now.step ? words.say('pinned_before', step) : at
    const told = `${then}: ${differences.join(', ') || words.say('pinned_same')}`
    write(this.#differs, told)
    this.#differs.title = told
    this.element.setAttribute('aria-label', `${words.say('pinned_run')}. ${told}`)
    write(this.#badge, at)
    this.#picture.setAttribute('aria-label', `${at}. ${pinned.sentence}`)
    this.#tell(pinned, now)
  }

  /** The numbers of both, below each other. */
  #tell(pinned: Pinned, now: Frame): void {
    const of = (readouts: Readout[], name: string) => readouts.find(readout => readout.name === name)
    const text = (readout: Readout | undefined) => (readout ? [readout.text, readout.unit].filter(Boolean).join(' ') : '–')
    const shown = this.#names.map(name => of(now.readouts, name) ?? of(pinned.readouts, name)).filter(readout => readout !== undefined)
    const rows = shown.map(({ name, title }) => [title, text(of(pinned.readouts, name)), text(of(now.readouts, name))] as const)
    const names = ['', this.words.say('pinned'), this.words.say('now')]
    const texts = [names, rows].flat(2).join('|')
    if (this.#table.dataset['texts'] === texts) return
    this.#table.dataset['texts'] = texts
    const arrow = () => h('span', { class: 'arrow', 'aria-hidden': 'true' }, '→')
    const row = ([title, then, now]: readonly [string, string, string]) => h('tr', { role: 'row' }, h('th', { role: 'rowheader' }, title), h('td', { role: 'cell' }, then), h('td', { role: 'cell' }, arrow(), now))
    this.#table.replaceChildren(h('tr', { class: 'hidden', role: 'row' }, ...names.map(name => h('th', { role: 'columnheader' }, name))), ...rows.map(row))
  }
}

type Area = [x: number, y: number, width: number, height: number]

function copy(from: HTMLCanvasElement, to: HTMLCanvasElement, [x, y, width, height]: Area): void {
  Object.assign(to, { width, height })
  to.getContext('2d', { alpha: false })!.drawImage(from, -x, -y)
}

/** What was set otherwise then, with what it is now: of the setup, not of how it is looked at. */
function differing(specs: ParamSpec[], then: Record<string, string>, now: Record<string, string>, words: Words, comma: boolean): string[] {
  const written = ({ choices, unit, kind }: ParamSpec, value: string) => {
    if (kind === 'flag' || kind === 'toggle') return words.say(value === 'on' ? 'on' : 'off')
    return choices.find(choice => choice.value === value)?.title ?? [comma ? value.replace('.', ',') : value, unit].filter(Boolean).join(' ')
  }
  const changed = specs.filter(({ name, group }) => group === 'setup' && then[name] !== undefined && then[name] !== now[name])
  return changed.map(spec => words.say('pin_differs', { title: spec.title, pinned: written(spec, then[spec.name]!), now: written(spec, now[spec.name]!) }))
}
