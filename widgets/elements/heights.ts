// How high a figure will be once it lives, so that it keeps that place free and nothing below it moves.
import { apart, first, heights } from './heights.json'

/**
 * What this figure took where tests/e2e/heights.spec.ts measured it at this width [px]. One whose author has set options is another: of its
 * height we know what `--fastslam-height` says, and else nothing.
 */
export function expected(figure: HTMLElement): number | undefined {
  const another = figure.matches('[fit], [size], [controls], [chips], [show]')
  if (another && !getComputedStyle(figure).getPropertyValue('--fastslam-height')) return undefined
  return usualHeight(figure.localName, figure.clientWidth)
}

/** Keeps so much free [px]. */
export function reserve(body: HTMLElement, height: number): void {
  body.style.setProperty('--_usual', `${height}px`)
  body.classList.add('reserved')
}

export function release(body: HTMLElement): void {
  body.classList.remove('reserved')
}

/** What a figure takes at this width where its author has set no options [px]; 0 where that was not measured. */
export function usualHeight(tag: string, width: number): number {
  const samples = (heights as Record<string, number[] | undefined>)[tag] ?? []
  const at = Math.min((width - first) / apart, samples.length - 1)
  if (at < 0) return 0
  const [below, above] = [samples[Math.floor(at)]!, samples[Math.ceil(at)]!]
  return Math.round(below + (above - below) * (at % 1))
}
