// What a figure on a page and a figure beside its program say to each other: the same words whether the two share a thread or not. A
// figure is asked by commands and tells by answers. The host is who carries them: LocalHost by calls, WorkerHost by messages.
import type { Action, Beginning } from './action'
import type { Phase } from './details'
import type { ProgramFrame, ProgramState, Told } from './shell'
import type { Message } from './words'

/** Topics of a bag that a reader has chosen. */
export type Topics = { scan?: string; odometry?: string }

/** What a log is written in. The program of the figure reads CARMEN itself; the others are read by one that is loaded for them. */
export type Format = 'carmen' | 'json' | 'bag'

/** What a session does beside its program, with files. */
export type Errand =
  | { do: 'export'; kind: 'csv' | 'json'; name: string }
  // Of figures that map a file:
  | { do: 'open'; file: Blob; name: string; start: boolean; topics: Topics; format: Format; decoder: WebAssembly.Module | undefined }
  | { do: 'run' | 'pause' }
  | { do: 'save'; what: SavedFile; writer: WebAssembly.Module | undefined }

export type Command = Action | Errand

const KEPT = ['size', 'words', 'lock', 'show', 'comma', 'compare', 'author']

/**
 * Of a command that says how the figure is to be shown, which holds also after a trap, whatever is loaded, the name; so is what a reader has in
 * the hand.
 */
export function keptAs(command: Command): string | undefined {
  if (command.do === 'own') return command.name === 'take' ? 'take' : undefined
  return KEPT.includes(command.do) ? command.do : undefined
}

/** The step that is meant where another one is asked for than those there are. */
export const clampedStep = (step: number, last: number): number => Math.max(0, Math.min(last, Math.round(step) || 0))

/** What a host remembers of its figure, so that it can be made again after a trap. */
export class HostMemory {
  readonly #kept = new Map<string, Command>()
  #beginning: Beginning | undefined
  #shown: string | undefined

  /** A command is sent. */
  note(command: Command): void {
    const name = keptAs(command)
    if (name) this.#kept.set(name, command)
    if (command.do === 'begin' || command.do === 'link') this.#beginning = command
  }

  /** A frame came: a state that is on its way to another one may be the one that traps. */
  saw({ busy, query }: { busy: boolean; query: string }): void {
    if (!busy) this.#shown = query
  }

  /** What makes the figure again: in this state, else as it was when it was shown last, else as it began. */
  again(query = this.#shown): Command[] {
    const begin = this.#beginning
    if (!begin) return [...this.#kept.values()]
    // One that traps before it has shown anything begins as it was to.
    return [...this.#kept.values(), query === undefined ? begin : { do: 'begin', value: query, name: '', on: false }]
  }
}

export type SavedFile = 'map.png' | 'map.ros' | 'path.tum' | 'path.mcap' | 'report.json'

export type { Phase }

export interface Run {
  phase: Phase
  /** Name of the file. */
  log: string
  /** Whether another one is being read. */
  reading: boolean
  /** [s] until the end, at the speed so far. */
  left: number
  /** What keeps it from being started: the parameter, and a line. */
  unfit: [string, string] | undefined
}

export interface Picture {
  width: number
  height: number
  /** To be asked for just before they are used: the next call into the program may move them. */
  pixels: () => Uint8ClampedArray<ArrayBuffer>
}

/** Everything there is to show. */
export interface Frame extends ProgramState, Omit<ProgramFrame, 'news'>, Told {
  /** Of what it says. */
  language: string
  /** Commands that had been carried out. */
  done: number
  picture: Picture | undefined
  run: Run | undefined
}

export type Answer =
  /** An empty message: nothing is wrong any more. */
  | { told: 'refused'; parameter: string; message: Message; file?: string }
  | { told: 'saved'; name: string; data: Blob }
  | { told: 'reading'; megabytes: number }
  | { told: 'choose'; what: 'scan' | 'odometry'; topics: string[] }
  /** What was taken for a log of CARMEN has lines of JSON. */
  | { told: 'json'; start: boolean }
  /** It has trapped. `why` is for readers, `error` for the console. */
  | { told: 'failed'; why: Message; error: string }

/** What is to be run: an experiment of a figure's program, its setting as a figure's link, and seeds from `from` to before `to`. */
export interface Job {
  name: string
  query: string
  from: number
  to: number
}

/** What is asked of the partner of a figure on the page: to begin what a link says, and then step by step its part for the page's. */
export type PartnerRequest =
  | { do: 'partner'; module: WebAssembly.Module; tag: string }
  | { do: 'begin-part'; run: number; query: string }
  | { do: 'part'; run: number; part: Float64Array }

/** What a worker is asked: seeds of a job, every so many; or to be the host of a figure, and then its commands; or the partner of one. */
export type WorkerRequest =
  | { do: 'job'; module: WebAssembly.Module; job: Job; every: number }
  | { do: 'figure'; module: WebAssembly.Module; tag: string }
  | PartnerRequest
  | Command

/** A frame as it is sent: its pixels are a copy, which goes over to the page. */
export type SentFrame = Omit<Frame, 'picture'> & { picture: { width: number; height: number; pixels: Uint8ClampedArray<ArrayBuffer> } | undefined }

export type WorkerResponse =
  | Answer
  | { told: 'frame'; frame: SentFrame }
  | { told: 'rows'; seed: number; rows: number[][] }
  | { told: 'done' }
  | { told: 'ready' }
  | { told: 'part'; run: number; part: Float64Array }

/** What a host tells its figure. */
export interface Listener {
  hear(answer: Answer): void
  /** There may be a new frame. */
  wake(): void
}

export interface FigureHost {
  /** Whether it works and paints by itself, seen or not. */
  readonly remote: boolean
  /** Whether a worker has to say its part first; the figure is woken then. */
  readonly waits: boolean
  /** What is set, and how far it is, as known here; undefined before anything is. */
  readonly state: ProgramState | undefined
  readonly busy: boolean
  /** Commands that have been sent, and that have been carried out. */
  readonly sent: number
  readonly done: number
  send(command: Command): void
  /** Goes on for so long [ms], if it is on its way to what was asked for; or with a worker, from one part of that to the next. */
  work(budget: number, shared?: boolean): void
  /**
   * What there is to show, if it is new. On the way to what was asked for there is nothing: what was shown before stays until that is there.
   * `now` in [ms]; without it at once, new or not, and what is told once is not told yet.
   */
  frame(now?: number): Frame | undefined
  /** To be shown again, new or not. */
  refresh(): void
  /** After a trap: as it was when it was shown last. */
  restart(): void
  free(): void
}
