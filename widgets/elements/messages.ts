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

  /** A line with a button for each of several things that can be done; a press on any takes it away. */
  offer(cause: string, text: string, actions: [name: string, action: () => void][]): void {
    this.set(cause, text)
    const line = [...this.element.children].find(child => (child as HTMLElement).dataset['key'] === cause)!
    const buttons = actions.map(([name, action]) => {
      const button = h('button', { type: 'button' }, name)
      button.addEventListener('click', () => {
        line.remove()
        action()
      })
      return button
    })
    line.lastElementChild!.replaceWith(...buttons)
  }

  clear(): void {
    this.element.replaceChildren()
  }
}
