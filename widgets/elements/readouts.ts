// The numbers of the state shown, as a list of names and values: those that do not stand in the picture.
import { h, write } from './dom'
import type { Readout } from './shell'

export function showReadouts(list: HTMLElement, readouts: Readout[], language: string): void {
  const names = [language, ...readouts.map(({ name }) => name)].join(' ') // another course may have others
  if (list.dataset['names'] !== names) {
    list.dataset['names'] = names
    list.replaceChildren(
      ...readouts.map(({ name, help }) =>
        h('div', { part: 'readout', 'data-name': name, title: help }, h('dt'), h('dd', {}, h('span'), h('span', { class: 'unit' }))),
      ),
    )
  }
  readouts.forEach((readout, i) => {
    const row = list.children[i] as HTMLElement
    row.hidden = readout.drawn
    const [title, value] = row.children as unknown as [HTMLElement, HTMLElement]
    write(title, readout.title)
    write(value.firstElementChild as HTMLElement, readout.text)
    write(value.lastElementChild as HTMLElement, readout.unit)
  })
}
