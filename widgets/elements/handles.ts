// Points of the picture that a reader moves. The picture draws them; here something to grasp lies over each, which takes the pointer. In it
// is a slider for each direction, unseen: it takes the focus and the keys, and tells assistive technology where the point is and can be.
import type { Action } from './action'
import { h } from './dom'
import { pointIn } from './pointer'
import type { Handle, ParamSpec } from './shell'

/** What the handles may ask of the figure. */
export interface Moves {
  /** What a pointer does in the picture; passing over it, nothing that lasts. */
  point(action: Action, lasts?: boolean): void
  /** A parameter, as assistive technology sets it. */
  change(parameter: string, value: string): void
}

const ARROWS: Record<string, [number, number]> = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }

/** How far a key goes [steps]. */
export function stride(event: KeyboardEvent): number {
  return event.shiftKey ? 10 : event.altKey ? 0.1 : 1
}

export class Handles {
  /** Lies over the canvas and lets everything through but the handles. */
  readonly layer = h('div', { class: 'handles' })
  private readonly grips = new Map<string, HTMLElement>() // by name, so that the focus survives a new picture
  private shown: Handle[] = []
  private following = false // a mouse is over an area
  private touch = { x: 0, y: 0, sideways: false } // where a finger came down, and how it went on

  constructor(private readonly moves: Moves) {}

  show(handles: Handle[], specs: ParamSpec[], values: Record<string, string>): void {
    this.shown = handles
    const names = new Set(handles.map(({ name }) => name))
    for (const [name, grip] of this.grips) {
      if (names.has(name)) continue
      this.grips.delete(name)
      if (grip.matches(':focus-within')) this.layer.parentElement?.focus()
      grip.remove()
    }
    handles.forEach((handle, i) => {
      const { name, x, y, hover } = handle
      let grip = this.grips.get(name)
      if (!grip) {
        grip = this.make(handle)
        this.grips.set(name, grip)
        this.layer.insertBefore(grip, this.layer.children[i] ?? null)
      }
      grip.style.left = `${x}px`
      grip.style.top = `${y}px`
      // What follows the pointer over an area must not come between the two.
      grip.classList.toggle('follows', hover !== null)
      showAxes(grip, handle, specs, values)
    })
  }

  /**
   * For pointers over the canvas: the handle of the area below follows a mouse, until it leaves the area; with a click it stays. A finger
   * takes it along when it taps or moves sideways; up and down it scrolls the page.
   */
  follow(event: PointerEvent): void {
    const { type, pointerType } = event
    const { x, y } = pointIn(this.layer, event)
    const below = this.shown.find(({ hover }) => hover && hover.x <= x && x < hover.x + hover.w && hover.y <= y && y < hover.y + hover.h)
    if (pointerType !== 'touch') {
      const over = type === 'pointerleave' ? undefined : below
      if (!over && this.following) this.moves.point({ do: 'leave' }, false)
      else if (over && type === 'pointerup') this.moves.point({ do: 'drag', name: over.name, at: [x, y] })
      else if (over) this.moves.point({ do: 'follow', name: over.name, at: [x, y] }, false)
      this.following = over !== undefined
      return
    }
    if (type === 'pointerdown') this.touch = { x, y, sideways: false }
    else if (type === 'pointermove') this.touch.sideways ||= Math.abs(x - this.touch.x) > Math.abs(y - this.touch.y)
    if (below && (type === 'pointerup' || (type === 'pointermove' && this.touch.sideways))) this.moves.point({ do: 'drag', name: below.name, at: [x, y] })
  }

  private make({ name, axes }: Handle): HTMLElement {
    const grip = h('div', { class: 'handle', part: 'handle', 'data-name': name }, ...axes.map((parameter, i) => this.axis(parameter, i)))
    let held: { pointer: number; x: number; y: number; dx: number; dy: number } | undefined
    grip.addEventListener('mousedown', event => event.preventDefault()) // or the picture would take the focus
    grip.addEventListener('pointerdown', event => {
      if (event.button !== 0 || held) return
      grip.setPointerCapture(event.pointerId)
      grip.querySelector('input')?.focus({ preventScroll: true })
      // It is held where it was grasped, and does not jump to have its middle there.
      const { clientX: x, clientY: y } = event
      const at = pointIn(grip, event)
      held = { pointer: event.pointerId, x, y, dx: at.x - grip.offsetWidth / 2, dy: at.y - grip.offsetHeight / 2 }
    })
    grip.addEventListener('pointermove', event => {
      const { clientX: x, clientY: y } = event
      if (event.pointerId !== held?.pointer || (x === held.x && y === held.y)) return // browsers also send moves by 0 px, after a scroll for example
      held = { ...held, x, y }
      const at = pointIn(this.layer, event)
      this.moves.point({ do: 'drag', name, at: [at.x - held.dx, at.y - held.dy] })
    })
    grip.addEventListener('lostpointercapture', () => (held = undefined)) // after up and cancel too
    grip.addEventListener('keydown', event => {
      const arrow = ARROWS[event.key]
      if (!arrow || event.ctrlKey || event.metaKey) return
      event.preventDefault() // Alt with an arrow would leave the page
      this.moves.point({ do: 'nudge', name, at: [arrow[0] * stride(event), arrow[1] * stride(event)] })
    })
    return grip
  }

  /** The slider of one direction. Arrow keys move the point in both, so that the first is all that Tab has to stop at. */
  private axis(parameter: string, number: number): HTMLInputElement {
    const slider = h('input', { type: 'range', tabindex: number === 0 ? '0' : '-1', 'aria-describedby': 'handle-keys', 'data-parameter': parameter })
    if (number > 0) slider.setAttribute('aria-orientation', 'vertical')
    slider.addEventListener('input', () => {
      const step = Number(slider.dataset['step'])
      this.moves.change(parameter, String(Number((Math.round(slider.valueAsNumber / step) * step).toPrecision(12))))
    })
    return slider
  }
}

/** Where a point is in each direction, and where it can be. */
function showAxes(grip: HTMLElement, { title, axes, value, text }: Handle, specs: ParamSpec[], values: Record<string, string>): void {
  const plane = axes.length > 1
  if (plane) {
    grip.role = 'group'
    grip.ariaLabel = title
  }
  const sliders = grip.querySelectorAll('input')
  axes.forEach((parameter, i) => {
    const [slider, spec] = [sliders[i]!, specs.find(({ name }) => name === parameter)!]
    // Any value, also between two steps: the point can be dragged there.
    Object.assign(slider, { min: spec.min, max: spec.max, step: 'any' })
    slider.dataset['step'] = String(spec.step)
    slider.value = plane ? values[parameter]! : String(value)
    slider.ariaLabel = plane ? spec.title : title
    slider.setAttribute('aria-valuetext', text)
  })
}
