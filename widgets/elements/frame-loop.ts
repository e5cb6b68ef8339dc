// When a figure is painted: in frames of the page, as long as it is about to be seen and has something to show.

// Shares of the picture in view, or of the window that it fills, from which on it counts as looked at, and below which it does not.
const LOOKED_AT = 0.9
const LEFT = 0.6

/** What a figure does when. */
export interface FrameActions {
  /** It comes within a screen of being seen: time to be built and painted, so that nothing moves when it comes into view. */
  approach(): void
  /** Its picture is looked at, or goes out of sight. */
  seen(on: boolean): void
  /** Whether it is to be painted also where nobody looks. */
  unseen(): boolean
  frame(now: number): void
}

export class FrameLoop {
  near = false
  inView = false
  #unsure = false
  #share = 0 // of the picture
  #request = 0
  readonly #approach = new IntersectionObserver(entries => this.#onApproach(entries), { rootMargin: '100% 0px' })
  readonly #views = new IntersectionObserver(entries => this.#onView(entries), { threshold: Array.from({ length: 51 }, (_, k) => k / 50) })

  constructor(
    private readonly figure: HTMLElement,
    private readonly stage: HTMLElement,
    private readonly actions: FrameActions,
  ) {}

  observe(signal: AbortSignal): void {
    this.#unsure = true
    this.#approach.observe(this.figure)
    this.#views.observe(this.figure)
    this.#views.observe(this.stage)
    document.addEventListener('visibilitychange', () => this.wake(), { signal })
  }

  /** The picture is another size now, and whether it is in view is told anew. */
  lookAgain(): void {
    this.#views.unobserve(this.stage)
    this.#views.observe(this.stage)
  }

  disconnect(): void {
    this.#approach.disconnect()
    this.#views.disconnect()
    cancelAnimationFrame(this.#request)
    this.#request = 0
    this.near = false
    this.inView = false
    this.#unsure = false
    this.#share = 0
  }

  /** Whether all of the picture is in view, or all that the window can show. */
  get lookedAt(): boolean {
    return this.#share >= LOOKED_AT
  }

  /** Takes what a busy browser would tell some frames late. Whether it has said by now if the figure is near. */
  ask(): boolean {
    this.#onApproach(this.#approach.takeRecords())
    return !this.#unsure
  }

  /** Whether a frame has been asked for. */
  get waiting(): boolean {
    return this.#request !== 0
  }

  /** There is something to show, or to do before that. */
  wake(): void {
    if (this.#idle) return
    this.#request ||= requestAnimationFrame(now => {
      this.#request = 0
      if (!this.#idle) this.actions.frame(now)
    })
  }

  get #idle(): boolean {
    return document.hidden || !(this.near || this.actions.unseen())
  }

  #onApproach(entries: IntersectionObserverEntry[]): void {
    const now = entries.at(-1)
    if (!now) return
    this.near = now.isIntersecting
    this.#unsure = false
    if (this.near) this.actions.approach()
    this.wake()
  }

  #onView(entries: IntersectionObserverEntry[]): void {
    for (const { target, isIntersecting, intersectionRatio, intersectionRect, rootBounds } of entries) {
      if (target === this.figure) {
        this.inView = isIntersecting
        continue
      }
      const before = this.#share
      this.#share = Math.max(intersectionRatio, intersectionRect.height / (rootBounds?.height ?? Infinity))
      if (this.lookedAt) this.actions.seen(true)
      else if (this.#share < Math.min(LEFT, before)) this.actions.seen(false) // who comes nearer, to what was started below, has not left
    }
    this.wake()
  }
}
