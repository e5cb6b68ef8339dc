// A figure beside its program, on the page or in a worker: carries out what it is asked, and says what there is to show.
import { clampedStep, type Answer, type Beginning, type Command, type Frame, type Layout, type Picture, type Run, type Size } from './host'
import { locked } from './options'
import { isRefusal, type Chip, type Handle, type Outcome, type ParamSpec, type Readout, type Room, type Shell, type ShellFigure, type TraceLine } from './shell'

const LEGIBLE = 0.6 // a picture is not made smaller than that to fit, whatever the size of its letters
const WORTH = 0.25 // … nor so narrow that its letters, times the share of the room's width that it takes, are less

export class Session {
  protected readonly figure: ShellFigure
  #done = 0
  #fresh = true
  #target = 0 // as it was asked for
  #authored = '' // with the version that the author names
  #specs: ParamSpec[] | undefined // until something changes that they may depend on
  #language = 'en'
  protected messages = '' // of that language, for the program
  #lock: string | null = null
  #size: Size | undefined
  #layout: Layout | undefined
  #changed = false
  #mustTrace = false
  #usual: Partial<Record<string, string>> = {} // defaults of the version that the author names, where they are others now
  #followed = new Map<string, string>() // what a pointer has changed by passing over it: the values to go back to
  #arrived = false // at what was asked for, at least once

  constructor(
    protected readonly shell: Shell,
    tag: string,
    protected readonly tell: (answer: Answer) => void,
  ) {
    this.figure = new shell.Figure(tag)
  }

  /** Carries out a command. What is refused is told; what is thrown is a trap. */
  do(command: Command): void | Promise<void> {
    const done = () => void (this.#done += 1)
    try {
      const underWay = this.perform(command)
      if (underWay) return underWay.catch(error => this.refuse(error)).then(done)
    } catch (error) {
      this.refuse(error)
    }
    done()
  }

  protected perform(command: Command): void | Promise<void> {
    const { figure } = this
    if (['begin', 'set', 'drag', 'nudge'].includes(command.do)) this.#followed.clear() // what was chosen stays
    switch (command.do) {
      case 'begin':
        return this.begin(command, command.changed)
      case 'set':
        return this.set(command.name, command.value, command.hand)
      case 'lock':
        this.#lock = command.text
        return
      case 'show':
        return figure.show(command.names)
      case 'words':
        this.#language = command.language
        this.#specs = undefined
        this.messages = command.messages
        return figure.set_words(command.messages)
      case 'comma':
        return figure.set_decimal_comma(command.on)
      case 'light':
        return figure.light(command.symbol)
      case 'seek':
        this.#target = command.step
        return figure.seek(this.target)
      case 'tell': {
        const step = figure.telling(this.#authored)
        if (step > 0) figure.seek(step)
        return this.#adoptTarget()
      }
      case 'trace':
        this.#mustTrace = true
        return
      case 'pick':
        return this.#move(() => figure.pick(...this.point(command)))
      case 'drag':
        return this.#move(() => figure.drag(command.handle, ...this.point(command)))
      case 'follow':
        return this.#follow(() => figure.drag(command.handle, ...this.point(command)))
      case 'leave':
        for (const [name, value] of this.#followed) this.set(name, value)
        return this.#followed.clear()
      case 'nudge':
        return this.#move(() => figure.nudge(command.handle, command.right, command.up))
      case 'take':
        return figure.take(command.tool)
      case 'press':
        return this.#use(() => figure.press(command.key, command.right, command.up))
      case 'stroke': {
        const [scale, , width] = this.point({ x: 1, y: 0 })
        return this.#use(() => figure.stroke(Float64Array.from(command.line, c => c * scale), width))
      }
      case 'size':
        this.#size = command.size
        return
      case 'compare':
        return figure.compare(command.on)
      case 'export': {
        const type = { csv: 'text/csv', json: 'application/json' }[command.kind]
        return this.tell({ told: 'saved', name: command.name, data: new Blob([figure[command.kind]()], { type }) })
      }
    }
  }

  // --- What it is ----------------------------------------------------------------------------------------------------------

  get done(): number {
    return this.#done
  }

  get values(): Record<string, string> {
    return this.figure.values() as Record<string, string>
  }

  get query(): string {
    return this.figure.query()
  }

  /** Of a figure whose drives end at different steps, one beyond the end is the end, also where that moves. */
  get target(): number {
    return clampedStep(this.#target, this.last)
  }

  get last(): number {
    return this.figure.step_count()
  }

  get specs(): ParamSpec[] {
    return (this.#specs ??= this.figure.params() as ParamSpec[])
  }

  get pending(): boolean {
    return this.figure.pending() > 0
  }

  /** Whether to leave shown what is: on the way to what was asked for is another moment than that. The first picture is watched as it comes. */
  get holds(): boolean {
    return this.#arrived && this.pending && !this.run() && !this.figure.refines()
  }

  /** How the mapping of a file stands, where one is mapped. */
  protected run(): Run | undefined {
    return undefined
  }

  /** What there is to show. That something has changed, and a trace, are told in one frame only, unless it is a look ahead. */
  frame(ahead = false): Frame {
    const { figure } = this
    const busy = this.pending && !this.run()
    const layout = this.#place()
    const picture = this.#paint()
    const changed = this.#changed && !busy && !ahead
    const trace = this.#mustTrace && !busy && !ahead ? (figure.trace() as TraceLine[]) : undefined
    const from = figure.watch_from()
    if (changed) this.#changed = false
    if (trace) this.#mustTrace = false
    this.#arrived ||= !busy
    return {
      done: this.#done,
      language: this.#language,
      specs: this.specs,
      values: this.values,
      query: this.query,
      step: figure.step(),
      target: this.target,
      last: this.last,
      watch: from === undefined ? undefined : { from, words: figure.watch() },
      pace: figure.pace(),
      busy,
      readouts: figure.readouts() as Readout[],
      handles: figure.handles(this.#size?.canvas.css ?? 0) as Handle[],
      rooms: figure.rooms(this.#size?.canvas.css ?? 0) as Room[],
      chips: figure.chips() as Chip[],
      sentence: figure.describe(),
      told: figure.told(),
      difference: figure.difference(),
      main: figure.main_readout(),
      instead: Object.fromEntries(new URLSearchParams(figure.instead())),
      changed,
      trace,
      prediction: figure.prediction() as Outcome | null,
      layout,
      gist: this.#gist(),
      picture,
      run: this.run(),
    }
  }

  /** Does a step of the work that is pending. */
  work(): void {
    this.figure.work()
  }

  free(): void {
    this.figure.free()
  }

  /** After a trap: nothing may be called any more, not by the collector of garbage either. */
  abandon(): void {
    ;(this.figure as unknown as { __destroy_into_raw(): number }).__destroy_into_raw()
  }

  // --- Parameters --------------------------------------------------------------------------------------------------------

  protected begin({ query, settings, authored, linked }: Beginning, changed: boolean): void {
    const refused = this.#fresh && query === undefined ? '' : this.figure.load(query ?? '').join('\n')
    this.#fresh = false
    this.#specs = undefined
    if (query !== undefined) this.tell({ told: 'refused', parameter: 'link', message: refused })
    this.#authored = String(new URLSearchParams(authored))
    this.#usual = this.#meant()
    if (linked) this.#keepLocked(Object.fromEntries(this.specs.map(({ name, default: usual }) => [name, authored[name] ?? this.#usual[name] ?? usual])))
    // In the order of the parameters, whatever that of an author's attributes: a guess is about the settings before it.
    const rank = (name: string) => this.specs.findIndex(spec => spec.name === name)
    const usual = query === undefined ? (Object.entries(this.#usual) as [string, string][]) : []
    for (const [name, value] of [...usual, ...settings].sort(([a], [b]) => rank(a) - rank(b))) {
      try {
        this.set(name, value)
      } catch (error) {
        this.refuse(error)
      }
    }
    this.#changed = changed
    this.#adoptTarget()
  }

  protected set(name: string, value: string | null, hand = false): void {
    const text = value ?? this.#default(name)
    if (text === undefined) return // a name that nobody knows was taken away again
    if (hand) this.figure.set_by_hand(name, text)
    else this.figure.set(name, text)
    this.#changes()
  }

  /** The value of a parameter of which the author says nothing. */
  #default(name: string): string | undefined {
    return this.#usual[name] ?? this.specs.find(spec => spec.name === name)?.default
  }

  /** What an author's code means without saying so. */
  #meant(): Record<string, string> {
    const usual: Record<string, string> = {}
    try {
      const told = this.figure.meant(this.#authored)
      for (let i = 0; i < told.length; i += 2) usual[told[i]!] = told[i + 1]!
    } catch (error) {
      this.refuse(error)
    }
    return usual
  }

  protected refuse(error: unknown, file?: string): void {
    if (!isRefusal(error)) throw error
    this.tell({ told: 'refused', parameter: error.parameter, message: error.told ?? error.message, ...(file !== undefined && { file }) })
  }

  #changes(): void {
    this.#changed = true
    this.#specs = undefined
    this.#adoptTarget()
  }

  #adoptTarget(): void {
    this.#target = Number(this.values['step'] ?? this.figure.step())
  }

  /** What a pointer does. A move that changes no parameter, because it ended where it began or at a limit, is none. */
  #move(action: () => void, values = this.values): void {
    const before = this.query
    action()
    this.#keepLocked(values)
    if (this.query !== before) this.#changes()
  }

  /** The same with a tool, which may do a part of what it was to do before it refuses the rest. */
  #use(action: () => void): void {
    let refused: unknown
    this.#move(() => {
      try {
        action()
      } catch (error) {
        if (!isRefusal(error)) throw error
        refused = error
      }
    })
    if (refused) throw refused
  }

  #follow(action: () => void): void {
    const before = this.values
    this.#move(action, before)
    const now = this.values
    for (const name in before) if (now[name] !== before[name] && !this.#followed.has(name)) this.#followed.set(name, before[name]!)
  }

  /** Puts back what is locked, where a reader's link or hand has moved it. */
  #keepLocked(before: Record<string, string>): void {
    const names = this.specs.map(({ name }) => name)
    for (const name of locked(this.#lock, names).locked) {
      const moved = this.values[name]
      if (moved === before[name]) continue
      try {
        this.figure.set(name, before[name]!)
      } catch (error) {
        if (!isRefusal(error)) throw error // the author's own value is refused, which has been said
      }
      if (moved !== this.values[name]) this.tell({ told: 'refused', parameter: 'locked', message: { key: 'fixed', values: { name } } })
    }
  }

  // --- Picture -----------------------------------------------------------------------------------------------------------

  /** A point of the canvas, and its width, as the figure has them. */
  protected point({ x, y }: { x: number; y: number }): [number, number, number] {
    const scale = this.#layout?.scale ?? 1
    return [x / scale, y / scale, (this.#size?.canvas.css ?? 1) / scale]
  }

  #place(): Layout | undefined {
    if (!this.#size || !(this.#size.room > 0)) return this.#layout
    const { room, height, fontScale } = this.#size
    let [scene, scale] = [room / fontScale, fontScale]
    const natural = Math.round(this.figure.height(scene) * scale)
    let best = WORTH
    const grows = fontScale > 1 && height < Infinity // a projector's letters, with its screen
    if (natural > height || grows) {
      const fitting = (wide: number) => Math.min(grows ? Infinity : fontScale, room / wide, height / this.figure.height(wide))
      // Other widths have other layouts, so the one is looked for that can be shown largest: in its letters, and in the room that it takes of
      // that there is. What would be too small to read is scrolled.
      const usual = scene
      for (let wide = 0.5 * usual, most = room / LEGIBLE; wide <= most; wide += 10) {
        const found = fitting(wide)
        const large = found * Math.min(1, (found * wide) / room)
        if (found >= LEGIBLE && large > best) [scene, scale, best] = [wide, found, large]
      }
    }
    const width = best > WORTH ? Math.floor(Math.min(room, scene * scale)) : undefined
    return (this.#layout = { scale, width, height: Math.round(this.figure.height(scene) * scale), natural })
  }

  #gist(): Room['area'] {
    const { scale = 1 } = this.#layout ?? {}
    const [x, y, w, h] = [...this.figure.gist((this.#size?.canvas.css ?? 0) / scale)].map(length => length * scale) as [number, number, number, number]
    return { x, y, w, h }
  }

  #paint(): Picture | undefined {
    const { canvas, theme } = this.#size ?? {}
    if (!canvas || canvas.width === 0 || canvas.height === 0) return undefined
    const { width, height, css } = canvas
    this.figure.paint(width, height, (width / css) * this.#layout!.scale, theme!)
    const pixels = () => new Uint8ClampedArray(this.shell.memory.buffer as ArrayBuffer, this.figure.pixels(), width * height * 4)
    return { width, height, pixels }
  }
}
