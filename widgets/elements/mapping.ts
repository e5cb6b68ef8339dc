// A figure that maps a file of its reader's. Its program runs in a worker, so that the page answers at once whatever the size of the file. That
// program is large, and many a reader never maps a log: it is fetched when the first thing is asked of the figure.
import type { Own } from './action'
import type { Controls } from './controls'
import { h, write } from './dom'
import { keepPage, takeDrops } from './drops'
import type { Extra, Transport } from './extra'
import type { Figure } from './figure'
import { fetchExample } from './files'
import { AT_REST } from './generated/log'
import type { Answer, Format, Frame, Phase, Run, SavedFile, Topics } from './host'
import type { Life } from './life'
import { Poster } from './log-poster'
import { takeGestures } from './map-gestures'
import { programNamed } from './program'
import { Timeline } from './timeline'
import type { View } from './view'
import { ToldError, type Key, type Words } from './words'

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

/**
 * @csspart source - Where a log is chosen.
 * @csspart example - Maps the example.
 * @csspart map - Maps the log that is open.
 * @csspart saves - The fold of what can be saved.
 */
export class Mapping implements Extra, Transport {
  static readonly offers = ['open', 'example', 'stop'] as const
  readonly keysHelp = 'map_keys'
  readonly patient = true
  readonly exports = false // the log itself is in none of it: it is a file of the reader's
  readonly stepped = false
  #phase: Phase = 'empty'
  #log: { file: Blob; name: string; start: boolean; topics: Topics; format: Format; decoder: WebAssembly.Module | undefined } | undefined // read again by another worker, after a move of the element
  #sent: unknown // the source that this worker was given
  #opened = 0 // commands that had been sent then, to this worker and to those that died before
  #lived = false // there has been a frame
  #unfit = '' // what was said to stand in the way
  #refused = false // the log chosen last, so that there is nothing to say of the one before
  readonly #timeline: Timeline // of what is mapped
  readonly #poster: Poster
  readonly #example: HTMLElement
  readonly #source: HTMLElement
  readonly #zoom = h('div', { class: 'zoom', role: 'group' })
  readonly #file = h('input', { type: 'file', class: 'hidden', accept: '.clf,.log,.gz,.txt,.mcap,.bag,.jsonl', id: 'file', tabindex: '-1', 'aria-hidden': 'true' })
  readonly #saves = h('details', { class: 'saves', part: 'saves', hidden: '' })

  readonly #life: Life
  readonly #view: View
  readonly #words: Words

  constructor(private readonly figure: Figure) {
    const { events, life, view, words } = figure
    ;[this.#life, this.#view, this.#words] = [life, view, words]
    figure.transport = this
    this.#timeline = new Timeline(figure)
    this.#poster = new Poster(words, () => (this.#phase === 'empty' ? void this.example() : this.play()))
    this.#example = this.#named('run_example', () => void this.example(), { part: 'button example' })
    this.#source = this.#sources()
    life.playback.stay()
    view.stage.classList.add('map')
    view.canvas.element.after(this.#zoom, this.#poster.element)
    view.panes.before(view.messages.element, this.#file)
    view.panes.after(view.sentence.element) // what was left out of a log can take many lines
    for (const [key, sign, name] of [['+', '+', 'magnify'], ['−', '−', 'make_smaller'], ['0', '⤢', 'show_whole']] as const) {
      const element = button(() => this.#look(MOVES[key]!))
      element.textContent = sign
      words.always(() => (element.ariaLabel = element.title = words.say(name)))
      this.#zoom.append(element)
    }
    const save = h('summary')
    this.#saves.append(save, h('div', { class: 'work' }, ...FILES.map(([what, name]) => this.#named(name, () => void this.#save(what)))))
    view.folds.append(this.#saves)
    words.always(() => {
      write(save, words.say('save'))
      this.#zoom.ariaLabel = words.say('magnification')
    })
    view.theme.onChange(() => this.#paintPoster())
    // What comes after a press: nothing moves away from under it.
    for (const type of ['click', 'keyup', 'dragenter'] as const) view.body.addEventListener(type, () => void life.start())
    for (const type of ['click', 'keydown', 'input', 'change', 'drop'] as const) view.body.addEventListener(type, () => (events.cause = 'reader'))
    takeDrops(view.body, file => void this.open(file))
    takeGestures(view.canvas.element, look => this.#look(look))
  }

  connected(signal: AbortSignal): void {
    keepPage(signal)
    signal.addEventListener('abort', () => (this.#sent = undefined))
  }

  // --- What a page's script may use ------------------------------------------------------------------------------------

  /** Reads a log, of a bag the topics named; maps it too if it is to start. */
  async open(file: Blob, name = file instanceof File ? file.name : 'log', start = false, topics: Partial<Record<'scan' | 'odometry', string>> = {}): Promise<void> {
    return this.#open(file, name, start, topics)
  }

  /** The same, of a file whose format is known by now. */
  async #open(file: Blob, name: string, start: boolean, topics: Topics, known?: Format): Promise<void> {
    this.#view.messages.set('file', '')
    this.#life.playback.stop()
    this.#life.crashes = 0 // another log, another chance
    const log = (this.#log = { file, name, start, topics, format: known ?? 'carmen', decoder: undefined as WebAssembly.Module | undefined })
    write(this.#view.status, this.#words.say('reading', { name }))
    for (const about of ['topic', 'unfit']) this.#view.messages.set(about, '') // of the log before
    this.#unfit = ''
    this.#refused = false
    this.#poster.show(this.#phase, true)
    try {
      if (!known && (await isBag(file))) log.format = 'bag'
      if (log.format !== 'carmen') log.decoder = await filesProgram()
    } catch (error) {
      if (this.#log !== log) return
      this.#log = undefined
      this.#poster.show(this.#phase, false)
      write(this.#view.status, '')
      return this.#view.messages.set('file', this.#words.say('cannot_map', { file: name, why: this.#words.tell(error instanceof ToldError ? error.told : String(error)) }), this.#words.say('try_again'), () => void this.#open(file, name, start, topics, known))
    }
    if (this.#log !== log) return // another one was opened meanwhile
    await this.#life.start()
    this.#sendLog()
  }

  /** Maps the log that comes with the figure. */
  async example(): Promise<void> {
    this.figure.events.cause = 'page'
    write(this.#view.status, this.#words.say('loading_example'))
    const response = await fetchExample().catch(() => undefined)
    if (response?.ok) return this.open(await response.blob(), this.#words.say('the_example'), true)
    write(this.#view.status, '')
    const text = response ? this.#words.say('example_answered', { status: response.status }) : this.#words.say('example_unreachable')
    this.#view.messages.set('file', text, this.#words.say('try_again'), () => void this.example())
  }

  /** Maps the log, or goes on after a pause; plays again what is mapped to its end. */
  play(): void {
    if (this.#phase === 'done') return this.#timeline.play()
    this.figure.events.cause = 'page'
    this.#life.send({ do: 'run' })
  }

  /** Waits; what is mapped can be looked at and saved. */
  pause(): void {
    if (this.#phase === 'running') this.#life.send({ do: 'pause' })
    else this.#timeline.pause()
  }

  /** The same as pause. */
  stop(): void {
    this.pause()
  }

  seek(step: number): void {
    if (this.figure.host) this.#timeline.seek(step)
  }

  get playing(): boolean {
    return this.#phase === 'running' || this.#timeline.playing
  }

  // --- Life ----------------------------------------------------------------------------------------------------------------

  // All there is before anything was asked.
  near(): void {
    const { events } = this.figure
    this.#view.canvas.release()
    this.#paintPoster()
    if (this.#log) void this.#life.start()
    if (this.#view.controls) return
    const { params: specs, readouts, describe: sentence } = AT_REST
    const values = Object.fromEntries(specs.map(spec => [spec.name, spec.default]))
    const rest = { done: 0, language: 'en', specs, values, query: '', step: 0, target: 0, last: 0, answer: 1, pace: 1, busy: false, readouts, handles: [], rooms: [], sentence, told: sentence, difference: '', instead: {}, main: '', changed: false }
    const frame: Frame = { ...rest, chips: AT_REST.chips, prediction: null, gist: { x: 0, y: 0, w: 0, h: 0 }, picture: undefined, run: { phase: 'empty', log: '', reading: false, left: NaN, unfit: undefined } }
    this.figure.present(frame)
    if (this.figure.wanted || this.#log) return // where more is on its way, that will be told
    events.tell(frame, true)
    events.send()
  }

  begun(): void {
    this.#sent = undefined
    this.#sendLog()
  }

  /** Gives the worker what is to be read, once: whether it was there before or has just begun. */
  #sendLog(): void {
    const { host } = this.figure
    if (!host || !this.#log || this.#sent === this.#log) return
    this.#sent = this.#log
    this.#life.send({ do: 'open', ...this.#log })
    this.#opened = host.sent
    this.#log.start = false // after a move of the element it waits for its reader
  }

  hear(answer: Answer): boolean {
    if (answer.told === 'reading') {
      write(this.#view.status, this.#words.say('reading_megabytes', { megabytes: answer.megabytes }))
    } else if (answer.told === 'choose') {
      this.#choose(answer.what, answer.topics)
    } else if (answer.told === 'json') {
      const log = this.#log
      if (log?.format === 'carmen') void this.#open(log.file, log.name, answer.start, log.topics, 'json')
    } else if (answer.told === 'failed') {
      this.#failed(this.#words.tell(answer.why))
    } else if (answer.told === 'refused' && answer.file !== undefined) {
      write(this.#view.status, '')
      if (this.#log?.name === answer.file) this.#log = undefined
      this.#refused = true
      this.#view.messages.set('unfit', '') // a frame of the log before may have been on its way
      this.#offerExample(this.#words.say('cannot_map', { file: answer.file, why: this.#words.tell(answer.message) }))
    } else {
      return false
    }
    return true
  }

  #offerExample(text: string): void {
    this.#view.messages.set('file', text, this.#words.say('run_example'), () => void this.example())
  }

  /** Several topics of a bag have what is needed: a button for each. */
  #choose(what: 'scan' | 'odometry', topics: string[]): void {
    write(this.#view.status, '')
    if (!this.#log) return
    const { file, name, start, topics: chosen } = this.#log
    this.#view.messages.offer(
      'topic',
      this.#words.say(what === 'scan' ? 'choose_scan_topic' : 'choose_odometry_topic', { file: name }),
      topics.map(topic => [topic, () => void this.open(file, name, start, { ...chosen, [what]: topic })]),
    )
  }

  /** What was mapped is lost with the worker; the log, the settings and the example are not. */
  #failed(why: string): void {
    write(this.#view.status, '')
    // What was refused before it said a word would be refused again.
    if (!this.#lived) return this.#life.refuse(why)
    if (this.#life.failedAgain) this.#log = undefined
    const kept = this.#log ? ` ${this.#words.say('log_open_again')}` : ''
    this.#offerExample(this.#words.say('mapping_failed', { why }) + kept)
    this.#life.restart()
  }

  /** Saves what is mapped up to now; most of it is written by the program that reads other formats. */
  async #save(what: SavedFile): Promise<void> {
    this.#view.messages.set('file', '')
    try {
      this.#life.send({ do: 'save', what, writer: what === 'map.png' || what === 'report.json' ? undefined : await filesProgram() })
    } catch (error) {
      this.#view.messages.set('file', this.#words.say('cannot_save', { file: what, why: this.#words.why(error) }), this.#words.say('try_again'), () => void this.#save(what))
    }
  }

  // --- What is shown -------------------------------------------------------------------------------------------------------

  mount({ main }: Controls): void {
    main.append(this.#source)
  }

  #paintPoster(): void {
    if (this.figure.frames.near) this.#poster.paint(this.#view.theme.shade)
  }

  frame({ run }: Frame): void {
    if (!this.figure.host) return
    this.#lived = true
    this.#showUnfit(run!)
    write(this.#view.status, run!.phase === 'empty' ? '' : run!.log)
  }

  show({ step, target, last, run }: Frame): void {
    const { element } = this.figure
    const held = document.activeElement === element && element.shadowRoot!.activeElement
    const phase = (this.#phase = run!.phase)
    const begun = phase !== 'empty' && phase !== 'ready'
    if (phase !== 'done') this.#life.playback.playing = false
    this.#poster.show(phase, run!.unfit !== undefined || this.#reads(run!))
    this.#view.stage.classList.toggle('empty', phase === 'empty')
    this.#zoom.inert = phase === 'empty'
    this.#example.hidden = phase === 'empty'
    this.#saves.hidden = !begun
    const controls = this.#view.controls!
    const left = phase === 'running' && step > 0 ? ` · ${this.#words.say('time_left', { time: duration(run!.left) })}` : ''
    controls.showPosition(step, target, begun ? last : 0, this.playing, left)
    controls.freeze(phase === 'running') // other settings would begin anew
    // The focus does not fall out of the figure with the button that had it.
    if (held === this.#poster.go && begun) controls.focus()
  }

  /** Whether a log is on its way: what was chosen is not there yet, and nothing else is to be mapped in its place. */
  #reads(run: Run): boolean {
    return run.reading || (this.#log !== undefined && (this.#sent !== this.#log || (this.figure.host?.done ?? 0) < this.#opened))
  }

  /** Why it cannot be started; told once, not with every picture. */
  #showUnfit(run: Run): void {
    const { unfit, log } = run
    const [parameter, message] = unfit ?? ['', '']
    if (message === this.#unfit || this.#refused || this.#reads(run)) return
    this.#unfit = message
    if (parameter !== 'lenient') return this.#view.messages.set('unfit', message)
    this.#view.messages.set('unfit', `${log}, ${message}.`, this.#words.say('skip_malformed'), () => this.#life.give('lenient', 'on'))
  }

  #sources(): HTMLElement {
    this.#file.addEventListener('change', () => {
      const file = this.#file.files?.[0]
      this.#file.value = '' // the same file may be chosen again
      if (file) void this.open(file)
    })
    const drop = h('span', { class: 'name' })
    this.#words.always(() => write(drop, this.#words.say('or_drop')))
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
    this.#life.send({ do: 'own', ...look })
  }

  key(key: string, target: HTMLElement): (() => void) | undefined {
    const { reader } = this.figure
    if (target !== this.#view.stage || this.#phase === 'empty') return undefined
    if (key === ' ') return () => (this.playing ? this.pause() : this.play())
    if (key === ',') return () => reader.stepBack()
    if (key === '.') return () => reader.step()
    const look = MOVES[SAME_KEYS[key] ?? key]
    return look && (() => this.#look(look))
  }

  /** A button of this.#words. */
  #named(name: Key, act: () => void, attributes: Record<string, string> = {}): HTMLButtonElement {
    const element = button(act, attributes)
    this.#words.always(() => write(element, this.#words.say(name)))
    return element
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

/** The program that reads bags and JSON, and writes what other programs read. */
const filesProgram = () => programNamed('files').module()

/** In words as short as the number is rough. */
function duration(seconds: number): string {
  if (seconds < 1.5) return '1 s'
  return seconds < 1.5 * MINUTE ? `${Math.round(seconds)} s` : `${Math.round(seconds / MINUTE)} min`
}
