// Folded away below a figure: in how many runs over many seeds something holds, for each of what is compared.
import { h, write } from './dom'
import type { Extra } from './extra'
import type { Figure } from './figure'
import { COUNTED } from './generated/counted'
import { Jobs } from './jobs'
import type { Counted, Shell } from './shell'
import type { Words } from './words'

const FIRST_SEED = 1

/**
 * A count over many seeds below a figure, which the page runs in the background.
 *
 * @csspart count - What runs over many seeds, and the button that starts it.
 * @csspart stop - Ends that.
 */
export class CountStudy implements Extra {
  private readonly counted: Counted
  private readonly words: Words
  private readonly start = h('button', { type: 'button', part: 'button count' })
  private readonly halt = h('button', { type: 'button', part: 'button stop' })
  private readonly runs = h('select', { name: 'runs' })
  private readonly progress = h('progress', { value: '0' })
  private readonly said = h('p', { class: 'said', 'aria-live': 'polite' })
  private readonly rows: ReturnType<typeof newRow>[]
  private query = '' // what is counted, or was
  private readonly jobs = new Jobs()
  private held: number[]
  private expected: number[] = [] // of each row, where there is such a column
  private seeds = 0
  private shell: Shell | undefined // computes the intervals

  constructor(private readonly figure: Figure) {
    const { element, view, words } = figure
    const counted = (this.counted = COUNTED[element.localName]!)
    this.words = words
    this.rows = counted.rows.map(newRow)
    this.held = counted.rows.map(() => 0)
    for (const runs of ['50', '200', '1000']) this.runs.add(new Option(runs, runs))
    this.runs.value = '200'
    this.runs.addEventListener('change', () => this.label())
    this.start.addEventListener('click', () => void this.count())
    this.halt.addEventListener('click', () => this.stop('stopped'))
    const summary = h('summary')
    const heading = h('p', { class: 'name', id: 'count' })
    const seeds = h('span', { class: 'name' })
    const work = h('div', { class: 'work' }, this.start, this.halt, h('label', { class: 'choice' }, seeds, this.runs), this.progress)
    const table = h('table', { 'aria-labelledby': 'count' }, h('tbody', {}, ...this.rows.map(({ row }) => row)))
    view.folds.append(h('details', { class: 'count', part: 'count' }, summary, heading, work, table, this.said))
    element.addEventListener('fastslam-change', () => this.check())
    words.always(() => {
      write(summary, words.say('count_many'))
      write(heading, words.say(counted.title))
      write(seeds, words.say('seeds'))
      write(this.halt, words.say('stop'))
      this.runs.ariaLabel = words.say('number_of_seeds')
      this.progress.ariaLabel = words.say('seeds_counted')
      this.rows.forEach(({ name }, k) => write(name, words.say(counted.rows[k]![0])))
      this.label()
    })
    this.show()
  }

  connected(signal: AbortSignal): void {
    signal.addEventListener('abort', () => this.stop())
  }

  /** Ends a count that is under way. What was counted stays. */
  private stop(said?: 'stopped'): void {
    if (!this.jobs.stop()) return
    this.show()
    if (said) this.say(this.words.say(said, { seeds: this.seeds, all: this.runs.value }))
  }

  /** After a change in the figure: a count of other settings begins again, and a finished one is taken away. */
  private check(): void {
    if (!this.query || this.query === this.settings()) return
    if (this.jobs.running) return void this.count()
    this.clear()
    write(this.said, this.words.say('count_again'))
  }

  private settings(): string {
    return this.counted.settings.split(' ').map(name => `${name}=${String(this.figure.life.get(name))}`).join('&')
  }

  private async count(): Promise<void> {
    this.clear()
    this.query = this.settings()
    write(this.said, '')
    const to = FIRST_SEED + Number(this.runs.value)
    try {
      const job = { name: this.counted.job, query: this.query, from: FIRST_SEED, to }
      const ran = this.jobs.run(this.figure.element.localName, job, (rows, shell) => this.add(rows, shell))
      this.show()
      if (!(await ran)) return
      this.show()
      this.say(this.words.say('counted', { seeds: this.seeds }))
    } catch (error) {
      this.show()
      write(this.said, this.words.say('did_not_count', { why: this.words.why(error) }))
    }
  }

  private clear(): void {
    this.query = ''
    this.held.fill(0)
    this.seeds = 0
    this.show()
  }

  private add(rows: number[][], shell: Shell): void {
    this.shell = shell
    this.seeds += rows.length
    this.counted.rows.forEach(([, column, expected], k) => {
      this.held[k]! += rows.filter(row => row[column] === 1).length
      if (expected !== undefined && rows[0]) this.expected[k] = rows[0][expected]!
    })
    this.show()
  }

  private label(): void {
    write(this.start, this.words.say('count', { seeds: this.runs.value }))
  }

  private show(): void {
    const on = this.jobs.running
    this.start.disabled = this.runs.disabled = on
    this.halt.disabled = !on
    this.progress.max = Number(this.runs.value)
    this.progress.value = this.seeds
    this.rows.forEach(({ fill, range, share, mark }, k) => {
      mark.hidden = this.seeds === 0 || this.expected[k] === undefined
      if (this.seeds === 0) {
        fill.style.width = range.style.width = '0'
        return write(share, '–')
      }
      const held = this.held[k]!
      const [low, high] = [...this.shell!.interval(held, this.seeds)] as [number, number]
      fill.style.width = percent(held / this.seeds)
      range.style.insetInlineStart = percent(low)
      range.style.width = percent(high - low)
      const round = (x: number) => (100 * x).toFixed(0)
      const counted = `${round(held / this.seeds)} % (${round(low)}–${round(high)})`
      const expected = this.expected[k]
      if (expected !== undefined) mark.style.insetInlineStart = percent(expected)
      write(share, expected === undefined ? counted : this.words.say('counted_expected', { counted, expected: round(expected) }))
    })
  }

  /** Said once, at the end, with every number: nobody wants to hear it grow. */
  private say(what: string): void {
    const shares = this.rows.map(({ share }, k) => `${this.words.say(this.counted.rows[k]![0])} ${share.textContent}`)
    write(this.said, this.seeds > 0 ? `${what} ${this.words.say('shares', { shares: shares.join(', ') })}` : what)
  }
}

function newRow() {
  const fill = h('div', { class: 'fill' })
  const range = h('div', { class: 'range' })
  const mark = h('div', { class: 'expected' })
  const share = h('td', { class: 'share' }, '–')
  const bar = h('td', { class: 'bar', 'aria-hidden': 'true' }, h('div', { class: 'track' }, fill, range, mark))
  const name = h('th', { scope: 'row' })
  return { fill, range, mark, share, name, row: h('tr', {}, name, bar, share) }
}

function percent(share: number): string {
  return `${100 * share}%`
}
