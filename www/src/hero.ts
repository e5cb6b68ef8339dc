// The first screen: the figure beside the title, folded to its picture. It plays its story by itself, twice, and rests where that is told;
// a click unfolds it in its place, with all that it has.
import type { FigureDetail } from '../../widgets/elements/details'
import type { FigureElement } from '../../widgets/elements/figure-element'
import { reducedMotion } from '../../widgets/elements/theme'

const TIMES = 2

/** What it has not while it is folded: the rest of the picture, and all controls but the one that pauses it. */
const FOLDED = { show: 'map', controls: 'play', chips: 'off', fit: 'on' }

const hero = document.querySelector<HTMLElement>('.hero')
if (hero) tell(hero, hero.querySelector<FigureElement & HTMLElement>('fastslam-lap')!)

function tell(hero: HTMLElement, figure: FigureElement): void {
  const [from, to, rest] = hero.dataset['plays']!.split(' ').map(Number) as [number, number, number]
  const unfolds = Object.assign(document.createElement('button'), { type: 'button', className: 'unfold', textContent: 'Open this figure' })
  const ended = new AbortController() // of the story: a reader has taken over, or it was told
  let told = 0

  const open = () => {
    ended.abort()
    for (const name of Object.keys(FOLDED)) figure.removeAttribute(name)
    hero.classList.replace('hero', 'wide')
    unfolds.remove()
  }
  const { signal } = ended
  // A link to it, or a challenge from its caption, is about all of it.
  const meant = () => location.hash.startsWith(`#${figure.localName}`) || location.hash === `#${hero.id}`
  if (meant()) return open()
  for (const [name, value] of Object.entries(FOLDED)) figure.setAttribute(name, value)
  hero.classList.add('folded')
  hero.querySelector('figcaption')!.before(unfolds)
  addEventListener('hashchange', () => meant() && open(), { signal })
  unfolds.addEventListener('click', () => {
    open()
    figure.focus()
  })
  figure.addEventListener('fastslam-challenge', open, { signal })
  figure.addEventListener('click', event => event.composedPath().some(one => one instanceof HTMLCanvasElement) && open(), { capture: true, signal })
  if (reducedMotion.matches) return

  const begin = () => {
    figure.seek(from)
    figure.play()
  }
  addEventListener('keydown', ({ key }) => {
    if (key !== 'Escape' || !figure.playing) return
    figure.pause()
    ended.abort()
  }, { signal })
  figure.addEventListener('fastslam-step', event => {
    const { detail } = event as CustomEvent<FigureDetail>
    if (detail.by === 'reader') return ended.abort()
    if (detail.step < to || !figure.playing) return
    told += 1
    if (told < TIMES) return begin()
    ended.abort()
    figure.seek(rest)
  }, { signal })
  void figure.settled().then(() => signal.aborted || begin())
}
