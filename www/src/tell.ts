// What a frame tells the page around it, where its address names the page's origin: ?tell=https://lms.example. Nobody else hears it, as the
// browser delivers a message to the origin alone that it is meant for.
import type { FigureElement } from '../../widgets/elements/figure-element'
import type { FigureDetail } from '../../widgets/elements/events'

/** Origins, apart by spaces or commas: https://lms.example, without a path. What is none is told to whoever wrote it, and a star is none. */
export function originsOf(texts: string[]): string[] {
  const words = texts.flatMap(text => text.split(/[\s,]+/)).filter(Boolean)
  return words.filter(word => {
    const known = URL.canParse(word) && /^https?:$/.test(new URL(word).protocol) && new URL(word).origin === word.replace(/\/$/, '')
    if (!known) console.info(`tell=${word}: an origin is wanted, such as https://lms.example`)
    return known
  }).map(word => word.replace(/\/$/, ''))
}

export function tellHosts(figure: FigureElement, given: string[]): void {
  const named = originsOf(given)
  // A message to another origin than the one around is an error in the console, where the browser says which one is around.
  const around = location.ancestorOrigins?.[0]
  const origins = around === undefined ? named : named.filter(origin => origin === around)
  const post = (message: object) => {
    for (const origin of origins) parent.postMessage({ ...message, figure: figure.localName }, origin)
  }
  const state = (event: Event) => {
    const { step, last, by, values, readouts } = (event as CustomEvent<FigureDetail>).detail
    post({ type: 'fastslam-state', state: figure.state, step, last, by, values, readouts: Object.fromEntries(readouts.map(({ name, value }) => [name, value])) })
  }
  for (const type of ['fastslam-step', 'fastslam-change']) figure.addEventListener(type, state)
  figure.addEventListener('fastslam-answer', event => post({ type: 'fastslam-answer', ...(event as CustomEvent<object>).detail }))
}
