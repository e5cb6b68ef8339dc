// All that a figure has: its view, the life of its program, what plays it, and its extras. Here is who calls whom: what a reader does, what the
// program tells, and the frames in which all of it is shown. What a page may do with a figure is the element's (figure-element.ts).
import { Events } from './events'
import type { Extra, Transport } from './extra'
import { FrameLoop } from './frame-loop'
import type { Answer, FigureHost, Frame, Listener } from './host'
import { Life } from './life'
import { reach } from './reached'
import { download } from './save'
import type { Chip } from './shell'
import type { Undoable } from './undo'
import { View, type Asked } from './view'
import { languageAround, Words } from './words'
import { yieldToMain } from './yield'

const WORK_SLICE = 8 // [ms] of simulation, in a frame and between two looks at what else the page has to do

/** What the figures of a tag have in common. */
export interface Kind {
  /** Whether its program runs in a worker, because it would keep the page waiting. */
  heavy: boolean
  extras: ExtraClass[]
}

export interface ExtraClass<E extends Extra = Extra> {
  new (figure: Figure): E
  /** Methods that pages may call on the element. */
  offers?: readonly (keyof E & string)[]
}

export class Figure implements Listener {
  transport!: Transport
  readonly extras: Extra[] = []
  #pictured = false
  #catchingUp = false

  readonly words = new Words()
  readonly events: Events
  readonly view: View
  readonly life: Life
  readonly frames: FrameLoop
  /** What a reader asks. */
  readonly reader: Asked = {
    refresh: () => this.life.refresh(),
    playPause: () => {
      this.view.undo.withdraw()
      if (this.transport.playing) this.transport.pause()
      else this.transport.play()
    },
    step: () => this.byHand(() => this.step()),
    stepBack: () => this.byHand(() => this.transport.seek(this.life.target - 1)),
    seek: step => this.byHand(() => this.transport.seek(step)),
    rewind: () => this.undoable('undo_rewind', () => this.transport.seek(0)),
    reset: () => this.undoable('undo_reset', () => this.life.reset()),
    rate: rate => (this.life.playback.rate = rate),
    watch: from =>
      this.byHand(() => {
        this.transport.seek(from)
        this.transport.play()
      }),
    takeUp: chip => this.takeUp(chip),
    takeBack: state => {
      this.byHand(() => this.life.load(state))
      this.view.stage.focus({ preventScroll: true }) // the button goes
    },
    point: (action, lasts) => {
      this.life.playback.stay()
      this.byHand(() => this.life.send(action), lasts)
    },
    change: (name, value) => this.#change(name, value),
    key: event => this.#onKey(event),
  }

  constructor(
    readonly element: HTMLElement,
    readonly kind: Kind,
  ) {
    this.events = new Events(element)
    this.view = new View(element, this.words, this.reader)
    this.life = new Life(element, kind, this.words, this.view, this.events, this)
    this.frames = new FrameLoop(element, this.view.stage, {
      approach: () => {
        for (const extra of this.extras) extra.near?.()
        this.reconsider()
      },
      seen: on => {
        if (on && !this.#pictured) return // a place that is kept free is no picture yet
        this.life.playback.onSeen(on)
        this.life.refresh()
      },
      unseen: () => this.host?.remote ?? false,
      frame: now => this.#frame(now),
    })
  }

  get host(): FigureHost | undefined {
    return this.life.host
  }

  /** Whether the program is wanted as soon as the figure is about to be seen. */
  get wanted(): boolean {
    // What is said before it is there is English.
    return !this.transport.patient || this.life.settings.any || this.words.language !== 'en'
  }

  reconsider(): void {
    if (this.frames.near && this.wanted) void this.life.start()
  }

  begun(): void {
    for (const extra of this.extras) extra.begun?.()
  }

  /** It leaves its page. */
  leave(): void {
    this.frames.disconnect()
    this.view.canvas.disconnect()
    this.life.leave()
  }

  /** Resolves when all that was asked of the figure is shown; playing goes on. */
  async settled(): Promise<void> {
    // What a frame shows may change sizes, which are told after it and ask for another one.
    for (let quiet = 0; quiet < 2; quiet = this.#unsettled ? 0 : quiet + 1) await new Promise(requestAnimationFrame)
  }

  get #unsettled(): boolean {
    const { host } = this
    if (this.life.starting || !this.frames.ask()) return true
    if (!host || !(host.remote || this.frames.near)) return false
    return host.busy || host.done < host.sent || (!this.transport.playing && (this.frames.waiting || this.view.sentence.waiting))
  }

  // --- What is asked of it -----------------------------------------------------------------------------------------------------

  /** One step on; told also if the figure is not seen: which lines of the algorithm it runs, and what comes out of them. */
  step(): void {
    this.transport.seek(this.life.target + 1)
    void this.#trace()
  }

  async #trace(): Promise<void> {
    if (!this.host) await this.life.start()
    this.life.send({ do: 'trace' })
    if (this.frames.inView) return
    this.host?.work(Infinity)
    this.#show(this.host?.frame(Infinity))
  }

  seekTo(step: number): void {
    this.view.watch.jumped()
    this.life.send({ do: 'seek', at: [step] })
  }

  /** An option was set, or taken away. */
  takeOption(name: string): void {
    const { author } = this.life
    if (name === 'lang') return void this.speak()
    if (name === 'v' && this.host) return this.life.reset() // all that is given means another thing
    if (name === 'theme' && this.element.isConnected) this.view.theme.look()
    author.show(name)
    author.send([name]) // after that: what the program refuses of it is said then
    this.life.refresh()
  }

  /** Speaks the language of the page around it. */
  async speak(): Promise<void> {
    if (!(await this.words.speak(languageAround(this.element)))) return
    this.life.author.send(['lang', 'decimal'])
    this.life.refresh()
    this.reconsider()
  }

  // --- What its reader does ------------------------------------------------------------------------------------------------------

  /** What is done then is told as the reader's own doing. Where it lasts, what was thrown away before it is not offered back any more. */
  byHand(act: () => void, lasts = true): void {
    this.events.cause = 'reader'
    if (lasts) this.view.undo.withdraw()
    act()
    this.events.cause = 'reader' // whatever it went by
  }

  /** Does what throws away what a reader has made, and offers it back until something else is done. */
  undoable(name: Undoable, act: () => void): void {
    const before = this.life.state
    this.byHand(act)
    this.view.undo.offer(name, before)
  }

  /** Takes up a challenge. */
  takeUp({ name, query }: Chip): void {
    this.undoable('undo_challenge', () => this.life.load(query))
    this.view.chips.takenUp(name)
    this.events.challenge(name, false)
    this.life.refresh()
  }

  #change(name: string, value: string): void {
    this.life.playback.stay()
    this.byHand(() => {
      const first = this.host && this.life.target === 0
      this.life.setTo(name, value, true)
      // At the first step nothing is seen of it.
      if (first && this.view.specs.find(spec => spec.name === name)?.group === 'setup') this.life.send({ do: 'tell' })
    })
    void this.life.start()
  }

  #onKey(event: KeyboardEvent): boolean {
    const { key } = event
    if (event.ctrlKey || event.metaKey || event.altKey) return false
    if (key === 'Escape' && this.view.help.close()) return true
    const target = event.target as HTMLElement
    const act = this.extras.map(extra => extra.key?.(key, target)).find(Boolean) ?? this.transport.key(key, target)
    if (!act) return false
    if (key !== 'Escape') event.preventDefault()
    act()
    return true
  }

  // --- What its program tells -----------------------------------------------------------------------------------------------------

  hear(answer: Answer): void {
    if (answer.told === 'failed') {
      console.warn(`${this.element.localName}:`, answer.error, answer.why)
      this.life.playback.playing = false
      this.life.crashes += 1
    }
    if (this.extras.some(extra => extra.hear?.(answer))) return
    if (answer.told === 'refused') {
      this.life.author.refused(answer.parameter, this.words.tell(answer.message), this.events.cause === 'page')
      if (this.host?.state) this.view.controls?.showValues(this.view.specs, this.host.state.values, answer.parameter)
    } else if (answer.told === 'saved') {
      download(answer.name, answer.data)
    } else if (answer.told === 'failed') {
      this.life.failed(this.words.tell(answer.why))
    }
  }

  // --- Frames ------------------------------------------------------------------------------------------------------------

  /** There may be something to show. */
  wake(): void {
    if (!this.host) return
    this.frames.wake()
    void this.#catchUp()
  }

  #frame(now: number): void {
    if (!this.host) return
    const plays = this.life.playback.playing && this.frames.inView
    if (plays && !this.host.busy) this.#advance(now)
    this.host?.work(WORK_SLICE, true)
    this.life.tellSize()
    this.#paint(now)
    // A part that it waits for wakes it: frames until then would take time from both cores.
    if (plays || (this.host?.busy && !this.host.waits)) this.wake()
  }

  #paint(now: number): void {
    this.#show(this.host?.frame(now))
    this.view.showBusy(this.host?.busy ?? false)
  }

  /**
   * Works also between frames, where that is on the page, and shows what was asked for, or a first answer to it, as soon as it is there: until
   * then there is nothing to paint, and the reader waits.
   */
  async #catchUp(): Promise<void> {
    if (this.#catchingUp) return
    this.#catchingUp = true
    do {
      await yieldToMain()
      if (!this.host || this.host.remote || !this.frames.waiting) break
      this.host.work(WORK_SLICE, true)
      if (this.#pictured) this.#paint(performance.now())
    } while (this.host?.busy && !this.host.waits)
    this.#catchingUp = false
  }

  #advance(now: number): void {
    const { target = 0, last = 0 } = this.host!.state ?? {}
    if (target >= last) {
      this.life.playback.playing = false
      this.host!.refresh()
    } else if (this.life.playback.isDue(now)) {
      this.view.watch.played(target, this.frames.lookedAt)
      this.events.cause = 'playback'
      this.host!.send({ do: 'seek', at: [target + 1] })
    }
  }

  #show(frame: Frame | undefined): void {
    if (!frame) return
    this.present(frame)
    if (!this.#pictured && frame.picture) {
      this.#pictured = true
      this.frames.lookAgain()
    }
    this.view.watch.show(frame)
    if (!frame.busy) {
      this.life.settings.recipe = frame.query
      if (this.view.stage.matches('.live')) this.view.canvas.release()
      this.events.tell(frame, frame.run !== undefined)
      this.#tick()
    }
    this.events.send()
  }

  /** Shows all there is of a state. */
  present(frame: Frame): void {
    const { view } = this
    if (view.introduce(frame)) {
      this.life.author.show('lock', 'controls', 'decimal')
      for (const extra of this.extras) extra.mount?.(view.controls!)
    }
    this.transport.show(frame)
    view.show(frame, this.transport.playing || frame.busy)
    this.life.playback.pace = frame.pace
    this.life.answered()
    for (const extra of this.extras) extra.frame?.(frame)
  }

  /** Remembers what the reader has just reached. A page that opens in such a state has not reached anything. */
  #tick(): void {
    const chip = this.events.cause === 'page' ? undefined : this.view.chips.justReached
    if (!chip) return
    reach(this.element.localName, chip.name)
    this.events.challenge(chip.name, true)
  }
}
