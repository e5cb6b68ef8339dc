// A page of one figure, for frames: embed.html?figure=proposal&range-std=0.05&samples=16. It needs no storage and no origin of its own,
// so it runs in a frame with sandbox="allow-scripts".
import type { FigureElement } from '../../widgets/elements/figure-element'
import { load } from '../../widgets/elements/define'
import { FIGURES } from '../../widgets/elements/generated/figures'
import { noFigure } from '../../widgets/elements/parameters'
import { takePrintKey } from '../../widgets/elements/paper'
import { asked, askedTag, configure, query } from './asked'

takePrintKey()

const main = document.querySelector<HTMLElement>('#figure')!
// In a frame it is no landmark: the page around has its own.
if (parent === self) main.role = 'main'

/** A page of its own for each figure has the figure in it; the common one makes what the address asks for. */
function figureAsked(): FigureElement | undefined {
  const there = main.querySelector<FigureElement>(Object.keys(FIGURES).join())
  if (there) return there
  if (askedTag) return document.createElement(askedTag) as FigureElement
  const wrong = asked ? noFigure(asked) : 'The address of this page names no figure.'
  const list = document.createElement('p')
  list.setAttribute('role', 'alert')
  list.append(`${wrong} There are `)
  Object.entries(FIGURES).forEach(([known, figure], i, all) => {
    const link = Object.assign(document.createElement('a'), { href: `?figure=${known.slice(9)}`, textContent: known.slice(9), title: figure!.title })
    list.append(i === 0 ? '' : i < all.length - 1 ? ', ' : ' and ', link)
  })
  list.append('.')
  main.replaceChildren(list)
  return undefined
}

/** Tells pages that listen how high the frame should be; those that do not lose nothing, as the figure fits its frame. */
function tellHeight(figure: FigureElement): void {
  let told = 0
  const tell = (): void => {
    const height = figure.naturalHeight + main.offsetTop // and what a page has above it
    if (Math.abs(height - told) < 2) return
    told = height
    for (const message of [{ type: 'fastslam-height', figure: figure.localName, height }, { subject: 'lti.frameResize', height }]) {
      parent.postMessage(message, '*') // it tells nothing but a length
    }
  }
  figure.addEventListener('fastslam-step', tell)
  figure.addEventListener('fastslam-change', tell)
  // What is opened and closed in it: its Lab, and what is folded there.
  figure.shadowRoot!.addEventListener('click', () => requestAnimationFrame(tell))
  addEventListener('resize', () => requestAnimationFrame(tell))
}

const figure = figureAsked()
if (figure) {
  await load(figure.localName)
  customElements.upgrade(figure) // it may have been made before its class was there
  configure(figure)
  figure.setAttribute('fit', '')
  if (figure.isConnected) figure.followLink() // which stands over what the address gives, as it does where the figure comes later
  document.title = FIGURES[figure.localName]!.title
  if (parent !== window) {
    tellHeight(figure)
    if (query.has('tell')) void import('./tell').then(({ tellHosts }) => tellHosts(figure, query.getAll('tell')))
  }
  if (!figure.isConnected) main.replaceChildren(figure)
}
