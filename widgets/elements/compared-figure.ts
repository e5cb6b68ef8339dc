// A figure that a script can run at several seeds.
import { Aside, atSeed } from './aside'
import type { SeedRun, SeedsDetail } from './details'
import { FigureElement } from './figure-element'
import { hasComma } from './options'

/** Seeds are whole numbers of 32 bits. */
const SEEDS = 2 ** 32

export interface SeedsWish {
  /** Where they are not given, the one shown and the next four. */
  seeds?: number[]
  /** Where it is not given, the step shown. */
  step?: number
  /** The setting, as a link has it; where it is not given, that of now. */
  state?: string
  /** Ends it. */
  signal?: AbortSignal
}

export class ComparedFigure extends FigureElement {
  /** What comes out at several seeds, the figure staying as it is. They run one after the other, in slices that the page does not notice. */
  async runSeeds({ signal = new AbortController().signal, ...wish }: SeedsWish = {}): Promise<SeedRun[]> {
    const query = new URLSearchParams(wish.state ?? this.state)
    if (wish.step !== undefined) query.set('step', String(wish.step))
    const first = Number((wish.state !== undefined && query.get('seed')) || this.getParameter('seed'))
    const { words } = this
    const aside = await Aside.of(this.localName, [
      { do: 'words', language: words.language, messages: words.forProgram },
      { do: 'comma', on: hasComma(this.getAttribute('decimal'), words) },
    ])
    const runs: SeedRun[] = []
    let readout = ''
    try {
      for (const seed of wish.seeds ?? [0, 1, 2, 3, 4].map(k => (first + k) % SEEDS)) {
        signal.throwIfAborted()
        const { step, query: state, readouts, main } = await aside.reach(atSeed(query.toString(), seed), signal)
        runs.push({ seed, step, state, readouts })
        readout = main
      }
    } finally {
      aside.free()
    }
    const values = runs.map(run => run.readouts.find(({ name }) => name === readout)?.value)
    const known = values.filter(value => value != null).sort((a, b) => a - b)
    const median = known.length === values.length ? ((known[(known.length - 1) >> 1]! + known[known.length >> 1]!) / 2) : null
    this.dispatchEvent(new CustomEvent<SeedsDetail>('fastslam-seeds', { bubbles: true, composed: true, detail: { readout, median, runs } }))
    return runs
  }
}
