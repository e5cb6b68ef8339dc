// The element of every figure: what a page may do with it, by attributes, properties, links and methods.
//
// One order holds for a parameter, however the element came to be: what is locked keeps the author's value; else a reader's link stands
// over what the author gave, by attribute or property, and that over the default. It is kept in settings.ts.
import type { FigureReadout } from './details'
import { embedCode, type CodeName, type FigureMarkup } from './embed-code'
import { homeAddress } from './files'
import { FIGURES } from './generated/figures'
import { HostedFigure } from './hosted-figure'
import { linkedQuery, linkTo, withoutLab } from './link'
import { OPTIONS } from './options'
import { unwatchReached, watchReached } from './reached'
import { fromText, isParameter, takeEarlyProperties, toText, watchUnknown } from './parameters'
import { takeToPaper } from './paper'

/** What hosts say that put a copy of the page aside, of which Back makes the page again: of a figure it has the attributes only. */
const CACHES = ['turbo:before-cache', 'htmx:beforeHistorySave']

/**
 * What a page may style of every figure, and what it is:
 *
 * @csspart figure - All of it.
 * @csspart title - Its title.
 * @csspart chips - The row of challenges.
 * @csspart chip - A challenge.
 * @csspart verdict - What a challenge asks, and how near that is.
 * @csspart stage - What the picture stands in.
 * @csspart canvas - The picture.
 * @csspart transport - The row that plays it.
 * @csspart button - Every button.
 * @csspart primary - The button that matters most.
 * @csspart play - Plays, or pauses.
 * @csspart rewind - Goes to the first step.
 * @csspart step-back - Goes one step back.
 * @csspart step - Goes one step on.
 * @csspart reset - Goes back to what the author set.
 * @csspart undo - Takes back what threw something away.
 * @csspart watch - Plays an end that was not watched.
 * @csspart scrub - The slider of steps.
 * @csspart controls - The controls that matter.
 * @csspart control - A control with its name.
 * @csspart notices - What there is to tell.
 * @csspart notice - One thing of it; there only then.
 * @csspart sentence - What happens now, in a line.
 * @csspart lab - Opens all that can be set, and closes it.
 * @csspart numbers - The fold of numbers.
 * @csspart readouts - The numbers.
 * @csspart readout - A number with its name.
 * @csspart settings - The fold of other controls.
 * @csspart menu - The menu’s button.
 */
export class FigureElement extends HostedFigure {
  #targetBefore = 0 // the step asked for, while there is no host
  #disconnected = new AbortController()
  readonly #onReached = (): void => this.chips.refresh()

  constructor() {
    super()
    this.words.always(() => this.showTitle())
    watchUnknown(this, name => this.#onAttribute(name))
  }

  attributeChangedCallback(name: string): void {
    this.#onAttribute(name)
  }

  connectedCallback(): void {
    this.#disconnected = new AbortController()
    const { signal } = this.#disconnected
    this.theme.observe(signal)
    addEventListener('hashchange', () => this.followLink(), { signal })
    addEventListener('scroll', () => this.frames.inView && this.tuck(), { signal, capture: true, passive: true })
    this.body.classList.toggle('pictured', this.ownPicture !== null)
    watchReached(this.#onReached)
    takeToPaper(this, signal)
    for (const type of CACHES) document.addEventListener(type, () => this.state && (this.dataset['state'] = this.state), { signal })
    this.frames.observe(signal)
    this.canvas.observe()
    void this.speak()
    this.takeName()
    this.takePicture('light') // for paper
    takeEarlyProperties(this)
    const { state } = this.dataset
    delete this.dataset['state']
    if (this.settings.recipe !== undefined) return // a node that was only moved goes on from where it was
    if (state) this.#load(state, false)
    else this.followLink()
  }

  disconnectedCallback(): void {
    this.#disconnected.abort()
    unwatchReached(this.#onReached)
    this.frames.disconnect()
    this.canvas.disconnect()
    if (!this.host) return
    this.#targetBefore = this.host.target
    this.settings.keep(this.host.query)
    this.end()
  }

  // --- What a page's script may use: what is said of it, types, manifest and documentation have word for word ---------------

  /** Plays on; from the start where it is at its end. */
  play(): void {
    this.events.cause = 'playback'
    if (this.host && this.host.target >= this.host.last) this.seekTo(0)
    this.playback.start()
    this.wake()
  }

  /** Stops at the step shown. */
  pause(): void {
    this.playback.stop()
    this.refresh()
  }

  // A method; but frameworks that set properties write the parameter `step` here, and mean it.
  /** One step on. */
  get step(): () => void {
    return () => {
      this.seek(this.currentStep + 1)
      void this.#trace()
    }
  }

  set step(step: number | string) {
    this.setParameter('step', step)
  }

  /** One step back. */
  stepBack(): void {
    this.seek(this.currentStep - 1)
  }

  /** To a step. */
  seek(step: number): void {
    this.pause()
    this.events.cause = 'page'
    if (this.host) this.seekTo(step)
    else this.settings.wait('step', String(step))
  }

  /** Back to what the page’s author gave. */
  reset(): void {
    this.playback.stop()
    this.events.cause = 'page'
    this.crashes = 0
    this.stopped = false
    this.stage.classList.remove('still')
    this.messages.clear()
    this.settings.load(undefined)
    this.chips.takenUp()
    if (this.host) this.begin(true)
    else void this.start()
  }

  /** Takes up one of its challenges, as a press on its chip does; resolves to whether there is such a one here. */
  async challenge(name: string): Promise<boolean> {
    if (!this.chips.any) {
      await this.start()
      await this.settled()
    }
    const chip = this.chips.find(name)
    if (chip) this.takeUp(chip)
    return chip !== undefined
  }

  /** Whether it plays. */
  get playing(): boolean {
    return this.playback.playing
  }

  /** The step asked for. */
  get currentStep(): number {
    return this.host?.target ?? this.#targetBefore
  }

  set currentStep(step: number) {
    this.seek(step)
  }

  /** The whole state, as a link has it: name=value&… */
  get state(): string {
    return this.host?.query ?? this.settings.recipe ?? ''
  }

  set state(query: string) {
    this.#load(query, false)
  }

  /** The numbers of what is shown, each with name, value and unit, as events have them; empty before anything is shown. Await settled() after a change. */
  get readouts(): FigureReadout[] {
    return this.events.told?.readouts ?? []
  }

  /** The parameters of what is shown, by name, as links write them; empty before anything is shown. */
  get values(): Record<string, string> {
    return this.events.told?.values ?? {}
  }

  /** The address of this page with the figure’s whole state. */
  get link(): string {
    return linkTo(this, this.#linkable + (this.labIsOpen ? '&lab=open' : ''), homeAddress())
  }

  /** @internal The code that puts this figure, as it stands, into another page; undefined where that would need an address it does not have. */
  embedCode(name: CodeName): string | undefined {
    const home = homeAddress()
    if (!home && (name === 'iframe' || name === 'myst')) return undefined
    return embedCode(name, this.markup, home, this.heading.textContent, this.words.say('no_script'))
  }

  /** @internal What its author would write for it as it stands. */
  get markup(): FigureMarkup {
    const options = Object.keys(OPTIONS).filter(option => !['fit', 'v', 'lab'].includes(option) && this.hasAttribute(option))
    const lab: [string, string][] = this.labIsOpen ? [['lab', 'open']] : []
    const state = new URLSearchParams(this.#linkable)
    const version = state.get('v') ?? '1' // as links have it
    state.delete('v')
    return { tag: this.localName, attributes: [['v', version], ...state, ...lab, ...options.map((name): [string, string] => [name, this.getAttribute(name)!])] }
  }

  /** The state; of a figure that has none yet, what its author gave. */
  get #linkable(): string {
    const { state } = this
    if (state || this.host) return state
    const { parameters } = FIGURES[this.localName]!
    const usual = (name: string) => fromText(this.specs.find(spec => spec.name === name)?.default)
    const given = parameters.map((name): [string, unknown] => [name, this.getParameter(name)]).filter(([name, value]) => value !== undefined && value !== usual(name))
    return String(new URLSearchParams([['v', this.settings.version], ...given.map(([name, value]) => [name, toText(value)])]))
  }

  /** Height [css px] that shows all of the figure at its present width. */
  get naturalHeight(): number {
    return this.canvas.naturalHeight
  }

  /** @internal Takes the state that the page's address holds for this figure, over what was given until now. */
  followLink(): void {
    const query = linkedQuery(this)
    if (query === undefined) return
    this.#load(query, true)
    this.scrollIntoView({ block: 'nearest' })
  }

  /** @internal For the properties that are made from the parameters. */
  setParameter(name: string, value: unknown): void {
    this.settings.give(name, toText(value))
    this.events.cause = 'page'
    this.setTo(name, toText(value))
  }

  /** @internal The value; of a figure that does not live, what it will begin with, or undefined for the default. */
  getParameter(name: string): unknown {
    return this.settings.get(name, this.host, this.specs)
  }

  // --- How it is done ------------------------------------------------------------------------------------------------------

  #onAttribute(name: string): void {
    if (name in OPTIONS) return this.takeOption(name)
    if (name === 'aria-label') return this.takeName()
    if (!isParameter(name)) return
    this.settings.giveAttribute(name)
    this.events.cause = 'page'
    if (this.host) return this.setTo(name, this.getAttribute(name))
    this.settings.waitAttribute(name)
    this.reconsider()
  }

  /** A whole state, over what was given until now; a link says of the Lab only that it is open. */
  #load(link: string, linked: boolean): void {
    const [query, lab] = withoutLab(link)
    if (lab !== null) this.showLab(lab === 'open')
    this.playback.stop() // the sender meant this very state
    this.events.cause = 'page'
    this.settings.load(query, linked)
    this.chips.takenUp()
    if (this.host) this.begin(true)
    else if (this.heavy && this.isConnected) void this.start() // where figures above it grow, it may not be seen for a while
    else this.reconsider()
  }

  /** Which lines of the algorithm the step asked for runs, and what comes out of them; told also if the figure is not seen. */
  async #trace(): Promise<void> {
    if (!this.host) await this.start()
    this.send({ do: 'trace' })
    if (this.frames.inView) return
    this.host?.work(Infinity)
    this.show(this.host?.frame(Infinity))
  }
}
