// A figure whose program runs on the page: commands are calls, and what they do can be read at once.
import { HostMemory, keptAs, type Command, type FigureHost, type Frame, type Listener } from './host'
import { Partner } from './partner'
import type { InstanceUser, Program } from './program'
import { trapMessage, type ProgramState, type Shell } from './shell'
import { Session } from './session'
import { ToldError } from './words'

const CATCH_UP_PAINT = 100 // [ms] between two pictures, where what was asked for is still being computed …
const REFINE_PAINT = 250 // … and where nothing was asked for since the first of the two

export class LocalHost implements FigureHost, InstanceUser {
  readonly remote = false
  #session: Session | undefined // none between a trap and the instance after it
  sent = 0
  #queue: Command[] = [] // what was asked meanwhile
  #dirty = true
  #paintedAt = -Infinity // [ms]
  #asked = true // something, since then
  #answer = 0 // to what was asked last that was painted
  readonly #memory = new HostMemory()
  #trapped = false // it was this figure that killed the instance
  #partner: Partner | undefined // once there was enough to do for two again
  #shareable = 0 // runs with enough to do for two
  #part: Float64Array = new Float64Array() // of the step that it works out
  #known: ProgramState | undefined // as it was asked to be, for the time without a session

  private constructor(
    private readonly program: Program,
    private shell: Shell,
    private readonly tag: string,
    private readonly listener: Listener,
  ) {
    this.#session = new Session(shell, tag, answer => listener.hear(answer))
    program.users.add(this)
  }

  static async create(program: Program, tag: string, listener: Listener): Promise<LocalHost> {
    return new LocalHost(program, await program.shell(), tag, listener)
  }

  /** At once, where the program is there. */
  static now(program: Program, tag: string, listener: Listener): LocalHost | undefined {
    return program.ready && new LocalHost(program, program.ready, tag, listener)
  }

  get state(): ProgramState | undefined {
    return this.#ask(session => session.state) ?? this.#known
  }

  get busy(): boolean {
    return this.#ask(session => session.pending) ?? true // between two instances it is on its way back
  }

  get done(): number {
    return this.sent - this.#queue.length
  }

  send(command: Command): void {
    this.#memory.note(command)
    this.sent += 1
    if (this.#session) this.#carryOut(command)
    else this.#queue.push(command)
  }

  get waits(): boolean {
    return this.#partner?.waits ?? false
  }

  work(budget: number, shared = false): void {
    if (shared && (this.waits || this.#share())) return
    this.#partner?.stop()
    this.#ask(session => {
      const end = performance.now() + budget
      while (session.pending && performance.now() < end) {
        session.work()
        this.#dirty = true
      }
    })
  }

  frame(now?: number): Frame | undefined {
    return this.#ask(session => {
      const { answer } = session.state
      const hurry = session.pending && answer <= this.#answer && now! < this.#paintedAt + (this.#asked ? CATCH_UP_PAINT : REFINE_PAINT)
      if (now !== undefined && (!this.#dirty || hurry || !answer)) return undefined
      const frame = session.frame(now === undefined)
      this.#answer = answer
      this.#dirty = this.#asked = now === undefined
      this.#paintedAt = performance.now()
      this.#memory.saw(frame)
      return frame
    })
  }

  refresh(): void {
    this.#dirty = true
  }

  /** Has the partner begin, where there is enough to do for two. Whether it does. */
  #share(): boolean {
    if (!this.#ask(session => session.shares)) return false
    // Who only reads has one such run, and a worker would be ready when it is over.
    this.#shareable += 1
    if (this.#shareable === 1) return false
    this.#partner ??= new Partner(
      this.program,
      this.tag,
      part => this.#hearPart(part),
      () => this.listener.wake(),
    )
    const partner = this.#partner
    if (!partner.isReady()) return false
    partner.begin(this.state!.query)
    this.#givePart()
    return true
  }

  #givePart(): void {
    this.#ask(session => this.#partner!.give((this.#part = session.part(0))))
  }

  #hearPart(part: Float64Array): void {
    this.#ask(session => session.workWith(this.#part, part))
    this.#dirty = true
    if (this.busy) return this.#givePart()
    this.#partner!.stop()
    this.listener.wake()
  }

  free(): void {
    this.#partner?.end()
    this.program.users.delete(this)
    this.#ask(session => session.free())
    this.#session = undefined
  }

  // --- A trap ------------------------------------------------------------------------------------------------------------

  /** The only way into the session. What comes out as an error is a trap: refusals are caught there. */
  #ask<T>(action: (session: Session) => T): T | undefined {
    if (!this.#session) return undefined
    try {
      return action(this.#session)
    } catch (error) {
      this.#trapped = true
      const why = trapMessage(error, this.shell)
      this.program.replace()
      this.listener.hear({ told: 'failed', why, error: String(error) })
      return undefined
    }
  }

  #carryOut(command: Command): void {
    this.#partner?.stop()
    this.#dirty = this.#asked = true
    this.#answer = 0
    this.#ask(session => {
      void session.do(command)
      // A state that is asked for is remembered, in case that another figure kills the instance before it is shown.
      if (!keptAs(command)) this.#known = session.state
    })
  }

  lose(): void {
    this.#partner?.stop()
    this.#session?.abandon()
    this.#session = undefined
  }

  revive(): void {
    void this.#revive()
  }

  async #revive(): Promise<void> {
    const again = this.#memory.again(this.#trapped ? undefined : this.#known?.query)
    this.#trapped = false
    try {
      this.shell = await this.program.shell()
      if (!this.program.users.has(this) || this.#session) return
      this.#session = new Session(this.shell, this.tag, answer => this.listener.hear(answer))
      for (const command of [...again, ...this.#queue.splice(0)]) this.#carryOut(command)
      this.listener.wake()
    } catch (error) {
      const why = error instanceof ToldError ? error.told : (error as Error).message
      this.listener.hear({ told: 'failed', why, error: String(error) })
    }
  }

  restart(): void {
    this.revive()
  }
}
