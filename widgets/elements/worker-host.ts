// A figure whose program runs in a worker: commands are messages, and what they did comes with the next frame. The page answers at once
// whatever the figure does.
import { clampedStep, HostMemory, type Command, type FigureHost, type Frame, type Listener, type SentFrame, type WorkerRequest, type WorkerResponse } from './host'
import { createWorker, workerRefused } from './jobs'
import type { Program } from './program'
import type { ProgramState } from './shell'

export class WorkerHost implements FigureHost {
  readonly remote = true
  readonly waits = false
  #worker: Worker | undefined
  sent = 0
  #before = 0 // commands of workers that have died
  #shown: SentFrame | undefined // the last frame that came
  #new = false
  #target: number | undefined // asked for since then
  readonly #memory = new HostMemory()

  private constructor(
    private readonly module: WebAssembly.Module,
    private readonly tag: string,
    private readonly listener: Listener,
  ) {
    this.#begin()
  }

  static async create(program: Program, tag: string, listener: Listener): Promise<WorkerHost> {
    return new WorkerHost(await program.module(), tag, listener)
  }

  get state(): ProgramState | undefined {
    return this.#shown && { ...this.#shown, target: this.#target ?? this.#shown.target }
  }

  get busy(): boolean {
    return this.done < this.sent || (this.#shown?.busy ?? true)
  }

  get done(): number {
    return this.#before + (this.#shown?.done ?? 0)
  }

  send(command: Command): void {
    this.#memory.note(command)
    if (command.do === 'seek') this.#target = clampedStep(command.at[0], this.#shown?.last ?? 0)
    this.sent += 1
    this.#post(command)
  }

  work(): void {
    // It does so by itself.
  }

  frame(now?: number): Frame | undefined {
    if (!this.#shown || (now !== undefined && !this.#new)) return undefined
    const { picture, ...frame } = this.#shown
    if (now === undefined) return { ...frame, changed: false, trace: undefined, picture: undefined }
    this.#shown = { ...frame, picture: undefined, changed: false, trace: undefined } // painted and told once
    this.#new = false
    return { ...frame, picture: picture && { ...picture, pixels: () => picture.pixels } }
  }

  refresh(): void {
    this.#new = true
  }

  restart(): void {
    this.#worker?.terminate()
    this.#before = this.sent
    this.#shown &&= { ...this.#shown, done: 0 }
    this.#target = undefined
    this.#begin()
    for (const command of this.#memory.again()) this.send(command)
  }

  free(): void {
    this.#worker?.terminate()
    this.#worker = undefined
  }

  #begin(): void {
    const worker = createWorker()
    this.#worker = worker
    worker.addEventListener('message', ({ data }: MessageEvent<WorkerResponse>) => worker === this.#worker && this.#hear(data))
    worker.addEventListener('error', event => {
      event.preventDefault()
      const { told, message } = workerRefused(event.message)
      if (worker === this.#worker) this.listener.hear({ told: 'failed', why: told, error: message })
    })
    this.#post({ do: 'figure', module: this.module, tag: this.tag })
  }

  #post(request: WorkerRequest): void {
    this.#worker?.postMessage(request)
  }

  #hear(response: WorkerResponse): void {
    if (response.told === 'rows' || response.told === 'done' || response.told === 'ready' || response.told === 'part') return
    if (response.told !== 'frame') return this.listener.hear(response)
    const { frame } = response
    // What was not looked at in time is not lost with the frame that it came with.
    const waiting = this.#new ? this.#shown : undefined
    this.#shown = { ...frame, changed: frame.changed || (waiting?.changed ?? false), trace: frame.trace ?? waiting?.trace, picture: frame.picture ?? waiting?.picture }
    this.#new = true
    this.#memory.saw(frame)
    if (this.done >= this.sent) this.#target = undefined
    this.listener.wake()
  }
}
