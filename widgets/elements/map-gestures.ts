// How a map is moved and magnified: a mouse drags it, two fingers move and magnify it, one finger and the wheel scroll the page.
import type { Command } from './host'
import { pointIn, type Point } from './pointer'

const LINE = 16 // [px] of a wheel that tells lines

export function takeGestures(canvas: HTMLCanvasElement, send: (command: Command) => void): void {
  let held: Point | undefined
  canvas.addEventListener('pointerdown', event => {
    if (event.pointerType === 'touch' || event.button !== 0) return
    canvas.setPointerCapture(event.pointerId)
    held = pointIn(canvas, event)
  })
  canvas.addEventListener('pointermove', event => {
    if (!held) return
    const now = pointIn(canvas, event)
    send({ do: 'pan', right: now.x - held.x, down: now.y - held.y })
    held = now
  })
  canvas.addEventListener('lostpointercapture', () => (held = undefined))
  canvas.addEventListener('dblclick', event => send({ do: 'zoom', factor: 2, ...pointIn(canvas, event) }))
  canvas.addEventListener('wheel', event => onWheel(event, canvas, send), { passive: false })

  let fingers: (Point & { apart: number }) | undefined
  const onTouch = (event: TouchEvent) => {
    if (event.touches.length !== 2) return void (fingers = undefined)
    event.preventDefault()
    const now = twoFingers(event, canvas)
    if (fingers) {
      send({ do: 'pan', right: now.x - fingers.x, down: now.y - fingers.y })
      send({ do: 'zoom', factor: now.apart / fingers.apart, x: now.x, y: now.y })
    }
    fingers = now
  }
  for (const type of ['touchstart', 'touchmove', 'touchend', 'touchcancel'] as const) canvas.addEventListener(type, onTouch, { passive: false })
}

/** The wheel scrolls the page, and magnifies with Ctrl: which is also what two fingers on a touchpad send. */
function onWheel(event: WheelEvent, canvas: HTMLCanvasElement, send: (command: Command) => void): void {
  if (!event.ctrlKey && !event.metaKey) return
  event.preventDefault()
  const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? LINE : 1
  send({ do: 'zoom', factor: Math.exp(-0.004 * lines * Math.max(-150, Math.min(150, event.deltaY))), ...pointIn(canvas, event) })
}

/** The middle between two fingers on the canvas, and how far they are apart [px]. */
function twoFingers({ touches }: TouchEvent, canvas: HTMLCanvasElement): Point & { apart: number } {
  const [a, b] = [pointIn(canvas, touches[0]!), pointIn(canvas, touches[1]!)]
  return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, apart: Math.max(10, Math.hypot(a.x - b.x, a.y - b.y)) }
}
