// What an author may fix about any figure, besides its parameters: attributes that every figure has.

import type { Command } from './host'

/** The words each of them takes. `lock` and `controls` take names of parameters, `show` those of parts of the picture. */
export const OPTIONS: Record<string, string[] | undefined> = {
  theme: ['light', 'dark', 'auto'],
  controls: undefined,
  show: undefined,
  lock: undefined,
  decimal: ['point', 'comma'],
  size: ['normal', 'presentation'],
  fit: ['off', 'on', ''],
}

/** What is wrong with an option's text; empty if nothing is. */
export function refusal(name: string, text: string | null): string {
  const words = OPTIONS[name]
  if (text === null || !words || words.includes(text)) return ''
  const [last, ...others] = words.filter(Boolean).reverse()
  return `${name} must be ${others.reverse().join(', ')} or ${last}, not “${text.slice(0, 40)}”`
}

/** Of all options, those that the program has to know: what it is told. */
export function optionCommand(name: string, text: string | null): Command | undefined {
  if (name === 'lock') return { do: 'lock', text }
  if (name === 'show') return { do: 'show', names: text ?? '' }
  return name === 'decimal' ? { do: 'comma', on: text === 'comma' } : undefined
}

/** Names of the parameters that readers may not change. */
export function locked(text: string | null, names: string[]): { locked: Set<string>; unknown: string[] } {
  const words = wordsOf(text)
  if (words.includes('all')) return { locked: new Set(names), unknown: [] }
  return { locked: new Set(words.filter(word => names.includes(word))), unknown: words.filter(word => !names.includes(word)) }
}

/** What `controls` names besides parameters: all of playback, or its button Play alone. */
export const [PLAYBACK, PLAY] = ['playback', 'play']

/** Names of the controls that readers see; undefined for all of them, which they also are where a name is unknown. */
export function offered(text: string | null, names: string[]): { offered: Set<string> | undefined; unknown: string[]; known: string[] } {
  const known = ['none', PLAYBACK, PLAY, ...names]
  const words = wordsOf(text)
  const unknown = words.filter(word => word !== 'all' && !known.includes(word))
  const all = words.length === 0 || words.includes('all') || unknown.length > 0
  return { offered: all ? undefined : new Set(words), unknown, known }
}

/** What is wrong with an option's names; empty if nothing is. */
export function unknownNames(option: string, unknown: string[], known: string[]): string {
  return unknown.length > 0 ? `${option} names “${unknown[0]!.slice(0, 40)}”, but this figure has ${known.join(', ')}, all` : ''
}

function wordsOf(text: string | null): string[] {
  return (text ?? '').split(/[\s,]+/).filter(Boolean)
}
