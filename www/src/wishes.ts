// What is to be done with a figure that has been set up: show it, set it as an assignment, project it, print it, take it along, use it in a
// notebook. Each has a few fields and one block to copy or to save, made from the figure as it stands.
import type { FigureElement } from '../../widgets/elements/figure-element'
import { h, write } from '../../widgets/elements/dom'
import { CODES, FRAME_WIDTH, frameHeight, frameQuery, type CodeName, type FigureMarkup } from '../../widgets/elements/embed-code'
import { OPTIONS } from '../../widgets/elements/options'
import { copy, download } from '../../widgets/elements/save'
import { Composer } from './compose'
import type { Declaration } from './embed-docs'
import { encode } from './task/task'

/** The editor around. */
export interface Editor {
  figure(): FigureElement
  declared(): Declaration
  /** Gives the figure an attribute; empty takes it away. */
  give(name: string, value: string): void
}

/** What stands in the block: text to copy, or a file to save. */
interface Block {
  title: string
  code?: string
  /** What keeps it from being made. */
  missing?: string
  save?: () => Promise<void>
  open?: string
}

interface Wish {
  title: string
  what: string
  fields: HTMLElement[]
  block(): Block
}

/** Height of the question above a figure in a narrow frame [px]. */
const QUESTION = 260

const LONG = 2000 // [ms] that a word of success stays

const label = (name: string, field: HTMLElement) => h('label', {}, h('span', { class: 'name' }, name), field)

export class Wishes {
  readonly element: HTMLElement
  readonly #panel = h('div', { class: 'wish' })
  readonly #code = h('code')
  readonly #pre = h('pre', { tabindex: '0' }, this.#code)
  readonly #title = h('p', { class: 'what' })
  readonly #missing = h('p', { class: 'missing', role: 'status' })
  readonly #copy = h('button', { type: 'button' }, 'Copy')
  readonly #save = h('button', { type: 'button' }, 'Save')
  readonly #open = h('a', { target: '_blank', class: 'button' }, 'Open')
  readonly #codes = h('div', { class: 'codes' }, h('div', { class: 'head' }, this.#title, this.#open, this.#copy, this.#save), this.#pre, this.#missing)
  readonly #radios: HTMLInputElement[]
  readonly #all: Record<string, Wish>
  readonly #lock: HTMLSelectElement[] = []
  readonly #controls: HTMLSelectElement[] = []
  readonly #composer: Composer
  #block: Block = { title: '' }
  /** The figure as the block has it: it may play on meanwhile. */
  #markup: FigureMarkup = { tag: '', attributes: [] }

  constructor(
    private readonly home: string,
    private readonly editor: Editor,
    /** The newest version that is kept, and the hash of its script. */
    private readonly kept: readonly [string, string] | undefined,
  ) {
    this.#composer = new Composer(editor, () => this.print())
    this.#all = this.#make()
    this.#radios = Object.keys(this.#all).map(name => h('input', { type: 'radio', name: 'wish', value: name }))
    const labels = Object.values(this.#all).map(({ title }, i) => h('label', {}, this.#radios[i]!, h('span', {}, title)))
    this.element = h('div', {}, h('fieldset', { class: 'wishes' }, h('legend', {}, 'What for?'), ...labels), this.#panel, this.#codes)
    this.element.addEventListener('change', event => {
      if (this.#radios.includes(event.target as HTMLInputElement)) this.#choose((event.target as HTMLInputElement).value)
    })
    this.#copy.addEventListener('click', () => void copy(this.#code.textContent).then(done => this.#say(this.#copy, done ? 'Copied' : 'Select it by hand')))
    this.#save.addEventListener('click', () => void this.#write())
    addEventListener('hashchange', () => this.#follow())
    this.#follow()
  }

  /** Another figure has begun. */
  begin(): void {
    this.#composer.begin()
    this.print()
  }

  /** The block, for the figure as it stands. */
  print(): void {
    for (const [selects, name] of [[this.#lock, 'lock'], [this.#controls, 'controls']] as const) for (const select of selects) this.#showOption(select, name)
    this.#markup = this.editor.figure().markup
    const block = (this.#block = this.#all[this.#chosen]!.block())
    write(this.#title, block.title)
    write(this.#code, block.code ?? '')
    write(this.#missing, block.missing ?? '')
    this.#pre.hidden = !block.code
    this.#copy.hidden = block.code === undefined
    this.#save.hidden = block.save === undefined
    this.#open.hidden = block.open === undefined
    if (block.open) this.#open.href = block.open
    this.#pre.ariaLabel = `Code: ${block.title}`
    this.#copy.ariaLabel = `Copy the code: ${block.title}`
    this.#save.ariaLabel = `Save: ${block.title}`
    for (const button of [this.#copy, this.#save]) button.disabled = Boolean(block.missing)
  }

  get #chosen(): string {
    return this.#radios.find(radio => radio.checked)!.value
  }

  /** The address names a wish: embed/#assign. */
  #follow(): void {
    const name = location.hash.slice(1)
    this.#choose(Object.hasOwn(this.#all, name) ? name : (this.#radios.find(radio => radio.checked)?.value ?? 'show'), false)
  }

  #choose(name: string, told = true): void {
    const { what, fields } = this.#all[name]!
    for (const radio of this.#radios) radio.checked = radio.value === name
    this.#panel.replaceChildren(h('p', {}, what), ...fields)
    if (told) history.replaceState(undefined, '', `#${name}`)
    if (this.element.isConnected) this.print()
  }

  async #write(): Promise<void> {
    this.#save.disabled = true
    write(this.#save, 'Making it…')
    try {
      await this.#block.save!()
      this.#say(this.#save, 'Saved')
    } catch (error) {
      write(this.#missing, `It could not be made: ${error instanceof Error ? error.message : String(error)}`)
      write(this.#save, 'Save')
    }
    this.#save.disabled = false
  }

  #say(button: HTMLButtonElement, text: string): void {
    const name = button === this.#copy ? 'Copy' : 'Save'
    write(button, text)
    setTimeout(() => write(button, name), LONG)
  }

  // --- The wishes ------------------------------------------------------------------------------------------------------------

  #make(): Record<string, Wish> {
    const into = this.#select('Into', [['element', 'a page of mine'], ...(this.kept ? [['kept', `a page of mine, as of ${this.kept[0]} for good`] as [string, string]] : []), ['iframe', 'a learning system (frame)'], ['link', 'a mail or a text (link)'], ['myst', 'MyST or Jupyter Book']])
    const out = this.#select('Hand it out as', [['link', 'a link'], ['iframe', 'a frame'], ['scorm', 'a SCORM package']])
    const mastery = h('input', { type: 'number', min: '0', max: '100', step: '5', placeholder: 'none' })
    mastery.addEventListener('input', () => this.print())
    const pass = label('Pass mark of 100', mastery)
    const composer = this.#composer
    return {
      show: {
        title: 'Show',
        what: 'Readers get the figure as it stands here, live.',
        fields: [into.element, this.#locks(), this.#offers()],
        block: () => this.#codeFor(into.select.value),
      },
      assign: {
        title: 'Assign',
        what: 'The figure as it stands, with a question beside it.',
        fields: [composer.element, this.#locks(), out.element, pass],
        block: () => {
          pass.hidden = out.select.value !== 'scorm'
          return this.#assignment(out.select.value, mastery.value)
        },
      },
      project: {
        title: 'Project',
        what: 'The figure alone in a window, its letters half as large again: open it, then F11 for the full screen. Space plays and pauses.',
        fields: [this.#offers()],
        block: () => {
          const { tag, attributes } = this.#markup
          const code = this.#page('embed.html', { tag, attributes: [...attributes.filter(([name]) => name !== 'size'), ['size', 'presentation']] })
          return { title: 'Address', code, open: code }
        },
      },
      print: {
        title: 'Print',
        what: 'A sheet with the figure in its state, the link to it, lines for name and date and, where Assign has a question, that question.',
        fields: [],
        block: () => {
          const task = composer.task
          const code = `${this.#page('task.html', this.#markup)}${'text' in task ? `&task=${encode(task)}` : ''}&print=on`
          return { title: 'Address of the sheet', code, open: code }
        },
      },
      offline: {
        title: 'Offline',
        what: 'One file of about 2 MB that needs no network: for a stick, a mail or a room without one. A double click opens it.',
        fields: [],
        block: () => ({
          title: `${this.#markup.tag}.html`,
          save: async () => {
            const { offlineFile } = await import('./offline-file')
            const { declared, figure } = this.editor
            download(`${this.#markup.tag}.html`, await offlineFile(this.home, this.#markup, declared().summary, figure().getAttribute('lang') ?? 'en'))
          },
        }),
      },
      notebook: {
        title: 'Notebook',
        what: 'A cell for Jupyter, marimo, Colab or VS Code. The wheel is made by npm run package: pip install fastslam_widgets-0.1.0-py3-none-any.whl',
        fields: [],
        block: () => this.#codeFor('python'),
      },
    }
  }

  /** A page of the site for a figure. */
  #page(page: string, markup: FigureMarkup): string {
    return `${this.home}${page}?${frameQuery(markup)}`
  }

  #codeFor(name: string): Block {
    const figure = this.editor.figure()
    if (name === 'link') return { title: 'Link', code: `${this.home}#${figure.localName}?${new URLSearchParams(this.#markup.attributes.filter(([name]) => name === 'v' || !(name in OPTIONS)))}` }
    if (name === 'kept') {
      const [version, integrity] = this.kept!
      const code = figure.embedCode('element')!.replaceAll(`"${this.home}`, `"${this.home}v/${version}/`)
      return { title: `${CODES.element}, version ${version}`, code: code.replace('></script>', ` integrity="${integrity}" crossorigin></script>`) }
    }
    return { title: CODES[name as CodeName], code: figure.embedCode(name as CodeName) ?? '' }
  }

  #assignment(out: string, mastery: string): Block {
    const { task } = this.#composer
    const missing = 'text' in task ? undefined : task.missing
    const title = { link: 'Link', iframe: 'Frame', scorm: 'SCORM 1.2 package' }[out]!
    if (!('text' in task)) return { title, missing: missing ?? '', ...(out === 'scorm' ? { save: () => Promise.resolve() } : { code: '' }) }
    const { declared } = this.editor
    const address = `${this.#page('task.html', this.#markup)}&task=${encode(task)}`
    if (out === 'link') return { title, code: address, open: address }
    if (out === 'iframe') {
      const height = frameHeight(this.#markup.tag) + QUESTION
      const sandbox = 'sandbox="allow-scripts allow-forms allow-downloads allow-modals allow-popups allow-popups-to-escape-sandbox"'
      return { title, code: `<iframe src="${address.replaceAll('&', '&amp;')}" title="${declared().summary}" width="${FRAME_WIDTH}" height="${height}" ${sandbox} credentialless allowfullscreen></iframe>` }
    }
    return {
      title,
      save: async () => {
        const { scormPackage } = await import('./scorm-package')
        const points = Number(mastery)
        const package_ = await scormPackage(this.home, { figure: this.#markup, title: declared().summary, task, ...(mastery !== '' && points >= 0 && points <= 100 && { mastery: points }) })
        download(`${this.#markup.tag}-task.zip`, package_)
      },
    }
  }

  // --- Fields ----------------------------------------------------------------------------------------------------------------

  #select(name: string, options: [string, string][]): { element: HTMLElement; select: HTMLSelectElement } {
    const select = h('select', {}, ...options.map(([value, text]) => new Option(text, value)))
    select.addEventListener('change', () => this.print())
    return { element: label(name, select), select }
  }

  /** What readers may change. */
  #locks(): HTMLElement {
    const select = this.#option('lock', [['', 'everything'], ['all', 'nothing, only play']])
    this.#lock.push(select)
    return label('Readers may change', select)
  }

  /** What readers see of controls. */
  #offers(): HTMLElement {
    const select = this.#option('controls', [['', 'all'], ['playback', 'what plays it'], ['none', 'none']])
    this.#controls.push(select)
    return label('Controls', select)
  }

  #option(name: string, options: [string, string][]): HTMLSelectElement {
    const select = h('select', {}, ...options.map(([value, text]) => new Option(text, value)))
    select.addEventListener('change', () => this.editor.give(name, select.value))
    return select
  }

  /** The select follows the attribute, which may also be a list of names. */
  #showOption(select: HTMLSelectElement, name: string): void {
    const value = this.editor.figure().getAttribute(name) ?? ''
    for (const option of [...select.options].filter(option => option.dataset['own'])) option.remove()
    if (![...select.options].some(option => option.value === value)) {
      const own = new Option(value, value)
      own.dataset['own'] = 'yes'
      select.add(own)
    }
    select.value = value
  }
}
