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

const ZOOM = 1.4 // magnified by one press of + or −
const PAN = 60 // [px] moved by one arrow key
const MINUTE = 60

/** What the buttons save. */
const FILES: [SavedFile, string][] = [
  ['map.png', 'Map (PNG)'],
  ['map.ros', 'Map for ROS (PGM, YAML)'],
  ['path.tum', 'Path (TUM)'],
  ['report.json', 'Report (JSON)'],
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
    { class: 'zoom', role: 'group', 'aria-label': 'Magnification' },
    ...(['+', '−', '0'] as const).map(key => {
      const name = { '+': 'Magnify', '−': 'Make smaller', '0': 'Show the whole' }[key]
      return button(key === '0' ? '⤢' : key, () => this.send(MOVES[key]!), { 'aria-label': name, title: name })
    }),
  )
  readonly #file = h('input', { type: 'file', class: 'hidden', accept: '.clf,.log,.gz,.txt', id: 'file', tabindex: '-1', 'aria-hidden': 'true' })
  readonly #go = button('Start', () => this.#playPause(), { class: 'primary', part: 'button play' })
  readonly #halt = button('Stop', () => this.stop(), { part: 'button stop' })
  readonly #progress = h('progress', { 'aria-label': 'Scans mapped', value: '0' })
  readonly #position = h('span', { class: 'position' })
  readonly #saves = FILES.map(([what, name]) => button(name, () => this.send({ do: 'save', what })))

  constructor() {
    super()
    this.playback.stay()
    this.stage.classList.add('map')
    this.canvas.element.after(this.#zoom, h('p', { class: 'idle' }, h('b', {}, 'No log is open'), 'Run the example, or choose or drop a log.'))
    this.stage.before(this.#sources(), this.messages.element)
    this.sentence.element.before(h('div', { class: 'work run', part: 'transport', role: 'group', 'aria-label': 'Mapping' }, this.#go, this.#halt, this.#progress, this.#position))
    this.body.append(h('div', { class: 'work saves', part: 'saves', role: 'group', 'aria-label': 'Save' }, h('span', { class: 'name' }, 'Save'), ...this.#saves))
    write(this.heading, AT_REST.title)
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
    write(this.status, `Reading ${name} …`)
    await this.start()
    this.#sendSource()
  }

  /** Reads and maps the log that comes with the figure. */
  async example(): Promise<void> {
    this.events.cause = 'page'
    write(this.status, 'Loading the example …')
    const response = await fetchExample().catch(() => undefined)
    if (response?.ok) return this.open(await response.blob(), 'the example', true)
    write(this.status, '')
    const why = response ? `the server answered ${response.status}` : 'the network is down, or a rule blocks it'
    this.messages.set('file', `The example could not be fetched (${why}).`, 'Try again', () => void this.example())
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
    return this.settings.any || this.#source !== undefined
  }

  /** All there is before anything was asked. */
  protected override approached(): void {
    this.canvas.release()
    if (this.controls) return
    const { params: specs, readouts, describe: sentence } = AT_REST
    const values = Object.fromEntries(specs.map(spec => [spec.name, spec.default]))
    const rest = { done: 0, specs, values, query: '', step: 0, target: 0, last: 0, busy: false, readouts, handles: [], sentence, changed: false }
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
    if (answer.told === 'reading') return write(this.status, `Reading, ${answer.megabytes} MB …`)
    if (answer.told !== 'refused' || answer.file === undefined) return super.hear(answer)
    write(this.status, '')
    if (this.#source?.name === answer.file) this.#source = undefined
    this.messages.set('file', `${answer.file} cannot be mapped: ${answer.message}.`, 'Run the example', () => void this.example())
  }

  /** What was mapped is lost with the worker; the log, the settings and the example are not. */
  protected override failed(why: string, again: boolean): void {
    write(this.status, '')
    // What was refused before it said a word would be refused again.
    if (!this.#lived) return this.refuseToLive(why)
    if (again) this.#source = undefined
    const kept = this.#source ? ' The log is open again.' : ''
    this.messages.set('file', `Something failed while this log was mapped (${why}), so it has stopped.${kept}`, 'Run the example', () => void this.example())
    this.restart()
  }

  // --- What is shown -------------------------------------------------------------------------------------------------------

  protected override placeControls(controls: Controls): void {
    controls.transport.setAttribute('aria-label', 'Settings of the draw')
    this.body.append(controls.view, controls.transport, controls.settings)
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
    this.controls!.transport.setAttribute('aria-label', 'Settings of the draw')
  }

  /** Why it cannot be started; told once, not with every picture. */
  #showUnfit({ unfit, log }: Run): void {
    const [parameter, message] = unfit ?? ['', '']
    if (message === this.#unfit) return
    this.#unfit = message
    if (parameter !== 'lenient') return this.messages.set('unfit', message)
    this.messages.set('unfit', `${log}, ${message}.`, 'Skip malformed lines', () => this.setParameter('lenient', 'on'))
  }

  #showPhase(run: Run | undefined, step: number, last: number): void {
    const held = document.activeElement === this && this.shadowRoot!.activeElement
    const phase = (this.#phase = run?.phase ?? 'empty')
    const underWay = phase === 'running' || phase === 'paused'
    write(this.#go, { running: 'Pause', paused: 'Resume', ready: 'Start', empty: 'Start', stopped: 'Start again', done: 'Start again' }[phase])
    this.#go.disabled = phase === 'empty' || run?.unfit !== undefined
    this.#halt.disabled = !underWay
    // The focus does not fall out of the figure with the button that had it.
    if (held === this.#halt && !underWay) this.#go.focus()
    this.#progress.max = Math.max(last, 1)
    this.#progress.value = step
    const time = phase === 'running' && step > 0 ? ` · ${duration(run!.left)} left` : ''
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
    return h(
      'div',
      { class: 'work source', part: 'source' },
      button('Run the example', () => void this.example(), { part: 'button example' }),
      button('Choose a log …', () => this.#file.click()),
      this.#file,
      h('span', { class: 'name' }, 'or drop one here: CARMEN (.clf, .log), also .gz. It is read and mapped by this page; nothing leaves your machine.'),
    )
  }

  // --- Reader's input ----------------------------------------------------------------------------------------------------

  #playPause(): void {
    if (this.playing) this.pause()
    else this.play()
  }

  protected override get keysHelp(): string {
    return 'Arrow keys move the map, plus and minus magnify it, 0 shows the whole. Space pauses and goes on. Two fingers move and magnify it, one scrolls the page.'
  }

  protected override keyAction(key: string, target: HTMLElement): (() => void) | undefined {
    if (target !== this.stage || this.#phase === 'empty') return undefined
    if (key === ' ') return () => this.#playPause()
    const command = MOVES[SAME_KEYS[key] ?? key]
    return command && (() => this.send(command))
  }

  /** The log itself is in none of it: it is a file of the reader's. */
  protected override menuItems(): MenuItem[] {
    return super.menuItems().filter(({ name }) => !name.startsWith('Save data'))
  }

  protected override fileName(extension: string): string {
    return `${this.id || this.localName}.${extension}`
  }
}

function button(text: string, act: () => void, attributes: Record<string, string> = {}): HTMLButtonElement {
  const element = h('button', { type: 'button', part: 'button', ...attributes }, text)
  element.addEventListener('click', act)
  return element
}

/** In words as short as the number is rough. */
function duration(seconds: number): string {
  if (seconds < 1.5) return '1 s'
  return seconds < 1.5 * MINUTE ? `${Math.round(seconds)} s` : `${Math.round(seconds / MINUTE)} min`
}

register('fastslam-log', FastslamLog)
