// What a reader has answered is kept on this device, and nowhere else. Where there is no storage, in a frame without an origin, it is not kept.

export function recall(key: string): string | undefined {
  try {
    return localStorage.getItem(key) ?? undefined
  } catch {
    return undefined
  }
}

export function remember(key: string, text: string | undefined): void {
  try {
    if (text === undefined) localStorage.removeItem(key)
    else localStorage.setItem(key, text)
  } catch {
    // then it is not kept
  }
}

/** A line below a question that is told to screen readers as it changes, with a button that takes the answer back. */
export function lineWith(title: string, forget: () => void): { line: HTMLElement; told: HTMLElement; button: HTMLButtonElement } {
  const told = Object.assign(document.createElement('span'), { role: 'status' })
  const button = Object.assign(document.createElement('button'), { type: 'button', textContent: title })
  const line = Object.assign(document.createElement('div'), { className: 'told' })
  button.addEventListener('click', forget)
  line.append(told, ' ', button)
  return { line, told, button }
}
