// Workers: what runs beside the page, so that nothing else has to wait for it. Experiments over many seeds run in two of their own.
import { workerScript } from './files'
import type { Job, WorkerRequest, WorkerResponse } from './host'
import { programOf } from './program'
import type { Shell } from './shell'
import { ToldError } from './words'

/** How many workers share a job, where there are as many processors: the page itself has little to do meanwhile. */
const WORKERS = 2

/** What becomes of the rows of a seed, with an instance of the same program on the page for what is to be computed from them. */
type OnRows = (rows: number[][], shell: Shell) => void

/**
 * Resolves when every seed has been run; rows are told in the order of the seeds, whichever worker was the quicker. A signal stops it at
 * once; what came until then has been told.
 */
async function runInWorkers(tag: string, job: Job, onRows: OnRows, signal: AbortSignal): Promise<void> {
  const program = programOf(tag)
  const [module, shell] = [await program.module(), await program.shell()]
  signal.throwIfAborted()
  const every = Math.max(1, Math.min(WORKERS, navigator.hardwareConcurrency || 1, job.to - job.from))
  const early = new Map<number, number[][]>()
  let next = job.from
  const take = (seed: number, rows: number[][]) => {
    early.set(seed, rows)
    for (let found; (found = early.get(next)); early.delete(next++)) onRows(found, shell)
  }
  const stop = new AbortController() // of the others, when one fails
  const either = AbortSignal.any([signal, stop.signal])
  try {
    await Promise.all(Array.from({ length: every }, (_, k) => share({ do: 'job', module, job: { ...job, from: job.from + k }, every }, take, either)))
  } finally {
    stop.abort()
  }
}

/** What one worker does of a job: every so many seeds. */
async function share(request: Extract<WorkerRequest, { do: 'job' }>, onSeed: (seed: number, rows: number[][]) => void, signal: AbortSignal): Promise<void> {
  const worker = createWorker()
  try {
    await new Promise<void>((done, fail) => {
      signal.addEventListener('abort', () => fail(signal.reason as Error), { once: true })
      worker.addEventListener('message', ({ data }: MessageEvent<WorkerResponse>) => {
        if (data.told === 'rows') onSeed(data.seed, data.rows)
        else if (data.told === 'done') done()
        else if (data.told === 'failed') fail(new ToldError(data.why))
      })
      worker.addEventListener('error', event => {
        event.preventDefault()
        fail(workerRefused(event.message))
      })
      worker.postMessage(request)
    })
  } finally {
    worker.terminate()
  }
}

/** Jobs of which one runs at a time: another one, or a stop, ends the one before. */
export class Jobs {
  #now: AbortController | undefined

  get running(): boolean {
    return this.#now !== undefined
  }

  /** Ends the one that runs, if one does. */
  stop(): boolean {
    const { running } = this
    this.#now?.abort()
    this.#now = undefined
    return running
  }

  /** Whether it was run to its end: nothing more is to be said of one that was stopped, or followed by another. */
  async run(tag: string, job: Job, onRows: OnRows): Promise<boolean> {
    this.stop()
    const now = (this.#now = new AbortController())
    try {
      await runInWorkers(tag, job, (rows, shell) => now === this.#now && onRows(rows, shell), now.signal)
    } catch (error) {
      if (now === this.#now) throw error
    } finally {
      if (now === this.#now) this.#now = undefined
    }
    return !now.signal.aborted
  }
}

/**
 * A worker's file must be of the page's own site. Where the figures come from another one, or the page has no site (a sandboxed frame),
 * a line that imports it is; and a file for offline use carries it along.
 */
export function createWorker(): Worker {
  try {
    const file = workerScript()
    const own = 'address' in file && new URL(file.address, location.href).origin === self.origin
    const script = 'text' in file ? file.text : `import ${JSON.stringify(new URL(file.address, location.href).href)}`
    const url = own ? file.address : URL.createObjectURL(new Blob([script], { type: 'text/javascript' }))
    const worker = new Worker(trusted(url), { type: 'text' in file ? 'classic' : 'module' })
    if (!own) setTimeout(() => URL.revokeObjectURL(url), 10_000) // when it has been read
    return worker
  } catch (error) {
    throw workerRefused(error instanceof Error ? error.message : '')
  }
}

interface TrustedTypes {
  createPolicy(name: string, rules: { createScriptURL(url: string): string }): { createScriptURL(url: string): URL }
}

let policy: ReturnType<TrustedTypes['createPolicy']> | undefined

/** Where a page lets no text become the address of a script, a policy of ours has to vouch for it: this one, for this address alone. */
function trusted(url: string): string | URL {
  try {
    policy ??= (self as { trustedTypes?: TrustedTypes }).trustedTypes?.createPolicy('fastslam', { createScriptURL: address => address })
  } catch {
    // The page does not know the name. Whether it asks for a policy at all, the worker will tell.
  }
  return policy?.createScriptURL(url) ?? url
}

export function workerRefused(why: string | undefined): ToldError {
  return new ToldError(why ? { key: 'no_background_because', values: { why } } : { key: 'no_background' })
}
