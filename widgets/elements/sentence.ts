// The sentence under the picture: always up to date for eyes; read out only when nothing moves.
import { h, write } from './dom'

const APART = 1000 // [ms] between two sentences while it plays: what an eye can read
const PAUSE = 120 // [ms] of rest before it is said: one sentence for a whole drag

export class Sentence {
  readonly element = h('p', { class: 'sentence', part: 'sentence', id: 'sentence', 'aria-live': 'off' })
  #saidAt = -Infinity // [ms]
  #timer = 0

  /** Whether a sentence is still to be said. */
  waiting = false

  say(text: string, playing: boolean): void {
    this.element.setAttribute('aria-live', playing ? 'off' : 'polite')
    clearTimeout(this.#timer)
    this.waiting = false
    if (playing && performance.now() < this.#saidAt + APART) return
    this.#saidAt = performance.now()
    // The first at once, as it makes the figure higher.
    if (playing || !this.element.hasChildNodes()) write(this.element, text)
    else this.#sayLater(text)
  }

  #sayLater(text: string): void {
    this.waiting = true
    this.#timer = window.setTimeout(() => {
      this.waiting = false
      write(this.element, text)
    }, PAUSE)
  }
}
