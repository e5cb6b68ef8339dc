// Playing: when the next step is due.
import { reducedMotion } from './theme'

const NORMAL_RATE = 6 // [steps/s]

export class Playback {
  playing = false
  /** [steps/s] */
  rate = NORMAL_RATE
  #mayStart = true // by itself, when it is seen
  #due = 0 // [ms]

  /** Somebody has touched the figure, or an author has chosen what is shown: it does not play by itself any more. */
  stay(): void {
    this.#mayStart = false
  }

  /** Stops, and does not play by itself any more. */
  stop(): void {
    this.stay()
    this.playing = false
  }

  start(): void {
    this.stay()
    this.playing = true
    this.#due = 0
  }

  /** The figure has come into view. */
  onSeen(): void {
    if (!this.#mayStart || reducedMotion.matches) return
    this.stay()
    this.playing = true
  }

  /** Whether the next step is due. Where the machine is too slow for the rate, playing takes longer; no step is ever skipped. */
  isDue(now: number): boolean {
    const interval = 1000 / this.rate
    if (now < this.#due) return false
    this.#due = Math.max(this.#due + interval, now + interval / 2)
    return true
  }
}
