// What is wrong with the chapter's sources, collected so that one build shows all of it.
import { StepError } from '../lib.mjs'

/** @typedef {{ position?: { start: { line: number } } | undefined } | number | undefined} Place a node of the Markdown, or a line */

/** @param {Place} place */
const lineOf = place => (typeof place === 'number' ? place : place?.position?.start.line)

export class Problems {
  /** @type {{ file: string, line: number, text: string }[]} */
  #all = []

  /** @param {string} file @param {Place} place @param {string} text */
  add(file, place, text) {
    this.#all.push({ file, line: lineOf(place) ?? 1, text })
  }

  /** One line each, as editors and terminals link them: file:line: what is wrong. */
  get lines() {
    return this.#all.map(({ file, line, text }) => `${file}:${line}: ${text}`)
  }

  throwIfAny() {
    if (this.#all.length > 0) throw new StepError(`The chapter cannot be built:\n${this.lines.join('\n')}`)
  }
}
