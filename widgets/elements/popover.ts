// What opens over a figure and closes by Escape, by a press beside it, or when the focus goes on: the platform's popovers.
import { h, write } from './dom'
import type { ParamSpec, Readout } from './shell'
import type { Words } from './words'

/** The focus has gone elsewhere: nothing covers what a reader is at now. */
export function closeBehindFocus(popover: HTMLElement): void {
  popover.addEventListener('focusout', ({ relatedTarget }) => {
    // Its own button closes it by itself.
    if (!(relatedTarget instanceof Element) || popover.contains(relatedTarget)) return
    if ((relatedTarget as HTMLButtonElement).popoverTargetElement !== popover) popover.hidePopover()
  })
}

/** Closes it, where it is open, and gives the focus back. */
export function closePopover(popover: HTMLElement, back: HTMLElement | undefined): boolean {
  if (!popover.matches(':popover-open')) return false
  popover.hidePopover()
  back?.focus() // browsers do not find it in every shadow root
  return true
}

/** What the controls and the numbers of a figure mean: for readers without a mouse to point at each of them. */
export class Help {
  readonly button = h('button', { type: 'button', class: 'ask', part: 'button', popovertarget: 'help' })
  readonly element = h('div', { class: 'help', id: 'help', popover: 'auto', role: 'dialog', 'aria-labelledby': 'help-title', tabindex: '-1' })
  #from: HTMLElement | undefined // had the focus before
  #specs: ParamSpec[] = []
  #readouts: Readout[] = []

  constructor(private readonly words: Words) {
    words.always(() => write(this.button, words.say('what_do_these_mean')))
    closeBehindFocus(this.element)
    this.element.addEventListener('beforetoggle', event => event.newState === 'open' && this.#write())
    // Not by `autofocus`: that would take the focus of a whole page as well.
    this.element.addEventListener('toggle', event => event.newState === 'open' && this.element.focus())
  }

  open(): void {
    this.element.showPopover()
  }

  close(): boolean {
    return closePopover(this.element, this.#from)
  }

  /** What there is to explain. */
  about(specs: ParamSpec[], readouts: Readout[]): void {
    this.#specs = specs
    this.#readouts = readouts
  }

  #write(): void {
    this.#from = ((this.element.getRootNode() as ShadowRoot).activeElement as HTMLElement | null) ?? undefined
    const close = h('button', { type: 'button' }, this.words.say('close'))
    close.addEventListener('click', () => this.close())
    const title = h('p', { class: 'title', id: 'help-title' }, this.words.say('what_they_mean'))
    this.element.replaceChildren(h('div', { class: 'head' }, title, close), ...explained(this.words.say('controls'), this.#specs), ...explained(this.words.say('numbers'), this.#readouts))
  }
}

function explained(name: string, all: Pick<ParamSpec, 'title' | 'unit' | 'help'>[]): HTMLElement[] {
  const rows = all.filter(({ help }) => help).map(({ title, unit, help }) => h('div', {}, h('dt', {}, unit ? `${title} [${unit}]` : title), h('dd', {}, help)))
  return rows.length > 0 ? [h('p', { class: 'name' }, name), h('dl', {}, ...rows)] : []
}
