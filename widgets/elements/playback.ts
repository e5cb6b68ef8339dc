// Playing: when the next step is due.
import { reducedMotion } from './theme'

/** What is played at, unless a reader chooses another rate [steps/s]. */
export const NORMAL_RATE = 6

export class Playback {
  playing = false
  /** [steps/s] */
  rate = NORMAL_RATE
  /** Of the step shown: how fast the figure wants it played, of the usual speed. A rate that a reader has chosen holds for every step. */
  pace = 1
  #mayStart = true // by itself, when it is seen
  #shown = -Infinity // since when the step before the next one has been due [ms]

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
    this.#shown = -Infinity
  }

  /** The figure has come into view. */
  onSeen(): void {
    if (!this.#mayStart || reducedMotion.matches) return
    this.stay()
    this.playing = true
  }

  /** Whether the next step is due. Where the machine is too slow for the rate, playing takes longer; no step is ever skipped. */
  isDue(now: number): boolean {
    const interval = 1000 / (this.rate === NORMAL_RATE ? NORMAL_RATE * this.pace : this.rate)
    if (now < this.#shown + interval) return false
    this.#shown = Math.max(this.#shown + interval, now - interval / 2)
    return true
  }
}
