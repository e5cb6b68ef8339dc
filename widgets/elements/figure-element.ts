// The element of every figure: its life on the page, and what a page's script may do with it. What it shows comes as frames from its host,
// which carries its commands to the program (host.ts); canvas, playback, settings, controls and menu have files of their own.
import { Canvas } from './canvas'
import { Controls } from './controls'
import { h, write } from './dom'
import { CODES, embedCode, type CodeName } from './embed-code'
import { Events } from './events'
import css from './figure.css?inline'
import { homeAddress, pictureAddress } from './files'
import { FIGURES } from './generated/figures'
import { Handles } from './handles'
import type { Answer, Command, FigureHost, Frame, Listener } from './host'
import { keepKeys } from './keys'
import { linkedQuery, linkTo } from './link'
import { LocalHost } from './local-host'
import { Menu, type MenuItem } from './menu'
import { Messages } from './messages'
import { locked, OPTIONS, refusal, unlockable } from './options'
import { isParameter, takeEarlyProperties, toText, watchUnknown } from './parameters'
import { Playback } from './playback'
import { programOf, type ParamSpec } from './program'
import { showReadouts } from './readouts'
import { copy, download } from './save'
import { Sentence } from './sentence'
import { Settings } from './settings'
import { onThemeChange, themeName } from './theme'
import { WorkerHost } from './worker-host'

const sheet = new CSSStyleSheet()
sheet.replaceSync(css)

const WORDS = 'en' // language of all that figures say, whatever that of the page
const WORK_BUDGET = 8 // [ms] of simulation a frame, which leaves half of a 60 Hz frame to painting and the page
const SEEN = 0.35 // share of the canvas in view at which the figure begins to play
const WIDE = 620 // [px] from here on the settings are open at first
const SLOW = 3000 // [ms] of loading after which the picture is shown meanwhile

export abstract class FigureElement extends HTMLElement implements Listener {
  /** Whether its program runs in a worker, because it would keep the page waiting. */
  static heavy = false

  #host?: FigureHost // lives while the element is connected and has been seen
  #starting: Promise<void> | undefined
  #stopped = false // after an error that beginning again did not cure, until Reset
  #crashes = 0
  #near = false // within a screen of being seen: built and painted, so that nothing on the page moves when it comes into view
  #inView = false
  #frameRequest = 0
  #disconnected = new AbortController()
  #sentSize = ''
  #target = 0 // the step asked for, while there is no host
  #timeline = true // whether there are steps to play

  protected specs: ParamSpec[] = []
  protected readonly events = new Events(this)
  protected controls: Controls | undefined
  protected readonly settings = new Settings(this)
  protected readonly playback = new Playback()
  protected readonly messages = new Messages()
  protected readonly heading = h('p', { class: 'title', part: 'title', id: 'title' })
  protected readonly status = h('span', { class: 'status', role: 'status' })
  protected readonly readouts = h('dl', { class: 'readouts', part: 'readouts' })
  protected readonly sentence = new Sentence()
  protected readonly stage = h('div', { class: 'stage', part: 'stage', role: 'group', tabindex: '0', 'aria-labelledby': 'title', 'aria-describedby': 'keys' })
  protected readonly body = h('div', { class: 'figure', part: 'figure', role: 'group', 'aria-labelledby': 'title', lang: WORDS })
  protected readonly canvas = new Canvas(this, this.body, this.stage, () => this.#refresh())
  protected readonly menu = new Menu(this.menuItems(), this)
  readonly #fallback = h('div', { class: 'fallback' }, h('slot'))
  readonly #handles = new Handles({
    drag: (handle, x, y) => this.#byPointer({ do: 'drag', handle, x, y }),
    nudge: (handle, right, up) => this.#byPointer({ do: 'nudge', handle, right, up }),
  })

  readonly #approach = new IntersectionObserver(entries => this.#onApproach(entries[entries.length - 1]!), { rootMargin: '100% 0px' })
  readonly #intersections = new IntersectionObserver(entries => this.#onIntersection(entries), { threshold: [0, SEEN] })

  constructor() {
    super()
    const root = this.attachShadow({ mode: 'open' })
    root.adoptedStyleSheets = [sheet]
    this.stage.append(this.canvas.element, this.#handles.layer, this.#fallback)
    this.body.append(
      h('div', { class: 'head' }, this.heading, this.status, this.menu.element),
      this.stage,
      h('p', { class: 'hidden', id: 'keys' }, this.keysHelp),
      h('p', { class: 'hidden', id: 'handle-keys' }, 'Arrow keys move it, with Shift far, with Alt a little.'),
      this.messages.element,
      this.sentence.element,
      this.readouts,
    )
    root.append(this.body)
    keepKeys(this.body, event => this.onKey(event))
    this.canvas.element.addEventListener('click', ({ offsetX: x, offsetY: y }) => this.#byPointer({ do: 'pick', x, y }))
    for (const type of ['pointerdown', 'pointermove', 'pointerup'] as const) {
      this.canvas.element.addEventListener(type, event => this.#handles.follow(event))
    }
    watchUnknown(this, name => this.#onAttribute(name))
  }

  attributeChangedCallback(name: string): void {
    this.#onAttribute(name)
  }

  connectedCallback(): void {
    this.#disconnected = new AbortController()
    const { signal } = this.#disconnected
    onThemeChange(() => this.#refresh(), signal)
    document.addEventListener('visibilitychange', () => this.wake(), { signal })
    addEventListener('hashchange', () => this.followLink(), { signal })
    this.body.classList.toggle('pictured', this.querySelector('img, picture') !== null)
    this.#approach.observe(this)
    this.#intersections.observe(this)
    this.#intersections.observe(this.stage)
    this.canvas.observe()
    takeEarlyProperties(this)
    if (this.settings.recipe === undefined) this.followLink() // a node that was only moved goes on from where it was
  }

  disconnectedCallback(): void {
    this.#disconnected.abort()
    this.#approach.disconnect()
    this.#intersections.disconnect()
    this.canvas.disconnect()
    cancelAnimationFrame(this.#frameRequest)
    this.#frameRequest = 0
    this.#near = false
    this.#inView = false
    if (!this.#host) return
    this.#target = this.#host.target
    this.settings.keep(this.#host.query)
    this.#end()
  }

  // --- What a page's script may use ------------------------------------------------------------------------------------

  play(): void {
    this.events.cause = 'playback'
    if (this.#host && this.#host.target >= this.#host.last) this.#seek(0)
    this.playback.start()
    this.wake()
  }

  pause(): void {
    this.playback.stop()
    this.#refresh()
  }

  /** A method; but frameworks that set properties write the parameter `step` here, and mean it. */
  get step(): () => void {
    return () => {
      this.seek(this.currentStep + 1)
      void this.#trace()
    }
  }

  set step(step: number | string) {
    this.setParameter('step', step)
  }

  stepBack(): void {
    this.seek(this.currentStep - 1)
  }

  seek(step: number): void {
    this.pause()
    this.events.cause = 'page'
    if (this.#host) this.#seek(step)
    else this.settings.wait('step', String(step))
  }

  /** Back to what the page's author gave: attributes, the first step, at rest. */
  reset(): void {
    this.playback.stop()
    this.events.cause = 'page'
    this.#crashes = 0
    this.#stopped = false
    this.stage.classList.remove('still')
    this.messages.clear()
    this.settings.load(undefined)
    if (this.#host) this.#begin(true)
    else void this.start()
  }

  get playing(): boolean {
    return this.playback.playing
  }

  /** The step asked for. */
  get currentStep(): number {
    return this.#host?.target ?? this.#target
  }

  set currentStep(step: number) {
    this.seek(step)
  }

  /** The whole state, as a link has it: `name=value&…`, what differs from the defaults. */
  get state(): string {
    return this.#host?.query ?? this.settings.recipe ?? ''
  }

  set state(query: string) {
    this.#load(query, false)
  }

  /** The address of this page with this figure's whole state. */
  get link(): string {
    return linkTo(this, this.state)
  }

  /** The code that puts this figure, as it stands, into another page; undefined where that would need an address it does not have. */
  embedCode(name: CodeName): string | undefined {
    const home = homeAddress()
    if (!home && (name === 'iframe' || name === 'myst')) return undefined
    const options = Object.keys(OPTIONS).filter(option => option !== 'fit' && this.hasAttribute(option))
    const attributes: [string, string][] = [...new URLSearchParams(this.state), ...options.map((o): [string, string] => [o, this.getAttribute(o)!])]
    return embedCode(name, { tag: this.localName, attributes }, home, this.heading.textContent)
  }

  /** Height [css px] that shows all of the figure at its present width, the picture as large as it would like to be. */
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
    this.#set(name, toText(value))
  }

  /** @internal The value; of a figure that does not live, what it will begin with, or undefined for the default. */
  getParameter(name: string): unknown {
    return this.settings.get(name, this.#host, this.specs)
  }

  // --- Life cycle --------------------------------------------------------------------------------------------------------

  /** Whether the program is wanted as soon as the figure is about to be seen. */
  protected get wanted(): boolean {
    return true
  }

  /** Fetches the program and begins, unless that has been done. */
  protected async start(): Promise<void> {
    if (this.#host || this.#stopped) return
    this.#starting ??= this.#start().finally(() => (this.#starting = undefined))
    return this.#starting
  }

  async #start(): Promise<void> {
    write(this.heading, FIGURES[this.localName]?.title ?? '')
    if (!this.status.textContent) write(this.status, 'Loading …')
    const slow = setTimeout(() => {
      this.#showPicture()
      write(this.status, 'Still loading, the network is slow …')
    }, SLOW)
    try {
      const Host = this.#heavy ? WorkerHost : LocalHost
      const host = await Host.create(programOf(this.localName), this.localName, this)
      if (!this.isConnected) return host.free()
      this.#host = host
      write(this.status, '')
      this.stage.classList.remove('still')
      this.messages.set('start', '')
      this.#begin(false)
      this.begun()
    } catch (error) {
      this.refuseToLive((error as Error).message)
    } finally {
      clearTimeout(slow)
    }
  }

  /** Gives the host all that was asked until now. */
  #begin(changed: boolean): void {
    this.#takeOption('decimal')
    this.send({ do: 'lock', text: this.getAttribute('lock') })
    if (!this.#host) return
    const beginning = this.settings.begin(this.#host.sent + 1)
    if (beginning.settings.some(([name]) => name === 'step')) this.playback.stop() // who names a step wants it looked at
    this.send({ do: 'begin', changed, ...beginning })
    this.#enable(true)
    this.#tellSize()
    // All in one frame, so that nothing of it need move in the next.
    const frame = this.controls ? undefined : this.#host?.frame()
    if (frame) this.present(frame)
    this.#refresh()
  }

  #end(): void {
    const host = this.#host
    this.#host = undefined
    this.#sentSize = ''
    host?.free()
  }

  /** A whole state, over what was given until now. */
  #load(query: string, linked: boolean): void {
    this.playback.stop() // the sender meant this very state
    this.events.cause = 'page'
    this.settings.load(query, linked)
    if (this.#host) this.#begin(true)
    else if (this.#heavy && this.isConnected) void this.start() // where figures above it grow, it may not be seen for a while
    else this.#reconsider()
  }

  get #heavy(): boolean {
    return (this.constructor as typeof FigureElement).heavy
  }

  #reconsider(): void {
    if (this.#near && this.wanted) void this.start()
  }

  #enable(on: boolean): void {
    this.controls?.enable(on)
    this.#handles.layer.inert = !on
  }

  /** Once, when the figure first tells what it is: its controls. */
  #introduce(specs: ParamSpec[]): void {
    const byHand = (act: () => void) => () => this.byHand(act)
    this.controls = new Controls(specs, {
      playPause: () => (this.playing ? this.pause() : this.play()),
      step: byHand(() => this.step()),
      stepBack: byHand(() => this.stepBack()),
      seek: step => this.byHand(() => this.seek(step)),
      reset: byHand(() => this.reset()),
      rate: rate => (this.playback.rate = rate),
      change: (name, value) => {
        this.playback.stay()
        this.byHand(() => this.#set(name, value))
        void this.start()
      },
    })
    this.controls.settings.open = this.clientWidth >= WIDE && !this.canvas.fits
    this.specs = specs
    this.placeControls(this.controls)
    this.#takeOption('lock')
    this.#takeOption('decimal')
  }

  protected placeControls(controls: Controls): void {
    this.stage.after(controls.transport, controls.view)
    this.readouts.after(controls.settings)
  }

  // --- Commands and answers --------------------------------------------------------------------------------------------------

  /** To the host, if there is one. */
  protected send(command: Command): void {
    this.#host?.send(command)
    this.#refresh()
  }

  hear(answer: Answer): void {
    switch (answer.told) {
      case 'refused':
        this.messages.set(answer.parameter, answer.message)
        if (this.#host?.values) this.controls?.showValues(this.specs, this.#host.values, answer.parameter)
        break
      case 'saved':
        download(answer.name, answer.data)
        break
      case 'failed':
        console.warn(`${this.localName}:`, answer.error, answer.why)
        this.playback.playing = false
        this.#crashes += 1
        this.failed(answer.why, this.#crashes > 1 || !this.isConnected)
    }
  }

  /** After a trap: the first time it is made again as it was, the second time it stops. */
  protected failed(why: string, again: boolean): void {
    if (again) return this.halt(`Something failed inside this figure again (${why}), so it has stopped.`)
    this.messages.set('crash', `Something failed inside this figure (${why}). It was rebuilt as it was before.`)
    this.restart()
  }

  /** Makes the host's program again, as it was when it was shown last. */
  protected restart(): void {
    this.#host?.restart()
    this.begun()
  }

  protected get alive(): boolean {
    return this.#host !== undefined
  }

  /** The figure has begun, or begun again after a trap. */
  protected begun(): void {}

  /** Until Reset. */
  protected halt(message: string): void {
    this.#stopped = true
    this.#enable(false)
    this.settings.keep(undefined)
    this.#end()
    this.messages.set('crash', message, 'Reset', () => this.reset())
  }

  /** What a parameter is to be; null for the default. */
  #set(name: string, text: string | null): void {
    if (name === 'step') this.playback.stop()
    if (!this.#host) return this.settings.wait(name, text)
    for (const cause of [name, 'link']) this.messages.set(cause, '')
    const value = text ?? this.specs.find(spec => spec.name === name)?.default
    if (value !== undefined) this.settings.ask(name, value, this.#host.sent + 1)
    this.send({ do: 'set', name, value: text })
    if (this.#host) this.settings.answered(this.#host.done)
  }

  #seek(step: number): void {
    this.send({ do: 'seek', step })
  }

  /** Which lines of the algorithm the step asked for runs, and what comes out of them; told also if the figure is not seen. */
  async #trace(): Promise<void> {
    if (!this.#host) await this.start()
    this.send({ do: 'trace' })
    if (this.#inView) return
    this.#host?.work(Infinity)
    this.#show(this.#host?.frame(Infinity))
  }

  #byPointer(command: Command): void {
    this.playback.stay()
    this.byHand(() => this.send(command))
  }

  protected byHand(act: () => void): void {
    act()
    this.events.cause = 'reader'
  }

  #onAttribute(name: string): void {
    if (name in OPTIONS) return this.#takeOption(name)
    if (!isParameter(name)) return
    this.settings.giveAttribute(name)
    this.events.cause = 'page'
    if (this.#host) return this.#set(name, this.getAttribute(name))
    this.settings.waitAttribute(name)
    this.#reconsider()
  }

  #takeOption(name: string): void {
    const text = this.getAttribute(name)
    let wrong = refusal(name, text)
    if (name === 'lock') {
      const names = this.specs.map(spec => spec.name)
      const wish = locked(text, names)
      this.controls?.lock(wish.locked)
      if (this.controls) wrong = unlockable(wish.unknown, names)
      this.#host?.send({ do: 'lock', text })
    } else if (name === 'decimal') {
      this.controls?.writeComma(text === 'comma')
      this.#host?.send({ do: 'comma', on: text === 'comma' })
    }
    this.messages.set(name, wrong)
    this.#refresh()
  }

  // --- Frames ------------------------------------------------------------------------------------------------------------

  wake(): void {
    if (!this.#host || document.hidden || !(this.#near || this.#host.remote)) return
    this.#frameRequest ||= requestAnimationFrame(now => this.#frame(now))
  }

  #refresh(): void {
    this.#host?.refresh()
    this.wake()
  }

  #frame(now: number): void {
    this.#frameRequest = 0
    if (!this.#host || document.hidden || !(this.#near || this.#host.remote)) return
    this.#tellSize()
    const plays = this.playback.playing && this.#inView
    if (plays && !this.#host.busy) this.#advance(now)
    this.#host?.work(WORK_BUDGET)
    this.#show(this.#host?.frame(now))
    if (plays || this.#host?.busy) this.wake()
  }

  #tellSize(): void {
    const { size } = this.canvas
    const text = JSON.stringify(size)
    if (text === this.#sentSize) return
    this.#sentSize = text
    this.#host?.send({ do: 'size', size })
  }

  #advance(now: number): void {
    const { target, last } = this.#host!
    if (target >= last) {
      this.playback.playing = false
      this.#host!.refresh()
    } else if (this.playback.isDue(now)) {
      this.events.cause = 'playback'
      this.#host!.send({ do: 'seek', step: target + 1 })
    }
  }

  #show(frame: Frame | undefined): void {
    if (!frame) return
    this.present(frame)
    if (!frame.busy) {
      this.settings.recipe = frame.query
      if (this.stage.matches('.live')) this.canvas.release()
      this.events.tell(frame, frame.run !== undefined)
    }
    this.events.send()
  }

  /** Shows all there is of a state. */
  protected present(frame: Frame): void {
    if (!this.controls) this.#introduce(frame.specs)
    this.specs = frame.specs
    if (this.#host) this.settings.answered(this.#host.done)
    if (frame.layout) this.canvas.place(frame.layout)
    if (frame.picture) this.canvas.show(frame.picture)
    showReadouts(this.readouts, frame.readouts)
    this.#handles.show(frame.handles)
    this.showPlayback(frame)
    this.controls!.showValues(frame.specs, frame.values)
    if (frame.sentence !== undefined) this.sentence.say(frame.sentence, this.playing)
  }

  protected showPlayback({ target, last, busy }: Frame): void {
    this.controls!.showPosition(target, last, this.playing, busy)
    const on = last > 0
    if (on === this.#timeline) return
    // Where there is nothing to play, the picture has no keys.
    this.#timeline = on
    this.stage.tabIndex = on ? 0 : -1
    if (on) this.stage.setAttribute('aria-describedby', 'keys')
    else this.stage.removeAttribute('aria-describedby')
  }

  // --- Reader's input ----------------------------------------------------------------------------------------------------

  #onApproach({ isIntersecting }: IntersectionObserverEntry): void {
    this.#near = isIntersecting
    if (isIntersecting) this.approached()
    this.#reconsider()
    this.wake()
  }

  /** It is about to be seen. */
  protected approached(): void {}

  #onIntersection(entries: IntersectionObserverEntry[]): void {
    for (const entry of entries) {
      if (entry.target === this) this.#inView = entry.isIntersecting
      else if (entry.intersectionRatio >= SEEN) this.playback.onSeen()
    }
    this.wake()
  }

  protected get keysHelp(): string {
    return 'Space plays and pauses. Left and right arrow keys step. Home and End go to the first and the last step.'
  }

  /** Whether the figure uses the key. */
  protected onKey(event: KeyboardEvent): boolean {
    if (event.ctrlKey || event.metaKey || event.altKey) return false
    if (event.key === 'Escape') return this.menu.close()
    const act = this.keyAction(event.key, event.target as HTMLElement)
    if (!act) return false
    event.preventDefault()
    act()
    return true
  }

  protected keyAction(key: string, target: HTMLElement): (() => void) | undefined {
    if (!this.#timeline) return undefined
    if (key === ' ' && !target.matches('button, summary, select, input:not([type=range])')) return () => (this.playing ? this.pause() : this.play())
    const onStage: Record<string, () => void> = {
      ArrowRight: () => this.step(),
      ArrowLeft: () => this.stepBack(),
      Home: () => this.seek(0),
      End: () => this.seek(Infinity),
    }
    const act = target === this.stage ? onStage[key] : undefined
    return act && (() => this.byHand(act))
  }

  protected menuItems(): MenuItem[] {
    const codes = (Object.keys(CODES) as CodeName[]).filter(name => name === 'python' || name === 'element' || homeAddress())
    const save = (kind: 'csv' | 'json') => () => this.send({ do: 'export', kind, name: this.fileName(kind) })
    return [
      { name: 'Copy link', act: () => void this.#copy('Link', this.link) },
      ...codes.map(name => ({ name: `Copy code: ${CODES[name]}`, act: () => void this.#copy('Code', this.embedCode(name)!) })),
      { name: 'Save picture (PNG)', act: () => this.canvas.element.toBlob(blob => blob && download(this.fileName('png'), blob)) },
      { name: 'Save data (CSV)', act: save('csv') },
      { name: 'Save data (JSON)', act: save('json') },
    ]
  }

  async #copy(what: 'Link' | 'Code', text: string): Promise<void> {
    if (await copy(text)) {
      write(this.status, `${what} copied`)
      setTimeout(() => write(this.status, ''), 3000)
    } else {
      this.messages.set('copy', `The browser does not let this page write to the clipboard. The ${what.toLowerCase()}:\n${text}`)
    }
  }

  protected fileName(extension: string): string {
    return `${this.id || this.localName}${this.#timeline ? `-step-${this.currentStep}` : ''}.${extension}`
  }

  // --- Where it cannot live ------------------------------------------------------------------------------------------------

  protected refuseToLive(why: string): void {
    write(this.status, '')
    this.#stopped = true
    this.#end()
    this.canvas.release()
    this.messages.set('start', `This figure is not live here: ${why}.${this.#showPicture()}`, 'Try again', () => this.reset())
  }

  /** The author's picture, or our own of a figure of which nothing was asked. Returns what is to be said of it. */
  #showPicture(): string {
    const slot = this.#fallback.firstElementChild!
    const own = this.querySelector('img, picture')
    const src = pictureAddress(this.localName, themeName(this.getAttribute('theme')).endsWith('dark') ? 'dark' : 'light')
    if (src && !own && !slot.hasChildNodes()) slot.append(h('img', { src, alt: `${this.heading.textContent}, at rest` }))
    this.stage.classList.add('still')
    return own || slot.hasChildNodes() ? ' The picture shows it at rest.' : ''
  }

  /** Something of a figure's own, below everything else. */
  protected addPanel(panel: HTMLElement): void {
    this.body.append(panel)
  }
}
