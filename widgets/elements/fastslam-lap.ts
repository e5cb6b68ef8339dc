import { ComparedFigure } from './compared-figure'
import { Drive } from './drive'
import type { Frame } from './host'
import { locked, offered } from './options'
import { register } from './parameters'

/** What a reader changes at the wheel, and what undoing brings back: the drive before the step, which depends on it. */
const PLAN = ['plan', 'drive', 'step'] as const

/** w17.1, the lap: every particle's own map, path and robot; and a reader who takes the wheel. */
export class FastslamLap extends ComparedFigure {
  readonly #before: Record<string, string>[] = [] // as the plan was, the newest last
  readonly #drive = new Drive(this.words, this.body, this.sentence.element, {
    take: tool => this.send({ do: 'own', name: 'take', value: tool }),
    showMap: alone => this.send({ do: 'show', name: alone ? 'map' : (this.getAttribute('show') ?? '') }),
    press: (key, right, up) => this.#edit(() => this.send({ do: 'own', name: 'press', value: key, at: [right, up] })),
    stroke: line => this.#edit(() => this.send({ do: 'own', name: 'stroke', at: line })),
    drive: () => this.play(),
    undo: () => this.#undo(),
    opened: () => this.#opened(),
  })

  constructor() {
    super()
    const root = this.shadowRoot!
    root.adoptedStyleSheets = [...root.adoptedStyleSheets, Drive.sheet]
  }

  protected override introduced(): void {
    super.introduced()
    this.controls!.main.append(this.#drive.opener)
    this.controls!.main.before(this.#drive.element) // in whose place it comes
  }

  protected override takeOption(name: string): void {
    this.#permit()
    super.takeOption(name)
  }

  protected override begun(): void {
    super.begun()
    this.#drive.again()
  }

  protected override enable(on: boolean): void {
    super.enable(on)
    this.#drive.element.inert = !on
  }

  protected override present(frame: Frame): void {
    super.present(frame)
    this.#permit()
    const { plan, drive } = frame.values
    // Before it is painted, nobody knows where the map is, and the button keeps its place.
    if (frame.picture) this.#drive.show(frame.rooms, this.stage.querySelector('.rooms')!, this.canvas.element, this.#before.length > 0, plan !== '' || drive !== '')
  }

  protected override onKey(event: KeyboardEvent): boolean {
    return super.onKey(event) || this.#drive.onEscape(event)
  }

  protected override keyAction(key: string, target: HTMLElement): (() => void) | undefined {
    return (target === this.stage ? this.#drive.keyAction(key) : undefined) ?? super.keyAction(key, target)
  }

  #edit(act: () => void): void {
    const before = this.#plan
    this.playback.stop()
    for (const cause of ['plan', 'drive']) this.messages.set(cause, '')
    this.byHand(act)
    const after = this.#plan
    if (before['plan'] !== after['plan'] || before['drive'] !== after['drive']) this.#before.push(before)
    this.refresh()
  }

  #undo(): void {
    const before = this.#before.pop()
    if (!before) return
    this.playback.stop()
    const now = this.#plan
    this.byHand(() => {
      for (const name of PLAN) if (before[name] !== now[name]) this.setTo(name, before[name]!)
    })
  }

  get #plan(): Record<string, string> {
    return Object.fromEntries(PLAN.map(name => [name, this.host?.values?.[name] ?? '']))
  }

  #opened(): void {
    this.playback.stop()
    this.stage.focus({ preventScroll: true })
    this.refresh()
  }

  /** What an author keeps from readers. */
  #permit(): void {
    if (this.specs.length === 0) return
    const names = this.specs.map(({ name }) => name)
    const kept = locked(this.getAttribute('lock'), names).locked
    const shown = offered(this.getAttribute('controls'), names).offered
    this.#drive.permit(!kept.has('drive'), !kept.has('plan'), shown?.has('drive') ?? true)
  }
}

register('fastslam-lap', FastslamLap)
