// Guesses of the exercises: compared with the live figure beside the question, where there is one, and kept on this device.
import { lineWith, recall, remember } from './kept'

interface Guess {
  guess: number | null
  result: number | null
  waived: boolean
}

interface Asking extends HTMLElement {
  setParameter(name: string, value: string): void
}

/** What is kept of a question. */
interface Kept {
  text: string
  told: string
}

const key = (question: Element) => `fastslam-guess:${question.id || question.closest('[id]')?.id}`

function kept(question: Element): Kept | undefined {
  try {
    const { text, told } = JSON.parse(recall(key(question)) ?? '{}') as Partial<Kept>
    return typeof text === 'string' && text ? { text, told: typeof told === 'string' ? told : '' } : undefined
  } catch {
    return undefined // what is in a storage may be anybody's
  }
}

const written = (x: number) => String(Number(x.toPrecision(3)))

/** Guess and result side by side, and how far off it is. */
function compared({ guess, result, waived }: Guess): string {
  if (waived || guess === null) return result === null ? 'The figure shows it: it never comes.' : `The figure says ${written(result)}. You did not guess.`
  if (result === null) return `You guessed ${written(guess)}; in the figure it never comes.`
  const percent = Math.round(100 * Math.abs(guess / result - 1))
  const off = percent === 0 ? 'right' : `${percent} % too ${guess < result ? 'low' : 'high'}`
  return `You guessed ${written(guess)}, the figure says ${written(result)}: ${off}.`
}

function follow(question: HTMLElement): void {
  const input = question.querySelector('input')!
  const figure = question.querySelector<Asking>(':scope > .trial > *')
  const { line, told, button: forget } = lineWith('Forget my guess', () => {
    input.value = ''
    figure?.setParameter('predict', 'off') // which takes the guess away, and the result
    figure?.setParameter('predict', 'on')
    show('')
    input.focus()
  })
  question.querySelector('label')!.after(line)

  const show = (text: string) => {
    told.textContent = text
    forget.hidden = !input.value
    line.hidden = !text && !input.value
    remember(key(question), input.value ? JSON.stringify({ text: input.value, told: text } satisfies Kept) : undefined)
  }
  const before = kept(question)
  if (before) input.value = before.text
  show(before?.told ?? '')

  input.addEventListener('input', () => show(''))
  if (!figure) return
  input.inputMode = 'decimal'
  input.addEventListener('change', () => {
    const guess = Number(input.value.replace(',', '.'))
    if (!input.value.trim() || Number.isNaN(guess)) return
    figure.setParameter('guess', String(guess))
    figure.setParameter('run', 'on')
  })
  figure.addEventListener('fastslam-guess', event => {
    const { detail } = event as CustomEvent<Guess>
    if (detail.guess !== null) input.value = written(detail.guess)
    show(compared(detail))
  })
  figure.addEventListener('fastslam-change', event => {
    // Other settings are another question.
    if ((event as CustomEvent<{ values: Record<string, string> }>).detail.values['run'] === 'off' && told.textContent) show('')
  })
}

for (const question of document.querySelectorAll<HTMLElement>('.predict')) follow(question)
