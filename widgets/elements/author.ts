// What a page's author fixes about a figure besides its parameters (options.ts), and what the author is told of mistakes.
import { figureEvent } from './events'
import { FIGURES } from './generated/figures'
import type { Command } from './host'
import { CHIPS, hasComma, locked, NUMBERS, offered, optionCommand, OPTIONS, refusal, unknownNames } from './options'
import type { View } from './view'
import type { Words } from './words'

const AT_HOME = /^(localhost|127\.0\.0\.1|\[::1\])$/.test(location.hostname)

export class Author {
  constructor(
    private readonly figure: HTMLElement,
    private readonly view: View,
    private readonly words: Words,
    private readonly command: (command: Command) => void,
  ) {}

  /** Tells the program of all options, or of some. */
  send(names = Object.keys(OPTIONS)): void {
    for (const name of names) {
      const command = optionCommand(name, this.figure.getAttribute(name), this.words)
      if (command) this.command(command)
    }
  }

  /** Names of the parameters that readers may not change, and of those whose controls they see; undefined for all. */
  get lets(): { locked: Set<string>; offered: Set<string> | undefined } {
    const names = this.view.specs.map(({ name }) => name)
    return { locked: locked(this.figure.getAttribute('lock'), names).locked, offered: offered(this.figure.getAttribute('controls'), names).offered }
  }

  /** What options do on the page, and what is wrong with them. */
  show(...options: string[]): void {
    for (const name of options) this.tell(name, this.#show(name, this.figure.getAttribute(name)))
  }

  #show(name: string, text: string | null): string {
    const { view, words } = this
    const { controls } = view
    if (name === 'lab') view.showLab(text === 'open')
    if (!controls) return refusal(name, text, words)
    const names = view.specs.map(spec => spec.name)
    if (name === 'lock') {
      const wish = locked(text, names)
      controls.lock(wish.locked)
      view.chips.lock(wish.locked)
      return unknownNames(name, wish.unknown, names, words)
    }
    if (name === 'controls') {
      const wish = offered(text, names)
      controls.offer(wish.offered)
      view.body.classList.toggle('some-controls', wish.offered !== undefined)
      view.showNumbers(wish.offered?.has(NUMBERS) ?? true)
      view.chips.element.classList.toggle('left-out', !(wish.offered?.has(CHIPS) ?? true))
      return unknownNames(name, wish.unknown, wish.known, words)
    }
    if (name === 'decimal') controls.writeComma(hasComma(text, words))
    return refusal(name, text, words)
  }

  /** A reader's input is refused in the figure. What the page asks for by an attribute, or by a name that no figure has, its author has mistaken. */
  refused(cause: string, text: string, byPage: boolean): void {
    const { figure } = this
    const mistaken = byPage && !['link', 'locked'].includes(cause) && (figure.hasAttribute(cause) || !FIGURES[figure.localName]!.parameters.includes(cause))
    if (mistaken) this.tell(cause, text)
    else this.view.messages.set(cause, text)
  }

  /** Readers can do nothing about it: it goes to the console and to whoever listens, and stands in the figure on the machine where a page is made. */
  tell(name: string, text: string): void {
    if (AT_HOME) this.view.messages.set(name, text)
    if (!text) return
    console.info(`<${this.figure.localName}>: ${text}`)
    // The program may be at work just now.
    queueMicrotask(() => this.figure.dispatchEvent(figureEvent('fastslam-notice', { name, text })))
  }
}
