// The challenges of a figure in its caption: with script they are buttons, which do what the figure's own chips do.
import type { FigureElement } from '../../widgets/elements/figure-element'

for (const words of document.querySelectorAll<HTMLElement>('figcaption .chip')) {
  const figure = [...words.closest('figure')!.children].find(child => child.localName.includes('-')) as FigureElement | undefined
  const name = words.dataset['challenge']!
  if (!figure) continue
  const button = document.createElement('button')
  Object.assign(button, { type: 'button', className: 'chip' })
  button.dataset['challenge'] = name
  button.append(...words.childNodes)
  words.replaceWith(button)
  button.addEventListener('click', () => {
    figure.scrollIntoView({ block: 'nearest' })
    void figure.challenge(name)
  })
}
