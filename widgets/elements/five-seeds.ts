// Folded away below a figure: its setting at the seed shown and at the next four, a small picture each, with the number that matters.
import { pictureOf } from './aside'
import type { SeedRun, SeedsDetail } from './details'
import { h, write } from './dom'
import type { Frame } from './host'
import type { Words } from './words'

/** How many. */
const COUNT = 5

export interface SeedsActions {
  run(wish: { step?: number }, signal: AbortSignal, came: (run: SeedRun, frame: Frame) => void): Promise<void>
  /** Goes to a state, as a link has it. */
  choose(state: string): void
  /** The readout that matters. */
  main(): string
  tell(detail: SeedsDetail): void
}

export class FiveSeeds {
  /** Width of a small figure [css px], of which a part is shown. */
  static readonly ROOM = 320

  readonly element: HTMLDetailsElement
  readonly #start = h('button', { type: 'button', part: 'button seeds-start' })
  readonly #halt = h('button', { type: 'button', part: 'button stop', disabled: '' })
  readonly #until = h('select')
  readonly #untilName = h('span', { class: 'name' })
  readonly #untilLabel = h('label', { class: 'choice' }, this.#untilName, this.#until)
  readonly #progress = h('progress', { value: '0', max: String(COUNT) })
  readonly #strip = h('div', { class: 'strip', part: 'seeds-strip', role: 'group' })
  readonly #said = h('p', { class: 'said', 'aria-live': 'polite' })
  #running: AbortController | undefined
  #ran: string | undefined // the setting that was run
  #runs: SeedRun[] = []
  #now: Frame | undefined
  #fixed = false

  constructor(
    private readonly words: Words,
    private readonly actions: SeedsActions,
  ) {
    const summary = h('summary')
    const shown = new Option('', 'shown')
    const end = new Option('', 'end')
    this.#until.append(shown, end)
    this.#start.addEventListener('click', () => void this.#run())
    this.#halt.addEventListener('click', () => this.stop('seeds_stopped'))
    const work = h('div', { class: 'work' }, this.#start, this.#halt, this.#untilLabel, this.#progress)
    this.element = h('details', { class: 'seeds', part: 'seeds' }, summary, work, this.#strip, this.#said)
    words.always(() => {
      write(summary, words.say('five_seeds'))
      write(this.#halt, words.say('stop'))
      write(this.#untilName, words.say('seeds_until'))
      shown.text = words.say('until_shown')
      end.text = words.say('until_end')
      this.#progress.ariaLabel = words.say('seeds_run')
      this.#strip.ariaLabel = words.say('five_seeds')
      this.#label()
      this.#runs.forEach((_, k) => this.#name(k))
    })
  }

  /** What the figure shows; where its author has fixed the seed, readers cannot go to another. */
  about(frame: Frame, fixed: boolean): void {
    this.#now = frame
    this.#fixed = fixed
    this.#untilLabel.hidden = frame.last === 0
    const stale = this.#ran !== undefined && this.#ran !== setting(frame)
    if (stale && this.#running) this.stop('seeds_changed')
    else if (stale && !this.#strip.matches('.stale')) write(this.#said, this.words.say('seeds_changed'))
    this.#strip.classList.toggle('stale', stale)
    this.#strip.querySelectorAll('button').forEach((button, k) => {
      button.disabled = fixed
      button.ariaCurrent = String(this.#runs[k]!.state === frame.query)
    })
  }

  /** Ends what is under way. What came until then stays. */
  stop(said?: 'seeds_stopped' | 'seeds_changed'): void {
    if (!this.#running) return
    this.#running.abort()
    this.#done()
    if (said) write(this.#said, this.words.say(said, { seeds: this.#runs.length, all: COUNT }))
  }

  async #run(): Promise<void> {
    if (!this.#now) return
    const running = (this.#running = new AbortController())
    this.#ran = setting(this.#now)
    this.#runs = []
    this.#strip.replaceChildren()
    this.#strip.classList.remove('stale')
    this.#start.disabled = true
    this.#halt.disabled = false
    this.#progress.value = 0
    write(this.#said, '')
    const main = this.actions.main()
    try {
      const wish = this.#until.value === 'end' && this.#now.last > 0 ? { step: this.#now.last } : {}
      await this.actions.run(wish, running.signal, (run, frame) => this.#add(run, pictureOf(frame, FiveSeeds.ROOM), main))
      if (running !== this.#running) return
      this.#done()
      this.#tell(main)
    } catch (error) {
      if (running !== this.#running) return // it was stopped
      this.#done()
      write(this.#said, this.words.say('seeds_failed', { why: this.words.why(error) }))
    }
  }

  #done(): void {
    this.#running = undefined
    const focused = (this.element.getRootNode() as ShadowRoot).activeElement === this.#halt
    this.#start.disabled = false
    if (focused) this.#start.focus({ preventScroll: true })
    this.#halt.disabled = true
    this.#label()
  }

  #label(): void {
    write(this.#start, this.words.say(this.#ran === undefined ? 'seeds_start' : 'seeds_again'))
  }

  #add(run: SeedRun, picture: HTMLCanvasElement, main: string): void {
    this.#runs.push(run)
    this.#progress.value = this.#runs.length
    picture.ariaHidden = 'true'
    const button = h('button', { type: 'button', part: 'button seed-run' }, picture, h('span', { class: 'name' }), h('span', { class: 'result' }, written(run, main)))
    button.disabled = this.#fixed
    button.ariaCurrent = String(run.state === this.#now?.query)
    button.addEventListener('click', () => this.actions.choose(run.state))
    this.#strip.append(button)
    this.#name(this.#runs.length - 1)
  }

  #name(k: number): void {
    const { seed, step } = this.#runs[k]!
    const words = this.words.say((this.#now?.last ?? 0) > 0 ? 'seed_at' : 'seed_number', { seed, step })
    write(this.#strip.children[k]!.querySelector<HTMLElement>('.name')!, words)
  }

  /** Said once, when all of them are there. */
  #tell(main: string): void {
    const known = this.#runs.filter(run => valueOf(run, main) !== null).sort((a, b) => valueOf(a, main)! - valueOf(b, main)!)
    const middle = known.length === this.#runs.length ? known[(known.length - 1) / 2] : undefined
    const title = this.#runs[0]!.readouts.find(({ name }) => name === main)?.title ?? ''
    write(this.#said, this.words.say('seeds_median', { title, median: middle ? written(middle, main) : '–' }))
    this.actions.tell({ readout: main, median: middle ? valueOf(middle, main) : null, runs: this.#runs })
  }
}

/** What decides the numbers at a seed. */
function setting({ specs, values }: Frame): string {
  return specs.filter(({ name, group }) => group === 'setup' && name !== 'seed').map(({ name }) => `${name}=${values[name]}`).join('&')
}

const valueOf = (run: SeedRun, name: string): number | null => run.readouts.find(readout => readout.name === name)?.value ?? null

function written(run: SeedRun, name: string): string {
  const readout = run.readouts.find(readout => readout.name === name)
  return readout ? [readout.text, readout.unit].filter(Boolean).join(' ') : '–'
}
