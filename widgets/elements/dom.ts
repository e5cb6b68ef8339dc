// Elements are made by hand: no innerHTML and no inline style text, so that the strictest Content-Security-Policy is met.
type Child = Node | string

export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, string> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag)
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value)
  element.append(...children)
  return element
}

/** Icons on a 16 × 16 grid, filled with the colour of the text. */
const ICONS = {
  play: 'M4 2.2v11.6L13.6 8z',
  pause: 'M3.5 2.5h3v11h-3zM9.5 2.5h3v11h-3z',
  step: 'M3 2.5v11L11 8zM11.5 2.5h2v11h-2z',
  back: 'M13 2.5v11L5 8zM2.5 2.5h2v11h-2z',
  reset: 'M8 2.5a5.5 5.5 0 1 0 5.4 6.6h-2A3.5 3.5 0 1 1 8 4.5c.9 0 1.7.3 2.3.9L8.5 7.2H14V1.7l-2.3 2.3A5.5 5.5 0 0 0 8 2.5z',
  rewind: 'M2 2.5h2v11H2zM9 2.8v10.4L4.4 8zM14 2.8v10.4L9.4 8z',
  dice: 'M3.5 1.5h9a2 2 0 0 1 2 2v9a2 2 0 0 1-2 2h-9a2 2 0 0 1-2-2v-9a2 2 0 0 1 2-2zM5 3.7a1.3 1.3 0 1 0 0 2.6 1.3 1.3 0 0 0 0-2.6zM8 6.7a1.3 1.3 0 1 0 0 2.6 1.3 1.3 0 0 0 0-2.6zM11 9.7a1.3 1.3 0 1 0 0 2.6 1.3 1.3 0 0 0 0-2.6z',
  forward: 'M8 2.5 14 12H2z',
  backward: 'M8 13.5 2 4h12z',
  left: 'M2.5 8 12 2v12z',
  right: 'M13.5 8 4 2v12z',
  more: 'M3 6.5a1.5 1.5 0 1 0 0 3 1.5 1.5 0 0 0 0-3zM8 6.5a1.5 1.5 0 1 0 0 3 1.5 1.5 0 0 0 0-3zM13 6.5a1.5 1.5 0 1 0 0 3 1.5 1.5 0 0 0 0-3z',
}

export type IconName = keyof typeof ICONS

const SVG = 'http://www.w3.org/2000/svg'

export function icon(name: IconName): SVGElement {
  const svg = document.createElementNS(SVG, 'svg')
  svg.setAttribute('viewBox', '0 0 16 16')
  svg.setAttribute('aria-hidden', 'true')
  svg.append(document.createElementNS(SVG, 'path'))
  redraw(svg, name)
  return svg
}

export function redraw(svg: Element, name: IconName): void {
  svg.firstElementChild!.setAttribute('d', ICONS[name])
  svg.firstElementChild!.setAttribute('fill-rule', 'evenodd')
}

/** Writes text only where it changed, so that an unchanged readout costs no layout. */
export function write(element: HTMLElement, text: string): void {
  if (element.textContent !== text) element.textContent = text
}
