// Programs: fetched when the first figure that needs one is seen, compiled once, with one instance that its figures share. After a trap
// the instance is dead: it is dropped, and another one is made of what was compiled.
import { fetchProgram, programName } from './files'
import { createShell, type Shell } from './generated/shell'

export type { Shell }
export type ShellFigure = InstanceType<Shell['Figure']>

/** What the shell tells about one parameter: the only source of attributes, properties, controls and links. */
export interface ParamSpec {
  name: string
  title: string
  unit: string
  kind: 'integer' | 'number' | 'choice' | 'flag' | 'toggle'
  min: number
  max: number
  step: number
  choices: { value: string; title: string }[]
  default: string
  group: 'setup' | 'view'
  slider: boolean
  help: string
}

export interface Readout {
  name: string
  title: string
  value: number | null
  text: string
  unit: string
  help: string
}

/** A line of the figure's algorithm that the step shown has run. */
export interface TraceLine {
  key: string
  text: string
}

/** A point of the picture that a reader moves, where it lies on the canvas [css px]. */
export interface Handle {
  name: string
  title: string
  x: number
  y: number
  value: number
  text: string
  hover: { x: number; y: number; w: number; h: number } | null
}

/** Who uses an instance, and has to be told of its end. */
export interface InstanceUser {
  /** The instance is dead: nothing of it may be called. */
  lose(): void
  /** There is another one. */
  revive(): void
}

export class Program {
  /** For other instances, in workers as well: it is not fetched again. */
  readonly module: () => Promise<WebAssembly.Module>
  readonly users = new Set<InstanceUser>()
  #shell: Promise<Shell> | undefined

  constructor(name: string) {
    this.module = once(() => compiled(name))
  }

  /** The instance of now. */
  shell(): Promise<Shell> {
    this.#shell ??= this.module()
      .then(createShell)
      .catch((error: unknown) => {
        this.#shell = undefined
        throw error
      })
    return this.#shell
  }

  /** One of the users has seen the instance trap: all of them get another one. */
  replace(): void {
    this.#shell = undefined
    const users = [...this.users]
    for (const user of users) user.lose()
    const revive = () => users.filter(user => this.users.has(user)).forEach(user => user.revive())
    this.shell().then(revive, revive) // who cannot be revived finds out why
  }
}

const programs = new Map<string, Program>()

/** The program of a figure. */
export function programOf(tag: string): Program {
  const name = programName(tag)
  const known = programs.get(name) ?? new Program(name)
  programs.set(name, known)
  return known
}

function once<T>(start: () => Promise<T>): () => Promise<T> {
  let shared: Promise<T> | undefined
  return () =>
    (shared ??= start().catch((error: unknown) => {
      shared = undefined // the network may be back at the next try
      throw error
    }))
}

/** Fetches and compiles a program, or says in words why it cannot. */
async function compiled(name: string): Promise<WebAssembly.Module> {
  if (typeof WebAssembly === 'undefined') throw new Error('this browser runs no WebAssembly')
  const response = await fetchProgram(name).catch(() => {
    throw new Error('its program could not be fetched, because the network is down or a rule blocks it')
  })
  if (!response.ok) throw new Error(`its program could not be fetched (the server answered ${response.status})`)
  try {
    // Compiled while it arrives, where the server says what it is.
    const known = response.headers.get('Content-Type')?.startsWith('application/wasm')
    return known && 'compileStreaming' in WebAssembly ? await WebAssembly.compileStreaming(response) : await WebAssembly.compile(await response.arrayBuffer())
  } catch (error) {
    // Chromium and Firefox word a refusal by policy differently; both name one of these.
    if (/unsafe-eval|security policy|csp|disallowed/i.test(String(error))) {
      throw new Error("the security policy of this page does not allow WebAssembly ('wasm-unsafe-eval')")
    }
    if (/network|fetch|load failed/i.test(String(error))) throw new Error('the network broke off while its program was on its way')
    throw new Error(`its program could not be started (${error instanceof Error ? error.message : String(error)})`)
  }
}

/** What went wrong inside the program, in its own words where it left any. */
export function trapMessage(error: unknown, shell: Shell | undefined): string {
  // Engines word a full stack differently, and not one calls it a trap.
  if (error instanceof RangeError || /too much recursion|call stack/i.test(String(error))) return 'its stack was full'
  let said: string | undefined
  try {
    if (error instanceof WebAssembly.RuntimeError) said = shell?.last_panic() // the instance is dead, but its memory can still be read
  } catch {
    // too broken to speak
  }
  if (said) return said
  if (shell && shell.memory.buffer.byteLength > FULL && error instanceof WebAssembly.RuntimeError) return 'its memory was full'
  return error instanceof Error ? error.message : String(error)
}

/** Memory [bytes] beyond which a trap without a word is one of memory: every panic leaves a word. */
const FULL = 1e9

/** A refused value: the shell's error that names a parameter, as against a trap. */
export function isRefusal(error: unknown): error is Error & { parameter: string } {
  return error instanceof Error && typeof (error as { parameter?: unknown }).parameter === 'string'
}
