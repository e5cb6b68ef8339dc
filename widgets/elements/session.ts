// A figure beside its program, on the page or in a worker: hands on what it is asked, and says what there is to show. What is asked and
// what comes of it is the program's (widgets/src/figure/asked.rs); here are files, and pixels.
import type { Action } from './action'
import type { Answer, Command, Frame, Picture, Run } from './host'
import { isRefusal, type Measured, type ProgramFrame, type ProgramState, type Refusal, type Shell, type ShellFigure, type Told } from './shell'

export class Session {
  protected readonly figure: ShellFigure // what changes nothing may be called; all else is asked
  #done = 0
  #canvas: [width: number, height: number] = [0, 0]
  #language = 'en'
  #state: ProgramState | undefined // as it was told last, until something is asked
  #told: Told = { specs: [], readouts: [], chips: [], handles: [], rooms: [] }

  constructor(
    protected readonly shell: Shell,
    tag: string,
    protected readonly tell: (answer: Answer) => void,
  ) {
    this.figure = new shell.Figure(tag)
  }

  /** Carries out a command. What is refused is told; what is thrown is a trap. */
  do(command: Command): void | Promise<void> {
    const done = () => void this.#done++
    try {
      const underWay = this.perform(command)
      if (underWay) return underWay.catch(error => this.refuse(error)).then(done)
    } catch (error) {
      this.refuse(error)
    }
    done()
  }

  protected perform(command: Command): void | Promise<void> {
    switch (command.do) {
      case 'export': {
        const [text, type] = command.kind === 'csv' ? [asCsv(this.measured), 'text/csv'] : [JSON.stringify(this.measured), 'application/json']
        return this.tell({ told: 'saved', name: command.name, data: new Blob([text], { type }) })
      }
      case 'open':
      case 'run':
      case 'pause':
      case 'save':
        return // there is no file
      default:
        this.act(command)
    }
  }

  /** Asks the program. Whether it did all of it. */
  protected act(action: Action): boolean {
    if (action.do === 'size') [, , , , ...this.#canvas] = action.at
    if (action.do === 'words') this.#language = action.name
    const refused = this.ask(figure => figure.act(action)) as Refusal[]
    for (const { parameter, message } of refused) {
      const told = parameter === 'locked' ? { key: 'fixed' as const, values: { name: message } } : message
      this.tell({ told: 'refused', parameter, message: told })
    }
    return refused.every(({ message }) => !message)
  }

  /** Whatever may change the program goes this way: of its state nothing is known after it. */
  protected ask<T>(call: (figure: ShellFigure) => T): T {
    this.#state = undefined
    return call(this.figure)
  }

  /** Data of every step so far. */
  protected get measured(): Measured {
    return this.figure.export() as Measured
  }

  get done(): number {
    return this.#done
  }

  get state(): ProgramState {
    return (this.#state ??= this.figure.state() as ProgramState)
  }

  get pending(): boolean {
    return this.figure.pending()
  }

  /** How the mapping of a file stands, where one is mapped. */
  protected run(): Run | undefined {
    return undefined
  }

  /** What there is to show. That something has changed, and a trace, are told in one frame only, unless it is a look ahead. */
  frame(ahead = false): Frame {
    const { news, ...frame } = this.ask(figure => figure.frame(ahead)) as ProgramFrame // of the first frame on, it may hold
    this.#told = { ...this.#told, ...news }
    return { ...this.state, ...this.#told, ...frame, done: this.#done, language: this.#language, picture: frame.layout && this.#picture(), run: this.run() }
  }

  /** Does a step of the work that is pending. */
  work(): void {
    this.ask(figure => figure.work())
  }

  /** Whether that is so much that it is to be shared. */
  get shares(): boolean {
    return this.figure.shares()
  }

  /** The first or the second part of what the next step is made of. */
  part(part: 0 | 1): Float64Array {
    return this.figure.part(part)
  }

  /** Does a step of which both parts are known. */
  workWith(first: Float64Array, second: Float64Array): void {
    this.ask(figure => figure.work_with(first, second))
  }

  free(): void {
    this.figure.free()
  }

  /** After a trap: nothing may be called any more, not by the collector of garbage either. */
  abandon(): void {
    ;(this.figure as unknown as { __destroy_into_raw(): number }).__destroy_into_raw()
  }

  protected refuse(error: unknown, file?: string): void {
    if (!isRefusal(error)) throw error
    this.tell({ told: 'refused', parameter: error.parameter, message: error.told ?? error.message, ...(file !== undefined && { file }) })
  }

  #picture(): Picture | undefined {
    const [width, height] = this.#canvas
    if (width === 0 || height === 0) return undefined
    const pixels = () => new Uint8ClampedArray(this.shell.memory.buffer as ArrayBuffer, this.figure.pixels(), width * height * 4)
    return { width, height, pixels }
  }
}

/** Numbers with the fewest digits that read back as the same bits; nothing for one that there is not. */
function asCsv({ columns, steps }: Measured): string {
  return [Object.keys(columns), ...steps.map(step => Object.values(step))].map(row => `${row.join(',')}\n`).join('')
}
