// What a figure says on the page, in the language around it. English is in the script. Another language is a file (../words), fetched for
// the first figure that speaks it; the words of the picture are in it too, and go to the program.
import { elements as english } from '../words/en.json'
import { fetchWords, type Catalogue } from './files'

export type Key = keyof typeof english
type Values = Record<string, string | number>

/** A message of the catalogue with its values, or what the program has said in words. */
export type Message = string | { key: Key; values?: Values }

/** An error that readers are told of; in English for the console. */
export class ToldError extends Error {
  constructor(readonly told: Message) {
    super(typeof told === 'string' ? told : filled(english[told.key], told.values))
  }
}

/** By language, once it was fetched; undefined for one that we do not have. */
const catalogues = new Map<string, Promise<Catalogue | undefined>>()

export class Words {
  /** The language spoken. */
  language = 'en'
  #catalogue: Catalogue | undefined
  #wanted = 'en'
  readonly #writers: (() => void)[] = []

  say(key: Key, values?: Values): string {
    return filled(this.#catalogue?.['elements']?.[key] || english[key], values)
  }

  tell(message: Message): string {
    return typeof message === 'string' ? message : this.say(message.key, message.values)
  }

  /** Why something failed. */
  why(error: unknown): string {
    return this.tell(error instanceof ToldError ? error.told : (error as Error).message)
  }

  /** Of a figure, before its program is there. */
  title(tag: string): string | undefined {
    return this.#catalogue?.[tag.replace('fastslam-', '').replaceAll('-', '_')]?.['title']
  }

  /** Whether numbers have a decimal comma. */
  get comma(): boolean {
    return this.#catalogue?.['language']?.['decimal'] === 'comma'
  }

  /** What the program says, as it takes it: a line for each message. Nothing for English. */
  get forProgram(): string {
    const sections = Object.entries(this.#catalogue ?? {}).filter(([section]) => section !== 'elements' && section !== 'language')
    return sections.flatMap(([section, messages]) => Object.entries(messages).map(([key, text]) => `${section}.${key}=${text}`)).join('\n')
  }

  /** Writes words: now, and again when they are of another language. */
  always(write: () => void): void {
    this.#writers.push(write)
    write()
  }

  /** Speaks a language, or English where we do not have it. True if another one was spoken before. */
  async speak(language: string): Promise<boolean> {
    this.#wanted = language
    const catalogue = language === 'en' ? undefined : await fetched(language)
    const spoken = catalogue ? language : 'en'
    if (language !== this.#wanted || spoken === this.language) return false
    this.language = spoken
    this.#catalogue = catalogue
    for (const write of this.#writers) write()
    return true
  }
}

function fetched(language: string): Promise<Catalogue | undefined> {
  const known = catalogues.get(language)
  if (known) return known
  const coming = fetchWords(language).catch((error: unknown) => {
    catalogues.delete(language) // the network may be back at the next try
    console.warn(`No words of language ${language}:`, error)
    return undefined
  })
  catalogues.set(language, coming)
  return coming
}

/** `{name}` is a value, and `{name:one|other}` the first word where that is 1, and else the second. */
function filled(message: string, values: Values = {}): string {
  return message.replace(/\{(\w+)(?::([^|}]*)\|([^}]*))?\}/g, (_, name: string, one?: string, other?: string) => {
    const value = String(values[name] ?? '')
    return one === undefined ? value : value === '1' ? one : other!
  })
}

/** The language that the page around an element says it has: the first part of its nearest `lang`, also beyond shadow roots. */
export function languageAround(element: Element): string {
  for (let at: Element | undefined = element; at; ) {
    const named = at.closest('[lang]')
    if (named) return named.getAttribute('lang')!.split('-')[0]!.toLowerCase()
    const root: Node = at.getRootNode()
    at = root instanceof ShadowRoot ? root.host : undefined
  }
  return 'en'
}
