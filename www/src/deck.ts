// The deck: one slide at a time, turned by arrows, Page Up and Page Down (which remotes send), by buttons and by links to a slide. Without
// script the slides stand below each other.
import '../../widgets/elements/index'
import { h } from '../../widgets/elements/dom'
import type { FigureElement } from '../../widgets/elements/figure-element'
import { takePrintKey } from '../../widgets/elements/paper'
import './deck.css'
import './page'

takePrintKey()

/** The title is the first of them. */
const slides = [...document.querySelectorAll<HTMLElement>('body > header, .slide')]
const figures = slides.map(slide => slide.querySelector<FigureElement>('figure > :first-child'))
const german = document.documentElement.lang === 'de'
const [back, on] = (german ? ['Zurück', 'Weiter'] : ['Previous', 'Next']).map(name => h('button', { type: 'button' }, name)) as [HTMLButtonElement, HTMLButtonElement]
const place = h('span', {})
let now = 0

// Where nothing is to be set beside a picture, it takes the room of that as well. And all of it is in sight, however high its box is.
const whole = new CSSStyleSheet()
whole.replaceSync('.stage { clip-path: none !important; } @container (min-width: 832px) { :host(:is([controls="none"], [controls="playback"])) .panes { grid-template-columns: minmax(0, 1fr) 0; } }')
const isSmall = matchMedia('(max-width: 75.99em)').matches
for (const figure of figures) {
  figure?.shadowRoot?.adoptedStyleSheets.push(whole)
  // In the hand it is a figure like any other.
  if (isSmall) for (const name of ['size', 'fit']) figure?.removeAttribute(name)
}

/** @param by whether somebody turned the page: then what is read next is its title */
function show(slide: number, by = true): void {
  figures[now]?.pause?.()
  now = Math.min(slides.length - 1, Math.max(0, slide))
  slides.forEach((other, i) => (other.hidden = i !== now))
  place.textContent = `${now + 1} / ${slides.length}`
  back.disabled = now === 0
  on.disabled = now === slides.length - 1
  if (!by) return
  history.replaceState(null, '', slides[now]!.id ? `#${slides[now]!.id}` : location.pathname + location.search)
  const title = slides[now]!.querySelector<HTMLElement>('h1, h2')!
  title.tabIndex = -1
  title.focus()
  scrollTo(0, 0)
}

/** The slide of an address: its own, or that of the figure whose state it has. */
function asked(): number {
  const key = decodeURIComponent(location.hash.slice(1).split('?')[0]!)
  return slides.findIndex((slide, i) => key !== '' && (slide.id === key || figures[i]?.localName === key))
}

const turns: Record<string, () => number> = {
  ArrowLeft: () => now - 1,
  ArrowRight: () => now + 1,
  PageUp: () => now - 1,
  PageDown: () => now + 1,
  Home: () => 0,
  End: () => slides.length - 1,
}

addEventListener('keydown', event => {
  if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey || event.shiftKey) return
  const path = event.composedPath().filter(one => one instanceof Element)
  const figure = path.some(one => one === figures[now])
  if (figure && event.key === 'Escape') return slides[now]!.querySelector<HTMLElement>('h2')!.focus()
  // In a figure the arrows are its own, and in its fields so are the other keys.
  const own = path.some(one => one.matches('input, select, textarea')) || (figure && !event.key.startsWith('Page'))
  const turn = turns[event.key]
  if (own || !turn) return
  event.preventDefault()
  show(turn())
})
addEventListener('hashchange', () => {
  const slide = asked()
  if (slide >= 0 && slide !== now) show(slide)
})
back.addEventListener('click', () => show(now - 1))
on.addEventListener('click', () => show(now + 1))
document.body.append(h('nav', { class: 'turn', 'aria-label': german ? 'Folien' : 'Slides' }, back, place, on))
document.body.classList.add('turned')
// A page is as wide as a slide, whatever other sheets say of paper.
const paper = new CSSStyleSheet()
paper.replaceSync('@page { margin: 8mm 10mm 10mm; size: 297mm 167mm; }')
document.adoptedStyleSheets.push(paper)
// What is in sight is all of the page: its title is the first one.
for (const title of document.querySelectorAll('.slide > h2')) title.setAttribute('aria-level', '1')
show(Math.max(0, asked()), false)
