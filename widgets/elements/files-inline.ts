// The same as files.ts for a script that carries its files along (scripts/single.mjs): notebooks, pages from file://, learning systems.
import { example, programs, worker, words } from 'virtual:fastslam-files'
import type { Catalogue } from './files'

/** The program of this name: where a figure uses two, both are one, with their names joined by + (scripts/registry.mjs). */
const carried = (name: string): string | undefined => Object.entries(programs).find(([names]) => names.split('+').includes(name))?.[1]

export const hasProgram = (name: string): boolean => carried(name) !== undefined

/** Packed as gzip in base64: a third smaller than the program itself. */
export async function fetchProgram(name: string): Promise<Response> {
  const stream = new Blob([bytes(carried(name) ?? '')]).stream().pipeThrough(new DecompressionStream('gzip'))
  return new Response(stream, { headers: { 'Content-Type': 'application/wasm' } })
}

function bytes(base64: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from(atob(base64), character => character.charCodeAt(0))
}

/** Those languages that were asked for when the script was made. */
export async function fetchWords(language: string): Promise<Catalogue | undefined> {
  return words[language]
}

/** Only the figure that maps logs asks for it: other figures' files come without. */
export async function fetchExample(): Promise<Response> {
  return new Response(bytes(example))
}

export function workerScript(): { text: string } {
  return { text: worker }
}

/** It needs no picture: what may be missing elsewhere is here. */
export function pictureAddress(): undefined {
  return undefined
}

export function homeAddress(): string {
  return ''
}
