// Programs: fetched when the first figure that needs one is seen, compiled once, with one instance that its figures share. After a trap
// the instance is dead: it is dropped, and another one is made of what was compiled.
import { fetchProgram, hasProgram } from './files'
import { FIGURES } from './generated/figures'
import { createShell } from './generated/shell'
import type { Shell } from './shell'
import { ToldError } from './words'

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
  /** The instance of now, where it is there already. */
  ready: Shell | undefined

  constructor(name: string) {
    this.module = once(() => compiled(name))
  }

  /** The instance of now. */
  shell(): Promise<Shell> {
    this.#shell ??= this.module()
      .then(createShell)
      .then(shell => (this.ready = shell))
      .catch((error: unknown) => {
        this.#shell = undefined
        throw error
      })
    return this.#shell
  }

  /** One of the users has seen the instance trap: all of them get another one. */
  replace(): void {
    this.#shell = this.ready = undefined
    const users = [...this.users]
    for (const user of users) user.lose()
    const revive = () => users.filter(user => this.users.has(user)).forEach(user => user.revive())
    this.shell().then(revive, revive) // who cannot be revived finds out why
  }
}

const programs = new Map<string, Program>()

/** On a page with more kinds of figures than that, one program for all of them is less to load. */
const FEW = 2

/**
 * The program of a figure: its own on a page with one or two kinds of figures, where all of these have one; else that which the chapter's
 * figures share. A program that is there already is taken.
 */
export function programOf(tag: string): Program {
  const own = nameOf(tag)
  const { program: shared = own } = FIGURES[tag] ?? {}
  const there = programs.get(own) ?? programs.get(shared)
  if (there) return there
  const kinds = Object.keys(FIGURES).filter(kind => kind === tag || programs.has(nameOf(kind)) || document.querySelector(kind))
  const sharing = kinds.filter(kind => FIGURES[kind]?.program === shared)
  const few = sharing.length <= FEW && sharing.every(kind => hasProgram(nameOf(kind)))
  return programNamed(few || !hasProgram(shared) ? own : shared)
}

const nameOf = (tag: string) => tag.slice('fastslam-'.length)

/** The program of this name. */
export function programNamed(name: string): Program {
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
  if (typeof WebAssembly === 'undefined') throw new ToldError({ key: 'no_webassembly' })
  const response = await fetchProgram(name).catch(() => {
    throw new ToldError({ key: 'unreachable' })
  })
  if (!response.ok) throw new ToldError({ key: 'answered', values: { status: response.status } })
  try {
    // Compiled while it arrives, where the server says what it is.
    const known = response.headers.get('Content-Type')?.startsWith('application/wasm')
    return known && 'compileStreaming' in WebAssembly ? await WebAssembly.compileStreaming(response) : await WebAssembly.compile(await response.arrayBuffer())
  } catch (error) {
    // Chromium and Firefox word a refusal by policy differently; both name one of these.
    if (/unsafe-eval|security policy|csp|disallowed/i.test(String(error))) {
      throw new ToldError({ key: 'policy' })
    }
    if (/network|fetch|load failed/i.test(String(error))) throw new ToldError({ key: 'broke_off' })
    throw new ToldError({ key: 'not_started', values: { why: error instanceof Error ? error.message : String(error) } })
  }
}
