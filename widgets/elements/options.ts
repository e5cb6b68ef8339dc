// What an author may fix about any figure, besides its parameters: attributes that every figure has.

/** The words each of them takes. `lock` takes names of parameters, `show` those of parts of the picture. */
export const OPTIONS: Record<string, string[] | undefined> = {
  theme: ['light', 'dark', 'auto'],
  controls: ['all', 'playback', 'none'],
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

/** Names of the parameters that readers may not change. */
export function locked(text: string | null, names: string[]): { locked: Set<string>; unknown: string[] } {
  const words = (text ?? '').split(/[\s,]+/).filter(Boolean)
  if (words.includes('all')) return { locked: new Set(names), unknown: [] }
  return { locked: new Set(words.filter(word => names.includes(word))), unknown: words.filter(word => !names.includes(word)) }
}

/** What is wrong with names to lock; empty if nothing is. */
export function unlockable(unknown: string[], names: string[]): string {
  return unknown.length > 0 ? `lock names “${unknown[0]!.slice(0, 40)}”, but this figure has ${names.join(', ')}, all` : ''
}
