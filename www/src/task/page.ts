// The page of an assignment: a question beside the figure that it is about. The figure is what the address asks for, as in embed.html, and the
// question is that of `task` in it; in a package for learning systems both stand in the page. What is answered is sent as an event, which
// scorm.js records and which goes to the page around, where that is to be told.
import type { FigureElement } from '../../../widgets/elements/figure-element'
import { h, write } from '../../../widgets/elements/dom'
import type { FigureDetail } from '../../../widgets/elements/events'
import { FIGURES } from '../../../widgets/elements/generated/figures'
import { printAll } from '../../../widgets/elements/paper'
import { query } from '../asked'
import '../embed' // which has made the figure when this goes on
import { answered, decode, isRight, NOTHING, readNumber, scoreOf, sound, TRIES, type Progress, type Result, type Task } from './task'
import { say as sayIn, type TaskKey } from './words'

/** What an answer is to whoever listens. */
export interface AnswerDetail {
  /** A prediction was kept, or an answer judged. */
  stage: 'prediction' | 'answer'
  kind: Task['kind']
  given: string
  result: Result
  /** What is right, where something is. */
  wanted: string | undefined
  /** Answers so far that counted, and those after the right one had been shown. */
  tries: number
  after: number
  /** Whether the task is over: answered, or out of tries. */
  over: boolean
  /** Points of a hundred; undefined while there are none. */
  score: number | undefined
  /** The state of the figure, as a link has it. */
  state: string
  /** For the next visit. */
  progress: Progress
}

/** Letters of a text: a prediction and an answer of that length are kept by any learning system, which needs to keep 4096. */
const LONGEST = 1500

const panel = document.querySelector<HTMLElement>('#task')!
const figure = document.querySelector<FigureElement>(`#figure > :is(${Object.keys(FIGURES).join()})`)
const packed = document.querySelector('#given')?.textContent
const asked = query.get('task')
const language = figure?.getAttribute('lang') ?? document.documentElement.lang
const say = (key: TaskKey, values?: Record<string, string | number>): string => sayIn(language, key, values)

/** The task; null where the address or the package has one that is not sound, undefined where there is none: a figure to be printed. */
function given(): Task | null | undefined {
  if (packed) return sound(JSON.parse(packed)) ?? null
  return asked === null ? undefined : (decode(asked) ?? null)
}

/** What was kept at an earlier visit, which scorm.js leaves at the figure. */
function kept(): Progress {
  try {
    const before = JSON.parse(figure?.dataset['kept'] ?? '') as Partial<Progress>
    return Number.isInteger(before.tries) && Number.isInteger(before.after) ? { ...NOTHING, ...before } : NOTHING
  } catch {
    return NOTHING
  }
}

class Assignment {
  #progress = kept()
  #touched = false // by the reader, since the state was set
  readonly #verdict = h('p', { class: 'verdict', role: 'status' })
  readonly #now = h('p', { class: 'now' })
  readonly #first = h('p', { class: 'first' })
  readonly #record = h('p', { class: 'record' })
  readonly #fields: HTMLElement
  readonly #button = h('button', { type: 'submit' })
  readonly #form: HTMLFormElement
  /** What is in the fields. */
  #given: () => string = () => ''

  constructor(
    readonly figure: FigureElement,
    readonly task: Task,
  ) {
    this.#fields = this.#makeFields()
    this.#form = h('form', { autocomplete: 'off', novalidate: '' }, this.#fields, this.#button)
    this.#form.addEventListener('submit', event => {
      event.preventDefault()
      this.#handIn()
    })
    for (const type of ['fastslam-step', 'fastslam-change']) {
      figure.addEventListener(type, event => {
        this.#touched ||= (event as CustomEvent<FigureDetail>).detail.by !== 'page'
        this.#showNow()
      })
    }
    panel.append(h('h1', {}, say('task')), h('p', { class: 'question' }, task.text), this.#first, this.#now, this.#form, this.#verdict, this.#record)
    if (this.#isFirst) {
      figure.pause() // nothing is to be seen before it is foretold
      figure.inert = true
    }
    this.#show()
    if (this.#progress.over) write(this.#verdict, this.#outcome())
  }

  /** Whether a prediction is due. */
  get #isFirst(): boolean {
    return this.task.predict === true && this.#progress.predicted === undefined
  }

  #makeFields(): HTMLElement {
    const { kind, unit, choices } = this.task
    if (kind === 'reach') return h('div', {})
    if (kind === 'choice') {
      const radios = choices!.map((_, i) => h('input', { type: 'radio', name: 'answer', value: String(i) }))
      this.#given = () => radios.find(radio => radio.checked)?.value ?? ''
      return h('fieldset', {}, h('legend', {}, say('your_answer')), ...choices!.map((choice, i) => h('label', {}, radios[i]!, h('span', {}, choice))))
    }
    const field = kind === 'text' ? h('textarea', { rows: '4', maxlength: String(LONGEST) }) : h('input', { inputmode: 'decimal', size: '10' })
    this.#given = () => field.value.trim()
    return h('label', {}, h('span', {}, say('your_answer')), field, ...(unit ? [h('span', { class: 'unit' }, unit)] : []))
  }

  /** What the figure shows of the goal. */
  get #value(): string {
    const { name } = this.task.goal!
    const readout = this.figure.readouts.find(readout => readout.name === name)
    return readout ? String(readout.value ?? '') : (this.figure.values[name] ?? '')
  }

  #handIn(): void {
    const { task } = this
    const reach = task.kind === 'reach'
    const given = reach ? this.#value : this.#given()
    if (given === '') return write(this.#verdict, say('no_answer'))
    if (task.kind === 'number' && readNumber(given) === undefined) return write(this.#verdict, say('not_a_number'))
    if (reach && !this.#touched && this.#progress.tries === 0) return write(this.#verdict, say('not_by_hand'))
    const stage = this.#isFirst ? 'prediction' : 'answer'
    const { progress, result } = answered(task, this.#progress, given)
    this.#progress = progress
    if (stage === 'prediction') {
      this.figure.inert = false
      this.#form.reset()
    }
    write(this.#verdict, stage === 'prediction' ? '' : result === 'after' ? say('after') : this.#outcome())
    this.#show()
    const detail: AnswerDetail = {
      stage,
      kind: task.kind,
      given,
      result,
      wanted: this.#wanted,
      tries: progress.tries,
      after: progress.after,
      over: progress.over,
      score: scoreOf(task, progress),
      state: this.figure.state,
      progress,
    }
    this.figure.dispatchEvent(new CustomEvent('fastslam-answer', { bubbles: true, composed: true, detail }))
  }

  get #wanted(): string | undefined {
    const { kind, answer, right, goal } = this.task
    if (kind === 'number') return String(answer)
    if (kind === 'choice') return String(right)
    return goal?.value
  }

  /** In words, after an answer that counted. */
  #outcome(): string {
    const { task } = this
    const { right, over, tries } = this.#progress
    const explained = over && task.explain ? ` ${task.explain}` : ''
    if (right === undefined) return say('handed_in') + explained
    if (right) return say('right') + explained
    const left = (task.tries ?? TRIES) - tries
    if (!over) return left === 1 ? say('wrong_once') : say('wrong', { left })
    if (task.kind === 'reach') return say('over_reach') + explained
    return say('over', { answer: this.#written(this.#wanted!) }) + explained
  }

  /** An answer as readers read it. */
  #written(answer: string): string {
    const { kind, choices, unit } = this.task
    return kind === 'choice' ? `“${choices![Number(answer)] ?? ''}”` : unit ? `${answer} ${unit}` : answer
  }

  #show(): void {
    const { task } = this
    const { predicted, tries, after } = this.#progress
    const legend = this.#fields.querySelector('legend') ?? this.#fields.querySelector('span')
    if (legend) write(legend, say(this.#isFirst ? 'your_prediction' : 'your_answer'))
    write(this.#button, say(this.#isFirst ? 'keep_prediction' : task.kind === 'reach' ? 'hand_in_state' : 'hand_in'))
    write(this.#first, this.#isFirst ? say('predict_first') : predicted === undefined ? '' : say('predicted', { given: this.#written(predicted) }))
    const score = scoreOf(task, this.#progress)
    const record = [tries > 0 && say('tries', { tries }), after > 0 && say('after_tries', { after }), score !== undefined && say('score', { score })]
    write(this.#record, record.filter(Boolean).join(' · '))
    this.#showNow()
  }

  #showNow(): void {
    const { goal } = this.task
    if (!goal) return
    const number = readNumber(this.#value)
    const now = number === undefined ? this.#value || '–' : String(Number(number.toPrecision(4)))
    write(this.#now, say(`goal_${goal.is}`, { title: goal.title, value: goal.value, now }))
    this.#now.classList.toggle('reached', isRight(this.task, this.#value) === true)
  }
}

/** One page of paper: name, date, task and answer, the figure's picture, and the link to its state, which the figure has on paper. */
function addPaper(): void {
  const line = (key: TaskKey, value = '') => h('label', {}, h('span', {}, say(key)), h('input', { value, autocomplete: 'off' }))
  const print = h('button', { type: 'button' }, say('print'))
  const note = h('p', { class: 'verdict', role: 'status' })
  print.addEventListener('click', () => void printAll().then(allowed => write(note, allowed ? '' : say('no_print', { link: figure!.link }))))
  panel.append(h('div', { class: 'paper' }, line('name'), line('date', new Date().toLocaleDateString()), print), note)
  const site = document.querySelector<HTMLMetaElement>('meta[name=site]')?.content
  if (!site) return
  // A package's own address is nothing outside of the learning system: the state opens on the site that it was made on.
  const link = h('p', { class: 'site' })
  panel.append(link)
  addEventListener('beforeprint', () => write(link, `${say('state')}: ${site}#${figure!.localName}?${figure!.state}`))
}

document.documentElement.lang = language
panel.ariaLabel = say('task')
if (figure) {
  const task = given()
  if (task) new Assignment(figure, task)
  else if (task === null) panel.append(h('p', { role: 'alert' }, say('no_task')))
  else panel.append(h('h1', {}, FIGURES[figure.localName]!.title)) // a sheet without a question
  addPaper()
  if (query.has('print') && !packed) void figure.settled().then(printAll)
}
