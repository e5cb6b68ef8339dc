// Calm lines in a figure that say what is wrong and offer what can be done.
import { h } from './dom'

/** A line, one for each cause; an empty text takes it away. */
export function notice(box: HTMLElement, key: string, text: string, actionName = 'Dismiss', action?: () => void): void {
  const old = [...box.children].find(child => (child as HTMLElement).dataset['key'] === key)
  if (!text) return old?.remove()
  const button = h('button', { type: 'button' }, actionName)
  const line = h('p', { part: 'notice', 'data-key': key }, h('span', {}, text), button)
  button.addEventListener('click', action ?? (() => line.remove()))
  if (old) old.replaceWith(line)
  else box.append(line)
}
