// A page of one figure, for frames: embed.html?figure=proposal&range-std=0.05&samples=16. It needs no storage and no origin of its own,
// so it runs in a frame with sandbox="allow-scripts".
import type { FigureElement } from '../../widgets/elements/figure-element'
import '../../widgets/elements/conditioning'
import '../../widgets/elements/joint'
import '../../widgets/elements/lap'
import '../../widgets/elements/proposal'
import '../../widgets/elements/smoothing'
import '../../widgets/elements/worked-example'
import { FIGURES } from '../../widgets/elements/generated/figures'
import { OPTIONS } from '../../widgets/elements/options'

/** Figures with much code of their own, which is loaded where one of them is asked for. */
const LATER: Record<string, () => Promise<unknown>> = {
  'fastslam-log': () => import('../../widgets/elements/log'),
  'fastslam-doors': () => import('../../widgets/elements/doors'),
  'fastslam-em': () => import('../../widgets/elements/em'),
  'fastslam-graph': () => import('../../widgets/elements/graph'),
  'fastslam-resampling': () => import('../../widgets/elements/resampling'),
  'fastslam-universes': () => import('../../widgets/elements/universes'),
}

/** Short names of parameters, as formulas have them: the first that a figure has. */
const SHORT: Record<string, string[]> = {
  m: ['universes', 'samples', 'particles'],
  n: ['landmarks'],
  t: ['poses'],
  'sigma-r': ['range-std', 'range'],
  'sigma-phi': ['bearing-std'],
}

const main = document.querySelector('#figure')!
// In a frame it is no landmark: the page around has its own.
if (parent === self) main.role = 'main'
const query = new URLSearchParams(location.search)

/** A page of its own for each figure has the figure in it; the common one makes what the address asks for. */
function figureAsked(): FigureElement | undefined {
  const there = main.querySelector<FigureElement>(Object.keys(FIGURES).join())
  if (there) return there
  const name = query.get('figure') ?? ''
  const tag = `fastslam-${name.replace(/^fastslam-/, '')}`
  if (FIGURES[tag]) return document.createElement(tag) as FigureElement
  const asked = name ? `There is no figure “${name.slice(0, 40)}”.` : 'The address of this page names no figure.'
  const list = document.createElement('p')
  list.setAttribute('role', 'alert')
  list.append(`${asked} There are `)
  Object.entries(FIGURES).forEach(([known, figure], i, all) => {
    const link = Object.assign(document.createElement('a'), { href: `?figure=${known.slice(9)}`, textContent: known.slice(9), title: figure!.title })
    list.append(i === 0 ? '' : i < all.length - 1 ? ', ' : ' and ', link)
  })
  list.append('.')
  main.replaceChildren(list)
  return undefined
}

/** Only what a figure knows becomes an attribute: an address is nobody's to trust. The rest the figure refuses in its own words. */
function configure(figure: FigureElement): void {
  const { parameters } = FIGURES[figure.localName]!
  for (const [key, value] of query) {
    if (key === 'figure') continue
    const dashed = key.replaceAll('_', '-')
    const name = parameters.includes(dashed) ? dashed : (SHORT[dashed]?.find(long => parameters.includes(long)) ?? dashed)
    if (parameters.includes(name) || name in OPTIONS) figure.setAttribute(name, value)
    else figure.setParameter(name, value)
  }
  figure.setAttribute('fit', '')
}

/** Tells pages that listen how high the frame should be; those that do not lose nothing, as the figure fits its frame. */
function tellHeight(figure: FigureElement): void {
  let told = 0
  const tell = (): void => {
    const height = figure.naturalHeight
    if (Math.abs(height - told) < 2) return
    told = height
    for (const message of [{ type: 'fastslam-height', figure: figure.localName, height }, { subject: 'lti.frameResize', height }]) {
      parent.postMessage(message, '*') // it tells nothing but a length
    }
  }
  figure.addEventListener('fastslam-step', tell)
  figure.addEventListener('fastslam-change', tell)
  figure.addEventListener('fastslam-step', () => figure.shadowRoot!.querySelector('.settings')?.addEventListener('toggle', tell), { once: true })
  addEventListener('resize', () => requestAnimationFrame(tell))
}

const figure = figureAsked()
if (figure) {
  await LATER[figure.localName]?.()
  customElements.upgrade(figure) // it may have been made before its class was there
  configure(figure)
  if (figure.isConnected) figure.followLink() // which stands over what the address gives, as it does where the figure comes later
  document.title = FIGURES[figure.localName]!.title
  if (parent !== window) tellHeight(figure)
  if (!figure.isConnected) main.replaceChildren(figure)
}
