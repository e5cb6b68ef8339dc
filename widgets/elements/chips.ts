// The challenges of a figure: chips, each of which sets its state, and below them what there is to reach from the one that is pointed at, or
// that is on: how far that is, from now to the goal. What was reached is ticked (reached.ts).
import { h, write } from './dom'
import { isReached } from './reached'
import type { Chip, ParamSpec } from './shell'
import type { Words } from './words'

const MARGIN = 24 // [px] of the chip before it, so that it is seen that there is one

export class Chips {
  readonly element = h('div', { class: 'chips', part: 'chips', role: 'group', hidden: '' })
  /** Unfolds them where there is no room for a row of them. */
  readonly fold = h('button', { type: 'button', class: 'unfolds', part: 'button', 'aria-expanded': 'false', hidden: '' })
  readonly #goal = h('span')
  readonly #bar = h('progress', { max: '1' })
  readonly #said = h('span', { class: 'now' })
  /** Of the chip that is pointed at, or on. What screen readers need of them is in the chips. */
  readonly verdict = h('div', { class: 'verdict', part: 'verdict', 'aria-hidden': 'true', hidden: '' }, this.#goal, this.#bar, this.#said)
  #chips: Chip[] = []
  #locked = new Set<string>()
  #specs: ParamSpec[] = []
  #values: Record<string, string> = {}
  #pointed = -1
  #seen = -1 // the one that was last brought in sight, where the row scrolls
  #taken = '' // taken up last: it is on as long as it is still the challenge

  constructor(
    private readonly tag: string,
    private readonly words: Words,
    private readonly take: (chip: Chip) => void,
  ) {
    words.always(() => write(this.fold, (this.element.ariaLabel = words.say('challenges'))))
    this.fold.addEventListener('click', () => (this.fold.ariaExpanded = String(this.fold.ariaExpanded !== 'true')))
    this.element.addEventListener('keydown', event => this.#move(event))
    this.element.addEventListener('click', ({ target }) => this.#press(this.#numberOf(target)))
    for (const type of ['pointerover', 'focusin'] as const) this.element.addEventListener(type, ({ target }) => this.#point(this.#numberOf(target)))
    for (const type of ['pointerleave', 'focusout'] as const) this.element.addEventListener(type, () => this.#point(-1))
  }

  /** Shows them as they are in a frame. */
  show(chips: Chip[], specs: ParamSpec[], values: Record<string, string>): void {
    if (this.element.childElementCount !== chips.length) this.#make(chips.length)
    ;[this.#chips, this.#specs, this.#values] = [chips, specs, values]
    this.verdict.hidden = !chips.some(({ goal }) => goal)
    this.refresh()
  }

  /** Parameters that readers cannot change. */
  lock(names: Set<string>): void {
    this.#locked = names
    this.refresh()
  }

  /** What was reached may be another. */
  refresh(): void {
    const [buttons, now] = [this.#buttons, this.#now]
    for (const [i, chip] of this.#chips.entries()) {
      const button = buttons[i]!
      const reached = isReached(this.tag, chip.name)
      const why = this.#why(chip)
      button.dataset['challenge'] = chip.name
      button.ariaPressed = String(i === now)
      button.ariaLabel = reached ? this.words.say('reached', { title: chip.title }) : chip.title
      button.ariaDisabled = String(why !== '')
      button.title = why || [chip.goal, i === now ? chip.said : ''].filter(Boolean).join(': ')
      button.classList.toggle('reached', reached)
      write(button, chip.title)
    }
    if (now !== this.#seen) {
      this.#seen = now
      if (now >= 0) this.element.scrollLeft = buttons[now]!.offsetLeft - MARGIN
    }
    // One of them is where Tab comes to: the one that is on, or the first.
    const focused = buttons.findIndex(button => button.matches(':focus'))
    const stop = focused >= 0 ? focused : Math.max(0, now)
    buttons.forEach((button, i) => (button.tabIndex = i === stop ? 0 : -1))
    this.#say()
  }

  /** Whether it is known which there are. */
  get any(): boolean {
    return this.#chips.length > 0
  }

  /** The one of this name, if it can be had on this page. */
  find(name: string): Chip | undefined {
    return this.#chips.find(chip => chip.name === name && this.#why(chip) === '')
  }

  /** A reader has taken one up; or with nothing, another state is there. */
  takenUp(name = ''): void {
    this.#taken = name
  }

  /** Names of the parameters that the one that is on leaves to the reader. */
  get free(): string[] {
    return this.#chips[this.#now]?.free ?? []
  }

  /** The one that is on, where its goal is reached and was not before. */
  get justReached(): Chip | undefined {
    const chip = this.#chips[this.#now]
    return chip?.done && !isReached(this.tag, chip.name) ? chip : undefined
  }

  get #buttons(): HTMLButtonElement[] {
    return [...this.element.children] as HTMLButtonElement[]
  }

  get #now(): number {
    const taken = this.#chips.findIndex(({ name, still }) => still && name === this.#taken)
    return taken >= 0 ? taken : this.#chips.findIndex(({ now }) => now)
  }

  #make(count: number): void {
    this.element.replaceChildren(...Array.from({ length: count }, () => h('button', { type: 'button', class: 'chip', part: 'button chip' })))
    this.element.hidden = this.fold.hidden = count === 0
  }

  #numberOf(target: EventTarget | null): number {
    return this.#buttons.findIndex(button => target instanceof Node && button.contains(target))
  }

  /** Why it cannot be had on this page; empty if it can. */
  #why({ query }: Chip): string {
    if (this.#locked.size === 0) return ''
    const wanted = new URLSearchParams(query)
    const fixed = this.#specs.find(({ name, default: usual }) => this.#locked.has(name) && (wanted.get(name) ?? usual) !== this.#values[name])
    return fixed ? this.words.say('fixed', { name: fixed.name }) : ''
  }

  #press(number: number): void {
    const chip = this.#chips[number]
    if (chip && this.#why(chip) === '') this.take(chip)
  }

  #point(number: number): void {
    this.#pointed = number
    this.#say()
  }

  #say(): void {
    const now = this.#chips[this.#now]
    const pointed = this.#chips[this.#pointed]
    const chip = pointed && (pointed.goal || this.#why(pointed)) ? pointed : now
    const on = chip !== undefined && chip === now && chip.goal !== ''
    write(this.#goal, chip ? this.#why(chip) || chip.goal : '')
    write(this.#said, on ? `${chip.said}${chip.done ? ' ✓' : ''}` : '')
    this.#bar.hidden = !on
    this.#bar.value = on ? chip.near : 0
  }

  #move(event: KeyboardEvent): void {
    const buttons = this.#buttons
    const at = this.#numberOf(event.target)
    // As they are seen: the other way round where the page is written from right to left.
    const on = getComputedStyle(this.element).direction === 'rtl' ? -1 : 1
    const to: Record<string, number> = { ArrowRight: at + on, ArrowLeft: at - on, Home: 0, End: buttons.length - 1 }
    const next = to[event.key]
    if (next === undefined || event.altKey || event.ctrlKey || event.metaKey) return
    event.preventDefault()
    const button = buttons[(next + buttons.length) % buttons.length]!
    button.focus()
    this.refresh()
  }
}
