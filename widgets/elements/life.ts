// The life of a figure: how its program is fetched, begins, ends and begins again after a trap, and what is sent to it.
import { Author } from './author'
import { write } from './dom'
import type { Events } from './events'
import type { Command, FigureHost, Frame, Listener } from './host'
import { withoutLab } from './link'
import { LocalHost } from './local-host'
import { Playback } from './playback'
import { programOf } from './program'
import { Settings } from './settings'
import { reducedMotion } from './theme'
import type { View } from './view'
import { WorkerHost } from './worker-host'
import { languageAround, type Words } from './words'

const SLOW = 3000 // [ms] of loading after which the picture is shown meanwhile

export class Life {
  host: FigureHost | undefined // lives while the element is connected and has been seen
  stopped = false // after an error that beginning again did not cure, until Reset
  crashes = 0
  readonly playback = new Playback()
  readonly settings: Settings
  readonly author: Author
  #starting: Promise<void> | undefined
  #targetBefore = 0 // the step asked for, while there is no host
  #sentSize = ''

  constructor(
    private readonly element: HTMLElement,
    private readonly kind: { heavy: boolean },
    private readonly words: Words,
    private readonly view: View,
    private readonly events: Events,
    private readonly figure: Listener & { begun(): void; present(frame: Frame): void; reconsider(): void },
  ) {
    this.settings = new Settings(element)
    this.author = new Author(element, view, words, command => this.host?.send(command))
  }

  // --- From its beginning to its end --------------------------------------------------------------------------------------------

  /** Fetches the program and begins, unless that has been done. */
  async start(): Promise<void> {
    if (this.host || this.stopped) return
    this.#starting ??= this.#start().finally(() => (this.#starting = undefined))
    return this.#starting
  }

  get starting(): boolean {
    return this.#starting !== undefined
  }

  async #start(): Promise<void> {
    const { element, view, words } = this
    if (!view.status.textContent) write(view.status, words.say('loading'))
    const slow = setTimeout(() => {
      view.showFallback()
      // Longer words in the place of others would be seen to move: a frame goes by without any.
      write(view.status, '')
      const say = () => this.#starting && !this.host && write(view.status, words.say('still_loading'))
      requestAnimationFrame(() => requestAnimationFrame(say))
    }, SLOW)
    try {
      const Host = this.kind.heavy ? WorkerHost : LocalHost
      const [host] = await Promise.all([Host.create(programOf(element.localName), element.localName, this.figure), words.speak(languageAround(element))])
      if (!element.isConnected || this.host) return host.free() // paper may have been quicker
      this.#live(host)
    } catch (error) {
      this.refuse(words.why(error))
    } finally {
      clearTimeout(slow)
    }
  }

  /** At once, where the program is there. */
  startNow(): void {
    if (this.host || this.stopped || this.kind.heavy) return
    const host = LocalHost.now(programOf(this.element.localName), this.element.localName, this.figure)
    if (host) this.#live(host)
  }

  #live(host: FigureHost): void {
    this.host = host
    write(this.view.status, '')
    this.view.stage.classList.remove('still')
    this.view.messages.set('start', '')
    this.#begin(false)
    this.figure.begun()
  }

  /** Gives the host all that was asked until now. */
  #begin(changed: boolean): void {
    this.author.send()
    if (!this.host) return
    this.send({ do: 'author', name: this.settings.authored })
    const beginning = this.settings.begin(this.host.sent + 1, changed)
    const named = new URLSearchParams(beginning.name).has('step')
    if (named) this.playback.stop() // who names a step wants it looked at
    this.send(beginning)
    if (!named && beginning.value === null && reducedMotion.matches) this.send({ do: 'tell' })
    this.view.enable(true)
    this.tellSize()
    // All in one frame, so that nothing of it need move in the next.
    const frame = this.view.controls ? undefined : this.host?.frame()
    if (frame) this.figure.present(frame)
    this.refresh()
  }

  /** The element leaves its page; in the next one it goes on from where it was. */
  leave(): void {
    if (!this.host) return
    this.#targetBefore = this.target
    this.#end(this.host.state?.query)
  }

  #end(query?: string): void {
    const { host } = this
    this.settings.keep(query)
    this.host = undefined
    this.#sentSize = ''
    host?.free()
  }

  /** It cannot live, until the reader has it tried again. */
  refuse(why: string): void {
    const { view, words } = this
    write(view.status, '')
    this.stopped = true
    this.#end()
    view.canvas.release()
    view.messages.set('start', words.say('not_live', { why }) + view.showFallback(), words.say('try_again'), () => {
      this.stopped = false
      view.stage.classList.remove('still')
      view.messages.set('start', '')
      void this.start()
    })
  }

  /** It has failed: the first time it is made again as it was, the second time it stops until Reset. */
  failed(why: string): void {
    const { view, words } = this
    if (!this.failedAgain) {
      view.messages.set('crash', words.say('rebuilt', { why }))
      return this.restart()
    }
    this.stopped = true
    view.enable(false)
    this.#end()
    view.messages.set('crash', words.say('failed_again', { why }), words.say('reset'), () => this.reset())
  }

  get failedAgain(): boolean {
    return this.crashes > 1 || !this.element.isConnected
  }

  /** Makes the host's program again, as it was when it was shown last. */
  restart(): void {
    this.host?.restart()
    this.figure.begun()
  }

  // --- What is asked of it ------------------------------------------------------------------------------------------------------

  /** To the host, if there is one. */
  send(command: Command): void {
    this.host?.send(command)
    this.refresh()
  }

  /** To be shown again, new or not. */
  refresh(): void {
    this.host?.refresh()
    this.figure.wake()
  }

  /** The step asked for. */
  get target(): number {
    return this.host ? (this.host.state?.target ?? 0) : this.#targetBefore
  }

  /** The whole state, as a link has it. */
  get state(): string {
    return this.host?.state?.query ?? this.settings.recipe ?? ''
  }

  /** A whole state, over what was given until now; a link says of the Lab only that it is open. */
  load(link: string, linked = false): void {
    const [query, lab] = withoutLab(link)
    if (lab !== null) this.view.showLab(lab === 'open')
    this.#anew(query, linked) // the sender meant this very state
    if (this.host) this.#begin(true)
    else if (this.kind.heavy && this.element.isConnected) void this.start() // where figures above it grow, it may not be seen for a while
    else this.figure.reconsider()
  }

  /** Back to what the page’s author gave. */
  reset(): void {
    this.crashes = 0
    this.stopped = false
    this.view.stage.classList.remove('still')
    this.view.messages.clear()
    this.#anew(undefined)
    if (this.host) this.#begin(true)
    else void this.start()
  }

  #anew(query: string | undefined, linked?: boolean): void {
    this.playback.stop()
    this.events.cause = 'page'
    this.settings.load(query, linked)
    this.view.chips.takenUp()
  }

  /** What a parameter is to be; null for the default. */
  setTo(name: string, text: string | null, hand = false): void {
    if (name === 'step') this.playback.stop()
    if (!this.host) return this.settings.wait(name, text)
    for (const cause of [name, 'link']) this.view.messages.set(cause, '')
    const value = text ?? this.view.specs.find(spec => spec.name === name)?.default
    if (value !== undefined) this.settings.ask(name, value, this.host.sent + 1)
    this.send({ do: 'set', name, value: text, on: hand })
    this.answered()
  }

  /** The author gives a parameter a value, by a property. */
  give(name: string, text: string): void {
    this.settings.give(name, text)
    this.events.cause = 'page'
    this.setTo(name, text)
  }

  /** What a parameter is, or will be. */
  get(name: string): unknown {
    return this.settings.get(name, this.host?.state?.values, this.view.specs)
  }

  /** What the host has carried out is on its way no more. */
  answered(): void {
    if (this.host) this.settings.answered(this.host.done)
  }

  tellSize(): void {
    const { size } = this.view.canvas
    const text = JSON.stringify(size)
    if (text === this.#sentSize) return
    this.#sentSize = text
    this.host?.send(size)
  }
}
