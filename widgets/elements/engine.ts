// One WebAssembly instance a page, shared by every figure. It is fetched when the first figure is seen, never before.
import init, { Figure, last_panic, program } from '../pkg/fastslam_widgets.js'
import { fetchLogProgram, fetchProgram } from './files'

export type Shell = Figure

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

export interface Engine {
  memory: WebAssembly.Memory
  /** For another instance, in a worker. */
  program: WebAssembly.Module
  create(tag: string): Shell
}

export const engine = once(async (): Promise<Engine> => {
  const { memory } = await begun(fetchProgram, response => init({ module_or_path: response }))
  return { memory, program: program() as WebAssembly.Module, create: tag => new Figure(tag) }
})

/** The program of the figure that maps logs, for its worker. */
export const logProgram = once(() => begun(fetchLogProgram, async response => WebAssembly.compile(await response.arrayBuffer())))

function once<T>(start: () => Promise<T>): () => Promise<T> {
  let shared: Promise<T> | undefined
  return () =>
    (shared ??= start().catch((error: unknown) => {
      shared = undefined // the network may be back at the next try
      throw error
    }))
}

/** Fetches a program and begins with it, or says in words why it cannot. */
async function begun<T>(fetched: () => Promise<Response>, begin: (response: Response) => Promise<T>): Promise<T> {
  if (typeof WebAssembly === 'undefined') throw new Error('this browser runs no WebAssembly')
  const response = await fetched().catch(() => {
    throw new Error('its program could not be fetched, because the network is down or a rule blocks it')
  })
  if (!response.ok) throw new Error(`its program could not be fetched (the server answered ${response.status})`)
  try {
    return await begin(response)
  } catch (error) {
    // Chromium and Firefox word a refusal by policy differently; both name one of these.
    if (/unsafe-eval|security policy|csp|disallowed/i.test(String(error))) {
      throw new Error("the security policy of this page does not allow WebAssembly ('wasm-unsafe-eval')")
    }
    if (/network|fetch|load failed/i.test(String(error))) throw new Error('the network broke off while its program was on its way')
    throw new Error(`its program could not be started (${error instanceof Error ? error.message : String(error)})`)
  }
}

/** What went wrong inside the wasm, in its own words where it left any. */
export function panicMessage(error: unknown): string {
  try {
    const said = error instanceof WebAssembly.RuntimeError && last_panic()
    if (said) return said
  } catch {
    // too broken to speak
  }
  return error instanceof Error ? error.message : String(error)
}

/** A refused value: the shell's error that names a parameter, as against a panic. */
export function isRefusal(error: unknown): error is Error & { parameter: string } {
  return error instanceof Error && typeof (error as { parameter?: unknown }).parameter === 'string'
}
