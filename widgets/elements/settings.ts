// What a figure's parameters are to be, for the time before its program is there, between two of them, and while a setting is on its
// way. One order holds: what is locked keeps the author's value; else a reader's link stands over what the author gave, and that over
// the default. What is set later, by whomever, stands over what was set before.
import type { Beginning } from './action'
import { FIGURES } from './generated/figures'
import { fromText, isParameter } from './parameters'
import type { ParamSpec } from './shell'

export class Settings {
  /** The last state shown, or one asked for, as a link has it: a figure is made from it after a move. Undefined until there was one. */
  recipe: string | undefined
  #linked = false // the recipe is a reader's link and not the figure's own
  #waiting = new Map<string, string | null>() // given while no figure lives: for the next one
  #asked = new Map<string, { text: string; number: number }>() // on their way, and the command that took them
  #given = new Map<string, string>() // given by property, since the attribute was last set

  constructor(private readonly figure: HTMLElement) {}

  /** Begins anew with a whole state; with undefined, from the attributes. */
  load(recipe: string | undefined, linked = false): void {
    this.recipe = recipe
    this.#linked = linked
    this.#waiting.clear()
    this.#asked.clear()
  }

  /** A property was set: it is the author's value until the attribute is set. */
  give(name: string, text: string): void {
    this.#given.set(name, text)
  }

  /** An attribute was set or taken away: it is the author's value. */
  giveAttribute(name: string): void {
    this.#given.delete(name)
  }

  /** For the figure to begin with, as none lives. */
  wait(name: string, text: string | null): void {
    this.#waiting.set(name, text)
  }

  /** An attribute is read when the figure begins, unless it begins with a state; then it is set after that. */
  waitAttribute(name: string): void {
    if (this.recipe === undefined) this.#waiting.delete(name)
    else this.#waiting.set(name, this.figure.getAttribute(name))
  }

  /** The version of the figure that its attributes are of. */
  get version(): string {
    const { version, unsaid } = FIGURES[this.figure.localName]!
    const v = this.figure.getAttribute('v') ?? unsaid
    return v === 'latest' ? version : v
  }

  /** Whether anything was asked of the figure. */
  get any(): boolean {
    return Boolean(this.recipe) || this.#waiting.size > 0 || this.version !== FIGURES[this.figure.localName]!.version || this.#attributes.length > 0
  }

  /** What the page's author gave, as a code has it. */
  get authored(): string {
    const authored = new URLSearchParams()
    for (const name of [...this.#attributes, 'v']) if (this.figure.hasAttribute(name)) authored.set(name, this.figure.getAttribute(name)!)
    for (const [name, text] of this.#given) authored.set(name, text)
    return authored.toString()
  }

  get #attributes(): string[] {
    return this.figure.getAttributeNames().filter(isParameter)
  }

  /** The state to begin with. What waited is on its way with the command of this number. */
  begin(number: number, changed: boolean): Beginning {
    const waiting = [...this.#waiting]
    this.#waiting.clear()
    const given = this.recipe === undefined ? this.#attributes.map((name): [string, string | null] => [name, this.figure.getAttribute(name)]) : []
    const settings = [...given, ...waiting]
    for (const [name, text] of settings) if (text !== null) this.#asked.set(name, { text, number })
    const written = settings.map(([name, text]) => (text === null ? name : `${name}=${encodeURIComponent(text)}`))
    const linked = this.#linked
    this.#linked = false
    return { do: linked ? 'link' : 'begin', value: this.recipe ?? null, name: written.join('&'), on: changed }
  }

  /** A setting was sent with the command of this number. */
  ask(name: string, text: string, number: number): void {
    this.#asked.set(name, { text, number })
  }

  /** All commands up to this number have been carried out. */
  answered(number: number): void {
    for (const [name, asked] of this.#asked) if (asked.number <= number) this.#asked.delete(name)
  }

  /** The figure ends: its state is kept for the next one, and what may not have come to it as well. */
  keep(query: string | undefined): void {
    this.recipe = query ?? this.recipe
    for (const [name, { text }] of this.#asked) this.#waiting.set(name, text)
    this.#asked.clear()
  }

  /** The value, or what it will be; undefined for the default where that is not known yet. */
  get(name: string, values: Record<string, string> | undefined, specs: ParamSpec[]): unknown {
    const before = this.recipe === undefined ? this.figure.getAttribute(name) : new URLSearchParams(this.recipe).get(name)
    const now = this.#asked.get(name)?.text ?? values?.[name] ?? this.#waiting.get(name) ?? before
    return fromText(now ?? specs.find(spec => spec.name === name)?.default)
  }
}
