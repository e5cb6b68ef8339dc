// Folded away below the figure of universes: the laps behind one of its points, run on this machine and compared digit by digit.
import { h, write } from './dom'
import { Jobs } from './jobs'
import type { Key, Words } from './words'

/** What was run, as the figure has it (TRIED in lab/src/experiment/universes.rs). */
const TRIED = [1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 40]
const PROPOSALS: [string, Key][] = [
  ['motion', 'laps_motion'],
  ['aware', 'laps_aware'],
]
const LAP_TAG = 'fastslam-lap' // whose program runs the laps
const SEEDS = 200

export class UniversesAgain {
  readonly element: HTMLElement
  private readonly start = h('button', { type: 'button', part: 'button again' })
  private readonly halt = h('button', { type: 'button', part: 'button stop', disabled: '' })
  private readonly proposal = h('select', { name: 'again-proposal' })
  private readonly universes = h('select', { name: 'again-universes' })
  private readonly progress = h('progress', { value: '0', max: String(SEEDS) })
  private readonly said = h('p', { class: 'said', 'aria-live': 'polite' })
  private readonly jobs = new Jobs()

  constructor(
    private readonly setting: (name: string) => unknown,
    private readonly words: Words,
  ) {
    for (const universes of TRIED) this.universes.add(new Option(`M = ${universes}`, String(universes)))
    this.start.addEventListener('click', () => void this.run())
    this.halt.addEventListener('click', () => this.stop())
    const [summary, heading] = [h('summary'), h('p', { class: 'name' })]
    const work = h('div', { class: 'work' }, this.start, this.halt, this.proposal, this.universes, this.progress)
    this.element = h('details', { class: 'count', part: 'count' }, summary, heading, work, this.said)
    words.always(() => {
      write(summary, words.say('laps_again'))
      write(heading, words.say('laps_help'))
      write(this.start, words.say('laps_run'))
      write(this.halt, words.say('stop'))
      this.progress.ariaLabel = words.say('seeds_counted')
      this.proposal.ariaLabel = words.say('laps_proposal')
      this.universes.ariaLabel = words.say('laps_universes')
      const chosen = this.proposal.value
      this.proposal.replaceChildren(...PROPOSALS.map(([value, key]) => new Option(words.say(key), value)))
      if (chosen) this.proposal.value = chosen
    })
    this.universes.value = '4'
  }

  /** Ends what is being run. */
  stop(): void {
    this.jobs.stop()
    this.show()
  }

  private async run(): Promise<void> {
    const [proposal, universes, threshold] = [this.proposal.value, this.universes.value, Number(this.setting('threshold'))]
    const found: number[] = []
    this.progress.value = 0
    write(this.said, '')
    try {
      const query = `course=apartment&odometry=1&range-std=0.02&universes=${universes}&proposal=${proposal}&matcher=subcell`
      const add = (rows: number[][]) => {
        for (const [, error] of rows) found.push(error!)
        this.progress.value = found.length
      }
      const ran = Promise.all([this.jobs.run(LAP_TAG, { name: 'laps', query, from: 1, to: SEEDS + 1 }, add), import('../../www/data/lap-table.json')])
      this.show()
      const [whole, { default: kept }] = await ran
      if (!whole) return
      this.show()
      const cell = `${proposal}.subcell.m${universes}`
      const shipped = kept as Record<string, number[] | undefined>
      const printed = shipped[`lap.${cell}`] ?? shipped[`lap.tried.${cell}`] ?? []
      const good = found.filter(error => error < threshold).length
      const same = found.length === printed.length && found.every((error, k) => error === printed[k])
      write(this.said, this.words.say(same ? 'laps_same' : 'laps_differ', { seeds: SEEDS, good, threshold }))
    } catch (error) {
      this.stop()
      write(this.said, this.words.say('did_not_count', { why: this.words.why(error) }))
    }
  }

  private show(): void {
    const on = this.jobs.running
    this.start.disabled = this.proposal.disabled = this.universes.disabled = on
    this.halt.disabled = !on
  }
}
