// What stands in the picture's place while no log is open: the finished map of the example, as a picture that is fetched when the figure is
// near, and the button that maps it. Over a log of one's own that waits to be mapped, there is the button alone.
import { h, write } from './dom'
import { pictureAddress } from './files'
import type { Phase } from './host'
import type { Words } from './words'

const NAME = 'fastslam-log-poster'

export class Poster {
  readonly go = h('button', { type: 'button', class: 'primary', part: 'button map' })
  readonly #picture = h('div', { class: 'poster' })
  readonly #what = h('span')
  readonly element = h('div', { class: 'idle' }, this.#picture, h('div', { class: 'work offer' }, this.go, this.#what))
  #shade: 'light' | 'dark' | undefined

  constructor(
    private readonly words: Words,
    map: () => void,
  ) {
    this.go.addEventListener('click', map)
    words.always(() => {
      write(this.go, words.say('map_this'))
      write(this.#what, words.say('poster_what'))
      const [image] = this.#picture.children
      if (image instanceof HTMLImageElement) image.alt = words.say('poster')
    })
  }

  /** Of these colours. Nothing is fetched of the other ones. */
  paint(shade: 'light' | 'dark'): void {
    if (shade === this.#shade) return
    this.#shade = shade
    const src = pictureAddress(NAME, shade)
    if (src) this.#picture.replaceChildren(h('img', { loading: 'lazy', src, alt: this.words.say('poster') }))
  }

  show(phase: Phase, unfit: boolean): void {
    this.element.hidden = phase !== 'empty' && phase !== 'ready'
    this.element.classList.toggle('ready', phase === 'ready')
    this.go.disabled = unfit
  }
}
