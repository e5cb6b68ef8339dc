// Drive it yourself: what a reader holds at the wheel of the lap. It stands where the controls of the figure stand otherwise. What is done
// is the program's (widgets/src/lap/drive.rs); here are the buttons for it, the keys, and the lines that a pointer draws.
import { h, icon, write, type IconName } from './dom'
import css from './drive.css?inline'
import { label } from './fields'
import { pointIn } from './pointer'
import type { Room } from './shell'
import type { Key, Words } from './words'

/** What it may ask of the figure. */
interface Asked {
  take(tool: string): void
  /** The map alone is shown, or what is shown otherwise. */
  showMap(alone: boolean): void
  /** A key, right and up. */
  press(key: string, right: number, up: number): void
  /** A line on the canvas [css px]: x, y, x, y … */
  stroke(line: number[]): void
  /** Shows the robot driving what is not shown of its drive. */
  drive(): void
  undo(): void
  /** It was opened, or closed. */
  opened(): void
}

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

export class Drive {
  static readonly sheet = sheet
  /** Takes the reader to the wheel; among the controls that matter. */
  readonly opener = h('button', { type: 'button', class: 'to-wheel', part: 'button' })
  readonly element = h('div', { class: 'wheel', part: 'controls', role: 'group', hidden: '' })
  readonly #tools = new Map<Tool, HTMLButtonElement>()
  readonly #toolRow = h('div', { class: 'tools', role: 'group' })
  readonly #pad = h('div', { class: 'pad', role: 'group' })
  readonly #hint = h('p', { class: 'hint' })
  readonly #undo = h('button', { type: 'button', part: 'button' })
  readonly #clear = h('button', { type: 'button', part: 'button' })
  readonly #done = h('button', { type: 'button', part: 'button' })
  /** Over the map: takes the pointer. */
  readonly #map = h('div', { class: 'wheel-map', hidden: '' })
  readonly #line = document.createElementNS(SVG, 'polyline')
  #canvas: HTMLCanvasElement | undefined
  #tool: Tool = 'wheel'
  #sentenceAfter: ChildNode | null = null
  #alone = false // the map is shown alone

  constructor(
    private readonly words: Words,
    private readonly body: HTMLElement,
    private readonly sentence: HTMLElement,
    private readonly asked: Asked,
  ) {
    for (const tool of TOOLS) {
      const button = h('button', { type: 'button', part: 'button', 'data-tool': tool })
      button.addEventListener('click', () => this.#take(tool))
      this.#tools.set(tool, button)
    }
    this.#toolRow.append(...this.#tools.values())
    const pad = PAD.map(([name, picture, right, up]) => {
      const button = h('button', { type: 'button', class: name, part: 'button', 'data-pad': name }, icon(picture))
      button.addEventListener('click', () => asked.press('drive', right, up))
      return button
    })
    this.#pad.append(...pad)
    this.opener.addEventListener('click', () => this.#open())
    this.#undo.addEventListener('click', () => asked.undo())
    this.#clear.addEventListener('click', () => asked.press('clear', 0, 0))
    this.#done.addEventListener('click', () => this.#close())
    this.element.append(this.#toolRow, this.#pad, this.#hint, h('div', { class: 'acts' }, this.#undo, this.#done, this.#clear))
    words.always(() => {
      write(this.opener, words.say('drive'))
      this.element.ariaLabel = words.say('drive')
      this.#toolRow.ariaLabel = words.say('drive_tools')
      this.#pad.ariaLabel = words.say('drive_pad')
      for (const [tool, button] of this.#tools) write(button, words.say(`drive_${tool}`))
      PAD.forEach(([name], i) => label(pad[i]!, words.say(`drive_${name}`)))
      for (const [button, key] of [[this.#undo, 'drive_undo'], [this.#clear, 'drive_clear'], [this.#done, 'drive_done']] as [HTMLElement, Key][]) write(button, words.say(key))
      this.#showTool()
    })
    this.#drawn()
  }

  /** Whether the reader is at the wheel. */
  get on(): boolean {
    return !this.element.hidden
  }

  /** Its program has begun again: what is in the reader's hand still is. */
  again(): void {
    if (!this.on) return
    this.asked.take(this.#tool)
    if (this.#alone) this.asked.showMap(true)
  }

  /** What an author lets readers do: steer, put up and take away walls; and whether anything of it is offered. */
  permit(steer: boolean, build: boolean, offered: boolean): void {
    this.opener.classList.toggle('left-out', !offered || !(steer || build))
    for (const [tool, button] of this.#tools) button.disabled = !(tool === 'wheel' || tool === 'lift' ? steer : build)
    for (const button of this.#pad.querySelectorAll('button')) button.disabled = !steer
    this.#clear.classList.toggle('left-out', !(steer && build))
  }

  /** Stands over the map, where the picture has one. */
  show(rooms: Room[], layer: Element, canvas: HTMLCanvasElement, undo: boolean, plan: boolean): void {
    const area = rooms.find(({ parameter }) => parameter === 'drive')?.area
    this.opener.hidden = !area
    if (!area && this.on) this.#close()
    if (this.#map.parentElement !== layer) layer.append(this.#map)
    this.#map.hidden = !this.on
    if (area) Object.assign(this.#map.style, { left: `${area.x}px`, top: `${area.y}px`, width: `${area.w}px`, height: `${area.h}px` })
    this.#undo.disabled = !undo
    this.#clear.disabled = !plan
    this.#canvas = canvas
  }

  /** What an arrow key or Enter does while the picture has the focus. */
  keyAction(key: string): (() => void) | undefined {
    if (!this.on) return undefined
    const arrow = ARROWS[key]
    if (arrow) return this.#tools.get(this.#tool)!.disabled ? () => {} : () => this.asked.press('move', ...arrow)
    return key === 'Enter' && this.#tool !== 'wheel' ? () => this.asked.press('set', 0, 0) : undefined
  }

  /** Escape drops a wall that was begun, and then leaves the wheel. */
  onEscape({ key }: KeyboardEvent): boolean {
    if (!this.on || key !== 'Escape') return false
    this.#close()
    return true
  }

  #open(): void {
    this.#sentenceAfter = this.sentence.nextSibling
    this.element.hidden = false
    this.element.append(this.sentence)
    this.body.classList.add('driving')
    this.#alone = this.body.clientWidth < BELOW
    if (this.#alone) this.asked.showMap(true)
    this.#take([...this.#tools].find(([, { disabled }]) => !disabled)?.[0] ?? 'wheel')
    this.asked.opened()
    this.element.scrollIntoView({ block: 'nearest' })
  }

  #close(): void {
    this.element.hidden = true
    this.#map.hidden = true
    this.body.classList.remove('driving')
    this.#sentenceAfter?.before(this.sentence)
    this.asked.take('')
    if (this.#alone) this.asked.showMap(false)
    this.#alone = false
    this.asked.opened()
    this.opener.focus()
  }

  #take(tool: Tool): void {
    this.#tool = tool
    this.#showTool()
    this.asked.take(tool)
  }

  #showTool(): void {
    for (const [tool, button] of this.#tools) button.setAttribute('aria-pressed', String(tool === this.#tool))
    write(this.#hint, this.words.say(`drive_hint_${this.#tool}`))
    this.element.dataset['tool'] = this.#tool
  }

  /** Lines that a pointer draws on the map. */
  #drawn(): void {
    const svg = document.createElementNS(SVG, 'svg')
    svg.setAttribute('aria-hidden', 'true')
    svg.append(this.#line)
    this.#map.append(svg)
    let held: { pointer: number; line: number[] } | undefined
    const show = () => {
      const canvas = this.#canvas!.getBoundingClientRect()
      const from = pointIn(this.#map, { clientX: canvas.x, clientY: canvas.y })
      const points = (held?.line ?? []).map((c, i) => c + (i % 2 ? from.y : from.x))
      const straight = [...points.slice(0, 2), ...points.slice(-2)]
      this.#line.setAttribute('points', (this.#tool === 'wall' ? straight : this.#tool === 'wheel' ? points : []).join(' '))
    }
    const at = (event: PointerEvent): [number, number] => {
      const { x, y } = pointIn(this.#canvas!, event)
      return [x, y]
    }
    this.#map.addEventListener('mousedown', event => event.preventDefault()) // the picture keeps the focus
    this.#map.addEventListener('pointerdown', event => {
      if (event.button !== 0 || held || this.#tools.get(this.#tool)!.disabled) return
      this.#map.setPointerCapture(event.pointerId)
      held = { pointer: event.pointerId, line: at(event) }
    })
    this.#map.addEventListener('pointermove', event => {
      if (event.pointerId !== held?.pointer) return
      const [x, y] = at(event)
      if (Math.hypot(x - held.line.at(-2)!, y - held.line.at(-1)!) < NEAR) return
      held.line.push(x, y)
      show()
    })
    this.#map.addEventListener('pointerup', event => {
      if (event.pointerId !== held?.pointer) return
      const line = held.line
      held = undefined
      show()
      this.asked.stroke(line)
      if (this.#tool === 'wheel') this.asked.drive()
    })
    this.#map.addEventListener('pointercancel', () => {
      held = undefined
      show()
    })
    this.#map.addEventListener('click', event => event.stopPropagation())
  }
}
