// The element of every figure: what a page may do with it, by attributes, properties, links and methods. What it is made of is a Figure.
//
// One order holds for a parameter, however the element came to be: what is locked keeps the author's value; else a reader's link stands
// over what the author gave, by attribute or property, and that over the default. It is kept in settings.ts.
import type { FigureReadout } from './details'
import type { CodeName, FigureMarkup } from './embed-code'
import type { Extra } from './extra'
import { Figure, type ExtraClass } from './figure'
import { FigureMenu } from './figure-menu'
import { linkedQuery } from './link'
import { OPTIONS } from './options'
import { PaperCopy } from './paper-copy'
import { takeToPaper } from './paper'
import { isParameter, takeEarlyProperties, toText, watchUnknown } from './parameters'
import { watchReached } from './reached'
import { codeOf, linkOf, markupOf } from './sharing'
import { Timeline } from './timeline'

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
export class FigureElement extends HTMLElement {
  /** @internal Whether its program runs in a worker, because it would keep the page waiting. */
  static heavy = false
  /** @internal What figures of this tag have that others do not. */
  static extras: ExtraClass[] = []

  readonly #figure = new Figure(this, this.constructor as typeof FigureElement)
  readonly #paper = new PaperCopy(this.#figure)
  #disconnected = new AbortController()

  constructor() {
    super()
    const figure = this.#figure
    for (const Extra of figure.kind.extras) figure.extras.push(new Extra(figure))
    figure.transport ??= new Timeline(figure)
    figure.extras.unshift(new FigureMenu(figure)) // it knows what plays the figure, and closes before anything else
    figure.words.always(() => figure.view.tellKeys(figure.words.say(figure.transport.keysHelp)))
    watchUnknown(this, name => this.#onAttribute(name))
  }

  attributeChangedCallback(name: string): void {
    this.#onAttribute(name)
  }

  connectedCallback(): void {
    this.#disconnected = new AbortController()
    const { signal } = this.#disconnected
    const { extras, frames, life, view } = this.#figure
    view.theme.observe(signal)
    addEventListener('hashchange', () => this.followLink(), { signal })
    addEventListener('scroll', () => frames.inView && view.tuck(), { signal, capture: true, passive: true })
    view.body.classList.toggle('pictured', view.ownPicture !== null)
    watchReached(view.chips, signal)
    takeToPaper(this.#paper, signal)
    for (const type of CACHES) document.addEventListener(type, () => this.state && (this.dataset['state'] = this.state), { signal })
    frames.observe(signal)
    view.canvas.observe()
    void this.#figure.speak()
    view.takeName()
    view.takePicture('light') // for paper
    for (const extra of extras) extra.connected?.(signal)
    takeEarlyProperties(this)
    const { state } = this.dataset
    delete this.dataset['state']
    if (life.settings.recipe !== undefined) return // a node that was only moved goes on from where it was
    if (state) life.load(state)
    else this.followLink()
  }

  disconnectedCallback(): void {
    this.#disconnected.abort()
    this.#figure.leave()
  }

  // --- What a page's script may use: what is said of it, types, manifest and documentation have word for word ---------------

  /** Plays on; from the start where it is at its end. */
  play(): void {
    this.#figure.transport.play()
  }

  /** Stops at the step shown. */
  pause(): void {
    this.#figure.transport.pause()
  }

  // A method; but frameworks that set properties write the parameter `step` here, and mean it.
  /** One step on. */
  get step(): () => void {
    return () => this.#figure.step()
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
    this.#figure.transport.seek(step)
  }

  /** Back to what the page’s author gave. */
  reset(): void {
    this.#figure.life.reset()
  }

  /** Takes up one of its challenges, as a press on its chip does; resolves to whether there is such a one here. */
  async challenge(name: string): Promise<boolean> {
    const { chips } = this.#figure.view
    if (!chips.any) {
      await this.#figure.life.start()
      await this.settled()
    }
    const chip = chips.find(name)
    if (chip) this.#figure.takeUp(chip)
    return chip !== undefined
  }

  /** Whether it plays. */
  get playing(): boolean {
    return this.#figure.transport.playing
  }

  /** The step asked for. */
  get currentStep(): number {
    return this.#figure.life.target
  }

  set currentStep(step: number) {
    this.seek(step)
  }

  /** The whole state, as a link has it: name=value&… */
  get state(): string {
    return this.#figure.life.state
  }

  set state(query: string) {
    this.#figure.life.load(query)
  }

  /** The numbers of what is shown, each with name, value and unit, as events have them; empty before anything is shown. Await settled() after a change. */
  get readouts(): FigureReadout[] {
    return this.#figure.events.told?.readouts ?? []
  }

  /** The parameters of what is shown, by name, as links write them; empty before anything is shown. */
  get values(): Record<string, string> {
    return this.#figure.events.told?.values ?? {}
  }

  /** The address of this page with the figure’s whole state. */
  get link(): string {
    return linkOf(this.#figure)
  }

  /** @internal The code that puts this figure, as it stands, into another page; undefined where that would need an address it does not have. */
  embedCode(name: CodeName): string | undefined {
    return codeOf(this.#figure, name)
  }

  /** @internal What its author would write for it as it stands. */
  get markup(): FigureMarkup {
    return markupOf(this.#figure)
  }

  /** Height [css px] that shows all of the figure at its present width. */
  get naturalHeight(): number {
    return this.#figure.view.canvas.naturalHeight
  }

  /** @internal Takes the state that the page's address holds for this figure, over what was given until now. */
  followLink(): void {
    const query = linkedQuery(this)
    if (query === undefined) return
    this.#figure.life.load(query, true)
    this.scrollIntoView({ block: 'nearest' })
  }

  /** @internal For the properties that are made from the parameters. */
  setParameter(name: string, value: unknown): void {
    this.#figure.life.give(name, toText(value))
  }

  /** @internal The value; of a figure that does not live, what it will begin with, or undefined for the default. */
  getParameter(name: string): unknown {
    return this.#figure.life.get(name)
  }

  /** Resolves when all that was asked of the figure is shown; playing goes on. */
  async settled(): Promise<void> {
    return this.#figure.settled()
  }

  /** @internal Lights a symbol of the chapter wherever the picture writes it; an empty one puts it out. */
  light(symbol: string): void {
    this.#figure.life.send({ do: 'light', name: symbol })
  }

  /** @internal Its extra of a kind, whose methods pages may call on the element (define.ts). */
  extra<E extends Extra>(kind: ExtraClass<E>): E {
    return this.#figure.extras.find(extra => extra instanceof kind) as E
  }

  #onAttribute(name: string): void {
    const { events, host, life, view } = this.#figure
    if (name in OPTIONS) return this.#figure.takeOption(name)
    if (name === 'aria-label') return view.takeName()
    if (!isParameter(name)) return
    life.settings.giveAttribute(name)
    events.cause = 'page'
    if (host) return life.setTo(name, this.getAttribute(name))
    life.settings.waitAttribute(name)
    this.#figure.reconsider()
  }
}
