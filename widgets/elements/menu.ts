// The menu of a figure: what is done seldom.
import { h, icon } from './dom'

export interface MenuItem {
  name: string
  act: () => void
}

export class Menu {
  readonly element: HTMLDetailsElement
  readonly #summary = h('summary', { 'aria-label': 'Menu', title: 'Menu', part: 'button menu' }, icon('more'))

  constructor(items: MenuItem[], figure: HTMLElement) {
    const toggle = () => void (document.fullscreenElement ? document.exitFullscreen() : figure.requestFullscreen())
    const all = document.fullscreenEnabled ? [...items, { name: 'Full screen', act: toggle }] : items
    this.element = h('details', { class: 'menu', part: 'menu' }, this.#summary, h('div', { class: 'items' }, ...all.map(item => this.#button(item))))
    this.element.addEventListener('focusout', event => {
      if (!this.element.contains(event.relatedTarget as Node | null)) this.element.open = false
    })
  }

  /** Closes it, where it is open, and leaves the focus at its button. */
  close(): boolean {
    if (!this.element.open) return false
    this.element.open = false
    this.#summary.focus()
    return true
  }

  #button({ name, act }: MenuItem): HTMLButtonElement {
    const button = h('button', { type: 'button' }, name)
    button.addEventListener('click', () => {
      this.element.open = false
      act()
    })
    return button
  }
}
