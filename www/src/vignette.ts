// <fastslam-vignette>: a small figure beside a sentence. It has a picture, one handle, which is a native slider, and one line that holds the
// number; no menu, no Lab, no playback. Its program is the one that the chapter's figures share, and it is hosted and painted as they are.
import { Canvas } from '../../widgets/elements/canvas'
import { h, write } from '../../widgets/elements/dom'
import { FrameLoop } from '../../widgets/elements/frame-loop'
import type { Answer, Command, Frame, Listener } from '../../widgets/elements/host'
import { LocalHost } from '../../widgets/elements/local-host'
import { hasComma } from '../../widgets/elements/options'
import { takeToPaper, type Printed } from '../../widgets/elements/paper'
import { programNamed } from '../../widgets/elements/program'
import { Theme } from '../../widgets/elements/theme'
import { languageAround, Words } from '../../widgets/elements/words'

class Vignette extends HTMLElement implements Listener, Printed {
  static readonly observedAttributes = ['lang']

  readonly #words = new Words()
  readonly #stage = h('div', { class: 'stage' })
  readonly #range = h('input', { type: 'range', min: '0' })
  readonly #title = h('span')
  readonly #value = h('span', { class: 'set', 'aria-hidden': 'true' }) // the slider says it itself
  readonly #told = h('p', { role: 'status' })
  readonly #theme = new Theme(this, this, this.#stage, () => this.#refresh())
  readonly #canvas = new Canvas(this, this.#stage, this.#stage, this.#theme, () => this.#refresh())
  readonly #frames = new FrameLoop(this, this.#stage, { approach: () => void this.load(), seen() {}, unseen: () => false, frame: now => this.#frame(now) })
  #starting: Promise<void> | undefined
  #host: LocalHost | undefined
  #life = new AbortController()

  connectedCallback(): void {
    const { element } = this.#canvas
    for (const name of ['aria-labelledby', 'aria-describedby']) element.removeAttribute(name)
    element.ariaLabel = this.querySelector('img')?.alt ?? ''
    this.#stage.append(element)
    // Only what comes to life has a handle: until then, and where it does not, there is the picture.
    this.append(this.#stage)
    this.#life = new AbortController()
    const { signal } = this.#life
    this.#range.addEventListener('input', () => this.#send({ do: 'set', name: 'at', value: this.#range.value }), { signal })
    this.#canvas.release() // its place is kept free by the page's styles
    this.#canvas.observe()
    this.#theme.observe(signal)
    this.#frames.observe(signal)
    takeToPaper(this, signal)
  }

  disconnectedCallback(): void {
    this.#life.abort()
    this.#frames.disconnect()
    this.#canvas.disconnect()
    this.#host?.free()
    this.#host = undefined
  }

  attributeChangedCallback(): void {
    if (this.#host) void this.#words.speak(languageAround(this)).then(() => this.#speak())
  }

  load(): Promise<void> {
    return (this.#starting ??= this.#start().finally(() => (this.#starting = undefined)))
  }

  async #start(): Promise<void> {
    if (this.#host) return
    try {
      const [host] = await Promise.all([LocalHost.create(programNamed('page'), this.localName, this), this.#words.speak(languageAround(this))])
      if (!this.isConnected) return host.free()
      this.#host = host
      const query = new URLSearchParams({ which: this.getAttribute('which') ?? '', at: this.getAttribute('at') ?? '0' })
      this.#send({ do: 'begin', value: query.toString(), name: '', on: false })
      this.#speak()
      this.#refresh()
    } catch {
      this.classList.add('still') // its picture, in the place of the live one
    }
  }

  #speak(): void {
    const { language, forProgram } = this.#words
    this.#send({ do: 'words', name: language, value: forProgram })
    this.#send({ do: 'comma', on: hasComma(null, this.#words) })
  }

  /** Lights a symbol wherever the picture writes it; an empty one puts it out. */
  light(symbol: string): void {
    this.#send({ do: 'light', name: symbol })
  }

  #send(command: Command): void {
    this.#host?.send(command)
    this.wake()
  }

  wake(): void {
    this.#frames.wake()
  }

  hear(answer: Answer): void {
    if (answer.told === 'refused' && answer.message) console.error(answer.message)
  }

  #refresh(): void {
    this.#send(this.#canvas.size)
  }

  #frame(now?: number): void {
    const frame = this.#host?.frame(now)
    if (frame) this.#show(frame)
  }

  #show({ specs, values, readouts: [set], sentence, layout, picture }: Frame): void {
    const spec = specs.find(({ name }) => name === 'at')!
    const value = `${set!.text} ${set!.unit}`.trim()
    if (!this.#range.isConnected) this.append(h('label', {}, this.#title, this.#range, this.#value), this.#told)
    write(this.#title, spec.title)
    write(this.#value, value)
    write(this.#told, sentence)
    this.#range.max = String(spec.max)
    this.#range.value = values['at']!
    this.#range.ariaValueText = value
    if (layout) this.#canvas.place(layout)
    if (!picture) return
    this.#canvas.show(picture)
    this.classList.add('live')
  }

  toPaper(): void {
    this.#theme.look()
    this.#canvas.measure()
    this.#refresh()
    this.#frame()
  }

  offPaper(): void {
    this.toPaper()
  }
}

customElements.define('fastslam-vignette', Vignette)
