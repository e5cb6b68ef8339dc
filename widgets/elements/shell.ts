// What the program's shell (widgets/src/shell.rs) gives and takes: the shapes of its data, and the two ways in which a call can fail.
import type { Shell } from './generated/shell'
import type { Message } from './words'

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
