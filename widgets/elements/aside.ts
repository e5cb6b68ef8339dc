// Another figure of the same program, which nobody sees: it is brought to a state in slices, between which the page does what else it
// has to do, and then asked what there is to show. What is run over several seeds goes through one of them, one seed after the other.
import { h } from './dom'
import type { Answer, Command, Frame, Listener, Size } from './host'
import { LocalHost } from './local-host'
import { programOf } from './program'
import { ToldError } from './words'
import { yieldToMain } from './yield'

const SLICE = 8 // [ms] of simulation between two looks at what else the page has to do

export class Aside implements Listener {
  #host: LocalHost | undefined
  #failed: ToldError | undefined

  /** Of a figure's kind, told first how that is to be shown: words, comma, panels. */
  static async of(tag: string, commands: Command[]): Promise<Aside> {
    const aside = new Aside()
    aside.#host = await LocalHost.create(programOf(tag), tag, aside)
    for (const command of commands) aside.#host.send(command)
    return aside
  }

  hear(answer: Answer): void {
    if (answer.told !== 'failed') return
    this.#failed = new ToldError(answer.why)
    this.free() // the instance is dead, and this one is not wanted in the next
  }

  wake(): void {}

  /** Goes to a state, and says what there is to show of it at this size; rejects when the signal says so, or where it traps. */
  async reach(state: string, size: Omit<Size, 'canvas'>, signal: AbortSignal): Promise<Frame> {
    this.#send({ do: 'begin', query: state, settings: [], authored: {}, linked: false, changed: false })
    while (this.#host?.busy) {
      this.#host.work(SLICE)
      await yieldToMain()
      signal.throwIfAborted()
    }
    const canvas = { css: 0, width: 0, height: 0 }
    this.#send({ do: 'size', size: { ...size, canvas } })
    const layout = this.#frame().layout!
    const [css, height] = [layout.width ?? size.room, layout.height]
    const pixels = (length: number) => Math.round(length * devicePixelRatio)
    this.#send({ do: 'size', size: { ...size, canvas: { css, width: pixels(css), height: pixels(height) } } })
    return this.#frame()
  }

  free(): void {
    this.#host?.free()
    this.#host = undefined
  }

  #send(command: Command): void {
    this.#host?.send(command)
  }

  #frame(): Frame {
    const frame = this.#host?.frame()
    if (!frame) throw this.#failed ?? new ToldError({ key: 'no_background' })
    return frame
  }
}

/** The same state at another seed. */
export function atSeed(state: string, seed: number): string {
  const query = new URLSearchParams(state)
  query.set('seed', String(seed))
  return query.toString()
}

/** A frame's picture, or the part of it that tells most, as a canvas of its own; it has to be asked for before the program is asked anything else. */
export function pictureOf({ picture, layout, gist }: Frame, room: number, whole = false): HTMLCanvasElement {
  const canvas = h('canvas')
  if (!picture) return canvas
  const scale = picture.width / (layout?.width ?? room)
  const part = [gist.x, gist.y, gist.w, gist.h].map(length => Math.round(length * scale))
  const [x, y, width, height] = (whole ? [0, 0, picture.width, picture.height] : part) as [number, number, number, number]
  Object.assign(canvas, { width, height })
  canvas.getContext('2d', { alpha: false })!.putImageData(new ImageData(picture.pixels(), picture.width, picture.height), -x, -y)
  return canvas
}
