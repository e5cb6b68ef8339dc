// Folded away below the figure of universes: the laps behind one of its points, run on this machine and compared digit by digit.
import { h, write } from './dom'
import type { Extra } from './extra'
import type { Figure } from './figure'
import { Jobs } from './jobs'
import { lapsOf } from './laps'
import type { Key } from './words'

/** What was run, as the figure has it (TRIED in lab/src/experiment/universes.rs). */
const TRIED = [1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 40]
const PROPOSALS: [string, Key][] = [
  ['motion', 'laps_motion'],
  ['aware', 'laps_aware'],
]
const SEEDS = 200

/**
 * @csspart count - What runs over many seeds, and the button that starts it.
 * @csspart stop - Ends that.
 * @csspart again - Runs the laps of a point again.
 */
export class UniversesAgain implements Extra {
  private readonly start = h('button', { type: 'button', part: 'button again' })
  private readonly halt = h('button', { type: 'button', part: 'button stop', disabled: '' })
  private readonly proposal = h('select', { name: 'again-proposal' })
  private readonly universes = h('select', { name: 'again-universes' })
  private readonly progress = h('progress', { value: '0', max: String(SEEDS) })
  private readonly said = h('p', { class: 'said', 'aria-live': 'polite' })
  private readonly jobs = new Jobs()

  constructor(private readonly figure: Figure) {
    const { view, words } = figure
    for (const universes of TRIED) this.universes.add(new Option(`M = ${universes}`, String(universes)))
    this.start.addEventListener('click', () => void this.run())
    this.halt.addEventListener('click', () => this.stop())
    const [summary, heading] = [h('summary'), h('p', { class: 'name' })]
    const work = h('div', { class: 'work' }, this.start, this.halt, this.proposal, this.universes, this.progress)
    view.folds.append(h('details', { class: 'count', part: 'count' }, summary, heading, work, this.said))
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

  connected(signal: AbortSignal): void {
    signal.addEventListener('abort', () => this.stop())
  }

  private stop(): void {
    this.jobs.stop()
    this.show()
  }

  private async run(): Promise<void> {
    const [proposal, universes, threshold] = [this.proposal.value, this.universes.value, Number(this.figure.life.get('threshold'))]
    const found: number[] = []
    this.progress.value = 0
    write(this.said, '')
    try {
      const { tag, job, query } = lapsOf(universes, proposal, 'subcell')
      const add = (rows: number[][]) => {
        for (const [, error] of rows) found.push(error!)
        this.progress.value = found.length
      }
      const ran = Promise.all([this.jobs.run(tag, { name: job, query, from: 1, to: SEEDS + 1 }, add), import('../../www/data/lap-table.json')])
      this.show()
      const [whole, { default: kept }] = await ran
      if (!whole) return
      this.show()
      const cell = `${proposal}.subcell.m${universes}`
      const shipped = kept as Record<string, number[] | undefined>
      const printed = shipped[`lap.${cell}`] ?? shipped[`lap.tried.${cell}`] ?? []
      const good = found.filter(error => error < threshold).length
      const same = found.length === printed.length && found.every((error, k) => error === printed[k])
      write(this.said, this.figure.words.say(same ? 'laps_same' : 'laps_differ', { seeds: SEEDS, good, threshold }))
    } catch (error) {
      this.stop()
      write(this.said, this.figure.words.say('did_not_count', { why: this.figure.words.why(error) }))
    }
  }

  private show(): void {
    const on = this.jobs.running
    this.start.disabled = this.proposal.disabled = this.universes.disabled = on
    this.halt.disabled = !on
  }
}
