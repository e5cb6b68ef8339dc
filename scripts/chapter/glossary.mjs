// The glossary: `## key: name, synonym` and one paragraph each. A term in the text links to its entry, which stands at the page's end and,
// with script, in a card beside the term.
import { toString } from 'mdast-util-to-string'

/**
 * @typedef {import('mdast').Paragraph} Paragraph
 * @typedef {{ name: string, also: string[], text: Paragraph, line: number | undefined }} Entry
 */

export class Glossary {
  /** @type {Map<string, Entry>} */
  #entries = new Map()
  /** @type {Set<string>} */
  #used = new Set()
  /** @type {Set<string>} */
  #here = new Set()

  /** @param {import('./parse.mjs').Source} source @param {import('./problems.mjs').Problems} problems */
  constructor({ file, tree }, problems) {
    this.file = file
    const { children } = tree
    children.forEach((node, i) => {
      if (node.type !== 'heading' || node.depth !== 2) return
      const [key = '', names] = toString(node).split(/:\s*(.*)/)
      const [name = key, ...also] = (names ?? key).split(/\s*[,;]\s*/)
      const text = children[i + 1]
      if (!/^[\w-]+$/.test(key)) problems.add(file, node, `“${key}” is no key: letters, digits and hyphens, then “: name, synonym”`)
      else if (text?.type !== 'paragraph') problems.add(file, node, `the entry ${key} has no paragraph`)
      else if (this.#entries.has(key)) problems.add(file, node, `the entry ${key} is there twice`)
      else this.#entries.set(key, { name, also, text, line: node.position?.start.line })
    })
  }

  beginPage() {
    this.#here = new Set()
  }

  /** Marks an entry as used; false where there is none. @param {string} key */
  use(key) {
    if (!this.#entries.has(key)) return false
    this.#used.add(key)
    this.#here.add(key)
    return true
  }

  /** The entries that the page uses, by name. */
  here() {
    return [...this.#entries].filter(([key]) => this.#here.has(key)).sort(([, a], [, b]) => a.name.localeCompare(b.name, 'en'))
  }

  /** @returns {[key: string, entry: Entry][]} */
  unused() {
    return [...this.#entries].filter(([key]) => !this.#used.has(key))
  }
}
