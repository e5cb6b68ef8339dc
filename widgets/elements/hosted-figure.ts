// A figure with its host: how it begins and ends, what it sends and hears, and the frames in which all that is shown.
import { Events, figureEvent } from './events'
import { FigureParts } from './figure-parts'
import { FrameLoop } from './frame-loop'
import { write } from './dom'
import { FIGURES } from './generated/figures'
import type { Answer, Command, FigureHost, Frame, Listener } from './host'
import { LocalHost } from './local-host'
import { CHIPS, hasComma, locked, NUMBERS, offered, optionCommand, OPTIONS, refusal, unknownNames } from './options'
import type { Printed } from './paper'
import { programOf } from './program'
import { reach } from './reached'
import { download } from './save'
import { Settings } from './settings'
import { reducedMotion } from './theme'
import type { Chip } from './shell'
import { WorkerHost } from './worker-host'
import { languageAround } from './words'
import { yieldToMain } from './yield'

const WORK_SLICE = 8 // [ms] of simulation, in a frame and between two looks at what else the page has to do
const PATIENCE = 4000 // [ms] of simulation for paper, while the browser waits
const SLOW = 3000 // [ms] of loading after which the picture is shown meanwhile
const AT_HOME = /^(localhost|127\.0\.0\.1|\[::1\])$/.test(location.hostname)

export abstract class HostedFigure extends FigureParts implements Listener, Printed {
  /** Whether its program runs in a worker, because it would keep the page waiting. */
  static heavy = false

  protected host?: FigureHost // lives while the element is connected and has been seen
  #starting: Promise<void> | undefined
  protected stopped = false // after an error that beginning again did not cure, until Reset
  protected crashes = 0
  #sentSize = ''
  #off: { step: number; playing: boolean } | undefined // what is shown off paper
  #since = Infinity // the step from which on all was played and looked at
  #watched = false // to the end
  #pictured = false
  #catchingUp = false

  protected readonly events = new Events(this)
  protected readonly settings = new Settings(this)
  protected readonly frames = new FrameLoop(this, this.stage, {
    approach: () => (this.approached(), this.reconsider()),
    seen: on => {
      if (on && !this.#pictured) return // a place that is kept free is no picture yet
      this.playback.onSeen(on)
      this.refresh()
    },
    unseen: () => this.host?.remote ?? false,
    frame: now => this.#frame(now),
  })

  // --- Life ----------------------------------------------------------------------------------------------------------------

  /** Whether the program is wanted as soon as the figure is about to be seen. */
  protected get wanted(): boolean {
    return true
  }

  /** Fetches the program and begins, unless that has been done. */
  protected async start(): Promise<void> {
    if (this.host || this.stopped) return
    this.#starting ??= this.#start().finally(() => (this.#starting = undefined))
    return this.#starting
  }

  async #start(): Promise<void> {
    if (!this.status.textContent) write(this.status, this.words.say('loading'))
    const slow = setTimeout(() => {
      this.showFallback()
      // Longer words in the place of others would be seen to move: a frame goes by without any.
      write(this.status, '')
      const say = () => this.#starting && !this.host && write(this.status, this.words.say('still_loading'))
      requestAnimationFrame(() => requestAnimationFrame(say))
    }, SLOW)
    try {
      const Host = this.heavy ? WorkerHost : LocalHost
      const [host] = await Promise.all([Host.create(programOf(this.localName), this.localName, this), this.words.speak(languageAround(this))])
      if (!this.isConnected || this.host) return host.free() // paper may have been quicker
      this.#live(host)
    } catch (error) {
      this.refuseToLive(this.words.why(error))
    } finally {
      clearTimeout(slow)
    }
  }

  #live(host: FigureHost): void {
    this.host = host
    write(this.status, '')
    this.stage.classList.remove('still')
    this.messages.set('start', '')
    this.begin(false)
    this.begun()
  }

  load(): Promise<void> | undefined {
    return this.heavy ? undefined : this.start()
  }

  /** @internal At once, where the program is there: seen or not. */
  toPaper(): void {
    this.theme.look()
    if (!this.host && !this.stopped && !this.heavy) {
      const host = LocalHost.now(programOf(this.localName), this.localName, this)
      if (host) this.#live(host)
    }
    if (!this.host?.remote) {
      if (this.host && this.playback.untouched) {
        this.#off = { step: this.host.target, playing: this.playback.playing }
        this.playback.playing = false
        this.send({ do: 'tell' })
      }
      this.host?.work(PATIENCE)
      // Its height comes from the first of them, and the picture of that height from the second.
      for (let paints = 0; paints < 2 && this.host && !this.host.busy; paints++) {
        this.canvas.measure()
        this.#tellSize()
        const frame = this.host.frame()
        if (frame) this.present(frame)
      }
    }
    this.writeForPaper()
  }

  offPaper(): void {
    this.theme.look()
    if (this.#off) this.seekTo(this.#off.step)
    this.playback.playing ||= this.#off?.playing ?? false
    this.#off = undefined
    this.refresh()
  }

  /** Gives the host all that was asked until now. */
  protected begin(changed: boolean): void {
    for (const name of Object.keys(OPTIONS)) this.#sendOption(name)
    if (!this.host) return
    this.send({ do: 'author', name: this.settings.authored })
    const beginning = this.settings.begin(this.host.sent + 1, changed)
    const named = new URLSearchParams(beginning.name).has('step')
    if (named) this.playback.stop() // who names a step wants it looked at
    this.send(beginning)
    if (!named && beginning.value === null && reducedMotion.matches) this.send({ do: 'tell' })
    this.enable(true)
    this.#tellSize()
    // All in one frame, so that nothing of it need move in the next.
    const frame = this.controls ? undefined : this.host?.frame()
    if (frame) this.present(frame)
    this.refresh()
  }

  protected end(): void {
    const host = this.host
    this.host = undefined
    this.#sentSize = ''
    host?.free()
  }

  protected get heavy(): boolean {
    return (this.constructor as typeof HostedFigure).heavy
  }

  protected reconsider(): void {
    if (this.frames.near && this.wanted) void this.start()
  }

  protected refuseToLive(why: string): void {
    write(this.status, '')
    this.stopped = true
    this.settings.keep(undefined)
    this.end()
    this.canvas.release()
    this.messages.set('start', this.words.say('not_live', { why }) + this.showFallback(), this.words.say('try_again'), () => this.#tryAgain())
  }

  #tryAgain(): void {
    this.stopped = false
    this.stage.classList.remove('still')
    this.messages.set('start', '')
    void this.start()
  }

  /** Resolves when all that was asked of the figure is shown; playing goes on. */
  async settled(): Promise<void> {
    // What a frame shows may change sizes, which are told after it and ask for another one.
    for (let quiet = 0; quiet < 2; quiet = this.#unsettled ? 0 : quiet + 1) await new Promise(requestAnimationFrame)
  }

  get #unsettled(): boolean {
    const { host } = this
    if (this.#starting || this.frames.unsure) return true
    if (!host || !(host.remote || this.frames.near)) return false
    return host.busy || host.done < host.sent || (!this.playing && (this.frames.waiting || this.sentence.waiting))
  }

  // --- Commands and answers --------------------------------------------------------------------------------------------------

  /** @internal Lights a symbol of the chapter wherever the picture writes it; an empty one puts it out. */
  light(symbol: string): void {
    this.send({ do: 'light', name: symbol })
  }

  /** To the host, if there is one. */
  protected send(command: Command): void {
    this.host?.send(command)
    this.refresh()
  }

  hear(answer: Answer): void {
    switch (answer.told) {
      case 'refused':
        this.#refused(answer.parameter, this.words.tell(answer.message))
        if (this.host?.values) this.controls?.showValues(this.specs, this.host.values, answer.parameter)
        break
      case 'saved':
        download(answer.name, answer.data)
        break
      case 'failed':
        console.warn(`${this.localName}:`, answer.error, answer.why)
        this.playback.playing = false
        this.crashes += 1
        this.failed(this.words.tell(answer.why), this.crashes > 1 || !this.isConnected)
    }
  }

  /** A reader's input is refused in the figure. What the page asks for by an attribute, or by a name that no figure has, its author has mistaken. */
  #refused(cause: string, text: string): void {
    const authors = this.events.cause === 'page' && !['link', 'locked'].includes(cause) && (this.hasAttribute(cause) || !FIGURES[this.localName]!.parameters.includes(cause))
    if (authors) this.#tellAuthor(cause, text)
    else this.messages.set(cause, text)
  }

  /** Readers can do nothing about it: it goes to the console and to whoever listens, and stands in the figure on the machine where a page is made. */
  #tellAuthor(name: string, text: string): void {
    if (AT_HOME) this.messages.set(name, text)
    if (!text) return
    console.info(`<${this.localName}>: ${text}`)
    // The program may be at work just now.
    queueMicrotask(() => this.dispatchEvent(figureEvent('fastslam-notice', { name, text })))
  }

  /** After a trap: the first time it is made again as it was, the second time it stops. */
  protected failed(why: string, again: boolean): void {
    if (again) return this.halt(this.words.say('failed_again', { why }))
    this.messages.set('crash', this.words.say('rebuilt', { why }))
    this.restart()
  }

  /** Makes the host's program again, as it was when it was shown last. */
  protected restart(): void {
    this.host?.restart()
    this.begun()
  }

  protected get alive(): boolean {
    return this.host !== undefined
  }

  /** The figure has begun, or begun again after a trap. */
  protected begun(): void {}

  /** Until Reset. */
  protected halt(message: string): void {
    this.stopped = true
    this.enable(false)
    this.settings.keep(undefined)
    this.end()
    this.messages.set('crash', message, this.words.say('reset'), () => this.reset())
  }

  protected change(name: string, value: string): void {
    this.playback.stay()
    this.byHand(() => {
      const first = this.host?.target === 0
      this.setTo(name, value, true)
      // At the first step nothing is seen of it.
      if (first && this.specs.find(spec => spec.name === name)?.group === 'setup') this.send({ do: 'tell' })
    })
    void this.start()
  }

  /** What a parameter is to be; null for the default. */
  protected setTo(name: string, text: string | null, hand = false): void {
    if (name === 'step') this.playback.stop()
    if (!this.host) return this.settings.wait(name, text)
    for (const cause of [name, 'link']) this.messages.set(cause, '')
    const value = text ?? this.specs.find(spec => spec.name === name)?.default
    if (value !== undefined) this.settings.ask(name, value, this.host.sent + 1)
    this.send({ do: 'set', name, value: text, on: hand })
    if (this.host) this.settings.answered(this.host.done)
  }

  protected seekTo(step: number): void {
    this.#since = Infinity
    this.send({ do: 'seek', at: [step] })
  }

  protected override byHand(act: () => void, lasts?: boolean): void {
    this.events.cause = 'reader'
    super.byHand(act, lasts)
    this.events.cause = 'reader' // whatever it went by
  }

  /** An option was set, or taken away. */
  protected takeOption(name: string): void {
    if (name === 'lang') return void this.speak()
    if (name === 'v' && this.host) return this.reset() // all that is given means another thing
    if (name === 'theme' && this.isConnected) this.theme.look()
    this.#showOption(name)
    this.#sendOption(name) // after that: what the program refuses of it is said then
    this.refresh()
  }

  /** Speaks the language of the page around it. */
  protected async speak(): Promise<void> {
    if (!(await this.words.speak(languageAround(this)))) return
    for (const name of ['lang', 'decimal']) this.#sendOption(name)
    this.refresh()
    this.reconsider()
  }

  protected showTitle(): void {
    write(this.heading, this.words.title(this.localName) ?? FIGURES[this.localName]?.title ?? '')
  }

  #sendOption(name: string): void {
    const command = optionCommand(name, this.getAttribute(name), this.words)
    if (command) this.host?.send(command)
  }

  /** What an option does on the page, and what is wrong with it. */
  #showOption(name: string): void {
    const text = this.getAttribute(name)
    const { controls } = this
    let wrong = refusal(name, text, this.words)
    if (name === 'lab') this.showLab(text === 'open')
    if (controls) {
      const names = this.specs.map(spec => spec.name)
      if (name === 'lock') {
        const wish = locked(text, names)
        controls.lock(wish.locked)
        this.chips.lock(wish.locked)
        wrong = unknownNames(name, wish.unknown, names, this.words)
      } else if (name === 'controls') {
        const wish = offered(text, names)
        controls.offer(wish.offered)
        this.body.classList.toggle('some-controls', wish.offered !== undefined)
        this.showNumbers(wish.offered?.has(NUMBERS) ?? true)
        this.chips.element.classList.toggle('left-out', !(wish.offered?.has(CHIPS) ?? true))
        wrong = unknownNames(name, wish.unknown, wish.known, this.words)
      } else if (name === 'decimal') {
        controls.writeComma(hasComma(text, this.words))
      }
    }
    this.#tellAuthor(name, wrong)
  }

  // --- Frames ------------------------------------------------------------------------------------------------------------

  wake(): void {
    if (this.host) this.frames.wake()
  }

  protected refresh(): void {
    this.host?.refresh()
    this.wake()
  }

  #frame(now: number): void {
    if (!this.host) return
    this.#tellSize()
    const plays = this.playback.playing && this.frames.inView
    if (plays && !this.host.busy) this.#advance(now)
    this.host?.work(WORK_SLICE)
    this.show(this.host?.frame(now))
    this.showBusy(this.host?.busy ?? false)
    if (plays || this.host?.busy) this.wake()
    void this.#catchUp()
  }

  /** Works also between frames, where that is on the page: on the way to what was asked for there is nothing to paint, and the reader waits. */
  async #catchUp(): Promise<void> {
    if (this.#catchingUp) return
    this.#catchingUp = true
    while (this.host?.busy && !this.host.remote && this.frames.waiting) {
      await yieldToMain()
      this.host?.work(WORK_SLICE)
    }
    this.#catchingUp = false
  }

  #tellSize(): void {
    const { size } = this.canvas
    const text = JSON.stringify(size)
    if (text === this.#sentSize) return
    this.#sentSize = text
    this.host?.send(size)
  }

  #advance(now: number): void {
    const { target, last } = this.host!
    if (target >= last) {
      this.playback.playing = false
      this.host!.refresh()
    } else if (this.playback.isDue(now)) {
      this.#since = this.frames.lookedAt ? Math.min(this.#since, target) : Infinity
      this.events.cause = 'playback'
      this.host!.send({ do: 'seek', at: [target + 1] })
    }
  }

  protected show(frame: Frame | undefined): void {
    if (!frame) return
    this.present(frame)
    if (!this.#pictured && frame.picture) {
      this.#pictured = true
      this.frames.lookAgain()
    }
    const { step, last, watch } = frame
    const atEnd = watch !== undefined && last > 0 && step === last && !frame.busy
    if (atEnd && this.#since <= watch.from) this.#watched = true
    this.offerWatch(atEnd && !this.#watched ? watch : undefined)
    if (!frame.busy) {
      this.settings.recipe = frame.query
      if (this.stage.matches('.live')) this.canvas.release()
      this.events.tell(frame, frame.run !== undefined)
      this.#tick()
    }
    this.events.send()
  }

  /** Remembers what the reader has just reached. A page that opens in such a state has not reached anything. */
  #tick(): void {
    if (this.events.cause === 'page') return
    const chip = this.chips.justReached
    if (!chip) return
    reach(this.localName, chip.name)
    this.events.challenge(chip.name, true)
  }

  protected override takeUp(chip: Chip): void {
    super.takeUp(chip)
    this.chips.takenUp(chip.name)
    this.events.challenge(chip.name, false)
    this.refresh()
  }

  protected override present(frame: Frame): void {
    super.present(frame)
    this.playback.pace = frame.pace
    if (this.host) this.settings.answered(this.host.done)
  }

  protected introduced(): void {
    for (const name of ['lock', 'controls', 'decimal']) this.#showOption(name)
  }

  /** It is about to be seen. */
  protected approached(): void {}
}
