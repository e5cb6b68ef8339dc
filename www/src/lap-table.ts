// The lap table of the chapter: a plain table (scripts/chapter/lap-table.mjs) that readers may compute again, cell by cell.
import { h, icon, write } from '../../widgets/elements/dom'
import { Jobs } from '../../widgets/elements/jobs'
import { lapsOf } from '../../widgets/elements/laps'
import { programOf } from '../../widgets/elements/program'
import type { Shell } from '../../widgets/elements/shell'

const PROPOSALS: Record<string, string> = { aware: 'measurement-aware proposal', motion: 'motion prior' }
const MATCHERS: Record<string, string> = { cell: 'cell score', subcell: 'sub-cell score' }

/** What `spread` returns, in its order, by the names that the table gives its numbers. */
const NUMBERS = ['median', 'low', 'high', 'p90', 'worst']

/**
 * Rough time of one particle's lap in WebAssembly [ms], on a machine of 2020: for the word before the first run. After it, the
 * reader's own machine is known.
 */
const PARTICLE_LAP: Record<string, number> = { aware: 3.2, motion: 1.2 }
const LAP = 10 // [ms] of a lap besides its particles: the world's scans
const GRAPH = 25 // [ms] of a lap as a pose graph, roughly, on the same machine
const FEW = 5 // seeds after which it is said whether they agree, long before the end

interface Cell {
  /** As in the table: `aware.cell.m16`, or `graph`. */
  name: string
  title: string
  run: Run
  element: HTMLTableCellElement
  button: HTMLButtonElement
  verdict: HTMLElement
}

/** What makes the errors of a cell. */
interface Run {
  /** The figure of whose program the job is. */
  tag: string
  job: string
  query: string
  /** One lap [ms] on the rough machine. */
  rough: number
}

/** The laps that a cell is made of, and what it is called. */
function cellNamed(name: string): { title: string; run: Run } {
  if (name === 'graph') {
    return { title: 'pose graph, sub-cell score', run: { tag: 'fastslam-graph', job: 'graphs', query: 'course=apartment&odometry=1', rough: GRAPH } }
  }
  const [proposal, matcher, m] = name.split('.') as [string, string, string]
  const particles = Number(m.slice(1))
  return {
    title: `${PROPOSALS[proposal]}, ${MATCHERS[matcher]}, M = ${particles}`,
    run: { ...lapsOf(particles, proposal, matcher), rough: LAP + PARTICLE_LAP[proposal]! * particles },
  }
}

export class FastslamLapTable extends HTMLElement {
  #cells: Cell[] = []
  #panel: Panel | undefined
  readonly #jobs = new Jobs()
  #asked: object | undefined // a mark of the run that is under way
  #slowness = 1 // time on this machine over the rough one
  #seeds = 0 // of every cell: all of them are run, or the digits could not be the same

  connectedCallback(): void {
    if (this.#panel) return
    this.#seeds = Number(this.getAttribute('seeds'))
    const cells = [...this.querySelectorAll<HTMLTableCellElement>('td[data-cell]')]
    this.#panel = new Panel(this.#seeds, () => this.stop('Stopped'))
    this.#cells = cells.map(element => this.#upgrade(element))
    this.append(this.#panel.element)
    this.#estimate()
  }

  disconnectedCallback(): void {
    this.stop()
  }

  /** Ends what is being computed. What there is stays to be read. */
  stop(said = ''): void {
    if (!this.#asked) return
    this.#asked = undefined
    this.#jobs.stop()
    this.#panel!.end(said)
  }

  #upgrade(element: HTMLTableCellElement): Cell {
    const name = element.dataset.cell!
    const button = h('button', { type: 'button', class: 'run' }, icon('play'), h('span', {}, 'run'))
    const verdict = h('span', { class: 'verdict' })
    const cell = { name, ...cellNamed(name), element, button, verdict }
    button.addEventListener('click', () => void this.#run(cell))
    element.append(h('span', { class: 'again' }, button, verdict))
    return cell
  }

  /** How long each cell takes, where it is pointed at or read out. */
  #estimate(): void {
    for (const cell of this.#cells) {
      const told = `Run it here: ${cell.title}. About ${duration(this.#expected(cell))}.`
      cell.button.title = told
      cell.button.setAttribute('aria-label', told)
    }
  }

  /** [ms] */
  #expected(cell: Cell): number {
    return this.#slowness * cell.run.rough * this.#seeds
  }

  async #run(cell: Cell): Promise<void> {
    this.stop()
    const asked = (this.#asked = {})
    const panel = this.#panel!
    for (const { element } of this.#cells) element.classList.toggle('chosen', element === cell.element)
    this.#judge(cell, '', '')
    panel.begin(cell.title, this.#expected(cell))
    const started = performance.now()
    const found: number[] = []
    try {
      const { default: kept } = await import('../data/lap-table.json')
      const printed = (kept as Record<string, number[]>)[`lap.${cell.name}`] ?? []
      const ofTable = Object.entries(kept as Record<string, number[]>).filter(([name]) => !name.startsWith('lap.tried.'))
      const axis = ofTable.flatMap(([, errors]) => errors)
      if (this.#asked !== asked) return // it was stopped, or another one was chosen
      panel.print(printed, [Math.min(...axis), Math.max(...axis)])
      const { tag, job: name, query, rough } = cell.run
      const add = (rows: number[][], shell: Shell) => {
        for (const [, error] of rows) found.push(error!)
        panel.show(found, printed, performance.now() - started, shell)
      }
      if (!(await this.#jobs.run(tag, { name, query, from: 1, to: this.#seeds + 1 }, add))) return
      const shell = await programOf(tag).shell()
      if (this.#asked !== asked) return
      this.#asked = undefined
      this.#slowness = (performance.now() - started) / (rough * this.#seeds)
      this.#estimate()
      this.#conclude(cell, shell.spread(new Float64Array(found)), found, printed, performance.now() - started)
    } catch (error) {
      if (this.#asked !== asked) return
      this.#asked = undefined
      panel.fail(`The laps did not run: ${(error as Error).message}.`)
    }
  }

  /** The digits in the cell against those computed here, and behind them every single error. */
  #conclude(cell: Cell, spread: Float64Array, found: number[], printed: number[], took: number): void {
    const here = [...spread].map(metres)
    const there = NUMBERS.map(name => cell.element.querySelector(`[data-of=${name}]`)?.textContent ?? '')
    const different = found.filter((error, k) => error !== printed[k]).length
    const [median, low, high, p90, worst] = here
    const numbers = `median ${median} m (${low}–${high}), p90 ${p90} m, worst ${worst} m`
    if (different === 0 && here.every((text, k) => text === there[k])) {
      this.#judge(cell, 'same', 'same digits')
      this.#panel!.agree(`The same digits as printed: ${numbers}. All ${found.length} errors agree to the last bit. It took ${duration(took)}.`)
    } else {
      this.#judge(cell, 'differs', 'differs')
      this.#panel!.differ(
        `These are not the digits printed. Here: ${numbers}. Printed: median ${there[0]} m (${there[1]}–${there[2]}), p90 ${there[3]} m, worst ${there[4]} m. ` +
          `${different} of ${found.length} errors differ. The chapter claims that this cannot happen: please report it, with the name of your browser.`,
      )
    }
  }

  #judge(cell: Cell, kind: '' | 'same' | 'differs', text: string): void {
    cell.verdict.className = `verdict ${kind}`
    write(cell.verdict, text)
  }
}

/** Below the table: how far it is, every error on one axis, and what comes of it. */
class Panel {
  readonly #title = h('p', { class: 'name', id: 'lap-table-run' })
  readonly #progress = h('progress', { 'aria-label': 'Seeds run', value: '0' })
  readonly #stop = h('button', { type: 'button' }, 'Stop')
  readonly #now = h('p', { class: 'now' })
  readonly #said = h('p', { class: 'said', role: 'status' })
  readonly #alert = h('p', { class: 'alert', role: 'alert' })
  readonly #strip = svg('svg', { class: 'strip', 'aria-hidden': 'true' })
  readonly #legend = h('p', { class: 'legend', 'aria-hidden': 'true' }, h('i', { class: 'printed' }), 'printed, ', h('i', { class: 'same' }), 'computed here; one dot a seed, RMS error [m]')
  readonly element = h(
    'div',
    { class: 'panel', role: 'group', 'aria-labelledby': 'lap-table-run' },
    this.#title,
    h('div', { class: 'work' }, this.#progress, this.#stop),
    this.#now,
    this.#strip,
    this.#legend,
    this.#said,
    this.#alert,
  )
  #marks: SVGElement[] = []
  #median: SVGElement | undefined
  #axis: [number, number] = [1, 1]
  #shown = 0

  constructor(
    private readonly seeds: number,
    stop: () => void,
  ) {
    this.#progress.max = seeds
    this.#stop.addEventListener('click', stop)
    this.element.hidden = true
  }

  begin(title: string, expected: number): void {
    this.element.hidden = false
    write(this.#title, title)
    write(this.#now, '')
    write(this.#alert, '')
    write(this.#said, `Running ${this.seeds} laps: about ${duration(expected)}. You may read on, or stop it at any time.`)
    this.#progress.value = 0
    this.#stop.disabled = false
    this.#strip.replaceChildren()
    this.#shown = 0
  }

  /** The errors as printed, before any is computed here. */
  print(errors: number[], axis: [number, number]): void {
    this.#axis = axis
    const ticks = [0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5].filter(x => axis[0] <= x && x <= axis[1])
    const lines = ticks.flatMap(x => {
      const label = svg('text', { x: this.#x(x), y: '52', 'text-anchor': 'middle' })
      label.textContent = String(x)
      return [svg('line', { class: 'tick', x1: this.#x(x), x2: this.#x(x), y1: '0', y2: '40' }), label]
    })
    this.#marks = errors.map((error, k) => svg('circle', { class: 'printed', cx: this.#x(error), cy: height(k), r: '2.5' }))
    this.#median = svg('line', { class: 'median', y1: '0', y2: '40' })
    this.#strip.replaceChildren(...lines, ...this.#marks, this.#median)
  }

  /** What has been computed so far. */
  show(found: number[], printed: number[], elapsed: number, shell: Shell): void {
    for (; this.#shown < found.length; this.#shown++) {
      const [k, error] = [this.#shown, found[this.#shown]!]
      if (error === printed[k]) this.#marks[k]!.setAttribute('class', 'same')
      else this.#strip.append(svg('circle', { class: 'differs', cx: this.#x(error), cy: height(k), r: '3.5' }))
    }
    const [median] = shell.spread(new Float64Array(found)) as unknown as [number]
    const same = found.filter((error, k) => error === printed[k]).length
    this.#progress.value = found.length
    for (const end of ['x1', 'x2']) this.#median!.setAttribute(end, this.#x(median))
    const left = (elapsed / found.length) * (this.seeds - found.length)
    const agree = same === found.length ? 'each error as printed' : `${found.length - same} not as printed`
    const going = found.length < this.seeds
    write(this.#now, `${found.length} of ${this.seeds} seeds, ${agree}. Median${going ? ' so far' : ''} ${metres(median)} m.${going ? ` ${capital(duration(left))} left.` : ''}`)
    if (found.length === FEW) write(this.#said, same === FEW ? `The first ${FEW} laps end with the errors printed, to the last bit.` : `The first ${FEW} laps do not end with the errors printed.`)
  }

  end(said: string): void {
    this.#stop.disabled = true
    if (said) write(this.#said, `${said} after ${this.#shown} of ${this.seeds} seeds.`)
  }

  agree(text: string): void {
    this.end('')
    write(this.#said, text)
  }

  differ(text: string): void {
    this.end('')
    write(this.#said, '')
    write(this.#alert, text)
  }

  fail(text: string): void {
    this.differ(text)
  }

  /** Errors differ by powers of ten. */
  #x(error: number): string {
    const [low, high] = this.#axis.map(Math.log) as [number, number]
    return `${(2 + (96 * (Math.log(error) - low)) / (high - low)).toFixed(2)}%`
  }
}

/** Dots of equal errors lie side by side: spread by the golden ratio. */
function height(k: number): string {
  return (4 + 32 * ((k * 0.618034) % 1)).toFixed(1)
}

function svg(tag: string, attributes: Record<string, string>): SVGElement {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag)
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value)
  return element
}

/** As the table writes them. */
function metres(error: number): string {
  return error.toFixed(3)
}

function capital(text: string): string {
  return text[0]!.toUpperCase() + text.slice(1)
}

/** No finer than such a guess can be. */
function duration(ms: number): string {
  const seconds = ms / 1000
  if (seconds < 1.5) return 'a second'
  if (seconds < 10) return `${Math.round(seconds)} seconds`
  if (seconds < 55) return `${5 * Math.round(seconds / 5)} seconds`
  const minutes = Math.round(seconds / 60)
  return minutes <= 1 ? 'a minute' : `${minutes} minutes`
}

if (!customElements.get('fastslam-lap-table')) customElements.define('fastslam-lap-table', FastslamLapTable)
