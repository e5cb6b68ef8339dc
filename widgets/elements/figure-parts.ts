// What a figure consists of on the page, and how a frame is shown in it: head, picture, sentence, readouts, controls, menu, keys. What
// comes and goes, and what is asked of the program, is the element's (figure-element.ts).
import { Canvas } from './canvas'
import { Chips } from './chips'
import { Controls } from './controls'
import { h, write } from './dom'
import { CODES, frameQuery, type CodeName, type FigureMarkup } from './embed-code'
import css from './figure.css?inline'
import chipsCss from './chips.css?inline'
import { homeAddress, pictureAddress } from './files'
import { Handles } from './handles'
import type { Command, Frame } from './host'
import { keepKeys } from './keys'
import { inChapter } from './link'
import { Menu, type MenuItem } from './menu'
import { Messages } from './messages'
import { printAll } from './paper'
import { Playback } from './playback'
import { placeIn } from './pointer'
import { Help } from './popover'
import { forgetReached } from './reached'
import { showReadouts } from './readouts'
import { copy, download } from './save'
import { Sentence } from './sentence'
import type { Chip, ParamSpec } from './shell'
import { Theme } from './theme'
import { Words } from './words'

const sheet = new CSSStyleSheet()
sheet.replaceSync(css + chipsCss)

const COPIED = 3000 // [ms] that a word of success stays

export abstract class FigureParts extends HTMLElement {
  #timeline = true // whether there are steps to play

  #introduced = '' // the language of the controls
  #below = 0 // the part of the picture that stays in sight [css px]
  #lab = false // open
  #compares = true // the setting before with that of now

  protected readonly words = new Words()
  protected specs: ParamSpec[] = []
  protected controls: Controls | undefined
  protected readonly playback = new Playback()
  protected readonly messages = new Messages(this.words)
  protected readonly heading = h('p', { class: 'title', part: 'title', id: 'title' })
  protected readonly status = h('span', { class: 'status', role: 'status' })
  protected readonly chips = new Chips(this.localName, this.words, chip => this.takeUp(chip))
  readonly #readoutList = h('dl', { class: 'readouts', part: 'readouts' })
  readonly #numbersName = h('summary')
  readonly #numbers = h('details', { class: 'numbers', part: 'numbers' }, this.#numbersName, this.#readoutList)
  /** Numbers and settings that not every reader needs, folded away. */
  protected readonly folds = h('div', { class: 'folds' }, this.#numbers)
  protected readonly sentence = new Sentence()
  protected readonly stage = h('div', { class: 'stage', part: 'stage', role: 'group', tabindex: '0', 'aria-labelledby': 'title', 'aria-describedby': 'keys' })
  /** The picture with what plays it and what matters for it: on one screen. */
  protected readonly panes = h('div', { class: 'panes' }, this.sentence.element, this.stage)
  protected readonly body = h('div', { class: 'figure', part: 'figure', role: 'group', 'aria-labelledby': 'title' })
  /** Where the styles of the page end. */
  readonly #edge = h('div', { class: 'edge' }, this.body)
  protected readonly theme = new Theme(this, this.#edge, this.body, () => this.refresh())
  protected readonly canvas = new Canvas(this, this.body, this.stage, this.theme, () => this.refresh())
  protected readonly menu = new Menu(() => this.menuItems(), this, this.words)
  readonly #undo = h('button', { type: 'button', class: 'undo', part: 'button undo', hidden: '' })
  /** Offers an end to be watched that was not. */
  readonly #watch = h('button', { type: 'button', class: 'undo watch', part: 'button watch', hidden: '' })
  #watchFrom = 0
  #before = '' // the state that undoing brings back
  readonly #help = new Help(this.words)
  /** On paper: where all of this is to be had again, and whose picture it is. */
  readonly #where = h('a')
  readonly #notThis = h('span')
  readonly #fallback = h('div', { class: 'fallback' }, h('slot'))
  readonly #handles = new Handles({
    drag: (handle, x, y) => this.#byPointer({ do: 'drag', name: handle, at: [x, y] }),
    nudge: (handle, right, up) => this.#byPointer({ do: 'nudge', name: handle, at: [right, up] }),
    follow: (handle, x, y) => this.#byHover({ do: 'follow', name: handle, at: [x, y] }),
    leave: () => this.#byHover({ do: 'leave' }),
    change: (name, value) => this.change(name, value),
  })

  /** Controls that stand in the picture. */
  readonly #rooms = h('div', { class: 'rooms' })

  constructor() {
    super()
    const root = this.attachShadow({ mode: 'open' })
    root.adoptedStyleSheets = [sheet]
    this.stage.append(this.canvas.element, this.#handles.layer, this.#rooms, this.#fallback)
    const keys = h('p', { class: 'hidden', id: 'keys' })
    const handleKeys = h('p', { class: 'hidden', id: 'handle-keys' })
    this.words.always(() => {
      this.#edge.lang = this.body.lang = this.words.language
      write(keys, this.keysHelp)
      write(handleKeys, this.words.say('handle_keys'))
      write(this.#numbersName, this.words.say('numbers'))
    })
    this.body.append(
      h('div', { class: 'head' }, this.heading, this.chips.fold, this.chips.element, this.chips.verdict, this.status, this.#watch, this.#undo, this.menu.element),
      this.panes,
      keys,
      handleKeys,
      this.messages.element,
      this.sentence.described,
      this.sentence.spoken,
      this.folds,
      this.#help.element,
      h('p', { class: 'paper' }, this.#notThis, this.#where),
    )
    root.append(this.#edge)
    this.#undo.addEventListener('click', () => this.#takeBack())
    this.#watch.addEventListener('click', () =>
      this.byHand(() => {
        this.seek(this.#watchFrom)
        this.play()
      }),
    )
    keepKeys(this.body, event => this.onKey(event))
    this.canvas.element.addEventListener('click', event => this.#byPointer({ do: 'pick', at: placeIn(this.canvas.element, event) }))
    for (const type of ['pointerdown', 'pointermove', 'pointerup', 'pointerleave'] as const) {
      this.canvas.element.addEventListener(type, event => this.#handles.follow(event))
    }
  }

  // --- What the element does -----------------------------------------------------------------------------------------------

  abstract play(): void
  abstract pause(): void
  abstract get step(): () => void
  abstract stepBack(): void
  abstract seek(step: number): void
  abstract reset(): void
  abstract get currentStep(): number
  abstract get playing(): boolean
  abstract get link(): string
  abstract get state(): string
  abstract set state(query: string)
  abstract embedCode(name: CodeName): string | undefined
  abstract get markup(): FigureMarkup
  protected abstract send(command: Command): void
  /** Shows again what is shown. */
  protected abstract refresh(): void
  /** A reader gives a parameter a value. */
  protected abstract change(name: string, value: string): void
  /** What is done then is told as the reader's own doing. Where it lasts, what was thrown away before it is not offered back any more. */
  protected byHand(act: () => void, lasts = true): void {
    if (lasts) this.#undo.hidden = true
    act()
  }
  /** The controls have been made. */
  protected abstract introduced(): void

  // --- A frame ---------------------------------------------------------------------------------------------------------------

  /** Shows all there is of a state. */
  protected present(frame: Frame): void {
    if (this.#introduced !== frame.language) this.#introduce(frame)
    this.specs = frame.specs
    if (frame.layout) this.canvas.place(frame.layout)
    this.#keepInSight(frame)
    if (frame.picture) this.canvas.show(frame.picture)
    showReadouts(this.#readoutList, frame.readouts, frame.language)
    this.chips.show(frame.chips, frame.specs, frame.values)
    this.#help.about(frame.specs, frame.readouts)
    this.#handles.show(frame.handles, frame.specs, frame.values)
    this.showPlayback(frame)
    this.controls!.stand(frame.rooms, this.#rooms)
    this.controls!.showValues(frame.specs, { ...frame.values, ...frame.instead })
    this.controls!.free(frame.specs, this.chips.free)
    this.sentence.show(frame, this.playing || frame.busy)
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
  protected tuck(): void {
    const { bottom } = this.stage.getBoundingClientRect()
    const over = this.controls?.transport.getBoundingClientRect()
    // Those that are not offered are nowhere, and cover nothing.
    const cut = over?.height ? Math.min(bottom - over.top, this.#below) : 0
    this.stage.style.clipPath = cut > 0 ? `inset(-20px -20px ${cut}px)` : ''
  }

  /** When the figure first tells what it is, in a language: its controls. */
  #introduce({ specs, language }: Frame): void {
    const before = this.controls
    this.#introduced = language
    this.controls = new Controls(specs, this.words, {
      playPause: () => this.#playPause(),
      step: () => this.byHand(() => this.step()),
      stepBack: () => this.byHand(() => this.stepBack()),
      seek: step => this.byHand(() => this.seek(step)),
      rewind: () => this.undoable('undo_rewind', () => this.seek(0)),
      reset: () => this.undoable('undo_reset', () => this.reset()),
      rate: rate => (this.playback.rate = rate),
      lab: () => this.showLab(!this.labIsOpen),
      change: (name, value) => this.change(name, value),
    })
    this.specs = specs
    this.controls.lab.ariaExpanded = String(this.#lab)
    if (before) this.controls.replace(before)
    else this.placeControls(this.controls)
    this.introduced()
  }

  protected placeControls(controls: Controls): void {
    this.panes.append(controls.transport, controls.main)
    this.folds.append(controls.settings, this.#help.button)
  }

  protected showPlayback({ step, target, last }: Frame): void {
    this.controls!.showPosition(step, target, last, this.playing)
    const on = last > 0
    if (on === this.#timeline) return
    // Where there is nothing to play, the picture has no keys.
    this.#timeline = on
    this.stage.tabIndex = on ? 0 : -1
    if (on) this.stage.setAttribute('aria-describedby', 'keys')
    else this.stage.removeAttribute('aria-describedby')
  }

  /** What is shown is not yet what was asked for. */
  protected showBusy(busy: boolean): void {
    this.stage.classList.toggle('busy', busy)
    this.controls?.showBusy(busy)
  }

  /** Offers what is to be watched, or nothing. */
  protected offerWatch(watch: Frame['watch']): void {
    this.#watch.hidden = !watch
    if (!watch) return
    this.#watchFrom = watch.from
    write(this.#watch, `▶ ${watch.words}`)
  }

  /** A page that names the element names its picture. */
  protected takeName(): void {
    const name = this.getAttribute('aria-label')
    for (const element of [this.body, this.stage, this.canvas.element]) {
      if (name) element.setAttribute('aria-label', name)
      else element.removeAttribute('aria-label')
      // A reference would stand over the name.
      if (name) element.removeAttribute('aria-labelledby')
      else element.setAttribute('aria-labelledby', 'title')
    }
  }

  /** Whether all that can be set is in sight, and not the few that matter first. */
  protected get labIsOpen(): boolean {
    return this.#lab
  }

  protected showLab(open: boolean): void {
    this.#lab = open
    this.body.classList.toggle('lab-open', open)
    if (this.controls) this.controls.lab.ariaExpanded = String(open)
  }

  /** Whether readers may unfold the numbers. */
  protected showNumbers(on: boolean): void {
    this.#numbers.classList.toggle('left-out', !on)
  }

  /** Below it stands where its state is to be had again; where the picture is not of that state, that is said. */
  protected writeForPaper(): void {
    write(this.#where, this.link)
    // A link to the page itself, browsers take for a place on the paper.
    this.#where.href = this.link.replace(/^[^#]*/, page => page + (page.includes('?') ? '&' : '?'))
    // A page's own picture is what its author says it is; that of our codes is the default's.
    const ours = this.ownPicture?.src.includes(`${this.localName}-`) ?? true
    write(this.#notThis, ours && !this.stage.matches('.live') ? `${this.words.say('default_picture')} ` : '')
  }

  /** Without a living program nothing can be done. */
  protected enable(on: boolean): void {
    this.controls?.enable(on)
    this.#handles.layer.inert = !on
  }

  /** In place of a frame: the author's picture, or our own of the figure at rest. Returns what is to be said of it. */
  protected showFallback(): string {
    const shown = this.takePicture(this.theme.shade)
    this.stage.classList.add('still')
    return shown ? ` ${this.words.say('picture_at_rest')}` : ''
  }

  /** The picture that its author gives: not one that stands for a script that has not arrived. */
  protected get ownPicture(): HTMLImageElement | null {
    return this.querySelector(':scope > img:not([slot]), :scope > :not([slot]) img')
  }

  /** Has a picture at hand that is not fetched before it is shown: also paper shows one, of a figure that has not been seen. */
  protected takePicture(shade: 'light' | 'dark'): boolean {
    if (this.ownPicture) return true
    const slot = this.#fallback.firstElementChild!
    const src = pictureAddress(this.localName, shade)
    if (src) slot.replaceChildren(h('img', { crossorigin: '', loading: 'lazy', src, alt: this.words.say('at_rest', { title: this.heading.textContent }) }))
    return slot.hasChildNodes()
  }

  // --- Reader's input ----------------------------------------------------------------------------------------------------

  #playPause(): void {
    this.#undo.hidden = true
    if (this.playing) this.pause()
    else this.play()
  }

  /** Does what throws away what a reader has made, and offers it back until something else is done. */
  protected undoable(name: 'undo_rewind' | 'undo_reset' | 'undo_challenge', act: () => void): void {
    const before = this.state
    this.byHand(act)
    this.#before = before
    write(this.#undo, this.words.say(name))
    this.#undo.hidden = false
  }

  /** A reader takes up a challenge. */
  protected takeUp({ query }: Chip): void {
    this.undoable('undo_challenge', () => (this.state = query))
  }

  #takeBack(): void {
    this.byHand(() => (this.state = this.#before))
    this.stage.focus({ preventScroll: true }) // the button goes
  }

  #byPointer(command: Command): void {
    this.playback.stay()
    this.byHand(() => this.send(command))
  }

  #byHover(command: Command): void {
    this.playback.stay()
    this.byHand(() => this.send(command), false)
  }

  protected get keysHelp(): string {
    return this.words.say('keys')
  }

  /** Whether the figure uses the key. */
  protected onKey(event: KeyboardEvent): boolean {
    if (event.ctrlKey || event.metaKey || event.altKey) return false
    if (event.key === 'Escape') return this.menu.close() || this.#help.close()
    const act = this.keyAction(event.key, event.target as HTMLElement)
    if (!act) return false
    event.preventDefault()
    act()
    return true
  }

  protected keyAction(key: string, target: HTMLElement): (() => void) | undefined {
    if (!this.#timeline) return undefined
    if (key === ' ' && !target.matches('button, summary, select, input:not([type=range]), [popover]')) return () => this.#playPause()
    const onStage: Record<string, () => void> = {
      ArrowRight: () => this.step(),
      ArrowLeft: () => this.stepBack(),
      Home: () => this.seek(0),
      End: () => this.seek(Infinity),
    }
    const act = target === this.stage ? onStage[key] : undefined
    return act && (() => this.byHand(act))
  }

  protected menuItems(): MenuItem[] {
    const home = homeAddress()
    const codes = (Object.keys(CODES) as CodeName[]).filter(name => name === 'python' || name === 'element' || home)
    const { words } = this
    const codeName = (name: CodeName) => (name === 'element' ? words.say('html_element') : CODES[name])
    const save = (kind: 'csv' | 'json') => ({
      name: words.say('save_data', { kind: kind.toUpperCase() }),
      act: () => this.send({ do: 'export', kind, name: this.fileName(kind) }),
    })
    return [
      { name: words.say('copy_link'), act: () => void this.#copy('link', this.link) },
      ...(home ? [{ name: words.say('use_in_class'), act: () => void open(`${home}embed/?${frameQuery(this.markup)}`, '_blank', 'noopener') }] : []),
      ...codes.map(name => ({ name: words.say('copy_code', { name: codeName(name) }), act: () => void this.#copy('code', this.embedCode(name)!) })),
      { name: words.say('save_picture'), act: () => this.canvas.element.toBlob(blob => blob && download(this.fileName('png'), blob)) },
      save('csv'),
      save('json'),
      { name: words.say('print'), act: () => void printAll().then(allowed => this.messages.set('print', allowed ? '' : words.say('no_print'))) },
      { name: words.say(this.#compares ? 'compare_off' : 'compare_on'), act: () => this.#compare(!this.#compares) },
      { name: words.say('explain'), act: () => this.#help.open() },
      { name: words.say('forget_reached'), act: forgetReached },
      // On other pages: whose it is, and where the rest of it is.
      ...(home && !inChapter(home) ? [{ name: words.say('chapter'), act: () => void open(home, '_blank', 'noopener') }] : []),
    ]
  }

  #compare(on: boolean): void {
    this.#compares = on
    this.menu.remake()
    this.send({ do: 'compare', on })
  }

  async #copy(what: 'link' | 'code', text: string): Promise<void> {
    if (await copy(text)) {
      write(this.status, this.words.say(`copied_${what}`))
      setTimeout(() => write(this.status, ''), COPIED)
    } else {
      this.messages.set('copy', `${this.words.say(`no_clipboard_${what}`)}\n${text}`)
    }
  }

  protected fileName(extension: string): string {
    return `${this.id || this.localName}${this.#timeline ? `-step-${this.currentStep}` : ''}.${extension}`
  }
}
