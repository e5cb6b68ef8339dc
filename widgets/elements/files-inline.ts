// The same as files.ts for a script that carries its files along (scripts/single.mjs): notebooks, pages from file://, learning systems.
import { program, worker } from 'virtual:fastslam-files'

/** Packed as gzip in base64: a third smaller than the program itself. */
export async function fetchProgram(): Promise<Response> {
  const bytes = Uint8Array.from(atob(program), character => character.charCodeAt(0))
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'))
  return new Response(stream, { headers: { 'Content-Type': 'application/wasm' } })
}

/** There is one program. */
export const fetchLogProgram = fetchProgram

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
