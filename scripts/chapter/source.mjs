// Rust taken from the source itself: pieces between `// ANCHOR: name` and `// ANCHOR_END: name`, highlighted by Shiki with classes.
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import { createHighlighter } from 'shiki'

/** @typedef {{ file: string, first: number, last: number, lines: { number: number, text: string }[] }} Piece `first` and `last` are lines of the file */
/** @typedef {{ text: string, kind: string }} Token kind "" is plain text */

/** Both the chapter's spelling and the one that the crate's own anchors use. */
const mark = /^\s*\/\/ *(anchor|end|anchor_end): *([\w-]+)\s*$/i

/** Colours that stand for classes: Shiki paints, the style sheet decides. @type {Record<string, string>} */
const kinds = { '#000001': 'c', '#000002': 'k', '#000003': 's', '#000004': 't', '#000005': 'f' }
const theme = {
  name: 'classes',
  type: /** @type {const} */ ('light'),
  fg: '#000000',
  bg: '#ffffff',
  settings: [
    { scope: ['comment', 'punctuation.definition.comment'], settings: { foreground: '#000001' } },
    { scope: ['keyword', 'storage'], settings: { foreground: '#000002' } },
    { scope: ['string', 'constant'], settings: { foreground: '#000003' } },
    { scope: ['entity.name.type', 'entity.name.lifetime'], settings: { foreground: '#000004' } },
    { scope: ['entity.name.function'], settings: { foreground: '#000005' } },
    { scope: ['keyword.operator', 'punctuation'], settings: { foreground: '#000000' } },
  ],
}

/** One for all: it takes a second to set up. @type {Promise<import('shiki').Highlighter> | undefined} */
let highlighter

export class Sources {
  /** @type {Map<string, string[] | undefined>} */
  #files = new Map()
  /** @type {import('shiki').Highlighter | undefined} */
  #highlighter

  /** @param {string} root */
  constructor(root) {
    this.root = root
  }

  async open() {
    this.#highlighter = await (highlighter ??= createHighlighter({ langs: ['rust', 'toml', 'javascript', 'html', 'shell'], themes: [theme] }))
    return this
  }

  /** The files that were read, for the development server to watch. */
  get files() {
    return [...this.#files.keys()].map(file => join(this.root, file))
  }

  /** @param {string} file */
  #lines(file) {
    if (!this.#files.has(file)) {
      try {
        this.#files.set(file, readFileSync(join(this.root, file), 'utf8').split('\n'))
      } catch {
        this.#files.set(file, undefined)
      }
    }
    return this.#files.get(file)
  }

  /** `path#anchor` @param {string} src @returns {Piece | string} what is wrong, in words, where there is no such piece */
  piece(src) {
    const [file = '', anchor] = src.split('#')
    if (file.startsWith('/') || file.split('/').includes('..')) return `${file} is not a path inside the repository`
    const lines = this.#lines(file)
    if (!lines) return `there is no file ${file}`
    if (!anchor) return `${src} names no anchor: write ${file}#name`
    let [start, end] = [-1, -1]
    lines.forEach((line, i) => {
      const [, kind = '', name] = mark.exec(line) ?? []
      if (name !== anchor) return
      if (kind.toLowerCase() === 'anchor') start = i
      else end = i
    })
    if (start < 0) return `${file} has no // ANCHOR: ${anchor}`
    if (end < start) return `${file} has no // ANCHOR_END: ${anchor}`
    const kept = lines.map((text, i) => ({ number: i + 1, text })).slice(start + 1, end).filter(({ text }) => !mark.test(text))
    const indent = Math.min(...kept.filter(({ text }) => text.trim()).map(({ text }) => text.search(/\S/)))
    const shown = kept.map(({ number, text }) => ({ number, text: text.slice(indent) }))
    if (shown.length === 0) return `${src} is empty`
    return { file, first: kept[0]?.number ?? 0, last: kept.at(-1)?.number ?? 0, lines: shown }
  }

  /** Code by lines, each in as few pieces as its colours allow. @param {string} code @param {string} language @returns {Token[][]} */
  highlight(code, language) {
    const highlighter = /** @type {import('shiki').Highlighter} */ (this.#highlighter)
    const known = highlighter.getLoadedLanguages().includes(language)
    const { tokens } = highlighter.codeToTokens(code, { lang: /** @type {any} */ (known ? language : 'text'), theme: 'classes' })
    return tokens.map(line => {
      /** @type {Token[]} */
      const merged = []
      for (const { content, color } of line) {
        const kind = kinds[color?.toLowerCase() ?? ''] ?? ''
        const last = merged.at(-1)
        if (last && (last.kind === kind || !content.trim())) last.text += content
        else merged.push({ text: content, kind: content.trim() ? kind : '' })
      }
      return merged
    })
  }
}
