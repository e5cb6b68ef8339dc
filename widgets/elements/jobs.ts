// Experiments over many seeds, beside the page: in a Web Worker, so that nothing else has to wait for them.
import { engine } from './engine'
import { workerScript } from './files'

/** What is to be run: an experiment of the shell, its setting as a figure's link, and seeds from `from` to before `to`. */
export interface Job {
  name: string
  query: string
  from: number
  to: number
}

/** What the worker says: rows as they come, one for each seed, then that it is done, or why it is not. */
export type Told = { rows: number[][] } | { done: true } | { failed: string }

/** Resolves when every seed has been run. A signal stops it at once; what came until then has been told. */
export async function runInWorker(job: Job, onRows: (rows: number[][]) => void, signal: AbortSignal): Promise<void> {
  const { program } = await engine()
  signal.throwIfAborted()
  const worker = hire()
  try {
    await new Promise<void>((done, fail) => {
      signal.addEventListener('abort', () => fail(signal.reason as Error), { once: true })
      worker.addEventListener('message', ({ data }: MessageEvent<Told>) => {
        if ('rows' in data) onRows(data.rows)
        else if ('done' in data) done()
        else fail(new Error(data.failed))
      })
      worker.addEventListener('error', event => {
        event.preventDefault()
        fail(refused(event.message))
      })
      worker.postMessage({ ...job, program })
    })
  } finally {
    worker.terminate()
  }
}

/**
 * A worker's file must be of the page's own site. Where the figures come from another one, or the page has no site (a sandboxed frame),
 * a line that imports it is; and a file for offline use carries it along.
 */
export function hire(): Worker {
  try {
    const file = workerScript()
    const own = 'address' in file && new URL(file.address, location.href).origin === self.origin
    const script = 'text' in file ? file.text : `import ${JSON.stringify(new URL(file.address, location.href).href)}`
    const url = own ? file.address : URL.createObjectURL(new Blob([script], { type: 'text/javascript' }))
    const worker = new Worker(url, { type: 'text' in file ? 'classic' : 'module' })
    if (!own) setTimeout(() => URL.revokeObjectURL(url), 10_000) // when it has been read
    return worker
  } catch (error) {
    throw refused(error instanceof Error ? error.message : '')
  }
}

export function refused(why: string | undefined): Error {
  return new Error(`this page lets nothing run in the background${why ? ` (${why})` : ''}`)
}
