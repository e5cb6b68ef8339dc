// A recorded log, mapped. Unlike the other figures it lives in a worker: the file is read, the filter runs and the picture is painted
// there, so that the page answers at once whatever the size of the log. Its program is large, and many a reader never maps a log: it is
// fetched when the first thing is asked of the figure.
import { sheet, WORDS, type Cause } from './base'
import { Controls } from './controls'
import { h, icon, write } from './dom'
import { logProgram, type ParamSpec, type Readout } from './engine'
import { AT_REST } from './generated/log'
import { fetchExample } from './files'
import { release, reserve } from './heights'
import { hire, refused } from './jobs'
import { keepKeys } from './keys'
import { linkedQuery, linkTo } from './link'
import type { Ask, Phase, Save, Shown, Told } from './log-work'
import { notice } from './notices'
import { locked, unlockable } from './options'
import { fromText, isParameter, register, takeEarlyProperties, toText, watchUnknown } from './parameters'
import { showReadouts } from './readouts'
import { copy, download } from './save'
import { onThemeChange, themeName } from './theme'

const WIDE = 620 // [px] from here on the settings are open at first
const STEP = 1.4 // magnified by one press of + or −
const SHIFT = 60 // [px] moved by one arrow key
const SAID = 1000 // [ms] between two sentences of a log under way: what an eye can read
const MINUTE = 60

/** What the buttons save. */
const FILES: [Save, string][] = [
  ['map.png', 'Map (PNG)'],
  ['map.ros', 'Map for ROS (PGM, YAML)'],
  ['path.tum', 'Path (TUM)'],
  ['report.json', 'Report (JSON)'],
]

/** What is shown before its program is there. */
export interface AtRest {
  title: string
  params: ParamSpec[]
  readouts: Readout[]
  describe: string
}

export class FastslamLog extends HTMLElement {
  #worker: Worker | undefined
  #starting: Promise<void> | undefined
  #phase: Phase = 'empty'
  #query: string | undefined // the settings: what a link holds; undefined until there was a link or a worker
  #waiting = new Map<string, string>() // settings given while there is no worker: the next one begins with them
  #given = new Map<string, string>() // settings that a script gave by property, since the attribute was last set
  #asked = new Map<string, { text: string; asks: number }>() // settings on their way to the worker, and which message took them
  #asks = 0 // messages sent to this worker
  #source: { file: Blob; name: string; start: boolean } | undefined // read again by another worker, after a move of the element
  #opened: unknown // the source that this worker was given
  #cause: Cause = 'page' // of what is told next
  #events: CustomEvent[] = [] // to be sent last of all
  #specs = AT_REST.params
  #controls: Controls | undefined
  #shown: Shown | undefined
  #frame = 0
  #saidAt = -Infinity // [ms]
  #unfit = '' // what was said to stand in the way
  #cssWidth = 0
  #deviceWidth = 0
  #disconnected = new AbortController()

  readonly #heading = h('p', { class: 'title', part: 'title', id: 'title' }, 'A building from a log')
  readonly #status = h('span', { class: 'status', role: 'status' })
  readonly #canvas = h('canvas', { part: 'canvas', role: 'img', 'aria-labelledby': 'title', 'aria-describedby': 'sentence' })
  readonly #zoom = h(
    'div',
    { class: 'zoom', role: 'group', 'aria-label': 'Magnification' },
    ...(['+', '−', '0'] as const).map(key => {
      const name = { '+': 'Magnify', '−': 'Make smaller', '0': 'Show the whole' }[key]
      return this.#button(key === '0' ? '⤢' : key, () => this.#key(key), { 'aria-label': name, title: name })
    }),
  )
  readonly #stage = h(
    'div',
    { class: 'stage map', part: 'stage', role: 'group', tabindex: '0', 'aria-labelledby': 'title', 'aria-describedby': 'keys' },
    this.#canvas,
    this.#zoom,
    h('p', { class: 'idle' }, h('b', {}, 'No log is open'), 'Run the example, or choose or drop a log.'),
    h('div', { class: 'fallback' }, h('slot')),
  )
  readonly #file = h('input', { type: 'file', class: 'hidden', accept: '.clf,.log,.gz,.txt', id: 'file', tabindex: '-1', 'aria-hidden': 'true' })
  readonly #go = this.#button('Start', () => this.#playPause(), { class: 'primary', part: 'button play' })
  readonly #halt = this.#button('Stop', () => this.stop(), { part: 'button stop' })
  readonly #progress = h('progress', { 'aria-label': 'Scans mapped', value: '0' })
  readonly #left = h('span', { class: 'position' })
  readonly #saves = FILES.map(([what, name]) => this.#button(name, () => this.#ask({ ask: 'save', what })))
  readonly #readouts = h('dl', { class: 'readouts', part: 'readouts' })
  readonly #sentence = h('p', { class: 'sentence', part: 'sentence', id: 'sentence', 'aria-live': 'polite' })
  readonly #notices = h('div', { class: 'notices', part: 'notices', role: 'alert' })
  readonly #menu = this.#makeMenu()
  readonly #body = h('div', { class: 'figure', part: 'figure', role: 'group', 'aria-labelledby': 'title', lang: WORDS })

  readonly #seen = new IntersectionObserver(entries => entries.some(entry => entry.isIntersecting) && this.#onSeen())
  readonly #sizes = new ResizeObserver(entries => this.#onResize(entries[entries.length - 1]!))

  constructor() {
    super()
    const root = this.attachShadow({ mode: 'open' })
    root.adoptedStyleSheets = [sheet]
    const choose = this.#button('Choose a log …', () => this.#file.click())
    this.#body.append(
      h('div', { class: 'head' }, this.#heading, this.#status, this.#menu),
      h(
        'div',
        { class: 'work source', part: 'source' },
        this.#button('Run the example', () => void this.example(), { part: 'button example' }),
        choose,
        this.#file,
        h('span', { class: 'name' }, 'or drop one here: CARMEN (.clf, .log), also .gz. It is read and mapped by this page; nothing leaves your machine.'),
      ),
      this.#notices,
      this.#stage,
      h(
        'p',
        { class: 'hidden', id: 'keys' },
        'Arrow keys move the map, plus and minus magnify it, 0 shows the whole. Space pauses and goes on. Two fingers move and magnify it, one scrolls the page.',
      ),
      h('div', { class: 'work run', part: 'transport', role: 'group', 'aria-label': 'Mapping' }, this.#go, this.#halt, this.#progress, this.#left),
      this.#sentence,
      this.#readouts,
      h('div', { class: 'work saves', part: 'saves', role: 'group', 'aria-label': 'Save' }, h('span', { class: 'name' }, 'Save'), ...this.#saves),
    )
    root.append(this.#body)
    this.#showPhase('empty')
    this.#file.addEventListener('change', () => {
      const file = this.#file.files?.[0]
      this.#file.value = '' // the same file may be chosen again
      if (file) void this.open(file)
    })
    // What comes after a press: nothing moves away from under it.
    for (const type of ['click', 'keyup', 'dragenter'] as const) this.#body.addEventListener(type, () => void this.#start())
    for (const type of ['click', 'keydown', 'input', 'change', 'drop'] as const) this.#body.addEventListener(type, () => (this.#cause = 'reader'))
    keepKeys(this.#body, event => this.#onKey(event))
    this.#takeDrops()
    this.#takeMoves()
    watchUnknown(this, name => this.#onAttribute(name))
  }

  attributeChangedCallback(name: string): void {
    this.#onAttribute(name)
  }

  connectedCallback(): void {
    this.#disconnected = new AbortController()
    const { signal } = this.#disconnected
    onThemeChange(() => this.#resize(), signal)
    addEventListener('hashchange', () => this.followLink(), { signal })
    keepPage(signal)
    this.#seen.observe(this)
    try {
      this.#sizes.observe(this.#canvas, { box: 'device-pixel-content-box' })
    } catch {
      this.#sizes.observe(this.#canvas) // Safari
    }
    takeEarlyProperties(this)
    if (this.#query === undefined) this.followLink() // an element that was only moved goes on with its settings
    if (this.#waiting.size > 0) this.#lookAgain()
  }

  disconnectedCallback(): void {
    this.#disconnected.abort()
    this.#seen.disconnect()
    this.#sizes.disconnect()
    for (const [name, { text }] of this.#asked) this.#waiting.set(name, text) // it may not have come to them
    this.#dismiss()
  }

  // --- What a page's script may use ------------------------------------------------------------------------------------

  /** Reads a log. Nothing is mapped yet, unless it is to start at once. */
  async open(file: Blob, name = file instanceof File ? file.name : 'log', start = false): Promise<void> {
    notice(this.#notices, 'file', '')
    this.#source = { file, name, start }
    write(this.#status, `Reading ${name} …`)
    await this.#start()
    this.#openSource()
  }

  /** Gives the worker what is to be read, once: whether it was there before or has just begun. */
  #openSource(): void {
    if (!this.#worker || !this.#source || this.#opened === this.#source) return
    this.#opened = this.#source
    this.#ask({ ask: 'open', ...this.#source })
    this.#source.start = false // after a move of the element it waits for its reader
  }

  /** Reads and maps the log that comes with the figure. */
  async example(): Promise<void> {
    this.#cause = 'page'
    write(this.#status, 'Loading the example …')
    const response = await fetchExample().catch(() => undefined)
    if (response?.ok) return this.open(await response.blob(), 'the example', true)
    write(this.#status, '')
    const why = response ? `the server answered ${response.status}` : 'the network is down, or a rule blocks it'
    this.#notice('file', `The example could not be fetched (${why}).`, 'Try again', () => void this.example())
  }

  /** Maps from the start, or goes on after a pause. */
  play(): void {
    this.#cause = 'page'
    this.#ask({ ask: 'run' })
  }

  pause(): void {
    this.#ask({ ask: 'pause' })
  }

  /** Ends the mapping where it is. What is mapped can still be looked at and saved. */
  stop(): void {
    this.#ask({ ask: 'stop' })
  }

  /** Back to the defaults. The log stays open. */
  reset(): void {
    this.#cause = 'page'
    void this.#order({ ask: 'load', query: '' })
  }

  get playing(): boolean {
    return this.#phase === 'running'
  }

  /** @internal As the attribute of this name would. */
  setParameter(name: string, value: unknown): void {
    this.#cause = 'page'
    this.#given.set(name, toText(value))
    this.#give(name, toText(value))
  }

  /** @internal */
  getParameter(name: string): unknown {
    const given = this.#asked.get(name)?.text ?? this.#waiting.get(name) ?? this.#shown?.values[name]
    const before = this.#query === undefined ? this.getAttribute(name) : new URLSearchParams(this.#query).get(name)
    return fromText(given ?? before ?? this.#specs.find(spec => spec.name === name)?.default)
  }

  /** Height [css px] that shows all of the figure at its present width. */
  get naturalHeight(): number {
    return this.#body.scrollHeight + this.#body.offsetHeight - this.#body.clientHeight
  }

  /** The settings, as a link has them: name=value&… */
  get state(): string {
    return this.#query ?? ''
  }

  set state(query: string) {
    this.#cause = 'page'
    this.#waiting.clear()
    this.#query = query
    if (this.#worker) this.#ask({ ask: 'load', query })
    else if (this.isConnected) void this.#start() // which begins with it
  }

  /** The address of this page with the settings. The log itself is not in it: it is a file of the reader's. */
  get link(): string {
    return linkTo(this, this.state)
  }

  // --- The worker --------------------------------------------------------------------------------------------------------

  #onSeen(): void {
    if (!this.#controls) this.#introduce()
    release(this.#body)
    if (this.#query || this.#source || this.#waiting.size > 0 || this.getAttributeNames().some(isParameter)) void this.#start()
    this.#send()
  }

  async #start(): Promise<void> {
    if (this.#worker) return
    await (this.#starting ??= this.#begin())
    this.#starting = undefined
  }

  async #begin(): Promise<void> {
    try {
      if (!this.#status.textContent) write(this.#status, 'Loading …')
      const program = await logProgram()
      if (!this.isConnected) return
      const worker = hire()
      this.#worker = worker
      worker.addEventListener('message', ({ data }: MessageEvent<Told>) => worker === this.#worker && this.#hear(data))
      worker.addEventListener('error', event => {
        event.preventDefault()
        if (worker === this.#worker) this.#die(refused(event.message).message)
      })
      this.#ask({ ask: 'begin', program, tag: this.localName, query: this.state })
      if (this.#query === undefined) for (const name of this.getAttributeNames().filter(isParameter)) this.#set(name, this.getAttribute(name)!)
      for (const [name, text] of this.#waiting) this.#set(name, text)
      this.#waiting.clear()
      this.#resize()
      this.#stage.classList.remove('still')
      notice(this.#notices, 'start', '')
      this.#openSource()
    } catch (error) {
      write(this.#status, '')
      this.#stage.classList.add('still')
      this.#notice('start', `This figure is not live here: ${(error as Error).message}.`, 'Try again', () => void this.#start())
    }
  }

  #ask(ask: Ask): void {
    if (!this.#worker) return
    this.#asks += 1
    this.#worker.postMessage(ask)
  }

  #set(name: string, text: string): void {
    this.#ask({ ask: 'set', name, value: text })
    this.#asked.set(name, { text, asks: this.#asks })
  }

  /** A setting, for the worker or, until there is one, to be kept for it. */
  #give(name: string, text: string): void {
    if (this.#worker) return this.#set(name, text)
    this.#waiting.set(name, text)
    if (this.isConnected) this.#lookAgain()
  }

  /** Tells again whether it is in view. */
  #lookAgain(): void {
    this.#seen.unobserve(this)
    this.#seen.observe(this)
  }

  /** The same for what may be the first thing asked. */
  async #order(ask: Ask): Promise<void> {
    await this.#start()
    this.#ask(ask)
  }

  #dismiss(): void {
    this.#worker?.terminate()
    this.#worker = undefined
    cancelAnimationFrame(this.#frame)
    this.#frame = 0
    this.#shown = undefined
    this.#asked.clear()
    this.#asks = 0
    this.#opened = undefined
    this.#unfit = ''
    notice(this.#notices, 'unfit', '')
  }

  #hear(told: Told): void {
    switch (told.told) {
      case 'shown':
        this.#shown = told.shown
        for (const [name, { asks }] of this.#asked) if (asks <= told.shown.asks) this.#asked.delete(name)
        // Once a frame, and not at all while nobody looks.
        this.#frame ||= requestAnimationFrame(() => this.#show())
        break
      case 'reading':
        write(this.#status, `Reading, ${told.megabytes} MB …`)
        break
      case 'refused':
        if (told.file !== undefined) {
          write(this.#status, '')
          if (this.#source?.name === told.file) this.#source = undefined
          this.#notice('file', `${told.file} cannot be mapped: ${told.message}.`, 'Run the example', () => void this.example())
        } else {
          this.#notice(told.parameter, told.message)
          this.#controls?.showValues(this.#specs, this.#shown?.values ?? {}, told.parameter)
        }
        break
      case 'saved':
        download(told.name, told.data)
        break
      case 'failed':
        this.#die(told.message)
    }
  }

  /** What ran in the worker is lost with it; the figure and the example are not. */
  #die(why: string): void {
    const lived = this.#shown !== undefined
    this.#dismiss()
    this.#source = undefined
    console.warn(`${this.localName}:`, why)
    write(this.#status, '')
    this.#showPhase('empty')
    // What was refused before it said a word would be refused again.
    if (!lived) return this.#notice('start', `This figure is not live here: ${why}.`, 'Try again', () => void this.#start())
    this.#notice('file', `Something failed while this log was mapped (${why}), so it has stopped.`, 'Run the example', () => void this.example())
    void this.#start()
  }

  // --- What is shown -------------------------------------------------------------------------------------------------------

  #show(): void {
    this.#frame = 0
    const shown = this.#shown
    if (!shown) return
    const { picture, phase } = shown
    if (!this.#controls) this.#introduce() // asked by a script or a link before anybody has seen it
    this.#specs = shown.specs
    const changed = this.#query !== undefined && this.#query !== shown.query
    this.#query = shown.query
    if (picture) {
      const { width, height, cssHeight } = picture
      if (this.#canvas.width !== width) this.#canvas.width = width
      if (this.#canvas.height !== height) this.#canvas.height = height
      const css = `${cssHeight}px`
      if (this.#canvas.style.height !== css) this.#canvas.style.height = css
      const pixels = new Uint8ClampedArray(picture.pixels)
      this.#canvas.getContext('2d', { alpha: false })!.putImageData(new ImageData(pixels, width, height), 0, 0)
      this.#body.style.setProperty('--_paper', `rgb(${pixels[0]} ${pixels[1]} ${pixels[2]})`)
      this.#stage.classList.add('live')
      shown.picture = undefined // painted once
    }
    showReadouts(this.#readouts, shown.readouts)
    this.#controls!.showValues(shown.specs, shown.values)
    this.#showUnfit(shown)
    this.#showPhase(phase, shown.step, shown.last, shown.left, shown.unfit !== undefined)
    write(this.#status, phase === 'empty' ? '' : shown.log)
    this.#say(shown.sentence)
    if (changed) this.#tell('fastslam-change', shown)
    this.#tell('fastslam-step', shown)
    this.#send()
  }

  /** Why it cannot be started; told once, not with every picture. */
  #showUnfit({ unfit, log }: Shown): void {
    const [parameter, message] = unfit ?? ['', '']
    if (message === this.#unfit) return
    this.#unfit = message
    if (parameter !== 'lenient') return this.#notice('unfit', message)
    this.#notice('unfit', `${log}, ${message}.`, 'Skip malformed lines', () => this.#set('lenient', 'on'))
  }

  #showPhase(phase: Phase, step = 0, last = 0, left = 0, unfit = false): void {
    const held = document.activeElement === this && this.shadowRoot!.activeElement
    this.#phase = phase
    const under = phase === 'running' || phase === 'paused'
    write(this.#go, phase === 'running' ? 'Pause' : phase === 'paused' ? 'Resume' : phase === 'ready' || phase === 'empty' ? 'Start' : 'Start again')
    this.#go.disabled = phase === 'empty' || unfit
    this.#halt.disabled = !under
    // The focus does not fall out of the figure with the button that had it.
    if (held === this.#halt && !under) this.#go.focus()
    this.#progress.max = Math.max(last, 1)
    this.#progress.value = step
    const time = phase === 'running' && step > 0 ? ` · ${duration(left)} left` : ''
    write(this.#left, last > 0 ? `${step} / ${last}${time}` : '')
    for (const button of this.#saves) button.disabled = step === 0
    if (this.#controls) this.#controls.settings.inert = this.#controls.transport.inert = under
    this.#zoom.inert = phase === 'empty'
  }

  /** Read out when nothing moves. */
  #say(sentence: string): void {
    const now = performance.now()
    const running = this.#phase === 'running'
    if (running && now < this.#saidAt + SAID) return
    this.#saidAt = now
    this.#sentence.setAttribute('aria-live', running ? 'off' : 'polite')
    write(this.#sentence, sentence)
  }

  /** Once: all there is before anything was asked. */
  #introduce(): void {
    const { title, params, readouts, describe } = AT_REST
    write(this.#heading, title)
    showReadouts(this.#readouts, readouts)
    write(this.#sentence, describe)
    const idle = () => undefined
    const change = (name: string, value: string) => {
      notice(this.#notices, name, '')
      this.#give(name, value)
      void this.#start()
    }
    const controls = new Controls(params, { playPause: idle, step: idle, stepBack: idle, seek: idle, pace: idle, reset: () => this.reset(), change })
    controls.showPosition(0, 0, false, false)
    const values = Object.fromEntries(params.map(spec => [spec.name, spec.default]))
    controls.showValues(params, values)
    controls.transport.setAttribute('aria-label', 'Settings of the draw')
    controls.settings.open = this.clientWidth >= WIDE
    this.#body.append(controls.view, controls.transport, controls.settings)
    this.#controls = controls
    this.#lock()
    // Where more is on its way, that will be told.
    if (!this.#starting) this.#tell('fastslam-step', { step: 0, last: 0, values, readouts, phase: 'empty' })
  }

  #tell(type: string, { step, last, values, readouts, phase }: Pick<Shown, 'step' | 'last' | 'values' | 'readouts' | 'phase'>): void {
    const detail = { step, last, by: this.#cause, values, readouts, phase }
    this.#events.push(new CustomEvent(type, { bubbles: true, composed: true, detail }))
  }

  /** Always the last thing done: who listens may remove, reset, move or clone this figure. */
  #send(): void {
    for (const event of this.#events.splice(0)) this.dispatchEvent(event)
  }

  /** Readers cannot change what the author has locked. */
  #lock(): void {
    const names = AT_REST.params.map(({ name }) => name)
    const wish = locked(this.getAttribute('lock'), names)
    this.#controls?.lock(wish.locked)
    this.#notice('lock', unlockable(wish.unknown, names))
  }

  #notice(key: string, text: string, action?: string, act?: () => void): void {
    notice(this.#notices, key, text, action, act)
  }

  // --- Size, theme, links ------------------------------------------------------------------------------------------------

  #onResize(entry: ResizeObserverEntry): void {
    const css = entry.contentRect.width
    if (!this.#controls) reserve(this.#body, this)
    let device = Math.round(css * devicePixelRatio)
    const box = entry.devicePixelContentBoxSize?.[0]
    if (box && Math.abs(box.inlineSize - device) < 2) device = box.inlineSize
    if (css === this.#cssWidth && device === this.#deviceWidth) return
    this.#cssWidth = css
    this.#deviceWidth = device
    this.#resize()
  }

  #resize(): void {
    const theme = themeName(this.getAttribute('theme'))
    if (this.#cssWidth > 0) this.#ask({ ask: 'size', css: this.#cssWidth, device: this.#deviceWidth, theme })
  }

  #onAttribute(name: string): void {
    if (name === 'theme') return this.#resize()
    if (name === 'lock') return this.#lock()
    if (!isParameter(name)) return
    const text = this.getAttribute(name)
    const value = text ?? this.#specs.find(spec => spec.name === name)?.default
    this.#cause = 'page'
    this.#given.delete(name)
    if (this.#worker || this.#query !== undefined) {
      if (value !== undefined) this.#give(name, value)
    } else {
      this.#waiting.delete(name) // the attribute itself is read at the start
      if (this.isConnected) this.#lookAgain()
    }
  }

  /** @internal Takes the settings that the page's address holds for this figure, over what was given until now; but not those locked. */
  followLink(): void {
    const query = linkedQuery(this)
    if (query === undefined) return
    const settings = new URLSearchParams(query)
    const fixed = locked(this.getAttribute('lock'), AT_REST.params.map(({ name }) => name)).locked
    for (const { name, default: usual } of AT_REST.params.filter(({ name }) => fixed.has(name))) {
      const authored = this.#given.get(name) ?? this.getAttribute(name) ?? usual
      if ((settings.get(name) ?? usual) !== authored) this.#notice('locked', `${name} is fixed on this page`)
      settings.set(name, authored)
    }
    this.state = fixed.size > 0 ? settings.toString() : query // also where figures above grow, and push it out of sight again
    this.scrollIntoView({ block: 'nearest' })
  }

  // --- Reader's input ----------------------------------------------------------------------------------------------------

  #playPause(): void {
    if (this.#phase === 'running') this.pause()
    else this.play()
  }

  #key(key: string): boolean {
    const middle = { x: NaN, y: NaN }
    const asks: Record<string, Ask> = {
      '+': { ask: 'zoom', factor: STEP, ...middle },
      '−': { ask: 'zoom', factor: 1 / STEP, ...middle },
      '0': { ask: 'fit' },
      ArrowLeft: { ask: 'pan', right: SHIFT, down: 0 },
      ArrowRight: { ask: 'pan', right: -SHIFT, down: 0 },
      ArrowUp: { ask: 'pan', right: 0, down: SHIFT },
      ArrowDown: { ask: 'pan', right: 0, down: -SHIFT },
    }
    const ask = asks[key === '=' ? '+' : key === '-' || key === '_' ? '−' : key]
    if (!ask || this.#phase === 'empty') return false
    this.#ask(ask)
    return true
  }

  /** Whether the figure uses the key. */
  #onKey(event: KeyboardEvent): boolean {
    if (event.ctrlKey || event.metaKey || event.altKey) return false
    if (event.key === 'Escape' && this.#menu.open) {
      this.#menu.open = false
      this.#menu.querySelector('summary')!.focus()
      return true
    }
    if (event.target !== this.#stage || this.#phase === 'empty') return false
    const space = event.key === ' '
    if (space) this.#playPause()
    if (!space && !this.#key(event.key)) return false
    event.preventDefault()
    return true
  }

  #takeMoves(): void {
    // A mouse drags the map; a finger scrolls the page.
    let held: { x: number; y: number } | undefined
    this.#canvas.addEventListener('pointerdown', event => {
      if (event.pointerType === 'touch' || event.button !== 0) return
      this.#canvas.setPointerCapture(event.pointerId)
      held = { x: event.clientX, y: event.clientY }
    })
    this.#canvas.addEventListener('pointermove', ({ clientX: x, clientY: y }) => {
      if (!held) return
      this.#ask({ ask: 'pan', right: x - held.x, down: y - held.y })
      held = { x, y }
    })
    this.#canvas.addEventListener('lostpointercapture', () => (held = undefined))
    this.#canvas.addEventListener('dblclick', ({ offsetX: x, offsetY: y }) => this.#ask({ ask: 'zoom', factor: 2, x, y }))
    // The wheel scrolls the page, and magnifies with Ctrl: which is also what two fingers on a touchpad send.
    this.#canvas.addEventListener(
      'wheel',
      event => {
        if (!event.ctrlKey && !event.metaKey) return
        event.preventDefault()
        const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1
        this.#ask({ ask: 'zoom', factor: Math.exp(-0.004 * lines * Math.max(-150, Math.min(150, event.deltaY))), x: event.offsetX, y: event.offsetY })
      },
      { passive: false },
    )
    let fingers: { x: number; y: number; apart: number } | undefined
    const two = ({ touches: [a, b] }: TouchEvent) => {
      const box = this.#canvas.getBoundingClientRect()
      const [x, y] = [(a!.clientX + b!.clientX) / 2 - box.x, (a!.clientY + b!.clientY) / 2 - box.y]
      return { x, y, apart: Math.max(10, Math.hypot(a!.clientX - b!.clientX, a!.clientY - b!.clientY)) }
    }
    for (const type of ['touchstart', 'touchmove', 'touchend', 'touchcancel'] as const) {
      this.#canvas.addEventListener(
        type,
        event => {
          if (event.touches.length !== 2) return void (fingers = undefined)
          event.preventDefault()
          const now = two(event)
          if (fingers) {
            this.#ask({ ask: 'pan', right: now.x - fingers.x, down: now.y - fingers.y })
            this.#ask({ ask: 'zoom', factor: now.apart / fingers.apart, x: now.x, y: now.y })
          }
          fingers = now
        },
        { passive: false },
      )
    }
  }

  #takeDrops(): void {
    const files = (event: DragEvent) => event.dataTransfer?.types.includes('Files')
    for (const type of ['dragenter', 'dragover'] as const) {
      this.#body.addEventListener(type, event => {
        if (!files(event)) return
        event.preventDefault()
        this.#body.classList.add('dropping')
      })
    }
    this.#body.addEventListener('dragleave', event => {
      if (!this.#body.contains(event.relatedTarget as Node | null)) this.#body.classList.remove('dropping')
    })
    this.#body.addEventListener('drop', event => {
      this.#body.classList.remove('dropping')
      if (!files(event)) return
      event.preventDefault()
      const file = event.dataTransfer!.files[0]
      if (file) void this.open(file)
    })
  }

  #button(text: string, act: () => void, attributes: Record<string, string> = {}): HTMLButtonElement {
    const button = h('button', { type: 'button', part: 'button', ...attributes }, text)
    button.addEventListener('click', act)
    return button
  }

  #makeMenu(): HTMLDetailsElement {
    const item = (text: string, act: () => void) =>
      this.#button(text, () => {
        menu.open = false
        act()
      })
    const items = h(
      'div',
      { class: 'items' },
      item('Copy link to the settings', () => void this.#copyLink()),
      item('Save picture (PNG)', () => this.#shown && this.#canvas.toBlob(blob => blob && download(`${this.localName}.png`, blob))),
    )
    const summary = h('summary', { 'aria-label': 'Menu', title: 'Menu', part: 'button menu' }, icon('more'))
    const menu = h('details', { class: 'menu', part: 'menu' }, summary, items)
    if (document.fullscreenEnabled) {
      items.append(item('Full screen', () => void (document.fullscreenElement ? document.exitFullscreen() : this.requestFullscreen())))
    }
    menu.addEventListener('focusout', event => {
      if (!menu.contains(event.relatedTarget as Node | null)) menu.open = false
    })
    return menu
  }

  async #copyLink(): Promise<void> {
    if (await copy(this.link)) write(this.#status, 'Link copied')
    else this.#notice('copy', `The browser does not let this page write to the clipboard. The link: ${this.link}`)
  }
}

/**
 * A log dropped beside the figure would make the browser leave the page and show the file. Zones of the page's own that take files,
 * boxes for files and editors are left alone.
 */
function keepPage(signal: AbortSignal): void {
  for (const type of ['dragover', 'drop'] as const) {
    addEventListener(
      type,
      event => {
        const target = event.composedPath()[0]
        if (event.defaultPrevented || !event.dataTransfer?.types.includes('Files')) return
        if (target instanceof HTMLElement && (target.matches('input, textarea') || target.isContentEditable)) return
        event.preventDefault()
        event.dataTransfer.dropEffect = 'none'
      },
      { signal },
    )
  }
}

/** In words as short as the number is rough. */
function duration(seconds: number): string {
  if (seconds < 1.5) return '1 s'
  return seconds < 1.5 * MINUTE ? `${Math.round(seconds)} s` : `${Math.round(seconds / MINUTE)} min`
}

register('fastslam-log', FastslamLog)
