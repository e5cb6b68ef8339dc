// The base of every figure: life cycle, attributes and links, frame loop, canvas, keyboard, errors.
// A figure's own file only names its tag; everything that differs comes from the shell (parameters, readouts, pixels).
import { Controls } from './controls'
import { CODES, embedCode, type CodeName } from './embed-code'
import { h, icon, write } from './dom'
import { engine, isRefusal, panicMessage, type Engine, type Handle, type ParamSpec, type Readout, type Shell, type TraceLine } from './engine'
import css from './figure.css?inline'
import { homeAddress, pictureAddress } from './files'
import { FIGURES } from './generated/figures'
import { Handles } from './handles'
import { release, reserve } from './heights'
import { keepKeys } from './keys'
import { linkedQuery, linkTo } from './link'
import { locked, OPTIONS, refusal, unlockable } from './options'
import { notice } from './notices'
import { fromText, isParameter, takeEarlyProperties, toText, watchUnknown } from './parameters'
import { showReadouts } from './readouts'
import { copy, download } from './save'
import { onThemeChange, reducedMotion, themeName } from './theme'

export const sheet = new CSSStyleSheet()
sheet.replaceSync(css)

export const WORDS = 'en' // language of all that figures say, whatever that of the page

const WORK_BUDGET = 8 // [ms] of simulation a frame, which leaves half of a 60 Hz frame to painting and the page
const CATCH_UP_PAINT = 100 // [ms] between pictures while the simulation catches up
const SEEN = 0.35 // share of the canvas in view at which the figure begins to play
const WIDE = 620 // [px] from here on the settings are open at first
const LARGE = 1.5 // letters and lines of the presentation size, over the normal one
const SLOW = 3000 // [ms] of loading after which the picture is shown meanwhile
const LEGIBLE = 0.5 // a picture is not made smaller than that to fit
const PICTURE_SHARE = 0.6 // of a frame's height, which the picture takes if the rest has to be scrolled
const MAX_PIXELS = 6e6 // a canvas beyond this is painted coarser: no screen shows the difference, every phone feels it

/** Who made a state what it is: the reader's own hand, playing, or the page (an attribute, a property, a link, a script). */
export type Cause = 'reader' | 'playback' | 'page'

export interface FigureDetail {
  step: number
  /** The last step there is; 0 where there is nothing to play. */
  last: number
  by: Cause
  values: Record<string, string>
  readouts: Readout[]
}

export interface TraceDetail {
  step: number
  lines: TraceLine[]
}

export abstract class FigureElement extends HTMLElement {
  #engine?: Engine
  #figure?: Shell // lives while the element is connected and has been seen
  #specs: ParamSpec[] = []
  #controls?: Controls
  #starting = false
  #stopped = false // after an error that rebuilding did not cure, until Reset
  #crashes = 0

  #recipe?: string // the last good state as a query; a figure is rebuilt from it after a move, a link or a panic
  #waiting = new Map<string, string | null>() // values given while no figure lives: applied to the next one
  #given = new Map<string, string>() // values that a script gave by property, since the attribute was last set

  #playing = false
  #mayAutoplay = true
  #pace = 6 // [steps/s]
  #due = 0 // [ms] when the next step is due
  #timeline = true // whether there are steps to play
  #target = 0 // the step asked for; the step shown may still be on its way to it

  #near = false // within a screen of being seen: built and painted, so that nothing on the page moves when it comes into view
  #inView = false
  #frameRequest = 0
  #mustPaint = false
  #paintedAt = -Infinity // [ms]
  #mustShowValues = false
  #mustTrace = false
  #changeToTell = false
  #cause: Cause = 'page' // of what is told next
  #events: CustomEvent[] = [] // to be sent last of all
  #toldStep = -1
  #toldSentence = 0
  #saidAt = -Infinity // [ms]
  #cssWidth = 0
  #scale = 1 // css px of the canvas for one of the scene
  #room = 0 // [css px] for the picture, sideways
  #deviceWidth = 0
  #deviceHeight = 0
  #disconnected = new AbortController()
  #locked = new Set<string>()
  #linked = false // the recipe is a reader's link and not the figure's own

  readonly #heading = h('p', { class: 'title', part: 'title', id: 'title' })
  readonly #status = h('span', { class: 'status', role: 'status' })
  readonly #canvas = h('canvas', { part: 'canvas', role: 'img', 'aria-labelledby': 'title', 'aria-describedby': 'sentence' })
  readonly #handles = new Handles({
    drag: (name, x, y) => this.#move(figure => figure.drag(name, x / this.#scale, y / this.#scale, this.#cssWidth / this.#scale)),
    nudge: (name, right, up) => this.#move(figure => figure.nudge(name, right, up)),
  })
  readonly #fallback = h('div', { class: 'fallback' }, h('slot'))
  readonly #stage = h(
    'div',
    { class: 'stage', part: 'stage', role: 'group', tabindex: '0', 'aria-labelledby': 'title', 'aria-describedby': 'keys' },
    this.#canvas,
    this.#handles.layer,
    this.#fallback,
  )
  readonly #readouts = h('dl', { class: 'readouts', part: 'readouts' })
  readonly #sentence = h('p', { class: 'sentence', part: 'sentence', id: 'sentence', 'aria-live': 'off' })
  readonly #notices = h('div', { class: 'notices', part: 'notices', role: 'alert' })
  readonly #menu = this.#makeMenu()
  readonly #body = h('div', { class: 'figure', part: 'figure', role: 'group', 'aria-labelledby': 'title', lang: WORDS })

  readonly #approach = new IntersectionObserver(entries => this.#onApproach(entries[entries.length - 1]!), { rootMargin: '100% 0px' })
  readonly #intersections = new IntersectionObserver(entries => this.#onIntersection(entries), { threshold: [0, SEEN] })
  readonly #sizes = new ResizeObserver(entries => this.#onResize(entries))

  constructor() {
    super()
    const root = this.attachShadow({ mode: 'open' })
    root.adoptedStyleSheets = [sheet]
    this.#body.append(
      h('div', { class: 'head' }, this.#heading, this.#status, this.#menu),
      this.#stage,
      h(
        'p',
        { class: 'hidden', id: 'keys' },
        'Space plays and pauses. Left and right arrow keys step. Home and End go to the first and the last step.',
      ),
      h('p', { class: 'hidden', id: 'handle-keys' }, 'Arrow keys move it, with Shift far, with Alt a little.'),
      this.#notices,
      this.#sentence,
      this.#readouts,
    )
    root.append(this.#body)
    keepKeys(this.#body, event => this.#onKey(event))
    this.#canvas.addEventListener('click', event => this.#onClick(event))
    for (const type of ['pointerdown', 'pointermove', 'pointerup'] as const) {
      this.#canvas.addEventListener(type, event => this.#handles.follow(event))
    }
    watchUnknown(this, name => this.#onAttribute(name))
  }

  attributeChangedCallback(name: string): void {
    this.#onAttribute(name)
  }

  connectedCallback(): void {
    this.#disconnected = new AbortController()
    const { signal } = this.#disconnected
    onThemeChange(() => this.#repaint(), signal)
    document.addEventListener('visibilitychange', () => this.#wake(), { signal })
    addEventListener('hashchange', () => this.followLink(), { signal })
    this.#body.classList.toggle('pictured', this.querySelector('img, picture') !== null)
    this.#approach.observe(this)
    this.#intersections.observe(this)
    this.#intersections.observe(this.#stage)
    this.#watchSize()
    takeEarlyProperties(this)
    if (this.#recipe === undefined) this.followLink() // a node that was only moved goes on from where it was
  }

  disconnectedCallback(): void {
    this.#disconnected.abort()
    this.#approach.disconnect()
    this.#intersections.disconnect()
    this.#sizes.disconnect()
    cancelAnimationFrame(this.#frameRequest)
    this.#frameRequest = 0
    this.#near = false
    this.#inView = false
    this.#guard(figure => {
      this.#recipe = figure.query()
      this.#figure = undefined
      figure.free()
    })
  }

  // --- What a page's script may use ------------------------------------------------------------------------------------

  play(): void {
    this.#mayAutoplay = false
    this.#cause = 'playback'
    this.#guard(figure => {
      if (this.#target >= figure.step_count()) this.#seek(0)
    })
    this.#playing = true
    this.#due = 0
    this.#wake()
  }

  pause(): void {
    this.#mayAutoplay = false
    this.#playing = false
    this.#repaint()
  }

  /** A method; but frameworks that set properties write the parameter `step` here, and mean it. */
  get step(): () => void {
    return () => {
      this.#mustTrace = true
      this.seek(this.#target + 1)
      if (!this.#inView) void this.#workUnseen()
    }
  }

  set step(step: number | string) {
    this.setParameter('step', step)
  }

  stepBack(): void {
    this.seek(this.#target - 1)
  }

  seek(step: number): void {
    this.pause()
    this.#cause = 'page'
    if (!this.#figure) this.#waiting.set('step', String(step))
    this.#seek(step)
  }

  /** Back to what the page's author gave: attributes, the first step, at rest. */
  reset(): void {
    this.#mayAutoplay = false
    this.#playing = false
    this.#cause = 'page'
    this.#recipe = undefined
    this.#crashes = 0
    this.#stopped = false
    this.#stage.classList.remove('still')
    this.#waiting.clear()
    this.#notices.replaceChildren()
    if (this.#engine) this.#rebuild()
    else void this.#start()
  }

  get playing(): boolean {
    return this.#playing
  }

  /** The step asked for. */
  get currentStep(): number {
    return this.#target
  }

  set currentStep(step: number) {
    this.seek(step)
  }

  /** The whole state, as a link has it: `name=value&…`, what differs from the defaults. */
  get state(): string {
    return this.#figure?.query() ?? this.#recipe ?? ''
  }

  set state(query: string) {
    this.#mayAutoplay = false // the sender meant this very state
    this.#playing = false
    this.#cause = 'page'
    this.#recipe = query
    this.#waiting.clear()
    this.#changeToTell = true
    if (this.#engine && !this.#stopped) this.#rebuild()
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
    return embedCode(name, { tag: this.localName, attributes }, home, this.#heading.textContent)
  }

  /** Height [css px] that shows all of the figure at its present width, the picture as large as it would like to be. */
  get naturalHeight(): number {
    const scale = this.#largeness
    const wanted = this.#figure && this.#room > 0 ? this.#figure.height(this.#room / scale) * scale : this.#stage.offsetHeight
    return Math.ceil(this.#aroundStage() + wanted)
  }

  /** Something of a figure's own, below everything else. */
  protected addPanel(panel: HTMLElement): void {
    this.#body.append(panel)
  }

  // --- Life cycle --------------------------------------------------------------------------------------------------------

  async #start(): Promise<void> {
    if (this.#figure || this.#starting || this.#stopped) return
    this.#starting = true
    write(this.#heading, FIGURES[this.localName]?.title ?? '')
    write(this.#status, 'Loading …')
    const slow = setTimeout(() => {
      this.#showPicture()
      write(this.#status, 'Still loading, the network is slow …')
    }, SLOW)
    try {
      this.#engine = await engine()
      clearTimeout(slow)
      write(this.#status, '')
      this.#stage.classList.remove('still')
      if (this.isConnected) this.#rebuild()
    } catch (error) {
      clearTimeout(slow)
      write(this.#status, '')
      this.#stopped = true
      release(this.#body)
      this.#notice('start', `This figure is not live here: ${(error as Error).message}.${this.#showPicture()}`, 'Try again', () => this.reset())
    }
    this.#starting = false
  }

  /** The author's picture, or our own of a figure of which nothing was asked. Returns what is to be said of it. */
  #showPicture(): string {
    const slot = this.#fallback.firstElementChild!
    const own = this.querySelector('img, picture')
    const src = pictureAddress(this.localName, themeName(this.getAttribute('theme')).endsWith('dark') ? 'dark' : 'light')
    if (src && !own && !slot.hasChildNodes()) slot.append(h('img', { src, alt: `${this.#heading.textContent}, at rest` }))
    this.#stage.classList.add('still')
    return own || slot.hasChildNodes() ? ' The picture shows it at rest.' : ''
  }

  /** A new figure from the recipe; without one, from the attributes. */
  #rebuild(): void {
    const old = this.#figure
    this.#figure = undefined
    try {
      old?.free()
      const figure = this.#engine!.create(this.localName)
      this.#figure = figure
      figure.set_decimal_comma(this.getAttribute('decimal') === 'comma')
      if (!this.#controls) this.#introduce(figure)
      if (this.#recipe === undefined) {
        // In the order of the parameters, so that the order of the attributes makes no difference.
        const rank = (name: string) => this.#specs.findIndex(spec => spec.name === name)
        for (const name of this.getAttributeNames().sort((a, b) => rank(a) - rank(b))) {
          if (name in OPTIONS) this.#onOption(name)
          else if (isParameter(name)) this.#take(name, this.getAttribute(name))
        }
      } else {
        this.#notice('link', figure.load(this.#recipe).join('\n'))
        if (this.#linked) this.#keepLocked(figure, this.#authored())
        this.#linked = false
      }
      for (const [name, text] of this.#waiting) this.#take(name, text)
      this.#waiting.clear()
      this.#adoptTarget()
      this.#recipe = figure.query()
    } catch (error) {
      this.#crash(error)
    }
    this.#enable(this.#figure !== undefined)
    this.#mustShowValues = true
    this.#repaint()
  }

  #enable(on: boolean): void {
    this.#controls?.enable(on)
    this.#handles.layer.inert = !on
  }

  /** Once, when the shell first tells what this figure is: its name, its controls, its properties. */
  #introduce(figure: Shell): void {
    this.#specs = figure.params() as ParamSpec[]
    write(this.#heading, figure.title())
    const controls = new Controls(this.#specs, {
      playPause: () => (this.#playing ? this.pause() : this.play()),
      step: () => this.#byHand(() => this.step()),
      stepBack: () => this.#byHand(() => this.stepBack()),
      seek: step => this.#byHand(() => this.seek(step)),
      reset: () => this.#byHand(() => this.reset()),
      pace: pace => (this.#pace = pace),
      change: (name, value) => {
        this.#mayAutoplay = false
        this.#byHand(() => this.#set(name, value))
      },
    })
    this.#controls = controls
    controls.settings.open = this.clientWidth >= WIDE && !this.#fits
    this.#onOption('lock')
    this.#onOption('decimal')
    this.#stage.after(controls.transport, controls.view)
    this.#readouts.after(controls.settings)
    // All in one frame, so that nothing of it need move in the next.
    this.#fitHeight(figure)
    showReadouts(this.#readouts, figure.readouts() as Readout[])
    this.#say(figure.describe())
  }

  /** @internal Takes the state that the page's address holds for this figure, over what was given until now. */
  followLink(): void {
    const query = linkedQuery(this)
    if (query === undefined) return
    this.#linked = true
    this.scrollIntoView({ block: 'nearest' })
    this.state = query
  }

  // --- Parameters --------------------------------------------------------------------------------------------------------

  #onAttribute(name: string): void {
    if (name in OPTIONS) return this.#onOption(name)
    if (!isParameter(name)) return
    const text = this.getAttribute(name)
    this.#given.delete(name)
    this.#cause = 'page'
    if (this.#figure) this.#take(name, text)
    else if (this.#recipe === undefined) this.#waiting.delete(name) // the attribute itself is read when the figure is made
    else this.#waiting.set(name, text)
  }

  #onOption(name: string): void {
    const text = this.getAttribute(name)
    let wrong = refusal(name, text)
    if (name === 'lock' && this.#controls) {
      const names = this.#specs.map(spec => spec.name)
      const wish = locked(text, names)
      this.#locked = wish.locked
      this.#controls.lock(wish.locked)
      wrong = unlockable(wish.unknown, names)
    } else if (name === 'decimal' && this.#controls) {
      this.#controls.writeComma(text === 'comma')
      this.#guard(figure => figure.set_decimal_comma(text === 'comma'))
      this.#mustShowValues = true
    }
    this.#notice(name, wrong)
    this.#repaint()
  }

  /** What the author gave: properties and attributes, the last of them, and else the defaults. */
  #authored(): Record<string, string> {
    return Object.fromEntries(this.#specs.map(({ name, default: usual }) => [name, this.#given.get(name) ?? this.getAttribute(name) ?? usual]))
  }

  /** Puts back what is locked, where a reader's link or hand has moved it. */
  #keepLocked(figure: Shell, before: Record<string, string>): void {
    const now = values(figure)
    for (const name of this.#locked) {
      if (now[name] === before[name]) continue
      try {
        figure.set(name, before[name]!)
      } catch (error) {
        if (!isRefusal(error)) throw error // the author's own value is refused, which has been said
      }
      if (now[name] !== values(figure)[name]) this.#notice('locked', `${name} is fixed on this page`)
    }
  }

  /** An attribute's text; null where it was taken away. */
  #take(name: string, text: string | null): void {
    const spec = this.#specs.find(candidate => candidate.name === name)
    if (!spec && text === null) return this.#notice(name, '')
    if (name === 'step') {
      this.#mayAutoplay = false // an author who names a step wants it looked at
      this.#playing = false
    }
    this.#set(name, text ?? spec!.default) // a name that nobody knows is refused by the shell, in the shell's words
  }

  /** @internal For the properties that are made from the parameters. */
  setParameter(name: string, value: unknown): void {
    const text = toText(value)
    this.#given.set(name, text)
    this.#cause = 'page'
    if (this.#figure) this.#take(name, text)
    else this.#waiting.set(name, text)
  }

  /** @internal The value; of a figure that does not live, what it will begin with, or undefined for the default. */
  getParameter(name: string): unknown {
    const value = this.#figure
      ? values(this.#figure)[name]
      : (this.#waiting.get(name) ?? (this.#recipe === undefined ? this.getAttribute(name) : new URLSearchParams(this.#recipe).get(name)))
    return fromText(value)
  }

  #set(name: string, value: string): void {
    let forced: string | undefined
    this.#guard(figure => {
      try {
        figure.set(name, value)
        this.#notice(name, '')
        this.#notice('link', '')
        this.#adoptTarget()
      } catch (error) {
        if (!isRefusal(error)) throw error
        this.#notice(name, error.message)
        forced = name
      }
    })
    if (forced) this.#showValues(forced)
    else this.#changed()
  }

  #showValues(forced?: string): void {
    this.#guard(figure => {
      this.#specs = figure.params() as ParamSpec[]
      this.#controls!.showValues(this.#specs, values(figure), forced)
    })
  }

  #changed(): void {
    this.#mustShowValues = true
    this.#changeToTell = true
    this.#repaint()
  }

  #adoptTarget(): void {
    this.#target = Number(values(this.#figure!)['step'] ?? this.#figure!.step())
  }

  // --- Frames --------------------------------------------------------------------------------------------------------------

  #seek(step: number): void {
    this.#guard(figure => {
      this.#target = Math.max(0, Math.min(figure.step_count(), Math.round(step) || 0))
      figure.seek(this.#target)
    })
    this.#repaint()
  }

  #repaint(): void {
    this.#mustPaint = true
    this.#wake()
  }

  #wake(): void {
    if (!this.#figure || !this.#near || document.hidden) return
    this.#frameRequest ||= requestAnimationFrame(now => this.#frame(now))
  }

  #frame(now: number): void {
    this.#frameRequest = 0
    if (!this.#near || document.hidden) return
    this.#guard(figure => {
      const plays = this.#playing && this.#inView
      if (plays && figure.pending() === 0) this.#advance(figure, now)
      const end = performance.now() + WORK_BUDGET
      while (figure.pending() > 0 && performance.now() < end) {
        figure.work()
        this.#mustPaint = true
      }
      this.#fitHeight(figure)
      // On the way to a step far off, a look now and then is enough: painting costs more than simulating.
      const hurry = figure.pending() > 0 && now < this.#paintedAt + CATCH_UP_PAINT
      if (this.#mustPaint && !hurry) this.#show(figure)
      if (plays || figure.pending() > 0) this.#wake()
    })
    this.#send()
  }

  #advance(figure: Shell, now: number): void {
    if (this.#target >= figure.step_count()) {
      this.#playing = false
      this.#mustPaint = true
      return
    }
    const interval = 1000 / this.#pace
    if (now < this.#due) return
    // Where the machine is too slow for the pace the lap takes longer; no step is ever skipped.
    this.#due = Math.max(this.#due + interval, now + interval / 2)
    this.#target += 1
    this.#cause = 'playback'
    figure.seek(this.#target)
  }

  #show(figure: Shell): void {
    this.#mustPaint = false
    this.#paintedAt = performance.now()
    const busy = figure.pending() > 0
    const step = figure.step()
    const readouts = figure.readouts() as Readout[]
    this.#paint(figure)
    showReadouts(this.#readouts, readouts)
    this.#handles.show(figure.handles(this.#cssWidth) as Handle[])
    this.#showTimeline(figure.step_count() > 0)
    this.#controls!.showPosition(this.#target, figure.step_count(), this.#playing, busy)
    if (this.#mustShowValues) this.#showValues()
    this.#mustShowValues = false
    if (busy) return
    this.#recipe = figure.query()
    this.#say(figure.describe())
    if (this.#stage.matches('.live')) release(this.#body)
    const detail: FigureDetail = { step, last: figure.step_count(), by: this.#cause, values: values(figure), readouts }
    this.#controls!.showValues(this.#specs, detail.values) // time may take a value along, as it does a cursor
    if (this.#changeToTell) this.#tell('fastslam-change', detail)
    this.#changeToTell = false
    if (step !== this.#toldStep) this.#tell('fastslam-step', detail)
    this.#toldStep = step
    this.#tellTrace(figure)
  }

  /** Where there is nothing to play, the picture has no keys. */
  #showTimeline(on: boolean): void {
    if (on === this.#timeline) return
    this.#timeline = on
    this.#stage.tabIndex = on ? 0 : -1
    if (on) this.#stage.setAttribute('aria-describedby', 'keys')
    else this.#stage.removeAttribute('aria-describedby')
  }

  #tell(type: string, detail: FigureDetail | TraceDetail): void {
    this.#events.push(new CustomEvent(type, { bubbles: true, composed: true, detail }))
  }

  /** Always the last thing done: who listens may remove, reset, move or clone this figure. */
  #send(): void {
    for (const event of this.#events.splice(0)) this.dispatchEvent(event)
  }

  /** After a step that was asked for by itself: which lines of the algorithm it ran, and what came out of them. */
  #tellTrace(figure: Shell): void {
    if (!this.#mustTrace) return
    this.#mustTrace = false
    const detail: TraceDetail = { step: figure.step(), lines: figure.trace() as TraceLine[] }
    this.#tell('fastslam-trace', detail)
  }

  /** A step asked for from elsewhere on the page, by the box of an algorithm: the picture waits until it is seen, the lines do not. */
  async #workUnseen(): Promise<void> {
    await this.#start()
    this.#guard(figure => {
      while (figure.pending() > 0) figure.work()
      this.#tellTrace(figure)
    })
    this.#send()
  }

  /** The sentence under the picture: always up to date for eyes; read out only when nothing moves. */
  #say(text: string): void {
    this.#sentence.setAttribute('aria-live', this.#playing ? 'off' : 'polite')
    clearTimeout(this.#toldSentence)
    // While it plays, a sentence a second is what an eye can read.
    if (this.#playing && performance.now() < this.#saidAt + 1000) return
    this.#saidAt = performance.now()
    // The first at once, as it makes the figure higher.
    if (this.#playing || !this.#sentence.hasChildNodes()) write(this.#sentence, text)
    else this.#toldSentence = setTimeout(() => write(this.#sentence, text), 120) // one sentence for a whole drag
  }

  // --- Canvas --------------------------------------------------------------------------------------------------------------

  /** Letters and lines that the author wishes over normal ones. */
  get #largeness(): number {
    return this.getAttribute('size') === 'presentation' ? LARGE : 1
  }

  /** Whether the picture takes what height there is, rather than all of the width. */
  get #fits(): boolean {
    return (this.hasAttribute('fit') && this.getAttribute('fit') !== 'off') || this.matches(':fullscreen')
  }

  #watchSize(): void {
    this.#sizes.observe(this.#stage)
    try {
      this.#sizes.observe(this.#canvas, { box: 'device-pixel-content-box' })
    } catch {
      this.#sizes.observe(this.#canvas) // Safari
    }
  }

  #onResize(entries: ResizeObserverEntry[]): void {
    if (!this.#stage.matches('.live') && !this.#stopped) reserve(this.#body, this)
    this.#room = entries.findLast(({ target }) => target === this.#stage)?.contentRect.width ?? this.#room
    const entry = entries.findLast(({ target }) => target === this.#canvas)
    if (!entry) return this.#repaint() // there may be another height to fit
    const { width, height } = entry.contentRect
    this.#cssWidth = width
    let [w, h] = [Math.round(width * devicePixelRatio), Math.round(height * devicePixelRatio)]
    // To the very pixel where the browser tells it; but emulated screens tell css pixels here.
    const box = entry.devicePixelContentBoxSize?.[0]
    if (box && Math.abs(box.inlineSize - w) < 2) [w, h] = [box.inlineSize, box.blockSize]
    const shrink = Math.min(1, Math.sqrt(MAX_PIXELS / (w * h)))
    this.#deviceWidth = Math.floor(w * shrink)
    this.#deviceHeight = Math.floor(h * shrink)
    this.#repaint()
  }

  /** All of the figure but its picture [css px]. */
  #aroundStage(): number {
    return this.#body.scrollHeight + this.#body.offsetHeight - this.#body.clientHeight - this.#stage.offsetHeight
  }

  #fitHeight(figure: Shell): void {
    const width = this.#room
    if (width === 0) return
    let [scene, scale] = [width / this.#largeness, this.#largeness]
    if (this.#fits) {
      const height = this.#body.offsetHeight
      const room = Math.max(height - this.#aroundStage(), PICTURE_SHARE * height)
      const fitting = (wide: number) => Math.min(this.#largeness, width / wide, room / figure.height(wide))
      // Other widths have other layouts, so the one is looked for that can be shown largest. What would be too small to read is scrolled.
      let best = LEGIBLE * scale
      for (let wide = 0.5 * scene, most = 2 * scene; wide <= most; wide += 10) {
        if (fitting(wide) >= best) [scene, scale, best] = [wide, fitting(wide), fitting(wide)]
      }
    }
    this.#scale = scale
    this.#stage.style.setProperty('--_width', this.#fits ? `${Math.floor(Math.min(width, scene * scale))}px` : '100%')
    const height = `${Math.round(figure.height(scene) * scale)}px`
    if (this.#canvas.style.height !== height) this.#canvas.style.height = height // the resize observer then asks for the paint
  }

  #paint(figure: Shell): void {
    const [width, height] = [this.#deviceWidth, this.#deviceHeight]
    if (width === 0 || height === 0) return
    const context = this.#canvas.getContext('2d', { alpha: false })!
    if (this.#canvas.width !== width) this.#canvas.width = width
    if (this.#canvas.height !== height) this.#canvas.height = height
    figure.paint(width, height, (width / this.#cssWidth) * this.#scale, themeName(this.getAttribute('theme')))
    // The view is made now and dropped now: the next call into wasm may grow the memory and detach it.
    const pixels = new Uint8ClampedArray(this.#engine!.memory.buffer, figure.pixels(), width * height * 4)
    context.putImageData(new ImageData(pixels, width, height), 0, 0)
    // The figure's frame takes the painted background, so that the two cannot drift apart.
    this.#body.style.setProperty('--_paper', `rgb(${pixels[0]} ${pixels[1]} ${pixels[2]})`)
    this.#stage.classList.add('live')
  }

  // --- Reader's input ----------------------------------------------------------------------------------------------------

  #onApproach({ isIntersecting }: IntersectionObserverEntry): void {
    this.#near = isIntersecting
    if (isIntersecting) void this.#start()
    this.#wake()
  }

  #onIntersection(entries: IntersectionObserverEntry[]): void {
    for (const entry of entries) {
      if (entry.target === this) {
        this.#inView = entry.isIntersecting
      } else if (entry.intersectionRatio >= SEEN && this.#mayAutoplay && !reducedMotion.matches) {
        this.#mayAutoplay = false
        this.#playing = true
      }
    }
    this.#wake()
  }

  /** Whether the figure uses the key. */
  #onKey(event: KeyboardEvent): boolean {
    if (event.ctrlKey || event.metaKey || event.altKey) return false
    const target = event.target as HTMLElement
    if (event.key === 'Escape' && this.#menu.open) {
      this.#menu.open = false
      this.#menu.querySelector('summary')!.focus()
      return true
    }
    if (!this.#timeline) return false
    const stageKeys: Record<string, () => void> = {
      ArrowRight: () => this.#byHand(() => this.step()),
      ArrowLeft: () => this.#byHand(() => this.stepBack()),
      Home: () => this.#byHand(() => this.seek(0)),
      End: () => this.#byHand(() => this.seek(Infinity)),
    }
    const anywhere = event.key === ' ' && !target.matches('button, summary, select, input:not([type=range])')
    const act = anywhere ? () => (this.#playing ? this.pause() : this.play()) : target === this.#stage ? stageKeys[event.key] : undefined
    if (!act) return false
    event.preventDefault()
    act()
    return true
  }

  #byHand(action: () => void): void {
    action()
    this.#cause = 'reader'
  }

  #onClick(event: MouseEvent): void {
    this.#mayAutoplay = false
    this.#guard(figure => {
      const before = values(figure)
      if (!figure.pick(event.offsetX / this.#scale, event.offsetY / this.#scale, this.#cssWidth / this.#scale)) return
      this.#keepLocked(figure, before)
      this.#byHand(() => this.#changed())
    })
  }

  /** What a handle does. A move that changes no parameter, because it ended where it began or at a limit, is none. */
  #move(action: (figure: Shell) => void): void {
    this.#mayAutoplay = false
    this.#guard(figure => {
      const [before, given] = [figure.query(), values(figure)]
      action(figure)
      this.#keepLocked(figure, given)
      if (figure.query() === before) return
      this.#adoptTarget()
      this.#byHand(() => this.#changed())
    })
  }

  #makeMenu(): HTMLDetailsElement {
    const item = (text: string, act: () => void) => {
      const button = h('button', { type: 'button' }, text)
      button.addEventListener('click', () => {
        menu.open = false
        act()
      })
      return button
    }
    const items = h(
      'div',
      { class: 'items' },
      item('Copy link', () => void this.#copy('Link', this.link)),
      ...(Object.keys(CODES) as CodeName[]).flatMap(name => {
        const button = item(`Copy code: ${CODES[name]}`, () => void this.#copy('Code', this.embedCode(name)!))
        return name === 'python' || name === 'element' || homeAddress() ? [button] : []
      }),
      item('Save picture (PNG)', () => this.#canvas.toBlob(blob => blob && download(this.#fileName('png'), blob))),
      item('Save data (CSV)', () => this.#saveText('csv', 'text/csv')),
      item('Save data (JSON)', () => this.#saveText('json', 'application/json')),
    )
    const summary = h('summary', { 'aria-label': 'Menu', title: 'Menu', part: 'button menu' }, icon('more'))
    const menu = h('details', { class: 'menu', part: 'menu' }, summary, items)
    if (document.fullscreenEnabled) {
      items.append(
        item('Full screen', () => void (document.fullscreenElement ? document.exitFullscreen() : this.requestFullscreen())),
      )
    }
    menu.addEventListener('focusout', event => {
      if (!menu.contains(event.relatedTarget as Node | null)) menu.open = false
    })
    return menu
  }

  async #copy(what: 'Link' | 'Code', text: string): Promise<void> {
    if (await copy(text)) {
      write(this.#status, `${what} copied`)
      setTimeout(() => write(this.#status, ''), 3000)
    } else {
      this.#notice('copy', `The browser does not let this page write to the clipboard. The ${what.toLowerCase()}:\n${text}`)
    }
  }

  #saveText(kind: 'csv' | 'json', type: string): void {
    this.#guard(figure => download(this.#fileName(kind), new Blob([figure[kind]()], { type })))
  }

  #fileName(extension: string): string {
    return `${this.id || this.localName}${this.#timeline ? `-step-${this.#target}` : ''}.${extension}`
  }

  // --- Trouble -------------------------------------------------------------------------------------------------------------

  /** The only way into a live figure. What comes out as an error is a panic: refusals are caught where values are set. */
  #guard(action: (figure: Shell) => void): void {
    if (!this.#figure) return
    try {
      action(this.#figure)
    } catch (error) {
      this.#crash(error)
    }
  }

  #crash(error: unknown): void {
    this.#figure = undefined // dropped, not freed: after a panic nothing may be called on it
    this.#playing = false
    this.#crashes += 1
    const what = panicMessage(error)
    console.warn(`${this.localName}:`, error)
    if (this.#crashes === 1 && this.isConnected) {
      this.#notice('crash', `Something failed inside this figure (${what}). It was rebuilt as it was before.`)
      this.#rebuild()
    } else {
      this.#stopped = true
      this.#enable(false)
      this.#notice('crash', `Something failed inside this figure again (${what}), so it has stopped.`, 'Reset', () => this.reset())
    }
  }

  #notice(key: string, text: string, actionName?: string, action?: () => void): void {
    notice(this.#notices, key, text, actionName, action)
  }
}

function values(figure: Shell): Record<string, string> {
  return figure.values() as Record<string, string>
}
