// Two buttons in the head of a figure: one takes back what threw something away, the other plays an end that was not watched.
import { h, write } from './dom'
import type { Frame } from './host'
import type { Key, Words } from './words'

export type Undoable = Extract<Key, 'undo_rewind' | 'undo_reset' | 'undo_challenge'>

/** Offers back what a reader has made, until something else is done. */
export class Undo {
  readonly element = h('button', { type: 'button', class: 'undo', part: 'button undo', hidden: '' })
  #before = '' // the state that it brings back

  constructor(
    private readonly words: Words,
    takeBack: (state: string) => void,
  ) {
    this.element.addEventListener('click', () => takeBack(this.#before))
  }

  offer(name: Undoable, before: string): void {
    this.#before = before
    write(this.element, this.words.say(name))
    this.element.hidden = false
  }

  withdraw(): void {
    this.element.hidden = true
  }
}

/** Offers an end to be watched that was not. */
export class Watch {
  readonly element = h('button', { type: 'button', class: 'undo watch', part: 'button watch', hidden: '' })
  #offered = 0 // the step before what is offered
  #since = Infinity // the step from which on all was played and looked at
  #watched = false // to the end

  constructor(watch: (from: number) => void) {
    this.element.addEventListener('click', () => watch(this.#offered))
  }

  /** A step was asked for. */
  jumped(): void {
    this.#since = Infinity
  }

  /** A step is played on from there. */
  played(from: number, lookedAt: boolean): void {
    this.#since = lookedAt ? Math.min(this.#since, from) : Infinity
  }

  show({ step, last, watch, busy }: Frame): void {
    const atEnd = watch !== undefined && last > 0 && step === last && !busy
    if (atEnd && this.#since <= watch.from) this.#watched = true
    this.element.hidden = !atEnd || this.#watched
    if (this.element.hidden || !watch) return
    this.#offered = watch.from
    write(this.element, `▶ ${watch.words}`)
  }
}
