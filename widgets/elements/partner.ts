// Two cores for one figure: a worker holds the same figure as the page, and each of the two works out a part of every step. What comes of it is the
// same to the bit; where the worker is late, or there is none, the page works alone.
import type { WorkerRequest, WorkerResponse } from './host'
import { createWorker } from './jobs'
import type { Program } from './program'

const PATIENCE = 100 // [ms] for which the page waits, in all of a run, beyond what it works itself: else the other core has something else to do
const REST = 8 // runs that the page makes alone then

export class Partner {
  #worker: Worker | undefined
  #ready = false
  #run = 0 // what comes of an earlier one is of no use
  #since: number | undefined // [ms] when the page began to wait for a part
  #heard = 0 // [ms] when the last one came
  #left = 0 // [ms] of patience
  #late: number | undefined // a timer, for when none is left
  #rest = 0 // runs until it is asked again

  constructor(
    program: Program,
    tag: string,
    private readonly hear: (part: Float64Array) => void,
    private readonly goAlone: () => void,
  ) {
    // The page itself has little to do meanwhile.
    if (navigator.hardwareConcurrency > 1) void this.#begin(program, tag)
  }

  async #begin(program: Program, tag: string): Promise<void> {
    try {
      const module = await program.module()
      const worker = createWorker()
      worker.addEventListener('message', ({ data }: MessageEvent<WorkerResponse>) => this.#onMessage(data))
      worker.addEventListener('error', event => {
        event.preventDefault()
        this.#fail()
      })
      this.#worker = worker
      this.#post({ do: 'partner', module, tag })
    } catch {
      // No worker, no partner.
    }
  }

  #post(request: WorkerRequest): void {
    this.#worker?.postMessage(request)
  }

  #onMessage(response: WorkerResponse): void {
    if (response.told === 'failed') this.#fail()
    else if (response.told === 'ready') this.#ready = true
    else if (response.told === 'part' && response.run === this.#run && this.waits) {
      clearTimeout(this.#late)
      this.#heard = performance.now()
      this.#left -= this.#heard - this.#since!
      this.hear(response.part)
    }
  }

  /** Whether it can begin a run, and is worth being asked. */
  isReady(): boolean {
    if (this.#rest > 0) this.#rest -= 1
    return this.#ready && this.#rest === 0
  }

  /** Whether the page waits for a part. */
  get waits(): boolean {
    return this.#since !== undefined && performance.now() < this.#since + this.#left
  }

  /** Begins what this link says. */
  begin(query: string): void {
    this.#run += 1
    this.#heard = performance.now()
    this.#left = PATIENCE
    this.#post({ do: 'begin-part', run: this.#run, query })
  }

  /** Gives the page's part of a step, and waits for the other. */
  give(part: Float64Array): void {
    this.#since = performance.now()
    this.#left += this.#since - this.#heard
    this.#late = window.setTimeout(this.goAlone, this.#left)
    this.#post({ do: 'part', run: this.#run, part })
  }

  /** Nothing more is wanted. */
  stop(): void {
    if (this.#since !== undefined && !this.waits) this.#rest = REST
    clearTimeout(this.#late)
    this.#run += 1
    this.#since = undefined
  }

  #fail(): void {
    this.end()
    this.goAlone()
  }

  end(): void {
    this.stop()
    this.#ready = false
    this.#worker?.terminate()
    this.#worker = undefined
  }
}
