// What is in the menu of every figure.
import { CODES, frameQuery, type CodeName } from './embed-code'
import { write } from './dom'
import type { Extra } from './extra'
import type { Figure } from './figure'
import { homeAddress } from './files'
import { inChapter } from './link'
import { Menu, type MenuItem } from './menu'
import { printAll } from './paper'
import { forgetReached } from './reached'
import { copy, download } from './save'
import { codeOf, linkOf, markupOf } from './sharing'

const COPIED = 3000 // [ms] that a word of success stays

export class FigureMenu implements Extra {
  readonly #menu: Menu
  #compares = true // the setting before with that of now

  constructor(private readonly figure: Figure) {
    this.#menu = new Menu(() => this.#items(), figure.element, figure.words)
    figure.view.head.append(this.#menu.element)
  }

  key(key: string): (() => void) | undefined {
    return key === 'Escape' && this.#menu.isOpen ? () => void this.#menu.close() : undefined
  }

  #items(): MenuItem[] {
    const { figure } = this
    const { life, view, words } = figure
    const home = homeAddress()
    const codes = (Object.keys(CODES) as CodeName[]).filter(name => name === 'python' || name === 'element' || home)
    const codeName = (name: CodeName) => (name === 'element' ? words.say('html_element') : CODES[name])
    const save = (kind: 'csv' | 'json') => ({
      name: words.say('save_data', { kind: kind.toUpperCase() }),
      act: () => life.send({ do: 'export', kind, name: this.#fileName(kind) }),
    })
    return [
      { name: words.say('copy_link'), act: () => void this.#copy('link', linkOf(figure)) },
      ...(home ? [{ name: words.say('use_in_class'), act: () => void open(`${home}embed/?${frameQuery(markupOf(figure))}`, '_blank', 'noopener') }] : []),
      ...codes.map(name => ({ name: words.say('copy_code', { name: codeName(name) }), act: () => void this.#copy('code', codeOf(figure, name)!) })),
      { name: words.say('save_picture'), act: () => view.canvas.element.toBlob(blob => blob && download(this.#fileName('png'), blob)) },
      ...(figure.transport.exports ? [save('csv'), save('json')] : []),
      { name: words.say('print'), act: () => void printAll().then(allowed => view.messages.set('print', allowed ? '' : words.say('no_print'))) },
      { name: words.say(this.#compares ? 'compare_off' : 'compare_on'), act: () => this.#compare(!this.#compares) },
      { name: words.say('explain'), act: () => view.help.open() },
      { name: words.say('forget_reached'), act: forgetReached },
      // On other pages: whose it is, and where the rest of it is.
      ...(home && !inChapter(home) ? [{ name: words.say('chapter'), act: () => void open(home, '_blank', 'noopener') }] : []),
    ]
  }

  #compare(on: boolean): void {
    this.#compares = on
    this.#menu.remake()
    this.figure.life.send({ do: 'compare', on })
  }

  async #copy(what: 'link' | 'code', text: string): Promise<void> {
    const { view, words } = this.figure
    if (await copy(text)) {
      write(view.status, words.say(`copied_${what}`))
      setTimeout(() => write(view.status, ''), COPIED)
    } else {
      view.messages.set('copy', `${words.say(`no_clipboard_${what}`)}\n${text}`)
    }
  }

  #fileName(extension: string): string {
    const { element, life, transport } = this.figure
    return `${element.id || element.localName}${transport.stepped ? `-step-${life.target}` : ''}.${extension}`
  }
}
