// The fields of an assignment, and the task that they hold.
import { h } from '../../widgets/elements/dom'
import { OPTIONS } from '../../widgets/elements/options'
import { readNumber, sound, TRIES, type Kind, type Task } from './task/task'
import type { Editor } from './wishes'

const label = (name: string, field: HTMLElement) => h('label', {}, h('span', { class: 'name' }, name), field)
const text = (given: Record<string, string> = {}) => h('input', { autocomplete: 'off', ...given })

export class Composer {
  readonly #question = h('textarea', { rows: '2', maxlength: '2000', placeholder: 'How many universes are left at the end?' })
  readonly #kind = h('select', {}, new Option('a number', 'number'), new Option('a choice', 'choice'), new Option('a text', 'text'), new Option('a state to reach', 'reach'))
  readonly #measured = h('select', {})
  readonly #answer = text({ inputmode: 'decimal' })
  readonly #tolerance = text({ inputmode: 'decimal' })
  readonly #unit = text()
  readonly #choices = h('textarea', { rows: '3', placeholder: 'One answer a line; * before the right one' })
  readonly #what = h('select', {})
  readonly #is = h('select', {}, new Option('at most', 'most'), new Option('at least', 'least'), new Option('equal to', 'equal'))
  readonly #bound = text()
  readonly #predict = h('input', { type: 'checkbox' })
  readonly #tries = h('input', { type: 'number', min: '1', max: '20', value: String(TRIES) })
  readonly #cost = h('input', { type: 'number', min: '0', max: '100', step: '5', value: '0' })
  readonly #explain = h('textarea', { rows: '1', maxlength: '2000', placeholder: 'shown with the answer' })
  readonly #of: Record<Kind, HTMLElement[]>
  readonly #judged: HTMLElement[]
  readonly #foretold = h('label', { class: 'tick' }, this.#predict, h('span', {}, 'Prediction first'))
  readonly element: HTMLElement

  constructor(
    private readonly editor: Editor,
    changed: () => void,
  ) {
    const row = (...fields: HTMLElement[]) => h('div', { class: 'row' }, ...fields)
    this.#of = {
      number: [label('Measured value', this.#measured), row(label('Right answer', this.#answer), label('± tolerance', this.#tolerance), label('Unit', this.#unit))],
      choice: [label('Answers', this.#choices)],
      text: [],
      reach: [row(label('What', this.#what), label('is', this.#is), label('Value', this.#bound))],
    }
    this.#judged = [row(label('Tries', this.#tries), label('Points a wrong try takes', this.#cost))]
    this.element = h('div', { class: 'compose' }, label('Question', this.#question), label('Asks for', this.#kind), ...Object.values(this.#of).flat(), this.#foretold, ...this.#judged, label('Explanation', this.#explain))
    this.#measured.addEventListener('input', () => this.#take())
    this.#what.addEventListener('input', () => (this.#bound.value = this.#now(this.#what.value)))
    this.element.addEventListener('input', () => {
      this.#show()
      changed()
    })
    this.#show()
  }

  /** Another figure: other numbers. */
  begin(): void {
    const { readouts, attributes } = this.editor.declared()
    const parameters = attributes.filter(({ name }) => !(name in OPTIONS))
    const names = readouts.map(({ name, description }) => new Option(description || name, name))
    this.#measured.replaceChildren(new Option('(write it below)', ''), ...names.map(option => option.cloneNode(true)))
    this.#what.replaceChildren(new Option('(choose)', ''), ...names, ...parameters.map(({ name }) => new Option(name, name)))
    this.#bound.value = ''
  }

  /** What the fields hold, or what is missing. */
  get task(): Task | { missing: string } {
    const kind = this.#kind.value as Kind
    const number = (field: HTMLInputElement) => readNumber(field.value)
    const lines = this.#choices.value.split('\n').map(line => line.trim()).filter(Boolean)
        const name = this.#what.value
    const wanted: [boolean, string][] = [
      [this.#question.value.trim() === '', 'Write the question.'],
      [kind === 'number' && number(this.#answer) === undefined, 'Write the right answer, a number.'],
      [kind === 'number' && !((number(this.#tolerance) ?? -1) >= 0), 'Write how far off an answer may be.'],
      [kind === 'choice' && lines.length < 2, 'Write at least two answers, each on a line of its own.'],
      [kind === 'choice' && lines.filter(line => line.startsWith('*')).length !== 1, 'Put a * before the one answer that is right.'],
      [kind === 'reach' && (name === '' || this.#bound.value.trim() === ''), 'Choose what is to be reached, and its value.'],
      [kind === 'reach' && this.#is.value !== 'equal' && number(this.#bound) === undefined, 'At most and at least need a number.'],
    ]
    const missing = wanted.find(([isMissing]) => isMissing)?.[1]
    if (missing) return { missing }
    const task = sound({
      text: this.#question.value.trim(),
      kind,
      predict: this.#predict.checked,
      explain: this.#explain.value.trim(),
      ...(kind !== 'text' && { tries: Number(this.#tries.value), cost: Number(this.#cost.value) }),
      ...(kind === 'number' && { answer: number(this.#answer), tolerance: number(this.#tolerance), unit: this.#unit.value.trim() }),
      ...(kind === 'choice' && { choices: lines.map(line => line.replace(/^\*\s*/, '')), right: lines.findIndex(line => line.startsWith('*')) }),
      ...(kind === 'reach' && { goal: { name, is: this.#is.value, value: this.#bound.value.trim().replace(',', '.'), title: this.#what.selectedOptions[0]!.text } }),
    })
    return task ?? { missing: 'It is too long for an address.' }
  }

  #show(): void {
    const kind = this.#kind.value as Kind
    for (const [name, fields] of Object.entries(this.#of)) for (const field of fields) field.hidden = name !== kind
    for (const field of this.#judged) field.hidden = kind === 'text'
    this.#foretold.hidden = kind === 'reach'
  }

  /** What the figure shows now. */
  #now(name: string): string {
    const { readouts, values } = this.editor.figure()
    const value = readouts.find(readout => readout.name === name)?.value
    return value == null ? (values[name] ?? '') : String(Number(value.toPrecision(3)))
  }

  /** The right answer is what the figure measures, a tenth of it the tolerance. */
  #take(): void {
    const name = this.#measured.value
    const now = name && this.#now(name)
    if (!now) return
    this.#answer.value = now
    this.#tolerance.value = String(Number(Math.abs(0.1 * Number(now)).toPrecision(2)))
    this.#unit.value = this.editor.figure().readouts.find(readout => readout.name === name)?.unit ?? ''
  }
}
