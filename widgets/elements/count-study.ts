// Folded away below a figure: in how many runs over many seeds something holds, for each of what is compared.
import { h, write } from './dom'
import { Jobs } from './jobs'
import type { Shell } from './shell'
import type { Key, Words } from './words'

/** What is counted (`Counted` in widgets/src/job.rs). */
export interface Counted {
  /** Name of the job of the figure's program, which counts. */
  job: string
  title: Key
  /** Names of the parameters that the count depends on, apart by spaces; it has seeds of its own. */
  settings: string
  /** What is compared, with the column of the job's rows that is 1 where it holds, and perhaps one that says how often it should. */
  rows: [name: Key, column: number, expected?: number][]
}

const FIRST_SEED = 1

export class CountStudy {
  readonly element: HTMLElement
  private readonly start = h('button', { type: 'button', part: 'button count' })
  private readonly halt = h('button', { type: 'button', part: 'button stop' })
  private readonly runs = h('select', { name: 'runs' })
  private readonly progress = h('progress', { value: '0' })
  private readonly said = h('p', { class: 'said', 'aria-live': 'polite' })
  private readonly rows: Row[]
  private query = '' // what is counted, or was
  private readonly jobs = new Jobs()
  private held: number[]
  private expected: number[] = [] // of each row, where there is such a column
  private seeds = 0
  private shell: Shell | undefined // computes the intervals

  constructor(
    private readonly tag: string,
    private readonly counted: Counted,
    private readonly setting: (name: string) => unknown,
    private readonly words: Words,
  ) {
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
    this.element = h('details', { class: 'count', part: 'count' }, summary, heading, work, table, this.said)
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

  /** Ends a count that is under way. What was counted stays. */
  stop(said?: 'stopped'): void {
    if (!this.jobs.stop()) return
    this.show()
    if (said) this.say(this.words.say(said, { seeds: this.seeds, all: this.runs.value }))
  }

  /** After a change in the figure: a count of other settings begins again, and a finished one is taken away. */
  check(): void {
    if (!this.query || this.query === this.settings()) return
    if (this.jobs.running) return void this.count()
    this.clear()
    write(this.said, this.words.say('count_again'))
  }

  private settings(): string {
    return this.counted.settings.split(' ').map(name => `${name}=${String(this.setting(name))}`).join('&')
  }

  private async count(): Promise<void> {
    this.clear()
    this.query = this.settings()
    write(this.said, '')
    const to = FIRST_SEED + Number(this.runs.value)
    try {
      const job = { name: this.counted.job, query: this.query, from: FIRST_SEED, to }
      const ran = this.jobs.run(this.tag, job, (rows, shell) => this.add(rows, shell))
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

interface Row {
  fill: HTMLElement
  range: HTMLElement
  mark: HTMLElement
  share: HTMLElement
  name: HTMLElement
  row: HTMLElement
}

function newRow(): Row {
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
