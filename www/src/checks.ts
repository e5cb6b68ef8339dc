// Grades the questions at the ends of sections as they are answered, by the reasons that their answers unfold, and keeps what was answered on
// this device.
import type { FigureElement } from '../../widgets/elements/figure-element'
import type { ChallengeDetail } from '../../widgets/elements/details'
import './checks.css'
import { lineWith, recall, remember } from './kept'

interface Judged {
  right: boolean
  said: (Node | string)[]
}

/** What is said to an answer, as it is kept, with the question set to it; undefined to what is no answer. */
type Judge = (answer: string) => Judged | undefined
type Give = (answer: string) => void

/** What is said to an answer. */
export const english = {
  number: 'Write a number, such as 0.25 or 1/4.',
  right: 'Yes.',
  low: '{answer} is too low.',
  high: '{answer} is too high.',
  done: 'Done.',
  forget: 'Forget my answer',
}
type Words = typeof english

/** What stands in it, once more. */
const copies = (element: Element): Node[] => [...element.children].map(child => child.cloneNode(true))

/** One of several answers, each with its reason. */
function choice(question: Element, give: Give): Judge {
  const inputs = [...question.querySelectorAll<HTMLInputElement>('input[type=radio]')]
  const reasons = [...question.querySelectorAll('.answer li')]
  inputs.forEach((input, i) => input.addEventListener('change', () => give(String(i))))
  return answer => {
    const [input, reason] = [inputs[Number(answer)], reasons[Number(answer)]]
    if (!input || !reason) return undefined
    input.checked = true
    return { right: reason.matches('.right'), said: copies(reason) }
  }
}

/** A number as it is written: 0,25 and 1/4 as well. */
function numberIn(text: string): number {
  const [above, below = '1', ...more] = text.replaceAll(',', '.').replaceAll(/\s/g, '').split('/')
  return above && below && more.length === 0 ? Number(above) / Number(below) : NaN
}

/** A number within a share of the right one. */
function count(question: HTMLElement, give: Give, words: Words): Judge {
  const input = question.querySelector<HTMLInputElement>('input[type=text]')!
  const [is, within] = [Number(question.dataset['is']), Number(question.dataset['within'])]
  input.addEventListener('change', () => give(input.value))
  return answer => {
    input.value = answer
    const value = numberIn(answer)
    if (Number.isNaN(value)) return { right: false, said: [words.number] }
    if (Math.abs(value - is) <= within * Math.abs(is) + 1e-9) return { right: true, said: [`${words.right} `, ...copies(question.querySelector('.answer > .fold')!)] }
    return { right: false, said: [words[value < is ? 'low' : 'high'].replace('{answer}', answer)] }
  }
}

/** A state of a figure of this page: taken up by the link, reached when the figure says so. */
function reach(question: HTMLElement, give: Give, words: Words): Judge {
  const { tag, challenge } = question.dataset
  const link = question.querySelector('a')!
  const figure = document.querySelector<FigureElement>(`figure > ${tag}`)
  if (figure) {
    link.addEventListener('click', event => {
      event.preventDefault()
      figure.scrollIntoView({ block: 'nearest' })
      void figure.challenge(challenge!)
    })
    figure.addEventListener('fastslam-challenge', event => {
      const { name, done } = (event as CustomEvent<ChallengeDetail>).detail
      if (done && name === challenge) give('done')
    })
  }
  return () => ({ right: true, said: [`${words.done} `, ...copies(question.querySelector('.answer > .fold')!)] })
}

function followOne(question: HTMLElement, isReached: (tag: string, name: string) => boolean, words: Words): void {
  const key = `fastslam-check:${question.id}`
  const { tag, challenge, is } = question.dataset
  const { line, told, button } = lineWith(words.forget, () => {
    for (const input of question.querySelectorAll('input')) {
      input.checked = false
      if (input.type === 'text') input.value = ''
    }
    give('')
    question.querySelector<HTMLElement>('input, a')!.focus()
  })
  question.querySelector('.answer')!.before(line)

  const say = (judged: Judged | undefined): void => {
    told.replaceChildren(...(judged?.said ?? []))
    button.hidden = !judged // the line stays, so that screen readers know it when it speaks
    if (judged) question.dataset['grade'] = judged.right ? 'right' : 'wrong'
    else delete question.dataset['grade']
  }
  const give = (answer: string): void => {
    const judged = answer.trim() ? judge(answer) : undefined
    remember(key, judged && answer)
    say(judged)
  }
  const judge = tag ? reach(question, give, words) : is === undefined ? choice(question, give) : count(question, give, words)
  give(recall(key) ?? (tag && challenge && isReached(tag, challenge) ? 'done' : ''))
}

/** Follows the questions of a page, or of a part of it. */
export function follow(root: ParentNode, isReached = (_tag: string, _name: string): boolean => false, words = english): void {
  for (const question of root.querySelectorAll<HTMLElement>('.check')) followOne(question, isReached, words)
}
