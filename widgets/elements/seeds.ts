// A figure with a seed, which a script can run at several.
import type { SeedRun, SeedsWish } from './details'
import { figureEvent } from './events'
import type { Figure } from './figure'
import type { Answer, Command, Frame, Listener } from './host'
import { LocalHost } from './local-host'
import { hasComma } from './options'
import { programOf } from './program'
import { ToldError } from './words'
import { yieldToMain } from './yield'

const SLICE = 8 // [ms] of simulation between two looks at what else the page has to do

/** Seeds are whole numbers of 32 bits. */
const SEEDS = 2 ** 32

/** @fires fastslam-seeds */
export class Seeds {
  static readonly offers = ['runSeeds'] as const

  constructor(private readonly figure: Figure) {}

  /** Runs the setting at several seeds, the one shown and the next four where none are named, to the step shown where none is; the figure stays as it is. */
  async runSeeds(wish: SeedsWish = {}): Promise<SeedRun[]> {
    const { element, life, words } = this.figure
    const { signal = new AbortController().signal } = wish
    const query = new URLSearchParams(wish.state ?? life.state)
    if (wish.step !== undefined) query.set('step', String(wish.step))
    const first = Number((wish.state !== undefined && query.get('seed')) || life.get('seed'))
    const aside = await Aside.of(element.localName, [
      { do: 'words', name: words.language, value: words.forProgram },
      { do: 'comma', on: hasComma(element.getAttribute('decimal'), words) },
    ])
    const runs: SeedRun[] = []
    let readout = ''
    try {
      for (const seed of wish.seeds ?? [0, 1, 2, 3, 4].map(k => (first + k) % SEEDS)) {
        signal.throwIfAborted()
        query.set('seed', String(seed))
        const { step, query: state, readouts, main } = await aside.reach(query.toString(), signal)
        runs.push({ seed, step, state, readouts })
        readout = main
      }
    } finally {
      aside.free()
    }
    const values = runs.map(run => run.readouts.find(({ name }) => name === readout)?.value)
    const known = values.filter(value => value != null).sort((a, b) => a - b)
    const median = known.length === values.length ? ((known[(known.length - 1) >> 1]! + known[known.length >> 1]!) / 2) : null
    element.dispatchEvent(figureEvent('fastslam-seeds', { readout, median, runs }))
    return runs
  }
}

/** Another figure of the same program, which nobody sees: it is brought to a state in slices, between which the page does what else it has to do. */
class Aside implements Listener {
  #host: LocalHost | undefined
  #failed: ToldError | undefined

  /** Of a figure's kind, told first how that is to be shown: words, comma, panels. */
  static async of(tag: string, commands: Command[]): Promise<Aside> {
    const aside = new Aside()
    aside.#host = await LocalHost.create(programOf(tag), tag, aside)
    for (const command of commands) aside.#host.send(command)
    return aside
  }

  hear(answer: Answer): void {
    if (answer.told !== 'failed') return
    this.#failed = new ToldError(answer.why)
    this.free() // the instance is dead, and this one is not wanted in the next
  }

  wake(): void {}

  /** Goes to a state, and says what there is of it; rejects when the signal says so, or where it traps. */
  async reach(state: string, signal: AbortSignal): Promise<Frame> {
    this.#host?.send({ do: 'begin', value: state, name: '', on: false })
    while (this.#host?.busy) {
      this.#host.work(SLICE)
      await yieldToMain()
      signal.throwIfAborted()
    }
    const frame = this.#host?.frame()
    if (!frame) throw this.#failed ?? new ToldError({ key: 'no_background' })
    return frame
  }

  free(): void {
    this.#host?.free()
    this.#host = undefined
  }
}
