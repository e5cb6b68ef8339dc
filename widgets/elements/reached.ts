// Which challenges a reader has reached: kept on this device, and nothing else of the reader. Where a page may not store, it holds while
// the page is open.
const KEY = 'fastslam-challenges'

const watchers = new Set<Watcher>()
let reached: Set<string> | undefined

/** What is stored; a page in a sandbox or of a file may have no storage, and what is in it may be anybody's. */
function stored(): string[] {
  try {
    const list: unknown = JSON.parse(localStorage.getItem(KEY) ?? '[]')
    return Array.isArray(list) ? list.filter(item => typeof item === 'string') : []
  } catch {
    return []
  }
}

const known = (): Set<string> => (reached ??= new Set(stored()))

export const isReached = (tag: string, name: string): boolean => known().has(`${tag} ${name}`)

/** Remembers that a challenge was reached. */
export function reach(tag: string, name: string): void {
  known().add(`${tag} ${name}`)
  keep(() => localStorage.setItem(KEY, JSON.stringify([...new Set([...stored(), ...known()])])))
}

/** Forgets all, of every figure. */
export function forgetReached(): void {
  reached = new Set()
  keep(() => localStorage.removeItem(KEY))
}

/** Has them shown again after every change, whichever figure made it. */
export function watchReached(watcher: Watcher, signal: AbortSignal): void {
  watchers.add(watcher)
  signal.addEventListener('abort', () => watchers.delete(watcher))
}

interface Watcher {
  refresh(): void
}

function keep(store: () => void): void {
  try {
    store()
  } catch {
    // it is known while the page is open
  }
  for (const watcher of watchers) watcher.refresh()
}
