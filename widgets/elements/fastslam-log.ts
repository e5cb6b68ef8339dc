// A recorded log, mapped. Its program runs in a worker, so that the page answers at once whatever the size of the log. That program is
// large, and many a reader never maps a log: it is fetched when the first thing is asked of the figure.
import type { Own } from './action'
import { h, write } from './dom'
import { keepPage, takeDrops } from './drops'
import { FigureElement } from './figure-element'
import { fetchExample } from './files'
import { AT_REST } from './generated/log'
import type { Answer, Frame, Phase, Run, SavedFile, Topics } from './host'
import { Poster } from './log-poster'
import { takeGestures } from './map-gestures'
import type { MenuItem } from './menu'
import { register } from './parameters'
import { programNamed } from './program'
import type { Chip, ParamSpec, Readout } from './shell'
import { ToldError, type Key } from './words'

const ZOOM = 1.4 // magnified by one press of + or −
const PAN = 60 // [px] moved by one arrow key
const MINUTE = 60

/** What the buttons save. */
const FILES: [SavedFile, Key][] = [
  ['map.png', 'save_map'],
  ['map.ros', 'save_ros'],
  ['path.tum', 'save_path'],
  ['path.mcap', 'save_path_mcap'],
  ['report.json', 'save_report'],
]

const MOVES: Record<string, Own> = {
  '+': { name: 'zoom', at: [ZOOM] },
  '−': { name: 'zoom', at: [1 / ZOOM] },
  '0': { name: 'fit' },
  ArrowLeft: { name: 'pan', at: [PAN, 0] },
  ArrowRight: { name: 'pan', at: [-PAN, 0] },
  ArrowUp: { name: 'pan', at: [0, PAN] },
  ArrowDown: { name: 'pan', at: [0, -PAN] },
}
const SAME_KEYS: Record<string, string> = { '=': '+', '-': '−', _: '−' }

/** What is shown before its program is there. */
export interface AtRest {
  title: string
  params: ParamSpec[]
  readouts: Readout[]
  chips: Chip[]
  describe: string
}

/**
 * A building mapped from a log of its own, in a worker.
 *
 * @csspart source - Where a log is chosen.
 * @csspart example - Maps the example.
 * @csspart map - Maps the log that is open.
 * @csspart saves - The fold of what can be saved.
 */
export class FastslamLog extends FigureElement {
  static override heavy = true

  #phase: Phase = 'empty'
  #log: { file: Blob; name: string; start: boolean; topics: Topics; decoder: WebAssembly.Module | undefined } | undefined // read again by another worker, after a move of the element
  #sent: unknown // the source that this worker was given
  #opened = 0 // commands that had been sent then, to this worker and to those that died before
  #lived = false // there has been a frame
  #unfit = '' // what was said to stand in the way
  #refused = false // the log chosen last, so that there is nothing to say of the one before
  #left = new AbortController()

  readonly #zoom = h(
    'div',
    { class: 'zoom', role: 'group' },
    ...(['+', '−', '0'] as const).map(key => {
      const element = button(() => this.#look(MOVES[key]!))
      element.textContent = key === '0' ? '⤢' : key
      this.words.always(() => (element.ariaLabel = element.title = this.words.say(({ '+': 'magnify', '−': 'make_smaller', '0': 'show_whole' } as const)[key])))
      return element
    }),
  )
  readonly #file = h('input', { type: 'file', class: 'hidden', accept: '.clf,.log,.gz,.txt,.mcap,.bag,.jsonl', id: 'file', tabindex: '-1', 'aria-hidden': 'true' })
  readonly #poster = new Poster(this.words, () => (this.#phase === 'empty' ? void this.example() : this.play()))
  readonly #example = this.#named('run_example', () => void this.example(), { part: 'button example' })
  readonly #source = this.#sources()
  readonly #saves = h('details', { class: 'saves', part: 'saves', hidden: '' })

  constructor() {
    super()
    this.playback.stay()
    this.stage.classList.add('map')
    this.canvas.element.after(this.#zoom, this.#poster.element)
    this.panes.before(this.messages.element, this.#file)
    this.panes.after(this.sentence.element) // what was left out of a log can take many lines
    const save = h('summary')
    this.#saves.append(save, h('div', { class: 'work' }, ...FILES.map(([what, name]) => this.#named(name, () => void this.#save(what)))))
    this.folds.append(this.#saves)
    this.words.always(() => {
      write(save, this.words.say('save'))
      this.#zoom.ariaLabel = this.words.say('magnification')
    })
    // What comes after a press: nothing moves away from under it.
    for (const type of ['click', 'keyup', 'dragenter'] as const) this.body.addEventListener(type, () => void this.start())
    for (const type of ['click', 'keydown', 'input', 'change', 'drop'] as const) this.body.addEventListener(type, () => (this.events.cause = 'reader'))
    takeDrops(this.body, file => void this.open(file))
    takeGestures(this.canvas.element, look => this.#look(look))
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

  /** Reads a log, of a bag the topics named; maps it too if it is to start. */
  async open(file: Blob, name = file instanceof File ? file.name : 'log', start = false, topics: Partial<Record<'scan' | 'odometry', string>> = {}): Promise<void> {
    this.messages.set('file', '')
    this.playback.stop()
    this.crashes = 0 // another log, another chance
    const log = (this.#log = { file, name, start, topics, decoder: undefined as WebAssembly.Module | undefined })
    write(this.status, this.words.say('reading', { name }))
    for (const about of ['topic', 'unfit']) this.messages.set(about, '') // of the log before
    this.#unfit = ''
    this.#refused = false
    this.#poster.show(this.#phase, true)
    try {
      if (await isBag(file)) log.decoder = await bagProgram()
    } catch (error) {
      if (this.#log !== log) return
      this.#log = undefined
      this.#poster.show(this.#phase, false)
      write(this.status, '')
      return this.messages.set('file', this.words.say('cannot_map', { file: name, why: this.words.tell(error instanceof ToldError ? error.told : String(error)) }), this.words.say('try_again'), () => void this.open(file, name, start, topics))
    }
    if (this.#log !== log) return // another one was opened meanwhile
    await this.start()
    this.#sendLog()
  }

  /** Maps the log that comes with the figure. */
  async example(): Promise<void> {
    this.events.cause = 'page'
    write(this.status, this.words.say('loading_example'))
    const response = await fetchExample().catch(() => undefined)
    if (response?.ok) return this.open(await response.blob(), this.words.say('the_example'), true)
    write(this.status, '')
    const text = response ? this.words.say('example_answered', { status: response.status }) : this.words.say('example_unreachable')
    this.messages.set('file', text, this.words.say('try_again'), () => void this.example())
  }

  /** Maps the log, or goes on after a pause; plays again what is mapped to its end. */
  override play(): void {
    if (this.#phase === 'done') return super.play()
    this.events.cause = 'page'
    this.send({ do: 'run' })
  }

  /** Waits; what is mapped can be looked at and saved. */
  override pause(): void {
    if (this.#phase === 'running') this.send({ do: 'pause' })
    else super.pause()
  }

  /** The same as pause. */
  stop(): void {
    this.pause()
  }

  override seek(step: number): void {
    if (this.alive) super.seek(step)
  }

  override get playing(): boolean {
    return this.#phase === 'running' || super.playing
  }

  // --- Life ----------------------------------------------------------------------------------------------------------------

  protected override get wanted(): boolean {
    // What is said before it is there is English.
    return this.settings.any || this.#log !== undefined || this.words.language !== 'en'
  }

  /** All there is before anything was asked. */
  protected override approached(): void {
    this.canvas.release()
    this.#paintPoster()
    if (this.controls) return
    const { params: specs, readouts, describe: sentence } = AT_REST
    const values = Object.fromEntries(specs.map(spec => [spec.name, spec.default]))
    const rest = { done: 0, language: 'en', specs, values, query: '', step: 0, target: 0, last: 0, holds: false, pace: 1, busy: false, readouts, handles: [], rooms: [], sentence, told: sentence, difference: '', instead: {}, main: '', changed: false }
    const frame: Frame = { ...rest, chips: AT_REST.chips, prediction: null, gist: { x: 0, y: 0, w: 0, h: 0 }, picture: undefined, run: { phase: 'empty', log: '', reading: false, left: NaN, unfit: undefined } }
    this.present(frame)
    if (this.wanted) return // where more is on its way, that will be told
    this.events.tell(frame, true)
    this.events.send()
  }

  protected override begun(): void {
    this.#sent = undefined
    this.#sendLog()
  }

  /** Gives the worker what is to be read, once: whether it was there before or has just begun. */
  #sendLog(): void {
    if (!this.alive || !this.#log || this.#sent === this.#log) return
    this.#sent = this.#log
    this.send({ do: 'open', ...this.#log })
    this.#opened = this.host?.sent ?? 0
    this.#log.start = false // after a move of the element it waits for its reader
  }

  override hear(answer: Answer): void {
    if (answer.told === 'reading') return write(this.status, this.words.say('reading_megabytes', { megabytes: answer.megabytes }))
    if (answer.told === 'choose') return this.#choose(answer.what, answer.topics)
    if (answer.told !== 'refused' || answer.file === undefined) return super.hear(answer)
    write(this.status, '')
    if (this.#log?.name === answer.file) this.#log = undefined
    this.#refused = true
    this.messages.set('unfit', '') // a frame of the log before may have been on its way
    this.messages.set('file', this.words.say('cannot_map', { file: answer.file, why: this.words.tell(answer.message) }), this.words.say('run_example'), () => void this.example())
  }

  /** Several topics of a bag have what is needed: a button for each. */
  #choose(what: 'scan' | 'odometry', topics: string[]): void {
    write(this.status, '')
    if (!this.#log) return
    const { file, name, start, topics: chosen } = this.#log
    this.messages.offer(
      'topic',
      this.words.say(what === 'scan' ? 'choose_scan_topic' : 'choose_odometry_topic', { file: name }),
      topics.map(topic => [topic, () => void this.open(file, name, start, { ...chosen, [what]: topic })]),
    )
  }

  /** What was mapped is lost with the worker; the log, the settings and the example are not. */
  protected override failed(why: string, again: boolean): void {
    write(this.status, '')
    // What was refused before it said a word would be refused again.
    if (!this.#lived) return this.refuseToLive(why)
    if (again) this.#log = undefined
    const kept = this.#log ? ` ${this.words.say('log_open_again')}` : ''
    this.messages.set('file', this.words.say('mapping_failed', { why }) + kept, this.words.say('run_example'), () => void this.example())
    this.restart()
  }

  /** Saves what is mapped up to now; what only the program of bags can write is written by that. */
  async #save(what: SavedFile): Promise<void> {
    this.messages.set('file', '')
    try {
      this.send({ do: 'save', what, writer: what === 'path.mcap' ? await bagProgram() : undefined })
    } catch (error) {
      this.messages.set('file', this.words.say('cannot_save', { file: what, why: this.words.why(error) }), this.words.say('try_again'), () => void this.#save(what))
    }
  }

  // --- What is shown -------------------------------------------------------------------------------------------------------

  protected override introduced(): void {
    super.introduced()
    this.controls!.main.append(this.#source)
  }

  protected override refresh(): void {
    super.refresh()
    if (this.frames.near) this.#paintPoster()
  }

  #paintPoster(): void {
    this.#poster.paint(this.theme.shade)
  }

  protected override present(frame: Frame): void {
    super.present(frame)
    if (!this.alive) return
    this.#lived = true
    this.#showUnfit(frame.run!)
    write(this.status, frame.run!.phase === 'empty' ? '' : frame.run!.log)
  }

  protected override showPlayback({ step, target, last, run }: Frame): void {
    const held = document.activeElement === this && this.shadowRoot!.activeElement
    const phase = (this.#phase = run!.phase)
    const begun = phase !== 'empty' && phase !== 'ready'
    if (phase !== 'done') this.playback.playing = false
    this.#poster.show(phase, run!.unfit !== undefined || this.#reads(run!))
    this.stage.classList.toggle('empty', phase === 'empty')
    this.#zoom.inert = phase === 'empty'
    this.#example.hidden = phase === 'empty'
    this.#saves.hidden = !begun
    const { main, settings, transport } = this.controls!
    this.controls!.showPosition(step, target, begun ? last : 0, this.playing)
    if (phase === 'running' && step > 0) transport.querySelector('.position')!.append(` · ${this.words.say('time_left', { time: duration(run!.left) })}`)
    // Other settings would begin anew. What is only drawn may change.
    for (const field of [...main.children, settings, transport.querySelector('.extras')!] as HTMLElement[]) {
      if (!field.matches('.flag, .source, .lab')) field.inert = phase === 'running'
    }
    // The focus does not fall out of the figure with the button that had it.
    if (held === this.#poster.go && begun) transport.querySelector<HTMLElement>('.play')!.focus()
  }

  /** Whether a log is on its way: what was chosen is not there yet, and nothing else is to be mapped in its place. */
  #reads(run: Run): boolean {
    return run.reading || (this.#log !== undefined && (this.#sent !== this.#log || (this.host?.done ?? 0) < this.#opened))
  }

  /** Why it cannot be started; told once, not with every picture. */
  #showUnfit(run: Run): void {
    const { unfit, log } = run
    const [parameter, message] = unfit ?? ['', '']
    if (message === this.#unfit || this.#refused || this.#reads(run)) return
    this.#unfit = message
    if (parameter !== 'lenient') return this.messages.set('unfit', message)
    this.messages.set('unfit', `${log}, ${message}.`, this.words.say('skip_malformed'), () => this.setParameter('lenient', 'on'))
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
      this.#named('choose_log', () => this.#file.click()),
      this.#example,
      drop,
    )
  }

  // --- Reader's input ----------------------------------------------------------------------------------------------------

  #look(look: Own): void {
    this.send({ do: 'own', ...look })
  }

  protected override get keysHelp(): string {
    return this.words.say('map_keys')
  }

  protected override keyAction(key: string, target: HTMLElement): (() => void) | undefined {
    if (target !== this.stage || this.#phase === 'empty') return undefined
    if (key === ' ') return () => (this.playing ? this.pause() : this.play())
    if (key === ',' || key === '.') return () => this.byHand(() => (key === ',' ? this.stepBack() : this.step()))
    const look = MOVES[SAME_KEYS[key] ?? key]
    return look && (() => this.#look(look))
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

/** A bag of ROS, by its first bytes, or packed by its name. */
async function isBag(file: Blob): Promise<boolean> {
  const start = String.fromCharCode(...new Uint8Array(await file.slice(0, 8).arrayBuffer()))
  return start.startsWith('\x89MCAP0') || start.startsWith('#ROSBAG') || (start.startsWith('\x1f\x8b') && file instanceof File && /\.(mcap|bag)\.gz$/i.test(file.name))
}

/** The program that reads bags, and writes one. */
const bagProgram = () => programNamed('bags').module()

/** In words as short as the number is rough. */
function duration(seconds: number): string {
  if (seconds < 1.5) return '1 s'
  return seconds < 1.5 * MINUTE ? `${Math.round(seconds)} s` : `${Math.round(seconds / MINUTE)} min`
}

register('fastslam-log', FastslamLog)
