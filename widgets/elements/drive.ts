// Drive it yourself: what a reader holds at the wheel of the lap. It stands where the controls of the figure stand otherwise. What is done
// is the program's (widgets/src/lap/drive.rs); here are the buttons for it, the keys, and the lines that a pointer draws.
import type { Own } from './action'
import type { Controls } from './controls'
import { h, icon, write, type IconName } from './dom'
import css from './drive.css?inline'
import type { Extra } from './extra'
import { label } from './fields'
import type { Figure } from './figure'
import type { Frame } from './host'
import { placeIn, pointIn } from './pointer'
import type { Key } from './words'

const TOOLS = ['wheel', 'wall', 'erase', 'lift'] as const
type Tool = (typeof TOOLS)[number]

const PAD: [name: 'forward' | 'left' | 'back' | 'right', picture: IconName, right: number, up: number][] = [
  ['forward', 'forward', 0, 1],
  ['left', 'left', -1, 0],
  ['back', 'backward', 0, -1],
  ['right', 'right', 1, 0],
]
const ARROWS: Record<string, [number, number]> = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }

const BELOW = 560 // [css px] where the map stands above the universes (widgets/src/lap/layout.rs), it would be out of sight of the pad
const NEAR = 3 // [css px] between points of a line that is drawn
const SVG = 'http://www.w3.org/2000/svg'

const sheet = new CSSStyleSheet()
sheet.replaceSync(css)

/** What a reader changes at the wheel, and what undoing brings back: the drive before the step, which depends on it. */
const PLAN = ['plan', 'drive', 'step'] as const

export class Drive implements Extra {
  /** Takes the reader to the wheel; among the controls that matter. */
  readonly #opener = h('button', { type: 'button', class: 'to-wheel', part: 'button' })
  readonly #wheel = h('div', { class: 'wheel', part: 'controls', role: 'group', hidden: '' })
  readonly #tools = new Map<Tool, HTMLButtonElement>()
  readonly #pad = h('div', { class: 'pad', role: 'group' })
  readonly #hint = h('p', { class: 'hint' })
  readonly #undo = h('button', { type: 'button', part: 'button' })
  readonly #clear = h('button', { type: 'button', part: 'button' })
  /** Over the map: takes the pointer. */
  readonly #map = h('div', { class: 'wheel-map', hidden: '' })
  readonly #line = document.createElementNS(SVG, 'polyline')
  readonly #before: Record<string, string>[] = [] // as the plan was, the newest last
  #tool: Tool = 'wheel'
  #alone = false // the map is shown alone

  constructor(private readonly figure: Figure) {
    const { view, words } = figure
    view.style(sheet)
    view.others.push(this.#wheel)
    view.rooms.append(this.#map)
    for (const tool of TOOLS) {
      const button = h('button', { type: 'button', part: 'button', 'data-tool': tool })
      button.addEventListener('click', () => this.#take(tool))
      this.#tools.set(tool, button)
    }
    const tools = h('div', { class: 'tools', role: 'group' }, ...this.#tools.values())
    const pad = PAD.map(([name, picture, right, up]) => {
      const button = h('button', { type: 'button', class: name, part: 'button', 'data-pad': name }, icon(picture))
      button.addEventListener('click', () => this.#press('drive', right, up))
      return button
    })
    this.#pad.append(...pad)
    const done = h('button', { type: 'button', part: 'button' })
    this.#opener.addEventListener('click', () => this.#open())
    this.#undo.addEventListener('click', () => this.#takeBack())
    this.#clear.addEventListener('click', () => this.#press('clear', 0, 0))
    done.addEventListener('click', () => this.#close())
    this.#wheel.append(tools, this.#pad, this.#hint, h('div', { class: 'acts' }, this.#undo, done, this.#clear))
    words.always(() => {
      write(this.#opener, words.say('drive'))
      this.#wheel.ariaLabel = words.say('drive')
      tools.ariaLabel = words.say('drive_tools')
      this.#pad.ariaLabel = words.say('drive_pad')
      for (const [tool, button] of this.#tools) write(button, words.say(`drive_${tool}`))
      PAD.forEach(([name], i) => label(pad[i]!, words.say(`drive_${name}`)))
      for (const [button, key] of [[this.#undo, 'drive_undo'], [this.#clear, 'drive_clear'], [done, 'drive_done']] as [HTMLElement, Key][]) write(button, words.say(key))
      this.#showTool()
    })
    this.#drawn()
  }

  mount({ main }: Controls): void {
    main.append(this.#opener)
    main.before(this.#wheel) // in whose place it comes
  }

  begun(): void {
    if (!this.#on) return
    // What is in the reader's hand still is.
    this.#own({ name: 'take', value: this.#tool })
    if (this.#alone) this.#showAlone(true)
  }

  frame(frame: Frame): void {
    this.#permit()
    if (!frame.picture) return // before it is painted, nobody knows where the map is, and the button keeps its place
    const area = frame.rooms.find(({ parameter }) => parameter === 'drive')?.area
    this.#opener.hidden = !area
    if (!area && this.#on) this.#close()
    this.#map.hidden = !this.#on
    if (area) Object.assign(this.#map.style, { left: `${area.x}px`, top: `${area.y}px`, width: `${area.w}px`, height: `${area.h}px` })
    const { plan, drive } = frame.values
    this.#undo.disabled = this.#before.length === 0
    this.#clear.disabled = plan === '' && drive === ''
  }

  /** What an author lets readers do: steer, put up and take away walls; and whether anything of it is offered. */
  #permit(): void {
    const { locked, offered } = this.figure.life.author.lets
    const [steer, build] = [!locked.has('drive'), !locked.has('plan')]
    this.#opener.classList.toggle('left-out', !(offered?.has('drive') ?? true) || !(steer || build))
    for (const [tool, button] of this.#tools) button.disabled = !(tool === 'wheel' || tool === 'lift' ? steer : build)
    for (const button of this.#pad.querySelectorAll('button')) button.disabled = !steer
    this.#clear.classList.toggle('left-out', !(steer && build))
  }

  key(key: string, target: HTMLElement): (() => void) | undefined {
    if (!this.#on) return undefined
    if (key === 'Escape') return () => this.#close()
    if (target !== this.figure.view.stage) return undefined
    const arrow = ARROWS[key]
    if (arrow) return () => this.#tools.get(this.#tool)!.disabled || this.#press('move', ...arrow)
    return key === 'Enter' && this.#tool !== 'wheel' ? () => this.#press('set', 0, 0) : undefined
  }

  /** Whether the reader is at the wheel. */
  get #on(): boolean {
    return !this.#wheel.hidden
  }

  #open(): void {
    const { view } = this.figure
    this.#wheel.hidden = false
    view.tellIn(this.#wheel)
    view.body.classList.add('driving')
    this.#alone = view.body.clientWidth < BELOW
    if (this.#alone) this.#showAlone(true)
    this.#take([...this.#tools].find(([, { disabled }]) => !disabled)?.[0] ?? 'wheel')
    this.#moved()
    this.#wheel.scrollIntoView({ block: 'nearest' })
  }

  #close(): void {
    const { view } = this.figure
    this.#wheel.hidden = true
    this.#map.hidden = true
    view.body.classList.remove('driving')
    view.tellIn(undefined)
    this.#own({ name: 'take', value: '' })
    if (this.#alone) this.#showAlone(false)
    this.#alone = false
    this.#moved()
    this.#opener.focus()
  }

  /** The reader has come to the wheel, or left it. */
  #moved(): void {
    this.figure.life.playback.stop()
    this.figure.view.stage.focus({ preventScroll: true })
    this.figure.life.refresh()
  }

  /** The map is shown alone, or what is shown otherwise. */
  #showAlone(alone: boolean): void {
    this.figure.life.send({ do: 'show', name: alone ? 'map' : (this.figure.element.getAttribute('show') ?? '') })
  }

  #own(own: Own): void {
    this.figure.life.send({ do: 'own', ...own })
  }

  #take(tool: Tool): void {
    this.#tool = tool
    this.#showTool()
    this.#own({ name: 'take', value: tool })
  }

  #press(key: string, right: number, up: number): void {
    this.#edit({ name: 'press', value: key, at: [right, up] })
  }

  #edit(own: Own): void {
    const { life, view } = this.figure
    const before = this.#plan
    life.playback.stop()
    for (const cause of ['plan', 'drive']) view.messages.set(cause, '')
    this.figure.byHand(() => this.#own(own))
    const after = this.#plan
    if (before['plan'] !== after['plan'] || before['drive'] !== after['drive']) this.#before.push(before)
    life.refresh()
  }

  #takeBack(): void {
    const { life } = this.figure
    const before = this.#before.pop()
    if (!before) return
    life.playback.stop()
    const now = this.#plan
    this.figure.byHand(() => {
      for (const name of PLAN) if (before[name] !== now[name]) life.setTo(name, before[name]!)
    })
  }

  get #plan(): Record<string, string> {
    return Object.fromEntries(PLAN.map(name => [name, this.figure.host?.state?.values[name] ?? '']))
  }

  #showTool(): void {
    for (const [tool, button] of this.#tools) button.setAttribute('aria-pressed', String(tool === this.#tool))
    write(this.#hint, this.figure.words.say(`drive_hint_${this.#tool}`))
    this.#wheel.dataset['tool'] = this.#tool
  }

  /** Lines that a pointer draws on the map. */
  #drawn(): void {
    const { element: canvas } = this.figure.view.canvas
    const svg = document.createElementNS(SVG, 'svg')
    svg.setAttribute('aria-hidden', 'true')
    svg.append(this.#line)
    this.#map.append(svg)
    let held: { pointer: number; line: number[] } | undefined
    const show = () => {
      const { x: clientX, y: clientY } = canvas.getBoundingClientRect()
      const from = pointIn(this.#map, { clientX, clientY })
      const points = (held?.line ?? []).map((c, i) => c + (i % 2 ? from.y : from.x))
      const straight = [...points.slice(0, 2), ...points.slice(-2)]
      this.#line.setAttribute('points', (this.#tool === 'wall' ? straight : this.#tool === 'wheel' ? points : []).join(' '))
    }
    this.#map.addEventListener('mousedown', event => event.preventDefault()) // the picture keeps the focus
    this.#map.addEventListener('pointerdown', event => {
      if (event.button !== 0 || held || this.#tools.get(this.#tool)!.disabled) return
      this.#map.setPointerCapture(event.pointerId)
      held = { pointer: event.pointerId, line: placeIn(canvas, event) }
    })
    this.#map.addEventListener('pointermove', event => {
      if (event.pointerId !== held?.pointer) return
      const [x, y] = placeIn(canvas, event)
      if (Math.hypot(x - held.line.at(-2)!, y - held.line.at(-1)!) < NEAR) return
      held.line.push(x, y)
      show()
    })
    this.#map.addEventListener('pointerup', event => {
      if (event.pointerId !== held?.pointer) return
      const line = held.line
      held = undefined
      show()
      this.#edit({ name: 'stroke', at: line })
      if (this.#tool === 'wheel') this.figure.transport.play() // shows the robot driving what is not shown of its drive
    })
    this.#map.addEventListener('pointercancel', () => {
      held = undefined
      show()
    })
    this.#map.addEventListener('click', event => event.stopPropagation())
  }
}
