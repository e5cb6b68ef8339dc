// What happens now: for eyes a line over the picture, always that of the step shown; for who does not see it, all that is shown in words,
// read out only when nothing moves.
import { h, write } from './dom'
import type { Frame } from './host'

const PAUSE = 120 // [ms] of rest before it is said: one sentence for a whole drag
const SAID = 1000 // [ms] after which it is taken away again, so that whoever reads on does not meet it twice

export class Sentence {
  readonly element = h('p', { class: 'sentence', part: 'sentence', 'aria-hidden': 'true' })
  /** The picture in words. */
  readonly described = h('p', { class: 'hidden described', id: 'described' })
  /** What is read out. */
  readonly spoken = h('p', { class: 'hidden spoken', 'aria-live': 'polite' })
  #said: string | undefined // last; the first is there to be read, and nobody asked for it
  #timer = 0

  /** Whether a sentence is still to be said. */
  waiting = false

  /** Shows what a frame has to say, and has its picture in words read out. While it plays, or is on its way somewhere, nothing is said. */
  show({ told, difference, sentence }: Frame, moving: boolean): void {
    const text = `${difference} ${sentence}`.trim()
    write(this.element, told)
    write(this.described, sentence)
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
