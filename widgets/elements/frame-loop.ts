// When a figure is painted: in frames of the page, as long as it is about to be seen and has something to show.

const SEEN = 0.35 // share of the picture in view at which the figure counts as seen

/** What a figure does when. */
export interface FrameActions {
  /** It comes within a screen of being seen: time to be built and painted, so that nothing moves when it comes into view. */
  approach(): void
  /** Its picture is in view. */
  seen(): void
  /** Whether it is to be painted also where nobody looks. */
  unseen(): boolean
  frame(now: number): void
}

export class FrameLoop {
  near = false
  inView = false
  #request = 0
  readonly #approach = new IntersectionObserver(entries => this.#onApproach(entries[entries.length - 1]!), { rootMargin: '100% 0px' })
  readonly #views = new IntersectionObserver(entries => this.#onView(entries), { threshold: [0, SEEN] })

  constructor(
    private readonly figure: HTMLElement,
    private readonly stage: HTMLElement,
    private readonly actions: FrameActions,
  ) {}

  observe(signal: AbortSignal): void {
    this.#approach.observe(this.figure)
    this.#views.observe(this.figure)
    this.#views.observe(this.stage)
    document.addEventListener('visibilitychange', () => this.wake(), { signal })
  }

  disconnect(): void {
    this.#approach.disconnect()
    this.#views.disconnect()
    cancelAnimationFrame(this.#request)
    this.#request = 0
    this.near = false
    this.inView = false
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

  #onApproach({ isIntersecting }: IntersectionObserverEntry): void {
    this.near = isIntersecting
    if (isIntersecting) this.actions.approach()
    this.wake()
  }

  #onView(entries: IntersectionObserverEntry[]): void {
    for (const entry of entries) {
      if (entry.target === this.figure) this.inView = entry.isIntersecting
      else if (entry.intersectionRatio >= SEEN) this.actions.seen()
    }
    this.wake()
  }
}
