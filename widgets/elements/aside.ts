// Another figure of the same program, which nobody sees: it is brought to a state in slices, between which the page does what else it
// has to do, and then asked what there is to show. What is run over several seeds goes through one of them, one seed after the other.
import type { Answer, Command, Frame, Listener } from './host'
import { LocalHost } from './local-host'
import { programOf } from './program'
import { ToldError } from './words'
import { yieldToMain } from './yield'

const SLICE = 8 // [ms] of simulation between two looks at what else the page has to do

export class Aside implements Listener {
  #host: LocalHost | undefined
  #failed: ToldError | undefined

  /** Of a figure's kind, told first how that is to be shown: words, comma, panels. */
  static async of(tag: string, commands: Command[]): Promise<Aside> {
    const aside = new Aside()
    aside.#host = await LocalHost.create(programOf(tag), tag, aside)
    for (const command of commands) aside.#host.send(command)
    return aside
  }

  hear(answer: Answer): void {
    if (answer.told !== 'failed') return
    this.#failed = new ToldError(answer.why)
    this.free() // the instance is dead, and this one is not wanted in the next
  }

  wake(): void {}

  /** Goes to a state, and says what there is of it; rejects when the signal says so, or where it traps. */
  async reach(state: string, signal: AbortSignal): Promise<Frame> {
    this.#host?.send({ do: 'begin', value: state, name: '', on: false })
    while (this.#host?.busy) {
      this.#host.work(SLICE)
      await yieldToMain()
      signal.throwIfAborted()
    }
    const frame = this.#host?.frame()
    if (!frame) throw this.#failed ?? new ToldError({ key: 'no_background' })
    return frame
  }

  free(): void {
    this.#host?.free()
    this.#host = undefined
  }
}

/** The same state at another seed. */
export function atSeed(state: string, seed: number): string {
  const query = new URLSearchParams(state)
  query.set('seed', String(seed))
  return query.toString()
}
