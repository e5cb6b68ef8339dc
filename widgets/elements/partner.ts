// Two cores for one figure: a worker holds the same figure as the page, and each of the two works out a part of every step. What comes of it is the
// same to the bit; where the worker is late, or there is none, the page works alone.
import type { WorkerRequest, WorkerResponse } from './host'
import { createWorker } from './jobs'
import type { Program } from './program'

const LATE = 250 // [ms] of waiting for a part, after which the page goes on alone
const SLOW = 50 // [ms] of waiting beyond what the page itself works: the other core has something else to do
const REST = 8 // runs that the page makes alone then

export class Partner {
  #worker: Worker | undefined
  #ready = false
  #run = 0 // what comes of an earlier one is of no use
  #since: number | undefined // [ms] when the page began to wait for a part
  #heard = 0 // [ms] when the last one came
  #ahead = 0 // [ms] by which the page has worked longer in this run than it has waited
  #rest = 0 // runs until it is asked again

  constructor(
    program: Program,
    tag: string,
    private readonly hear: (part: Float64Array) => void,
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
        this.end()
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
    if (response.told === 'failed') this.end()
    else if (response.told === 'ready') this.#ready = true
    else if (response.told === 'part' && response.run === this.#run && this.waits) {
      this.#heard = performance.now()
      this.#ahead -= this.#heard - this.#since!
      this.hear(response.part)
    }
  }

  /** Whether it can begin a run, and is worth being asked. */
  isReady(): boolean {
    if (this.#rest > 0) this.#rest -= 1
    return this.#ready && this.#rest === 0
  }

  /** Whether more is waited for it in this run than it helps. */
  get isSlow(): boolean {
    return this.#ahead < -SLOW
  }

  /** Whether the page waits for a part, and not too long. */
  get waits(): boolean {
    return this.#since !== undefined && performance.now() < this.#since + LATE
  }

  /** Begins what this link says. */
  begin(query: string): void {
    this.#run += 1
    this.#heard = performance.now()
    this.#ahead = 0
    this.#post({ do: 'begin-part', run: this.#run, query })
  }

  /** Gives the page's part of a step, and waits for the other. */
  give(part: Float64Array): void {
    this.#since = performance.now()
    this.#ahead += this.#since - this.#heard
    this.#post({ do: 'part', run: this.#run, part })
  }

  /** Nothing more is wanted. */
  stop(): void {
    if (this.isSlow || (this.#since !== undefined && !this.waits)) this.#rest = REST
    this.#ahead = 0
    this.#run += 1
    this.#since = undefined
  }

  end(): void {
    this.stop()
    this.#ready = false
    this.#worker?.terminate()
    this.#worker = undefined
  }
}
