// Where the files of the figures are: beside this script. A script that carries them along has files-inline.ts in place of this one.
import worker from './worker?worker&url'

/** A file of ../words, by section and key. */
export type Catalogue = Record<string, Record<string, string>>

/** Of every language but English, which is in the script: a file more here is a language more. */
const WORDS = import.meta.glob<string>(['../words/*.json', '!../words/en.json'], { eager: true, query: '?url', import: 'default' })
const PICTURES = import.meta.glob<string>('../pictures/fastslam-*.png', { eager: true, query: '?url', import: 'default' })

const PROGRAMS = import.meta.glob<string>('../pkg/fastslam-*.wasm', { eager: true, query: '?url', import: 'default' })

const programAddress = (name: string) => PROGRAMS[`../pkg/fastslam-${name}.wasm`]

/** Whether this program came along: those of single figures take minutes to make, and a site may do without. */
export const hasProgram = (name: string): boolean => programAddress(name) !== undefined

/** What may arrive: of a version that is kept, files with these hashes (scripts/versions.mjs writes them here); else any. */
const checked = { integrity: '' }

export function fetchProgram(name: string): Promise<Response> {
  return fetch(programAddress(name)!, checked)
}

/** The words of a language; undefined for one that we do not have. */
export async function fetchWords(language: string): Promise<Catalogue | undefined> {
  const address = WORDS[`../words/${language}.json`]
  if (!address) return undefined
  const response = await fetch(address, checked)
  if (!response.ok) throw new Error(`the server answered ${response.status}`)
  return (await response.json()) as Catalogue
}

/** The log that comes with that figure. */
export function fetchExample(): Promise<Response> {
  return fetch(new URL('../../www/public/example.clf.gz', import.meta.url), checked)
}

/** The worker's script: an address, or what is in it. */
export function workerScript(): { address: string } | { text: string } {
  return { address: worker }
}

/** The picture of a figure at rest; undefined where the program came without pictures. */
export function pictureAddress(tag: string, shade: 'light' | 'dark'): string | undefined {
  return PICTURES[`../pictures/${tag}-${shade}.png`]
}

/** The folder of the site that serves this script, where it is one; a version that is kept lies in a folder of it. Else empty. */
export function homeAddress(): string {
  return /^https?:[^?#]*?\/(?=(v\/\d+\.\d+\.[^/]+\/)?fastslam(-[\w-]{8})?\.js([?#]|$))/.exec(import.meta.url)?.[0] ?? ''
}
