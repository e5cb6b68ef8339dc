// Paper: the browser waits for nothing once it prints, so every figure whose program is there computes at once what it is to show. Whoever
// prints from a figure's menu, or by our own pages' key, has all programs fetched first.

/** What a figure does about paper. */
export interface Printed {
  /** Fetches its program. */
  load(): Promise<void> | undefined
  /** Shows what it is to show, now. */
  toPaper(): void
  /** Is on the screen again. */
  offPaper(): void
}

const figures = new Set<Printed>()

/** Whether the page is being printed: on white. */
export let printing = false

addEventListener('beforeprint', () => {
  printing = true
  for (const figure of figures) figure.toPaper()
})
addEventListener('afterprint', () => {
  printing = false
  for (const figure of figures) figure.offPaper()
})

/** Until the signal it is told of paper. */
export function takeToPaper(figure: Printed, signal: AbortSignal): void {
  figures.add(figure)
  signal.addEventListener('abort', () => figures.delete(figure))
}

/** On a page of ours the key for printing does that. In a frame it prints the page around. */
export function takePrintKey(): void {
  if (parent !== self) return
  addEventListener('keydown', event => {
    if (!(event.ctrlKey || event.metaKey) || event.altKey || event.shiftKey || event.key.toLowerCase() !== 'p') return
    event.preventDefault()
    void printAll()
  })
}

/** Prints the page, once all its figures are there. False where that is not allowed. */
export async function printAll(): Promise<boolean> {
  await Promise.allSettled([...figures].map(figure => figure.load()))
  let allowed = false
  addEventListener('beforeprint', () => (allowed = true), { once: true })
  print()
  return allowed
}
