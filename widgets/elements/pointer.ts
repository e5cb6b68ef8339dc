// Where a pointer is in a picture. Events tell it in pixels of the window; a picture may be scaled in it, by a deck of slides for example.

export interface Point {
  x: number
  y: number
}

/** From the window to the element [css px of its own layout], however the page has scaled it. */
export function pointIn(element: HTMLElement, { clientX, clientY }: { clientX: number; clientY: number }): Point {
  const box = element.getBoundingClientRect()
  const across = element.offsetWidth / box.width || 1
  const down = element.offsetHeight / box.height || across // a layer may have no height of its own
  return { x: (clientX - box.x) * across, y: (clientY - box.y) * down }
}

/** The same as x and y in a row. */
export function placeIn(element: HTMLElement, event: { clientX: number; clientY: number }): [x: number, y: number] {
  const { x, y } = pointIn(element, event)
  return [x, y]
}
