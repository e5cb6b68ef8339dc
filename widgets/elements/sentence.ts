// The sentence under the picture: for eyes always that of the step shown; read out only when nothing moves.
import { h, write } from './dom'

const PAUSE = 120 // [ms] of rest before it is said: one sentence for a whole drag
const SAID = 1000 // [ms] after which it is taken away again, so that whoever reads on does not meet it twice

export class Sentence {
  readonly element = h('p', { class: 'sentence', part: 'sentence', id: 'sentence' })
  /** What is read out. */
  readonly spoken = h('p', { class: 'hidden spoken', 'aria-live': 'polite' })
  #said: string | undefined // last; the first is there to be read, and nobody asked for it
  #timer = 0

  /** Whether a sentence is still to be said. */
  waiting = false

  /** Shows what a frame has to say, and has it read out with the rest of it. While it plays, or is on its way somewhere, nothing is said. */
  show(shown: string, text: string, moving: boolean): void {
    write(this.element, shown)
    clearTimeout(this.#timer)
    this.waiting = !moving && this.#said !== undefined && text !== this.#said
    if (this.waiting) this.#timer = window.setTimeout(() => this.#say(text), PAUSE)
    this.#said ??= text
  }

  #say(text: string): void {
    this.waiting = false
    this.#said = text
    write(this.spoken, text)
    this.#timer = window.setTimeout(() => write(this.spoken, ''), SAID)
  }
}
