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
  /** Whether nobody has touched the figure, and no author has chosen what is shown. */
  untouched = true
  #mayStart = true // by itself, when it is looked at
  #left = false // it stopped as it went out of sight
  #shown = -Infinity // since when the step before the next one has been due [ms]

  /** Somebody has touched the figure, or an author has chosen what is shown: it does not play by itself any more. */
  stay(): void {
    this.untouched = this.#mayStart = this.#left = false
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

  /** The picture is looked at, or goes out of sight: there it waits. */
  onSeen(on: boolean): void {
    if (!on) {
      if (this.playing) this.#left = true
      this.playing = false
    } else if (this.#left || (this.#mayStart && !reducedMotion.matches)) {
      this.#mayStart = this.#left = false
      this.playing = true
    }
  }

  /** Whether the next step is due. Where the machine is too slow for the rate, playing takes longer; no step is ever skipped. */
  isDue(now: number): boolean {
    const interval = 1000 / (this.rate === NORMAL_RATE ? NORMAL_RATE * this.pace : this.rate)
    if (now < this.#shown + interval) return false
    this.#shown = Math.max(this.#shown + interval, now - interval / 2)
    return true
  }
}
