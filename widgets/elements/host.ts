// What a figure on a page and a figure beside its program say to each other: the same words whether the two share a thread or not. A
// figure is asked by commands and tells by answers. The host is who carries them: LocalHost by calls, WorkerHost by messages.
import type { Phase } from './details'
import type { Chip, Handle, Outcome, ParamSpec, Readout, Room, TraceLine } from './shell'
import type { ThemeName } from './theme'
import type { Message } from './words'

/** Where the picture goes, and how it is to look. */
export interface Size {
  /** Width for the picture [css px]. */
  room: number
  /** Most height for the picture [css px]; where it would be higher, it does not take all of the width. */
  height: number
  /** Letters and lines over normal ones. */
  fontScale: number
  /** The canvas: its width on the page [css px], and its pixels. */
  canvas: { css: number; width: number; height: number }
  theme: ThemeName
}

/** How large the picture is on the page. */
export interface Layout {
  /** Px of the page for one of the scene. */
  scale: number
  /** [css px]; undefined for all there is. */
  width: number | undefined
  /** [css px] */
  height: number
  /** What the height would be if nothing had to fit [css px]. */
  natural: number
}

/** The state that a figure begins with. */
export interface Beginning {
  /** As a link has it; undefined for the defaults. */
  query: string | undefined
  /** What is set after that, in this order; null is the default. */
  settings: [string, string | null][]
  /** What the page's author gave, and `v`, of which version that is: what is left out or taken away is at the default of that version. */
  authored: Record<string, string>
  /** Whether the query is a reader's link: locked parameters keep what the author gave. */
  linked: boolean
}

/** Topics of a bag that a reader has chosen. */
export type Topics = { scan?: string; odometry?: string }

export type Command =
  | ({ do: 'begin'; changed: boolean } & Beginning)
  /** By a reader's hand, what was set before is compared with it. */
  | { do: 'set'; name: string; value: string | null; hand?: boolean }
  | { do: 'lock'; text: string | null }
  | { do: 'show'; names: string }
  | { do: 'comma'; on: boolean }
  /** A symbol that a reader of the chapter points at, in the picture too; an empty one puts it out. */
  | { do: 'light'; symbol: string }
  /** What it says: of a language, as the program takes them. */
  | { do: 'words'; language: string; messages: string }
  | { do: 'seek'; step: number }
  /** To the step that tells most, if there is such a one. */
  | { do: 'tell' }
  | { do: 'trace' }
  | { do: 'pick'; x: number; y: number }
  | { do: 'drag'; handle: string; x: number; y: number }
  // A pointer over an area: the handle goes along, and when the pointer leaves, back to where it was.
  | { do: 'follow'; handle: string; x: number; y: number }
  | { do: 'leave' }
  | { do: 'nudge'; handle: string; right: number; up: number }
  // What a figure's own controls put into the reader's hand, and what is done with it: by a key, right and up, or along a line [css px of
  // the canvas: x, y, x, y …].
  | { do: 'take'; tool: string }
  | { do: 'press'; key: string; right: number; up: number }
  | { do: 'stroke'; line: number[] }
  | { do: 'size'; size: Size }
  /** Whether the setting before is compared with that of now. */
  | { do: 'compare'; on: boolean }
  | { do: 'export'; kind: 'csv' | 'json'; name: string }
  // Of figures that map a file:
  | { do: 'open'; file: Blob; name: string; start: boolean; topics: Topics; decoder: WebAssembly.Module | undefined }
  | { do: 'run' | 'pause' | 'fit' }
  | { do: 'zoom'; factor: number; x: number; y: number }
  | { do: 'pan'; right: number; down: number }
  | { do: 'save'; what: SavedFile; writer: WebAssembly.Module | undefined }

/** Whether a command says how the figure is to be shown, which holds also after a trap, whatever is loaded. */
export const isKept = ({ do: name }: Command): boolean => ['size', 'words', 'lock', 'show', 'comma', 'compare', 'take'].includes(name)

/** The step that is meant where another one is asked for than those there are. */
export const clampedStep = (step: number, last: number): number => Math.max(0, Math.min(last, Math.round(step) || 0))

/** What a host remembers of its figure, so that it can be made again after a trap. */
export class HostMemory {
  readonly #kept = new Map<Command['do'], Command>()
  #beginning: (Command & { do: 'begin' }) | undefined
  #shown: string | undefined

  /** A command is sent. */
  note(command: Command): void {
    if (isKept(command)) this.#kept.set(command.do, command)
    if (command.do === 'begin') this.#beginning = command
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
    return [...this.#kept.values(), query === undefined ? begin : { ...begin, query, settings: [], linked: false, changed: false }]
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
export interface Frame {
  /** Commands that had been carried out. */
  done: number
  /** Of what it says. */
  language: string
  specs: ParamSpec[]
  values: Record<string, string>
  query: string
  /** The step that all of this is of, the one asked for, and the last there is. */
  step: number
  target: number
  last: number
  /** What is to be watched until the end, and the step before it. */
  watch: { from: number; words: string } | undefined
  /** How fast this step is played, of the usual speed. */
  pace: number
  /** Whether it is still on its way to what was asked for. */
  busy: boolean
  readouts: Readout[]
  handles: Handle[]
  rooms: Room[]
  chips: Chip[]
  /** What is shown. */
  sentence: string
  /** What stands below the picture: where a number was changed what it changed, else that. */
  told: string
  /** What is different from the setting before, at the same step; empty where nothing is, or nobody wants to know. */
  difference: string
  /** What controls show instead of the values, where a prediction was run. */
  instead: Record<string, string>
  /** The readout that matters first, by its name. */
  main: string
  /** Whether a parameter was changed since the frame before. */
  changed: boolean
  trace: TraceLine[] | undefined
  /** Where one is asked for. */
  prediction: Outcome | null
  layout: Layout | undefined
  /** The part of the picture that tells most where there is no room for the whole [css px]. */
  gist: Room['area']
  picture: Picture | undefined
  run: Run | undefined
}

export type Answer =
  /** An empty message: nothing is wrong any more. */
  | { told: 'refused'; parameter: string; message: Message; file?: string }
  | { told: 'saved'; name: string; data: Blob }
  | { told: 'reading'; megabytes: number }
  | { told: 'choose'; what: 'scan' | 'odometry'; topics: string[] }
  /** It has trapped. `why` is for readers, `error` for the console. */
  | { told: 'failed'; why: Message; error: string }

/** What a host tells its figure. */
export interface Listener {
  hear(answer: Answer): void
  /** There may be a new frame. */
  wake(): void
}

export interface FigureHost {
  /** Whether it works and paints by itself, seen or not. */
  readonly remote: boolean
  /** As known here; undefined before anything is. */
  readonly values: Record<string, string> | undefined
  readonly query: string | undefined
  readonly target: number
  readonly last: number
  readonly busy: boolean
  /** Commands that have been sent, and that have been carried out. */
  readonly sent: number
  readonly done: number
  send(command: Command): void
  /** Goes on for so long [ms], if it is on its way to what was asked for. */
  work(budget: number): void
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
