// What an author may fix about any figure, besides its parameters: attributes that every figure has.

import type { Command } from './host'
import type { Words } from './words'

/**
 * The words each of them takes. `v` says which version of the figure the other attributes are of. `lock` and `controls` take names of parameters, `show` those of parts of the picture. `lang` comes
 * first: what is wrong with the others is said in it.
 */
export const OPTIONS: Record<string, string[] | undefined> = {
  lang: undefined,
  v: undefined,
  theme: ['light', 'dark', 'auto'],
  controls: undefined,
  lab: ['closed', 'open'],
  chips: ['on', 'off'],
  show: undefined,
  lock: undefined,
  decimal: ['point', 'comma'],
  size: ['normal', 'presentation'],
  fit: ['off', 'on', ''],
}

/** What is wrong with an option's text; empty if nothing is. */
export function refusal(name: string, text: string | null, words: Words): string {
  const allowed = OPTIONS[name]
  if (text === null || !allowed || allowed.includes(text)) return ''
  const [last, ...others] = allowed.filter(Boolean).reverse()
  return words.say('must_be', { name, others: others.reverse().join(', '), last: last!, text: text.slice(0, 40) })
}

/** Of all options, those that the program has to know: what it is told. */
export function optionCommand(name: string, text: string | null, words: Words): Command | undefined {
  if (name === 'lock') return { do: 'lock', name: wordsOf(text).join(' ') }
  if (name === 'lang') return { do: 'words', name: words.language, value: words.forProgram }
  if (name === 'show') return { do: 'show', name: text ?? '' }
  return name === 'decimal' ? { do: 'comma', on: hasComma(text, words) } : undefined
}

/** Whether numbers have a decimal comma: as the author says, else as the language has it. */
export function hasComma(decimal: string | null, { comma }: Words): boolean {
  return OPTIONS['decimal']!.includes(decimal ?? '') ? decimal === 'comma' : comma
}

/** Names of the parameters that readers may not change. */
export function locked(text: string | null, names: string[]): { locked: Set<string>; unknown: string[] } {
  const words = wordsOf(text)
  if (words.includes('all')) return { locked: new Set(names), unknown: [] }
  return { locked: new Set(words.filter(word => names.includes(word))), unknown: words.filter(word => !names.includes(word)) }
}

/** What `controls` names besides parameters: all of playback, its button Play alone, the folded numbers, and the chips of the challenges. */
export const [PLAYBACK, PLAY, NUMBERS, CHIPS] = ['playback', 'play', 'numbers', 'chips']

/** Names of the controls that readers see; undefined for all of them, which they also are where a name is unknown. */
export function offered(text: string | null, names: string[]): { offered: Set<string> | undefined; unknown: string[]; known: string[] } {
  const known = ['none', 'picture', PLAYBACK, PLAY, NUMBERS, CHIPS, ...names]
  const words = wordsOf(text)
  const unknown = words.filter(word => word !== 'all' && !known.includes(word))
  const all = words.length === 0 || words.includes('all') || unknown.length > 0
  return { offered: all ? undefined : new Set(words), unknown, known }
}

/** What is wrong with an option's names; empty if nothing is. */
export function unknownNames(option: string, unknown: string[], known: string[], words: Words): string {
  return unknown.length > 0 ? words.say('unknown_names', { option, name: unknown[0]!.slice(0, 40), known: known.join(', ') }) : ''
}

function wordsOf(text: string | null): string[] {
  return (text ?? '').split(/[\s,]+/).filter(Boolean)
}
