// Files that are dropped: on a figure, which reads them, or beside it.

/** A figure takes the first of the files that are dropped on it. */
export function takeDrops(body: HTMLElement, open: (file: File) => void): void {
  for (const type of ['dragenter', 'dragover'] as const) {
    body.addEventListener(type, event => {
      if (!hasFiles(event)) return
      event.preventDefault()
      body.classList.add('dropping')
    })
  }
  body.addEventListener('dragleave', event => {
    if (!body.contains(event.relatedTarget as Node | null)) body.classList.remove('dropping')
  })
  body.addEventListener('drop', event => {
    body.classList.remove('dropping')
    if (!hasFiles(event)) return
    event.preventDefault()
    const file = event.dataTransfer!.files[0]
    if (file) open(file)
  })
}

/**
 * A file dropped beside the figure would make the browser leave the page and show the file. Zones of the page's own that take files,
 * boxes for files and editors are left alone.
 */
export function keepPage(signal: AbortSignal): void {
  for (const type of ['dragover', 'drop'] as const) {
    addEventListener(
      type,
      event => {
        const target = event.composedPath()[0]
        if (event.defaultPrevented || !hasFiles(event)) return
        if (target instanceof HTMLElement && (target.matches('input, textarea') || target.isContentEditable)) return
        event.preventDefault()
        event.dataTransfer!.dropEffect = 'none'
      },
      { signal },
    )
  }
}

function hasFiles(event: DragEvent): boolean {
  return event.dataTransfer?.types.includes('Files') ?? false
}
