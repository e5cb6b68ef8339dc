// The first screen: the figure beside the title, folded to its picture. It plays its story by itself, twice, and rests where that is told;
// a click unfolds it in its place, with all that it has.
import type { FigureDetail } from '../../widgets/elements/details'
import type { FigureElement } from '../../widgets/elements/figure-element'
import { reducedMotion } from '../../widgets/elements/theme'

const TIMES = 2

const hero = document.querySelector<HTMLElement>('.hero')
if (hero) tell(hero, hero.querySelector<FigureElement & HTMLElement>('fastslam-lap')!)

function tell(hero: HTMLElement, figure: FigureElement): void {
  const [from, to, rest] = hero.dataset['plays']!.split(' ').map(Number) as [number, number, number]
  const unfolds = Object.assign(document.createElement('button'), { type: 'button', className: 'unfold', textContent: 'Open this figure' })
  const folded = new AbortController()
  const story = new AbortController() // until it was told, or a reader takes over

  const open = () => {
    story.abort()
    folded.abort()
    // What leaves out the rest of it (scripts/chapter/figure.mjs).
    for (const name of hero.dataset['folds']!.split(' ')) figure.removeAttribute(name)
    hero.classList.replace('hero', 'wide')
    unfolds.remove()
  }
  // A link to it is about all of it, and so is what a box of the text runs with it.
  const meant = () => location.hash.startsWith(`#${figure.localName}`) || location.hash === `#${hero.id}`
  if (meant()) return open()
  hero.querySelector('figcaption')!.before(unfolds)
  const { signal } = folded
  addEventListener('hashchange', () => meant() && open(), { signal })
  for (const type of ['fastslam-challenge', 'fastslam-trace']) figure.addEventListener(type, open, { signal })
  // By hand, all of it comes into view.
  const unfold = () => {
    open()
    hero.scrollIntoView({ block: 'nearest' })
  }
  figure.addEventListener('click', event => event.composedPath().some(one => one instanceof HTMLCanvasElement) && unfold(), { capture: true, signal })
  unfolds.addEventListener('click', () => {
    unfold()
    figure.shadowRoot!.querySelector<HTMLElement>('.stage')!.focus({ preventScroll: true }) // the button is gone
  })
  if (reducedMotion.matches) return

  let begun = 0
  const begin = () => {
    begun += 1
    figure.seek(from)
    figure.play()
  }
  const stop = ({ key }: KeyboardEvent) => {
    if (key !== 'Escape' || !figure.playing) return
    story.abort()
    figure.pause()
  }
  const onStep = (event: Event) => {
    const { step, by } = (event as CustomEvent<FigureDetail>).detail
    if (begun === 0) return begin() // it lives
    if (by === 'reader') return story.abort()
    if (step < to || !figure.playing) return
    if (begun < TIMES) return begin()
    story.abort()
    figure.seek(rest)
  }
  addEventListener('keydown', stop, { signal: story.signal })
  figure.addEventListener('fastslam-step', onStep, { signal: story.signal })
}
