// Pseudo-code that lights up line by line while a figure does what it says. The figure tells in an event which lines it has run, and with
// which values; the box shows them one after another.
interface Traced {
  lines: { key: string; text: string }[]
}

interface Steppable extends HTMLElement {
  step(): void
}

const DWELL = 450 // [ms] a line is lit before the next one
const still = matchMedia('(prefers-reduced-motion: reduce)')

function follow(box: HTMLElement, figure: Steppable): void {
  const button = Object.assign(document.createElement('button'), { type: 'button', textContent: 'Run one step' })
  box.querySelector('.head')!.append(button)
  button.addEventListener('click', () => figure.step())
  let timer = 0

  const lineOf = (key: string) => box.querySelector<HTMLElement>(`[data-line="${CSS.escape(key)}"]`)

  const light = (lit: HTMLElement[]) => {
    for (const line of box.querySelectorAll('.lit')) if (!lit.includes(line as HTMLElement)) line.classList.remove('lit')
    for (const line of lit) line.classList.add('lit')
  }

  const say = (line: HTMLElement, text: string) => {
    const step = line.querySelector('.step')!
    const value = step.querySelector('.value') ?? step.appendChild(Object.assign(document.createElement('span'), { className: 'value' }))
    value.textContent = text
  }

  figure.addEventListener('fastslam-trace', event => {
    clearTimeout(timer)
    const traced = (event as CustomEvent<Traced>).detail.lines.flatMap(({ key, text }) => {
      const line = lineOf(key)
      return line ? [{ line, text }] : []
    })
    for (const value of box.querySelectorAll('.value')) value.remove()
    if (still.matches) {
      for (const { line, text } of traced) say(line, text)
      light(traced.map(({ line }) => line))
      return
    }
    const next = (i: number) => {
      const now = traced[i]
      if (!now) return
      say(now.line, now.text)
      light([now.line])
      timer = setTimeout(() => next(i + 1), DWELL)
    }
    next(0)
  })
}

for (const box of document.querySelectorAll<HTMLElement>('.algorithm[data-figure]')) {
  const figure = [...(document.getElementById(box.dataset['figure']!)?.children ?? [])].find(child => child.localName.includes('-'))
  if (figure) follow(box, figure as Steppable)
}
