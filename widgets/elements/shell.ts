// What the program's shell (widgets/src/shell.rs) gives and takes: the shapes of its data, and the two ways in which a call can fail.
import type { Shell } from './generated/shell'
import type { TraceLine, FigureReadout as Readout } from './details'
import type { Key, Message } from './words'

export type { Shell }
export type { FigureReadout as Readout, TraceLine } from './details'
export type ShellFigure = InstanceType<Shell['Figure']>

/** What the shell tells about one parameter: the only source of attributes, properties, controls and links. */
export interface ParamSpec {
  name: string
  title: string
  unit: string
  kind: 'integer' | 'number' | 'choice' | 'flag' | 'toggle' | 'text'
  min: number
  max: number
  step: number
  choices: { value: string; title: string }[]
  default: string
  group: 'setup' | 'view'
  slider: boolean
  /** Whether its control is in first sight; those that are not are in the Lab. */
  sight: boolean
  folded: boolean
  /** Whether it means anything in this state. */
  applies: boolean
  help: string
}

/** A state that is worth trying (widgets/src/challenge.rs). */
export interface Chip {
  name: string
  title: string
  /** The link to it. */
  query: string
  /** What there is to reach; empty where there is nothing. */
  goal: string
  /** Names of the parameters that are left to the reader. */
  free: string[]
  /** Whether the figure is in it, at whatever step and seed. */
  now: boolean
  /** The same but for the parameters that it leaves to the reader. */
  still: boolean
  done: boolean
  /** What counts for the goal, as it is now, and how near that is, from 0 to 1. */
  said: string
  near: number
}

/** What comes of a reader's prediction. */
export interface Outcome {
  /** What is predicted. */
  name: string
  guess: number | null
  /** `null` before it is shown, and where what was to be predicted never comes. */
  result: number | null
  /** Whether the reader has seen the result without a guess. */
  waived: boolean
  shown: boolean
}

/** A point of the picture that a reader moves, where it lies on the canvas [css px]. */
export interface Handle {
  name: string
  title: string
  x: number
  y: number
  /** Parameters that it moves, sideways first. */
  axes: string[]
  value: number
  text: string
  hover: { x: number; y: number; w: number; h: number } | null
}

/** Where the control of a parameter stands in the picture [css px]. */
export interface Room {
  parameter: string
  area: { x: number; y: number; w: number; h: number }
}

/** How large the picture is on the page. */
export interface Layout {
  /** Px of the page for one of the scene. */
  scale: number
  /** [css px]; undefined for all there is. */
  width?: number
  /** [css px] */
  height: number
  /** What the height would be if nothing had to fit [css px]. */
  natural: number
}

/** What is refused, and why; of nothing where nothing is wrong any more. */
export interface Refusal {
  parameter: string
  message: string
}

/** What is set, and how far it is computed (widgets/src/frame.rs, whose test holds these four to it). */
export interface ProgramState {
  values: Record<string, string>
  query: string
  /** The step that all of this is of, the one asked for, and the last there is. */
  step: number
  target: number
  last: number
  /** 0 where what is shown is to be left so: on the way to what was asked for is another moment than that. Else which answer there is to it. */
  answer: number
  /** What keeps a file from being mapped. */
  unfit?: Refusal
}

/** What is shown. */
export interface ProgramFrame {
  /** What is not as it was in the frame before. */
  news: Partial<Told>
  /** Whether it is still on its way to what was asked for. */
  busy: boolean
  /** What is to be watched until the end, and the step before it. */
  watch?: { from: number; words: string }
  /** How fast this step is played, of the usual speed. */
  pace: number
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
  trace?: TraceLine[]
  /** Where one is asked for. */
  prediction: Outcome | null
  layout?: Layout
  /** The part of the picture that tells most where there is no room for the whole [css px]. */
  gist: Room['area']
}

/** Measured data (widgets/src/export.rs). */
export interface Measured {
  figure: string
  query: string
  /** What each of them means. */
  columns: Record<string, string>
  steps: Record<string, number | null>[]
}

/** What most frames change nothing of. */
export interface Told {
  specs: ParamSpec[]
  readouts: Readout[]
  chips: Chip[]
  handles: Handle[]
  rooms: Room[]
}

/** What is shown of a figure before its program is there, where that waits for something to be asked. */
export interface AtRest {
  title: string
  params: ParamSpec[]
  readouts: Readout[]
  chips: Chip[]
  describe: string
}

/** What is counted over many seeds (`Counted` in widgets/src/job.rs). */
export interface Counted {
  /** Name of the job of the figure's program, which counts. */
  job: string
  title: Key
  /** Names of the parameters that the count depends on, apart by spaces; it has seeds of its own. */
  settings: string
  /** What is compared, with the column of the job's rows that is 1 where it holds, and perhaps one that says how often it should. */
  rows: [name: Key, column: number, expected?: number][]
}

/** Memory [bytes] beyond which a trap without a word is one of memory: every panic leaves a word. */
const FULL = 1e9

/** What went wrong inside the program, in its own words where it left any. */
export function trapMessage(error: unknown, shell: Shell | undefined): Message {
  // Engines word a full stack differently, and not one calls it a trap.
  if (error instanceof RangeError || /too much recursion|call stack/i.test(String(error))) return { key: 'stack_full' }
  let said: string | undefined
  try {
    if (error instanceof WebAssembly.RuntimeError) said = shell?.last_panic() // the instance is dead, but its memory can still be read
  } catch {
    // too broken to speak
  }
  if (said) return said
  if (shell && shell.memory.buffer.byteLength > FULL && error instanceof WebAssembly.RuntimeError) return { key: 'memory_full' }
  return error instanceof Error ? error.message : String(error)
}

/** A refused value: the shell's error that names a parameter, as against a trap. */
export function isRefusal(error: unknown): error is Error & { parameter: string; told?: Message } {
  return error instanceof Error && typeof (error as { parameter?: unknown }).parameter === 'string'
}
