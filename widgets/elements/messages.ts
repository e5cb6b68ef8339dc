// Calm lines in a figure that say what is wrong and offer what can be done.
import { h } from './dom'
import type { Words } from './words'

export class Messages {
  readonly element = h('div', { class: 'notices', part: 'notices', role: 'alert' })

  constructor(private readonly words: Words) {}

  /** A line, one for each cause; an empty text takes it away. */
  set(cause: string, text: string, actionName = this.words.say('dismiss'), action?: () => void): void {
    const old = [...this.element.children].find(child => (child as HTMLElement).dataset['key'] === cause)
    if (!text) return old?.remove()
    const button = h('button', { type: 'button' }, actionName)
    const line = h('p', { part: 'notice', 'data-key': cause }, h('span', {}, text), button)
    button.addEventListener('click', action ?? (() => line.remove()))
    if (old) old.replaceWith(line)
    else this.element.append(line)
  }

  clear(): void {
    this.element.replaceChildren()
  }
}
