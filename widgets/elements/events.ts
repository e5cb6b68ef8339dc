// Events: always the last thing done: who listens may remove, reset, move or clone the figure.
import type { Cause, FigureDetail, FigureEvents, GuessDetail } from './details'
import type { Frame } from './host'

export type { Cause, ChallengeDetail, FigureDetail, GuessDetail, NoticeDetail, TraceDetail } from './details'

/** An event that pages are told of: there is no other way to make one, so that types and manifest name them all. */
export function figureEvent<Name extends keyof FigureEvents>(name: Name, detail: FigureEvents[Name]['detail']): CustomEvent {
  return new CustomEvent(name, { bubbles: true, composed: true, detail })
}

export class Events {
  cause: Cause = 'page' // of what is told next
  told: FigureDetail | undefined // of the last frame at rest
  #waiting: CustomEvent[] = []
  #step = -1 // told last
  #guess = '' // told last

  constructor(private readonly figure: HTMLElement) {}

  /** What a frame shows is told when the frame is over; each step once, unless `always`. */
  tell({ step, last, values, readouts, run, changed, trace, prediction }: Frame, always: boolean): void {
    const detail: FigureDetail = { step, last, by: this.cause, values, readouts, ...(run && { phase: run.phase }) }
    this.told = detail
    if (changed) this.#add('fastslam-change', detail)
    if (always || step !== this.#step) this.#add('fastslam-step', detail)
    this.#step = step
    const { shown, ...guess } = prediction ?? { shown: false }
    const told = shown ? JSON.stringify(guess) : ''
    if (told && told !== this.#guess) this.#add('fastslam-guess', guess as GuessDetail)
    this.#guess = told
    if (trace) this.#add('fastslam-trace', { step, lines: trace })
  }

  /** A challenge was taken up or, if it is done, reached. */
  challenge(name: string, done: boolean): void {
    this.#add('fastslam-challenge', { name, done })
  }

  send(): void {
    for (const event of this.#waiting.splice(0)) this.figure.dispatchEvent(event)
  }

  #add<Name extends keyof FigureEvents>(name: Name, detail: FigureEvents[Name]['detail']): void {
    this.#waiting.push(figureEvent(name, detail))
  }
}
