// The steps of a figure: what plays them, the row below the picture, and the keys on it.
import type { Transport } from './extra'
import type { Figure } from './figure'
import type { Frame } from './host'

export class Timeline implements Transport {
  readonly keysHelp = 'keys'
  readonly patient = false
  readonly exports = true
  stepped = true

  constructor(private readonly figure: Figure) {}

  get playing(): boolean {
    return this.figure.life.playback.playing
  }

  /** From the start where it is at its end. */
  play(): void {
    const { figure } = this
    figure.events.cause = 'playback'
    const { target = 0, last = 0 } = figure.host?.state ?? {}
    if (figure.host && target >= last) figure.seekTo(0)
    figure.life.playback.start()
    figure.wake()
  }

  pause(): void {
    this.figure.life.playback.stop()
    this.figure.life.refresh()
  }

  seek(step: number): void {
    this.figure.transport.pause()
    this.figure.events.cause = 'page'
    if (this.figure.host) this.figure.seekTo(step)
    else this.figure.life.settings.wait('step', String(step))
  }

  show({ step, target, last }: Frame): void {
    const { view } = this.figure
    view.controls!.showPosition(step, target, last, this.playing)
    const on = last > 0
    if (on === this.stepped) return
    this.stepped = on
    view.takeKeys(on)
  }

  key(key: string, target: HTMLElement): (() => void) | undefined {
    const { reader, view } = this.figure
    if (!this.stepped) return undefined
    if (key === ' ' && !target.matches('button, summary, select, input:not([type=range]), [popover]')) return () => reader.playPause()
    const onStage: Record<string, () => void> = {
      ArrowRight: () => reader.step(),
      ArrowLeft: () => reader.stepBack(),
      Home: () => reader.seek(0),
      End: () => reader.seek(Infinity),
    }
    return target === view.stage ? onStage[key] : undefined
  }
}
