// How a map is moved and magnified: a mouse drags it, two fingers move and magnify it, one finger and the wheel scroll the page.
import type { Command } from './host'

const LINE = 16 // [px] of a wheel that tells lines

export function takeGestures(canvas: HTMLCanvasElement, send: (command: Command) => void): void {
  let held: { x: number; y: number } | undefined
  canvas.addEventListener('pointerdown', event => {
    if (event.pointerType === 'touch' || event.button !== 0) return
    canvas.setPointerCapture(event.pointerId)
    held = { x: event.clientX, y: event.clientY }
  })
  canvas.addEventListener('pointermove', ({ clientX: x, clientY: y }) => {
    if (!held) return
    send({ do: 'pan', right: x - held.x, down: y - held.y })
    held = { x, y }
  })
  canvas.addEventListener('lostpointercapture', () => (held = undefined))
  canvas.addEventListener('dblclick', ({ offsetX: x, offsetY: y }) => send({ do: 'zoom', factor: 2, x, y }))
  canvas.addEventListener('wheel', event => onWheel(event, send), { passive: false })

  let fingers: { x: number; y: number; apart: number } | undefined
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
function onWheel(event: WheelEvent, send: (command: Command) => void): void {
  if (!event.ctrlKey && !event.metaKey) return
  event.preventDefault()
  const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? LINE : 1
  send({ do: 'zoom', factor: Math.exp(-0.004 * lines * Math.max(-150, Math.min(150, event.deltaY))), x: event.offsetX, y: event.offsetY })
}

/** The middle between two fingers on the canvas, and how far they are apart [px]. */
function twoFingers({ touches: [a, b] }: TouchEvent, canvas: HTMLCanvasElement): { x: number; y: number; apart: number } {
  const box = canvas.getBoundingClientRect()
  const [x, y] = [(a!.clientX + b!.clientX) / 2 - box.x, (a!.clientY + b!.clientY) / 2 - box.y]
  return { x, y, apart: Math.max(10, Math.hypot(a!.clientX - b!.clientX, a!.clientY - b!.clientY)) }
}
