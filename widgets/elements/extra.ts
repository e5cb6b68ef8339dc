// What only some figures have, in parts: each is made with its figure, builds what it adds to the page, and is called at few moments.
import type { Controls } from './controls'
import type { Answer, Frame } from './host'

export interface Extra {
  /** The controls have been made, in another language again: it takes its place among them. */
  mount?(controls: Controls): void
  /** A frame is shown. */
  frame?(frame: Frame): void
  /** What a key does in the figure; nothing where it is not used. */
  key?(key: string, target: HTMLElement): (() => void) | undefined
  /** The figure is in a page, until the signal. */
  connected?(signal: AbortSignal): void
  /** The figure is about to be seen. */
  near?(): void
  /** Its program has begun, or begun again after a trap. */
  begun?(): void
  /** What its program tells; true for what nobody else has to hear. */
  hear?(answer: Answer): boolean
}

/** What plays a figure: a timeline, but for a figure that maps a file. */
export interface Transport {
  readonly playing: boolean
  play(): void
  pause(): void
  seek(step: number): void
  /** Where a frame is, in the row of playback. */
  show(frame: Frame): void
  /** What a key does on the picture, and what is told of the keys: a message. */
  key(key: string, target: HTMLElement): (() => void) | undefined
  readonly keysHelp: 'keys' | 'map_keys'
  /** Whether there are steps, by which saved files are named. */
  readonly stepped: boolean
  /** Whether something is shown before the program is there, which is fetched only when something is asked of the figure. */
  readonly patient: boolean
  /** Whether the menu saves what was measured; a figure of files does so by buttons of its own. */
  readonly exports: boolean
}
