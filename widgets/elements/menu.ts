// The menu of a figure: what is done seldom. It is a popover, so that neither the figure nor what is around it cuts it off; where it
// lies is figure.css's.
import { h, icon } from './dom'
import { closeBehindFocus, closePopover } from './popover'
import type { Words } from './words'

export interface MenuItem {
  name: string
  act: () => void
}

export class Menu {
  readonly #button = h('button', { type: 'button', 'aria-haspopup': 'menu', 'aria-expanded': 'false', popovertarget: 'menu', part: 'button menu' }, icon('more'))
  readonly #list = h('div', { class: 'items', id: 'menu', popover: 'auto', role: 'menu' })
  readonly element = h('div', { class: 'menu' }, this.#button, this.#list)

  /** What an item is called may have changed. */
  readonly remake: () => void

  constructor(items: () => MenuItem[], figure: HTMLElement, words: Words) {
    const toggle = () => void (document.fullscreenElement ? document.exitFullscreen() : figure.requestFullscreen())
    this.remake = () => {
      const all = document.fullscreenEnabled ? [...items(), { name: words.say('full_screen'), act: toggle }] : items()
      this.#list.replaceChildren(...all.map(item => this.#item(item)))
      this.#button.ariaLabel = this.#button.title = this.#list.ariaLabel = words.say('menu')
    }
    words.always(this.remake)
    this.#list.addEventListener('toggle', () => {
      this.#button.ariaExpanded = String(this.isOpen)
      if (this.isOpen && !this.#focused) this.#focus(0)
    })
    this.#button.addEventListener('keydown', event => {
      if (event.key !== 'ArrowDown' && event.key !== 'ArrowUp') return
      event.preventDefault()
      this.#list.showPopover()
      this.#focus(event.key === 'ArrowDown' ? 0 : -1)
    })
    this.#list.addEventListener('keydown', event => this.#move(event))
    closeBehindFocus(this.#list)
  }

  /** Closes it, where it is open, and leaves the focus at its button. */
  close(): boolean {
    return closePopover(this.#list, this.#button)
  }

  get isOpen(): boolean {
    return this.#list.matches(':popover-open')
  }

  get #focused(): Element | null {
    return this.#list.querySelector(':focus')
  }

  /** The item of this number; from the end where it is negative. Tab comes to that one alone. */
  #focus(number: number): void {
    const items = [...this.#list.children] as HTMLElement[]
    const item = items.at(number)
    for (const each of items) each.tabIndex = each === item ? 0 : -1
    item?.focus()
  }

  #move(event: KeyboardEvent): void {
    const items = [...this.#list.children]
    const at = items.indexOf(this.#focused!)
    const to: Record<string, number> = { ArrowDown: (at + 1) % items.length, ArrowUp: at - 1, Home: 0, End: -1 }
    const next = to[event.key]
    if (next === undefined || event.altKey || event.ctrlKey || event.metaKey) return
    event.preventDefault()
    this.#focus(next)
  }

  #item({ name, act }: MenuItem): HTMLButtonElement {
    const button = h('button', { type: 'button', role: 'menuitem', tabindex: '-1' }, name)
    button.addEventListener('click', () => {
      this.close()
      act()
    })
    return button
  }
}
