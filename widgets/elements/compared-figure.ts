// A figure that a script can run at several seeds.
import { Aside, atSeed } from './aside'
import type { SeedRun, SeedsWish } from './details'
import { figureEvent } from './events'
import { FigureElement } from './figure-element'
import { hasComma } from './options'

/** Seeds are whole numbers of 32 bits. */
const SEEDS = 2 ** 32

/** @fires fastslam-seeds */
export class ComparedFigure extends FigureElement {
  /** Runs the setting at several seeds, the one shown and the next four where none are named, to the step shown where none is; the figure stays as it is. */
  async runSeeds(wish: SeedsWish = {}): Promise<SeedRun[]> {
    const { signal = new AbortController().signal } = wish
    const query = new URLSearchParams(wish.state ?? this.state)
    if (wish.step !== undefined) query.set('step', String(wish.step))
    const first = Number((wish.state !== undefined && query.get('seed')) || this.getParameter('seed'))
    const { words } = this
    const aside = await Aside.of(this.localName, [
      { do: 'words', name: words.language, value: words.forProgram },
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
    this.dispatchEvent(figureEvent('fastslam-seeds', { readout, median, runs }))
    return runs
  }
}
