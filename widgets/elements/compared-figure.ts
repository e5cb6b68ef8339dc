// A figure whose runs can be compared: one of them pinned beside the others, and the same setting at further seeds.
import { Aside, atSeed, pictureOf } from './aside'
import type { SeedRun } from './details'
import css from './compare.css?inline'
import { h, write } from './dom'
import { FigureElement } from './figure-element'
import { FiveSeeds } from './five-seeds'
import type { Answer, Frame } from './host'
import { hasComma, locked } from './options'
import { PinCard, type Pinned } from './pin'

const sheet = new CSSStyleSheet()
sheet.replaceSync(css)

const SAID = 3000 // [ms] that a word of success stays

/** Seeds are whole numbers of 32 bits. */
const SEEDS = 2 ** 32

/** How a kind of figure is compared. */
export interface Compared {
  /** Names of the readouts that tell most in this state, the one that matters first. */
  readouts(values: Record<string, string>): string[]
  /** The part of the picture that is shown of a seed. */
  panels: string
}

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

export abstract class ComparedFigure extends FigureElement {
  protected abstract readonly compared: Compared
  #pinned: Pinned | undefined
  #curves = new Float64Array()
  #look = '' // the theme and the language of its picture
  #repainting: AbortController | undefined
  #pinning = false // with the next frame that shows what was asked for
  #shown: Frame | undefined // the last that showed it
  readonly #button = h('button', { type: 'button', class: 'pin', part: 'button pin' })
  readonly #pinWords = [h('span', { class: 'long' }), h('span', { class: 'short', 'aria-hidden': 'true' })] as const
  readonly #card = new PinCard(this.words, {
    back: () => this.#goBack(),
    unpin: () => (this.unpin(), this.#button.focus({ preventScroll: true })),
    peek: on => this.#card.peek(on),
  })
  readonly #seeds = new FiveSeeds(this.words, {
    run: (wish, signal, came) => this.#run(wish, signal, came),
    choose: state => this.undoable('undo_seed', () => (this.state = state)),
    main: () => this.compared.readouts(this.host?.values ?? {})[0]!,
    tell: detail => this.dispatchEvent(new CustomEvent('fastslam-seeds', { bubbles: true, composed: true, detail })),
  })

  constructor() {
    super()
    this.shadowRoot!.adoptedStyleSheets.push(sheet)
    this.#button.append(...this.#pinWords)
    this.menu.element.before(this.#button)
    this.folds.append(this.#seeds.element)
    this.#button.addEventListener('click', () => this.byHand(() => this.pin()))
    this.words.always(() => {
      write(this.#pinWords[0], this.words.say('pin'))
      write(this.#pinWords[1], this.words.say('pin_short'))
      this.#button.ariaLabel = this.words.say('pin')
      this.#button.title = this.words.say('pin_help')
    })
  }

  // --- What a page's script may use ------------------------------------------------------------------------------------

  /** Keeps the run shown: its curves behind those of the runs after it, its picture and its numbers beside them. */
  pin(): void {
    // What is set right after this call is not of the run that was to be kept.
    if (this.#shown?.query === this.state) this.#keep(this.#shown)
    else this.#pinning = true
    this.refresh()
  }

  unpin(): void {
    this.#pinning = false
    this.#pinned = undefined
    this.#repainting?.abort()
    this.#haunt(new Float64Array())
    this.#card.hold(undefined)
    this.#fit()
  }

  /** The state of the run that is pinned, as a link has it. */
  get pinned(): string | undefined {
    return this.#pinned?.state
  }

  /** What comes out at several seeds, the figure staying as it is. They run one after the other, in slices that the page does not notice. */
  async runSeeds({ signal = new AbortController().signal, ...wish }: SeedsWish = {}): Promise<SeedRun[]> {
    const runs: SeedRun[] = []
    await this.#run(wish, signal, run => runs.push(run))
    return runs
  }

  // --- How it is done ------------------------------------------------------------------------------------------------------

  override disconnectedCallback(): void {
    super.disconnectedCallback()
    this.#seeds.stop()
    this.#repainting?.abort()
  }

  protected override begun(): void {
    super.begun()
    if (this.#pinned) this.#haunt(this.#curves)
  }

  protected override introduced(): void {
    super.introduced()
    this.#place()
  }

  override hear(answer: Answer): void {
    super.hear(answer)
    if (answer.told === 'pinned') this.#haunt(answer.curves)
  }

  protected override byHand(act: () => void, lasts?: boolean): void {
    this.#card.peek(false)
    super.byHand(act, lasts)
  }

  protected override present(frame: Frame): void {
    super.present(frame)
    if (frame.busy) return
    this.#shown = frame
    if (this.#pinning) this.#keep(frame)
    if (this.#pinned) this.#card.compare(frame, this.compared.readouts(frame.values), hasComma(this.getAttribute('decimal'), this.words))
    if (this.#pinned && frame.picture && frame.layout) this.#take(this.#pinned, frame)
    this.#seeds.about(frame, locked(this.getAttribute('lock'), frame.specs.map(({ name }) => name)).locked.has('seed'))
  }

  protected override onKey(event: KeyboardEvent): boolean {
    if (event.key !== 'Escape' || this.#card.overlay.hidden) return super.onKey(event)
    this.#card.peek(false)
    return true
  }

  #keep({ query, step, last, values, readouts, sentence, gist }: Frame): void {
    this.#pinning = false
    this.#pinned = { state: query, step, last, values, readouts, sentence, gist, css: this.canvas.size.canvas.css }
    this.#card.hold(this.#pinned)
    this.#fit()
    this.send({ do: 'pin' })
    write(this.status, this.words.say('pinned'))
    setTimeout(() => this.status.textContent === this.words.say('pinned') && write(this.status, ''), SAID)
  }

  #fit(): void {
    this.#place()
    this.body.classList.toggle('pinned', this.#pinned !== undefined)
  }

  #place(): void {
    const { element, overlay } = this.#card
    if (!this.#pinned) return [element, overlay].forEach(part => part.remove())
    this.controls?.transport.after(element)
    this.stage.append(overlay)
  }

  #haunt(curves: Float64Array<ArrayBuffer>): void {
    this.#curves = curves
    this.send({ do: 'haunt', curves })
  }

  /** Its picture, as large as it is now, in these colours and words: the one on the page where that is of the same state. */
  #take(pinned: Pinned, frame: Frame): void {
    const { canvas, theme } = this.canvas.size
    const look = `${theme} ${frame.language}`
    const known = this.#look === look
    this.#look = look
    if (pinned.state !== frame.query) return known ? undefined : void this.#repaint(pinned)
    Object.assign(pinned, { gist: frame.gist, css: canvas.css, readouts: frame.readouts, sentence: frame.sentence })
    this.#card.take(this.canvas.element)
  }

  /** Another theme or language: the pinned run is made again, beside. */
  async #repaint(pinned: Pinned): Promise<void> {
    this.#repainting?.abort()
    const { signal } = (this.#repainting = new AbortController())
    let aside: Aside | undefined
    try {
      aside = await this.#beside(this.getAttribute('show') ?? '')
      const { room } = this.canvas.size
      const frame = await aside.reach(pinned.state, this.canvas.size, signal)
      if (this.#pinned !== pinned) return
      Object.assign(pinned, { gist: frame.gist, css: frame.layout!.width ?? room, readouts: frame.readouts, sentence: frame.sentence })
      this.#card.take(pictureOf(frame, room, true))
      this.refresh()
    } catch (error) {
      if (!signal.aborted) console.warn(`${this.localName}: the pinned picture stays as it was.`, error)
    } finally {
      aside?.free()
    }
  }

  /** Another figure of this kind, which speaks as this one does. */
  #beside(panels: string): Promise<Aside> {
    const { words } = this
    return Aside.of(this.localName, [
      { do: 'words', language: words.language, messages: words.forProgram },
      { do: 'comma', on: hasComma(this.getAttribute('decimal'), words) },
      { do: 'show', names: panels },
    ])
  }

  #goBack(): void {
    const { state } = this.#pinned!
    this.undoable('undo_back', () => (this.state = state))
  }

  async #run(wish: Omit<SeedsWish, 'signal'>, signal: AbortSignal, came: (run: SeedRun, frame: Frame) => void): Promise<void> {
    const query = new URLSearchParams(wish.state ?? this.state)
    if (wish.step !== undefined) query.set('step', String(wish.step))
    const state = query.toString()
    const first = Number(wish.state === undefined ? this.getParameter('seed') : (query.get('seed') ?? this.getParameter('seed')))
    const seeds = wish.seeds ?? [0, 1, 2, 3, 4].map(k => (first + k) % SEEDS)
    const aside = await this.#beside(this.compared.panels)
    try {
      const { theme } = this.canvas.size
      for (const seed of seeds) {
        signal.throwIfAborted()
        const frame = await aside.reach(atSeed(state, seed), { room: FiveSeeds.ROOM, height: Infinity, fontScale: 1, theme }, signal)
        came({ seed, step: frame.step, state: frame.query, readouts: frame.readouts }, frame)
      }
    } finally {
      aside.free()
    }
  }
}
