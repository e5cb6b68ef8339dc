import { h } from './dom'

export function download(name: string, data: Blob): void {
  const url = URL.createObjectURL(data)
  h('a', { href: url, download: name }).click()
  setTimeout(() => URL.revokeObjectURL(url), 10_000) // Safari reads the blob after the click has returned
}

/** False where the browser refuses (no permission, no secure context): the caller then shows the text instead. */
export async function copy(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text)
    return true
  } catch {
    return false
  }
}
