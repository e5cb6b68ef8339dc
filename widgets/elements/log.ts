// A recorded log, mapped. Its program runs in a worker, so that the page answers at once whatever the size of the log. That program is
// large, and many a reader never maps a log: it is fetched when the first thing is asked of the figure.
import type { Controls } from './controls'
import { h, write } from './dom'
import { keepPage, takeDrops } from './drops'
import { FigureElement } from './figure-element'
import { fetchExample } from './files'
import { AT_REST } from './generated/log'
import type { Answer, Command, Frame, Phase, Run, SavedFile } from './host'
import { takeGestures } from './map-gestures'
import type { MenuItem } from './menu'
import { register } from './parameters'
import type { ParamSpec, Readout } from './shell'
import type { Key } from './words'

const ZOOM = 1.4 // magnified by one press of + or −
const PAN = 60 // [px] moved by one arrow key
const MINUTE = 60

/** What the buttons save. */
const FILES: [SavedFile, Key][] = [
  ['map.png', 'save_map'],
  ['map.ros', 'save_ros'],
  ['path.tum', 'save_path'],
  ['report.json', 'save_report'],
]

const MIDDLE = { x: NaN, y: NaN }
const MOVES: Record<string, Command> = {
  '+': { do: 'zoom', factor: ZOOM, ...MIDDLE },
  '−': { do: 'zoom', factor: 1 / ZOOM, ...MIDDLE },
  '0': { do: 'fit' },
  ArrowLeft: { do: 'pan', right: PAN, down: 0 },
  ArrowRight: { do: 'pan', right: -PAN, down: 0 },
  ArrowUp: { do: 'pan', right: 0, down: PAN },
  ArrowDown: { do: 'pan', right: 0, down: -PAN },
}
const SAME_KEYS: Record<string, string> = { '=': '+', '-': '−', _: '−' }

/** What is shown before its program is there. */
export interface AtRest {
  title: string
  params: ParamSpec[]
  readouts: Readout[]
  describe: string
}

export class FastslamLog extends FigureElement {
  static override heavy = true

  #phase: Phase = 'empty'
  #source: { file: Blob; name: string; start: boolean } | undefined // read again by another worker, after a move of the element
  #sent: unknown // the source that this worker was given
  #lived = false // there has been a frame
  #unfit = '' // what was said to stand in the way
  #left = new AbortController()

  readonly #zoom = h(
    'div',
    { class: 'zoom', role: 'group' },
    ...(['+', '−', '0'] as const).map(key => {
      const element = button(() => this.send(MOVES[key]!))
      element.textContent = key === '0' ? '⤢' : key
      this.words.always(() => (element.ariaLabel = element.title = this.words.say(({ '+': 'magnify', '−': 'make_smaller', '0': 'show_whole' } as const)[key])))
      return element
    }),
  )
  readonly #file = h('input', { type: 'file', class: 'hidden', accept: '.clf,.log,.gz,.txt', id: 'file', tabindex: '-1', 'aria-hidden': 'true' })
  readonly #go = button(() => this.#playPause(), { class: 'primary', part: 'button play' })
  readonly #halt = this.#named('stop', () => this.stop(), { part: 'button stop' })
  readonly #progress = h('progress', { value: '0' })
  readonly #position = h('span', { class: 'position' })
  readonly #saves = FILES.map(([what, name]) => this.#named(name, () => this.send({ do: 'save', what })))

  constructor() {
    super()
    this.playback.stay()
    this.stage.classList.add('map')
    const [idle, what, save] = [h('b'), h('span'), h('span', { class: 'name' })]
    this.canvas.element.after(this.#zoom, h('p', { class: 'idle' }, idle, what))
    this.panes.before(this.#sources(), this.messages.element)
    const run = h('div', { class: 'work run', part: 'transport', role: 'group' }, this.#go, this.#halt, this.#progress, this.#position)
    const saves = h('div', { class: 'work saves', part: 'saves', role: 'group' }, save, ...this.#saves)
    this.panes.append(run)
    this.body.append(saves)
    this.words.always(() => {
      const { words } = this
      write(idle, words.say('no_log'))
      write(what, words.say('no_log_what'))
      write(save, words.say('save'))
      saves.ariaLabel = words.say('save')
      run.ariaLabel = words.say('mapping')
      this.#zoom.ariaLabel = words.say('magnification')
      this.#progress.ariaLabel = words.say('scans_mapped')
    })
    this.#showPhase(undefined, 0, 0)
    // What comes after a press: nothing moves away from under it.
    for (const type of ['click', 'keyup', 'dragenter'] as const) this.body.addEventListener(type, () => void this.start())
    for (const type of ['click', 'keydown', 'input', 'change', 'drop'] as const) this.body.addEventListener(type, () => (this.events.cause = 'reader'))
    takeDrops(this.body, file => void this.open(file))
    takeGestures(this.canvas.element, command => this.send(command))
  }

  override connectedCallback(): void {
    super.connectedCallback()
    this.#left = new AbortController()
    keepPage(this.#left.signal)
  }

  override disconnectedCallback(): void {
    this.#left.abort()
    this.#sent = undefined
    super.disconnectedCallback()
  }

  // --- What a page's script may use ------------------------------------------------------------------------------------

  /** Reads a log. Nothing is mapped yet, unless it is to start at once. */
  async open(file: Blob, name = file instanceof File ? file.name : 'log', start = false): Promise<void> {
    this.messages.set('file', '')
    this.crashes = 0 // another log, another chance
    this.#source = { file, name, start }
    write(this.status, this.words.say('reading', { name }))
    await this.start()
    this.#sendSource()
  }

  /** Reads and maps the log that comes with the figure. */
  async example(): Promise<void> {
    this.events.cause = 'page'
    write(this.status, this.words.say('loading_example'))
    const response = await fetchExample().catch(() => undefined)
    if (response?.ok) return this.open(await response.blob(), this.words.say('the_example'), true)
    write(this.status, '')
    const text = response ? this.words.say('example_answered', { status: response.status }) : this.words.say('example_unreachable')
    this.messages.set('file', text, this.words.say('try_again'), () => void this.example())
  }

  /** Maps from the start, or goes on after a pause. */
  override play(): void {
    this.events.cause = 'page'
    this.send({ do: 'run' })
  }

  override pause(): void {
    this.send({ do: 'pause' })
  }

  /** Ends the mapping where it is. What is mapped can still be looked at and saved. */
  stop(): void {
    this.send({ do: 'stop' })
  }

  override get playing(): boolean {
    return this.#phase === 'running'
  }

  // --- Life ----------------------------------------------------------------------------------------------------------------

  protected override get wanted(): boolean {
    // What is said before it is there is English.
    return this.settings.any || this.#source !== undefined || this.words.language !== 'en'
  }

  /** All there is before anything was asked. */
  protected override approached(): void {
    this.canvas.release()
    if (this.controls) return
    const { params: specs, readouts, describe: sentence } = AT_REST
    const values = Object.fromEntries(specs.map(spec => [spec.name, spec.default]))
    const rest = { done: 0, language: 'en', specs, values, query: '', step: 0, target: 0, last: 0, busy: false, readouts, handles: [], rooms: [], sentence, changed: false }
    const frame: Frame = { ...rest, trace: undefined, layout: undefined, picture: undefined, run: { phase: 'empty', log: '', left: NaN, unfit: undefined } }
    this.present(frame)
    if (this.wanted) return // where more is on its way, that will be told
    this.events.tell(frame, true)
    this.events.send()
  }

  protected override begun(): void {
    this.#sent = undefined
    this.#sendSource()
  }

  /** Gives the worker what is to be read, once: whether it was there before or has just begun. */
  #sendSource(): void {
    if (!this.alive || !this.#source || this.#sent === this.#source) return
    this.#sent = this.#source
    this.send({ do: 'open', ...this.#source })
    this.#source.start = false // after a move of the element it waits for its reader
  }

  override hear(answer: Answer): void {
    if (answer.told === 'reading') return write(this.status, this.words.say('reading_megabytes', { megabytes: answer.megabytes }))
    if (answer.told !== 'refused' || answer.file === undefined) return super.hear(answer)
    write(this.status, '')
    if (this.#source?.name === answer.file) this.#source = undefined
    this.messages.set('file', this.words.say('cannot_map', { file: answer.file, why: this.words.tell(answer.message) }), this.words.say('run_example'), () => void this.example())
  }

  /** What was mapped is lost with the worker; the log, the settings and the example are not. */
  protected override failed(why: string, again: boolean): void {
    write(this.status, '')
    // What was refused before it said a word would be refused again.
    if (!this.#lived) return this.refuseToLive(why)
    if (again) this.#source = undefined
    const kept = this.#source ? ` ${this.words.say('log_open_again')}` : ''
    this.messages.set('file', this.words.say('mapping_failed', { why }) + kept, this.words.say('run_example'), () => void this.example())
    this.restart()
  }

  // --- What is shown -------------------------------------------------------------------------------------------------------

  protected override placeControls(controls: Controls): void {
    controls.transport.setAttribute('aria-label', this.words.say('settings_of_draw'))
    super.placeControls(controls)
  }

  protected override present(frame: Frame): void {
    super.present(frame)
    if (!this.alive) return
    this.#lived = true
    this.#showUnfit(frame.run!)
    write(this.status, frame.run!.phase === 'empty' ? '' : frame.run!.log)
  }

  protected override showPlayback({ step, last, run }: Frame): void {
    this.#showPhase(run, step, last)
    this.controls!.showPosition(0, 0, 0, false)
    this.controls!.transport.setAttribute('aria-label', this.words.say('settings_of_draw'))
  }

  /** Why it cannot be started; told once, not with every picture. */
  #showUnfit({ unfit, log }: Run): void {
    const [parameter, message] = unfit ?? ['', '']
    if (message === this.#unfit) return
    this.#unfit = message
    if (parameter !== 'lenient') return this.messages.set('unfit', message)
    this.messages.set('unfit', `${log}, ${message}.`, this.words.say('skip_malformed'), () => this.setParameter('lenient', 'on'))
  }

  #showPhase(run: Run | undefined, step: number, last: number): void {
    const held = document.activeElement === this && this.shadowRoot!.activeElement
    const phase = (this.#phase = run?.phase ?? 'empty')
    const underWay = phase === 'running' || phase === 'paused'
    write(this.#go, this.words.say(({ running: 'pause', paused: 'resume', ready: 'start', empty: 'start', stopped: 'start_again', done: 'start_again' } as const)[phase]))
    this.#go.disabled = phase === 'empty' || run?.unfit !== undefined
    this.#halt.disabled = !underWay
    // The focus does not fall out of the figure with the button that had it.
    if (held === this.#halt && !underWay) this.#go.focus()
    this.#progress.max = Math.max(last, 1)
    this.#progress.value = step
    const time = phase === 'running' && step > 0 ? ` · ${this.words.say('time_left', { time: duration(run!.left) })}` : ''
    write(this.#position, last > 0 ? `${step} / ${last}${time}` : '')
    for (const save of this.#saves) save.disabled = step === 0
    if (this.controls) this.controls.settings.inert = this.controls.transport.inert = underWay
    this.#zoom.inert = phase === 'empty'
  }

  #sources(): HTMLElement {
    this.#file.addEventListener('change', () => {
      const file = this.#file.files?.[0]
      this.#file.value = '' // the same file may be chosen again
      if (file) void this.open(file)
    })
    const drop = h('span', { class: 'name' })
    this.words.always(() => write(drop, this.words.say('or_drop')))
    return h(
      'div',
      { class: 'work source', part: 'source' },
      this.#named('run_example', () => void this.example(), { part: 'button example' }),
      this.#named('choose_log', () => this.#file.click()),
      this.#file,
      drop,
    )
  }

  // --- Reader's input ----------------------------------------------------------------------------------------------------

  #playPause(): void {
    if (this.playing) this.pause()
    else this.play()
  }

  protected override get keysHelp(): string {
    return this.words.say('map_keys')
  }

  protected override keyAction(key: string, target: HTMLElement): (() => void) | undefined {
    if (target !== this.stage || this.#phase === 'empty') return undefined
    if (key === ' ') return () => this.#playPause()
    const command = MOVES[SAME_KEYS[key] ?? key]
    return command && (() => this.send(command))
  }

  /** The log itself is in none of it: it is a file of the reader's. */
  protected override menuItems(): MenuItem[] {
    return super.menuItems().filter(({ name }) => !['CSV', 'JSON'].some(kind => name === this.words.say('save_data', { kind })))
  }

  /** A button of words. */
  #named(name: Key, act: () => void, attributes: Record<string, string> = {}): HTMLButtonElement {
    const element = button(act, attributes)
    this.words.always(() => write(element, this.words.say(name)))
    return element
  }

  protected override fileName(extension: string): string {
    return `${this.id || this.localName}.${extension}`
  }
}

function button(act: () => void, attributes: Record<string, string> = {}): HTMLButtonElement {
  const element = h('button', { type: 'button', part: 'button', ...attributes })
  element.addEventListener('click', act)
  return element
}

/** In words as short as the number is rough. */
function duration(seconds: number): string {
  if (seconds < 1.5) return '1 s'
  return seconds < 1.5 * MINUTE ? `${Math.round(seconds)} s` : `${Math.round(seconds / MINUTE)} min`
}

register('fastslam-log', FastslamLog)
