// What a figure consists of on the page, and how a frame is shown in it: head, picture, sentence, readouts, controls. What is done about a
// press or a key is the figure's (figure.ts).
import { Canvas } from './canvas'
import { Chips } from './chips'
import { Controls, type Actions } from './controls'
import { h, write } from './dom'
import css from './figure.css?inline'
import chipsCss from './chips.css?inline'
import { pictureAddress } from './files'
import { FIGURES } from './generated/figures'
import { Handles, type Moves } from './handles'
import type { Frame } from './host'
import { keepKeys } from './keys'
import { Messages } from './messages'
import { placeIn } from './pointer'
import { Help } from './popover'
import { showReadouts } from './readouts'
import roomCss from './room.css?inline'
import { Sentence } from './sentence'
import type { Chip, ParamSpec } from './shell'
import { Theme } from './theme'
import { Undo, Watch } from './undo'
import type { Words } from './words'

const sheet = new CSSStyleSheet()
sheet.replaceSync(css + roomCss + chipsCss)

/** What it may ask of the figure. */
export interface Asked extends Omit<Actions, 'lab'>, Moves {
  /** To be shown again. */
  refresh(): void
  takeUp(chip: Chip): void
  takeBack(state: string): void
  watch(from: number): void
  /** Whether the figure uses the key. */
  key(event: KeyboardEvent): boolean
}

export class View {
  specs: ParamSpec[] = []
  controls: Controls | undefined
  #language = '' // of the controls
  #below = 0 // the part of the picture that stays in sight [css px]
  #lab = false // open

  readonly #heading = h('p', { class: 'title', part: 'title', id: 'title' })
  readonly status = h('span', { class: 'status', role: 'status' })
  readonly chips: Chips
  readonly undo: Undo
  readonly watch: Watch
  readonly head = h('div', { class: 'head' })
  readonly messages: Messages
  readonly #readouts = h('dl', { class: 'readouts', part: 'readouts' })
  readonly #numbersName = h('summary')
  readonly #numbers = h('details', { class: 'numbers', part: 'numbers' }, this.#numbersName, this.#readouts)
  /** Numbers and settings that not every reader needs, folded away. */
  readonly folds = h('div', { class: 'folds' }, this.#numbers)
  readonly sentence = new Sentence()
  readonly stage = h('div', { class: 'stage', part: 'stage', role: 'group', tabindex: '0', 'aria-labelledby': 'title', 'aria-describedby': 'keys' })
  /** The picture with what plays it and what matters for it: on one screen. */
  readonly panes = h('div', { class: 'panes' }, this.sentence.element, this.stage)
  readonly body = h('div', { class: 'figure', part: 'figure', role: 'group', 'aria-labelledby': 'title' })
  readonly theme: Theme
  readonly canvas: Canvas
  readonly help: Help
  readonly #keys = h('p', { class: 'hidden', id: 'keys' })
  /** On paper: where all of this is to be had again, and whose picture it is. */
  readonly #where = h('a')
  readonly #notThis = h('span')
  readonly #fallback = h('div', { class: 'fallback' }, h('slot'))
  readonly #handles: Handles
  /** Controls that stand in the picture. */
  readonly rooms = h('div', { class: 'rooms' })
  /** Of its extras, what can do nothing without a living program. */
  readonly others: HTMLElement[] = []

  constructor(
    private readonly figure: HTMLElement,
    private readonly words: Words,
    private readonly asked: Asked,
  ) {
    // Around it is where the styles of the page end.
    const edge = h('div', { class: 'edge' }, this.body)
    const refresh = () => asked.refresh()
    this.theme = new Theme(figure, edge, this.body, refresh)
    this.canvas = new Canvas(figure, this.body, this.stage, this.theme, refresh)
    this.chips = new Chips(figure.localName, words, chip => asked.takeUp(chip))
    this.messages = new Messages(words)
    this.undo = new Undo(words, state => asked.takeBack(state))
    this.watch = new Watch(from => asked.watch(from))
    this.help = new Help(words)
    this.#handles = new Handles(asked)
    const { element: canvas } = this.canvas
    this.stage.append(canvas, this.#handles.layer, this.rooms, this.#fallback)
    this.head.append(this.#heading, this.chips.fold, this.chips.element, this.chips.verdict, this.status, this.watch.element, this.undo.element)
    const handleKeys = h('p', { class: 'hidden', id: 'handle-keys' })
    const paper = h('p', { class: 'paper' }, this.#notThis, this.#where)
    const { described, spoken } = this.sentence
    this.body.append(this.head, this.panes, this.#keys, handleKeys, this.messages.element, described, spoken, this.folds, this.help.element, paper)
    words.always(() => {
      edge.lang = this.body.lang = words.language
      write(handleKeys, words.say('handle_keys'))
      write(this.#numbersName, words.say('numbers'))
      write(this.#heading, words.title(figure.localName) ?? FIGURES[figure.localName]?.title ?? '')
    })
    keepKeys(this.body, event => asked.key(event))
    canvas.addEventListener('click', event => asked.point({ do: 'pick', at: placeIn(canvas, event) }))
    for (const type of ['pointerdown', 'pointermove', 'pointerup', 'pointerleave'] as const) canvas.addEventListener(type, event => this.#handles.follow(event))
    const root = figure.attachShadow({ mode: 'open' })
    root.adoptedStyleSheets = [sheet]
    root.append(edge)
  }

  /** Of a part that has a style of its own. */
  style(more: CSSStyleSheet): void {
    this.figure.shadowRoot!.adoptedStyleSheets.push(more)
  }

  get title(): string {
    return this.#heading.textContent
  }

  // --- A frame ---------------------------------------------------------------------------------------------------------------

  /** Whether a frame is the first to tell what the figure is, in a language: its controls have been made then. */
  introduce({ specs, language }: Frame): boolean {
    this.specs = specs
    if (this.#language === language) return false
    this.#language = language
    const before = this.controls
    const controls = (this.controls = new Controls(specs, this.words, { ...this.asked, lab: () => this.showLab(!this.#lab) }))
    controls.lab.ariaExpanded = String(this.#lab)
    if (before) {
      controls.replace(before)
    } else {
      this.panes.append(controls.transport, controls.main)
      this.folds.append(controls.settings, this.help.button)
    }
    return true
  }

  /** Shows all there is of a state. */
  show(frame: Frame, moving: boolean): void {
    const { specs, values } = frame
    const controls = this.controls!
    if (frame.layout) this.canvas.place(frame.layout)
    this.#keepInSight(frame)
    if (frame.picture) this.canvas.show(frame.picture)
    showReadouts(this.#readouts, frame.readouts, frame.language)
    this.chips.show(frame.chips, specs, values)
    this.help.about(specs, frame.readouts)
    this.#handles.show(frame.handles, specs, values)
    controls.stand(frame.rooms, this.rooms)
    controls.showValues(specs, { ...values, ...frame.instead })
    controls.free(specs, this.chips.free)
    this.sentence.show(frame, moving)
  }

  /** The part of the picture that stays in sight on a phone, whatever is set. */
  #keepInSight({ gist: { y, h }, layout }: Frame): void {
    if (!layout) return
    const below = layout.height - y - h
    if (below === this.#below) return
    this.#below = below
    for (const [name, length] of Object.entries({ low: y + h, tell: h, below })) this.panes.style.setProperty(`--_${name}`, `${length}px`)
    this.tuck()
  }

  /** Controls that come up over the picture are seen, but for the part of it that stays. */
  tuck(): void {
    const { bottom } = this.stage.getBoundingClientRect()
    const over = this.controls?.transport.getBoundingClientRect()
    // Those that are not offered are nowhere, and cover nothing.
    const cut = over?.height ? Math.min(bottom - over.top, this.#below) : 0
    this.stage.style.clipPath = cut > 0 ? `inset(-20px -20px ${cut}px)` : ''
  }

  /** The sentence stands elsewhere, or over the picture. */
  tellIn(place: HTMLElement | undefined): void {
    if (place) place.append(this.sentence.element)
    else this.stage.before(this.sentence.element)
  }

  /** What is shown is not yet what was asked for. */
  showBusy(busy: boolean): void {
    this.stage.classList.toggle('busy', busy)
    this.controls?.showBusy(busy)
  }

  // --- What holds for all frames ----------------------------------------------------------------------------------------------

  /** What is told of the keys on the picture. */
  tellKeys(text: string): void {
    write(this.#keys, text)
  }

  /** Where there is nothing to play, the picture has no keys. */
  takeKeys(on: boolean): void {
    this.stage.tabIndex = on ? 0 : -1
    if (on) this.stage.setAttribute('aria-describedby', 'keys')
    else this.stage.removeAttribute('aria-describedby')
  }

  /** A page that names the element names its picture. */
  takeName(): void {
    const name = this.figure.getAttribute('aria-label')
    for (const element of [this.body, this.stage, this.canvas.element]) {
      if (name) element.setAttribute('aria-label', name)
      else element.removeAttribute('aria-label')
      // A reference would stand over the name.
      if (name) element.removeAttribute('aria-labelledby')
      else element.setAttribute('aria-labelledby', 'title')
    }
  }

  /** Whether all that can be set is in sight, and not the few that matter first. */
  get labIsOpen(): boolean {
    return this.#lab
  }

  showLab(open: boolean): void {
    this.#lab = open
    this.body.classList.toggle('lab-open', open)
    if (this.controls) this.controls.lab.ariaExpanded = String(open)
  }

  /** Whether readers may unfold the numbers. */
  showNumbers(on: boolean): void {
    this.#numbers.classList.toggle('left-out', !on)
  }

  /** Without a living program nothing can be done. */
  enable(on: boolean): void {
    this.controls?.enable(on)
    for (const part of [this.#handles.layer, ...this.others]) part.inert = !on
  }

  /** Below it stands where its state is to be had again; where the picture is not of that state, that is said. */
  writeForPaper(link: string): void {
    write(this.#where, link)
    // A link to the page itself, browsers take for a place on the paper.
    this.#where.href = link.replace(/^[^#]*/, page => page + (page.includes('?') ? '&' : '?'))
    // A page's own picture is what its author says it is; that of our codes is the default's.
    const ours = this.ownPicture?.src.includes(`${this.figure.localName}-`) ?? true
    write(this.#notThis, ours && !this.stage.matches('.live') ? `${this.words.say('default_picture')} ` : '')
  }

  /** In place of a frame: the author's picture, or our own of the figure at rest. Returns what is to be said of it. */
  showFallback(): string {
    const shown = this.takePicture(this.theme.shade)
    this.stage.classList.add('still')
    return shown ? ` ${this.words.say('picture_at_rest')}` : ''
  }

  /** The picture that its author gives: not one that stands for a script that has not arrived. */
  get ownPicture(): HTMLImageElement | null {
    return this.figure.querySelector(':scope > img:not([slot]), :scope > :not([slot]) img')
  }

  /** Has a picture at hand that is not fetched before it is shown: also paper shows one, of a figure that has not been seen. */
  takePicture(shade: 'light' | 'dark'): boolean {
    if (this.ownPicture) return true
    const slot = this.#fallback.firstElementChild!
    const src = pictureAddress(this.figure.localName, shade)
    if (src) slot.replaceChildren(h('img', { crossorigin: '', loading: 'lazy', src, alt: this.words.say('at_rest', { title: this.title }) }))
    return slot.hasChildNodes()
  }
}
