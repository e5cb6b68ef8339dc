// How a map is moved and magnified: a mouse drags it, two fingers move and magnify it, one finger and the wheel scroll the page.
import type { Own } from './action'
import { placeIn, pointIn, type Point } from './pointer'

const LINE = 16 // [px] of a wheel that tells lines

export function takeGestures(canvas: HTMLCanvasElement, send: (look: Own) => void): void {
  let held: Point | undefined
  canvas.addEventListener('pointerdown', event => {
    if (event.pointerType === 'touch' || event.button !== 0) return
    canvas.setPointerCapture(event.pointerId)
    held = pointIn(canvas, event)
  })
  canvas.addEventListener('pointermove', event => {
    if (!held) return
    const now = pointIn(canvas, event)
    send({ name: 'pan', at: [now.x - held.x, now.y - held.y] })
    held = now
  })
  canvas.addEventListener('lostpointercapture', () => (held = undefined))
  canvas.addEventListener('dblclick', event => send({ name: 'zoom', at: [2, ...placeIn(canvas, event)] }))
  canvas.addEventListener('wheel', event => onWheel(event, canvas, send), { passive: false })

  let fingers: (Point & { apart: number }) | undefined
  const onTouch = (event: TouchEvent) => {
    if (event.touches.length !== 2) return void (fingers = undefined)
    event.preventDefault()
    const now = twoFingers(event, canvas)
    if (fingers) {
      send({ name: 'pan', at: [now.x - fingers.x, now.y - fingers.y] })
      send({ name: 'zoom', at: [now.apart / fingers.apart, now.x, now.y] })
    }
    fingers = now
  }
  for (const type of ['touchstart', 'touchmove', 'touchend', 'touchcancel'] as const) canvas.addEventListener(type, onTouch, { passive: false })
}

/** The wheel scrolls the page, and magnifies with Ctrl: which is also what two fingers on a touchpad send. */
function onWheel(event: WheelEvent, canvas: HTMLCanvasElement, send: (look: Own) => void): void {
  if (!event.ctrlKey && !event.metaKey) return
  event.preventDefault()
  const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? LINE : 1
  send({ name: 'zoom', at: [Math.exp(-0.004 * lines * Math.max(-150, Math.min(150, event.deltaY))), ...placeIn(canvas, event)] })
}

/** The middle between two fingers on the canvas, and how far they are apart [px]. */
function twoFingers({ touches }: TouchEvent, canvas: HTMLCanvasElement): Point & { apart: number } {
  const [a, b] = [pointIn(canvas, touches[0]!), pointIn(canvas, touches[1]!)]
  return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, apart: Math.max(10, Math.hypot(a.x - b.x, a.y - b.y)) }
}
