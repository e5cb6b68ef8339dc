// A figure on paper.
import type { Figure } from './figure'
import type { Printed } from './paper'
import { linkOf } from './sharing'

const PATIENCE = 4000 // [ms] of simulation, while the browser waits

export class PaperCopy implements Printed {
  #off: { step: number; playing: boolean } | undefined // what is shown off paper

  constructor(private readonly figure: Figure) {}

  load(): Promise<void> | undefined {
    return this.figure.kind.heavy ? undefined : this.figure.life.start()
  }

  /** At once, where the program is there: seen or not. */
  toPaper(): void {
    const { life, view } = this.figure
    view.theme.look()
    life.startNow()
    if (!life.host?.remote) {
      if (life.host && life.playback.untouched) {
        this.#off = { step: life.target, playing: life.playback.playing }
        life.playback.playing = false
        life.send({ do: 'tell' })
      }
      life.host?.work(PATIENCE)
      // Its height comes from the first of them, and the picture of that height from the second.
      for (let paints = 0; paints < 2 && life.host && !life.host.busy; paints++) {
        view.canvas.measure()
        life.tellSize()
        const frame = life.host.frame()
        if (frame) this.figure.present(frame)
      }
    }
    view.writeForPaper(linkOf(this.figure))
  }

  offPaper(): void {
    const { life, view } = this.figure
    view.theme.look()
    if (this.#off) this.figure.seekTo(this.#off.step)
    life.playback.playing ||= this.#off?.playing ?? false
    this.#off = undefined
    life.refresh()
  }
}
