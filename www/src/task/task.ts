// An assignment: a question about a figure in a state that its teacher has set up. It is plain data, which travels in an address and in a
// package for learning systems; nothing here knows a page.

export type Kind = 'number' | 'choice' | 'text' | 'reach'

/** What a figure is to show: one of its readouts or parameters. */
export interface Goal {
  /** Of the readout or parameter. */
  name: string
  is: 'most' | 'least' | 'equal'
  value: string
  /** What readers call it, with its unit. */
  title: string
}

export interface Task {
  /** What is asked, in plain text. */
  text: string
  kind: Kind
  /** Whether the same question is put once before the figure may be touched. That answer is kept, and not judged. */
  predict?: boolean
  /** Answers until the right one is shown. */
  tries?: number
  /** Points of a hundred that each wrong answer takes. */
  cost?: number
  /** Of a number. */
  answer?: number
  tolerance?: number
  unit?: string
  /** Of a choice, and which of them is right, from 0. */
  choices?: string[]
  right?: number
  /** Of a state to reach. */
  goal?: Goal
  /** Shown with the answer. */
  explain?: string
}

/** How far a reader is. */
export interface Progress {
  predicted?: string
  /** Answers given before the right one was shown. */
  tries: number
  /** Answers given after that: they are told apart, and count for nothing. */
  after: number
  /** The last answer that counted. */
  last?: string
  right?: boolean
  /** The right answer has been shown, or a free text handed in. */
  over: boolean
}

export type Result = 'kept' | 'right' | 'wrong' | 'after'

export const TRIES = 3
export const NOTHING: Progress = { tries: 0, after: 0, over: false }

/** A number as a reader writes it, with a point or a comma; undefined where it is not one. */
export function readNumber(text: string): number | undefined {
  const plain = text.trim().replace('−', '-').replace(',', '.')
  return plain !== '' && Number.isFinite(Number(plain)) ? Number(plain) : undefined
}

/** Whether an answer is right; undefined for a text, which nobody but a reader can judge. `given`: of a state, the value that the figure shows. */
export function isRight(task: Task, given: string): boolean | undefined {
  if (task.kind === 'text') return undefined
  if (task.kind === 'choice') return Number(given) === task.right
  if (task.kind === 'reach') return reaches(task.goal!, given)
  const number = readNumber(given)
  // What is a tolerance away is within it, however it is rounded.
  return number !== undefined && Math.abs(number - task.answer!) <= task.tolerance! * (1 + 1e-9) + 1e-12
}

function reaches({ is, value }: Goal, given: string): boolean {
  if (is === 'equal') return given === value || (readNumber(given) !== undefined && readNumber(given) === readNumber(value))
  const [now, bound] = [readNumber(given), readNumber(value)]
  return now !== undefined && bound !== undefined && (is === 'most' ? now <= bound : now >= bound)
}

/** What an answer changes, and what is to be said of it. */
export function answered(task: Task, before: Progress, given: string): { progress: Progress; result: Result } {
  if (task.predict && before.predicted === undefined) return { progress: { ...before, predicted: given }, result: 'kept' }
  if (before.over) return { progress: { ...before, after: before.after + 1 }, result: 'after' }
  const right = isRight(task, given)
  const tries = before.tries + 1
  const over = right !== false || tries >= (task.tries ?? TRIES)
  const progress: Progress = { ...before, tries, last: given, over, ...(right !== undefined && { right }) }
  return { progress, result: right === undefined ? 'kept' : right ? 'right' : 'wrong' }
}

/** Points of a hundred; undefined as long as there is nothing to score, and for a text. */
export function scoreOf(task: Task, { over, right, tries }: Progress): number | undefined {
  if (!over || right === undefined) return undefined
  return right ? Math.max(0, 100 - (task.cost ?? 0) * (tries - 1)) : 0
}

// --- In an address ------------------------------------------------------------------------------------------------------------

/** As an address has it: nobody reads it at a glance, and everybody can who wants to. */
export function encode(task: Task): string {
  const bytes = new TextEncoder().encode(JSON.stringify(task))
  return btoa(String.fromCharCode(...bytes)).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '')
}

/** The task of an address, which may be anybody's: undefined where it is none. */
export function decode(text: string): Task | undefined {
  try {
    const bytes = Uint8Array.from(atob(text.replaceAll('-', '+').replaceAll('_', '/')), character => character.charCodeAt(0))
    return sound(JSON.parse(new TextDecoder('utf-8', { fatal: true }).decode(bytes)))
  } catch {
    return undefined
  }
}

const LONGEST = 2000 // letters of a text
const MOST_CHOICES = 10

const isText = (x: unknown): x is string => typeof x === 'string' && x.length <= LONGEST
const isNumber = (x: unknown): x is number => typeof x === 'number' && Number.isFinite(x)
const isCount = (x: unknown, from: number, to: number): x is number => Number.isInteger(x) && Number(x) >= from && Number(x) <= to

/** A task that can be set: whole, and no larger than a page can show. */
export function sound(given: unknown): Task | undefined {
  if (typeof given !== 'object' || given === null) return undefined
  const { text, kind, predict, tries, cost, answer, tolerance, unit, choices, right, goal, explain } = given as Partial<Record<keyof Task, unknown>>
  if (!isText(text) || text.trim() === '') return undefined
  const task: Task = { text, kind: kind as Kind }
  if (predict === true && kind !== 'reach') task.predict = true // of a state that is to be reached, there is nothing to foretell
  if (isCount(tries, 1, 20)) task.tries = tries
  if (isNumber(cost) && cost >= 0 && cost <= 100) task.cost = cost
  if (isText(explain) && explain !== '') task.explain = explain
  switch (kind) {
    case 'number':
      if (!isNumber(answer) || !isNumber(tolerance) || tolerance < 0) return undefined
      return { ...task, answer, tolerance, ...(isText(unit) && unit !== '' && { unit }) }
    case 'choice':
      if (!Array.isArray(choices) || choices.length < 2 || choices.length > MOST_CHOICES || !choices.every(isText) || !isCount(right, 0, choices.length - 1)) return undefined
      return { ...task, choices, right }
    case 'text':
      return task
    case 'reach': {
      const { name, is, value, title } = (goal ?? {}) as Partial<Record<keyof Goal, unknown>>
      if (!isText(name) || !isText(value) || value === '' || !isText(title) || (is !== 'most' && is !== 'least' && is !== 'equal')) return undefined
      return { ...task, goal: { name, is, value, title } }
    }
    default:
      return undefined
  }
}
