// Rust taken from the source itself, found by the names of its items, highlighted by Shiki with classes.
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import { createHighlighter } from 'shiki'

/** @typedef {{ file: string, first: number, last: number, lines: { number: number, text: string }[] }} Piece `first` and `last` are lines of the file */
/** @typedef {{ text: string, kind: string }} Token kind "" is plain text */

/** The first line of an item, with its indentation, kind and name. */
const itemStart = /^(\s*)(?:pub(?:\([^)]*\))? )?(?:const |async |unsafe )*(fn|struct|enum|trait|type|const|static|mod|impl)\b\s*(.*)$/

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

  /**
   * `path#name`: an item of Rust with the comments above it, as rustfmt lays it out. `Type::name` is a method, `a+b` shows two items with a
   * blank line between them, and `name:text` is the one line of an item that contains a text.
   * @param {string} src @returns {Piece | string} what is wrong, in words, where there is no such piece
   */
  piece(src) {
    const [file = '', names] = src.split('#')
    if (file.startsWith('/') || file.split('/').includes('..')) return `${file} is not a path inside the repository`
    const lines = this.#lines(file)
    if (!lines) return `there is no file ${file}`
    if (!names) return `${src} names no item: write ${file}#name`
    const [, listed = '', text] = /^((?:\w|::|\+)+)(?::([^:].*))?$/.exec(names) ?? []
    /** @type {{ number: number, text: string }[]} */
    const shown = []
    for (const name of listed.split('+')) {
      const found = item(lines, name)
      if (typeof found === 'string') return `${file} ${found}`
      if (shown.length > 0) shown.push({ number: 0, text: '' })
      shown.push(...found)
    }
    if (text) {
      const [line, more] = shown.filter(line => line.text.includes(text) && !line.text.trimStart().startsWith('//'))
      if (!line) return `${file}: no line of ${listed} contains ${text}`
      if (more) return `${file}: more than one line of ${listed} contains ${text}`
      return { file, first: line.number, last: line.number, lines: [line] }
    }
    return { file, first: shown[0]?.number ?? 0, last: shown.at(-1)?.number ?? 0, lines: shown }
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

/** The lines of an item, without their common indentation; in words, why there are none. @param {string[]} lines @param {string} name */
function item(lines, name) {
  const [type, method] = name.includes('::') ? name.split('::') : [undefined, name]
  const starts = lines.flatMap((line, i) => (isNamed(line, method ?? '') && (!type || ownerOf(lines, i) === type) ? [i] : []))
  const [start] = starts
  if (start === undefined) return `has no item ${name}`
  if (starts.length > 1) return `has more than one ${name}: write Type::${name}`
  const indent = lines[start]?.search(/\S/) ?? 0
  let first = start
  while (first > 0 && /^\s*(\/\/\/|#\[)/.test(lines[first - 1] ?? '')) first--
  const last = lines.findIndex((line, i) => i >= start && line.search(/\S/) === indent && /(;|\}|\},)$/.test(line))
  if (last < 0) return `has no end of ${name}`
  return lines.slice(first, last + 1).map((text, i) => ({ number: first + i + 1, text: text.slice(indent) }))
}

/** Whether a line begins an item of this name. @param {string} line @param {string} name */
function isNamed(line, name) {
  const [, , kind, rest = ''] = itemStart.exec(line) ?? []
  return kind !== undefined && kind !== 'impl' && /^\w+/.exec(rest)?.[0] === name
}

/** The type whose `impl`, or the trait or module, that a line stands in. @param {string[]} lines @param {number} at */
function ownerOf(lines, at) {
  const indent = lines[at]?.search(/\S/) ?? 0
  for (let i = at - 1; i >= 0; i--) {
    const [, space = '', kind, rest = ''] = itemStart.exec(lines[i] ?? '') ?? []
    if (kind === undefined || space.length >= indent) continue
    if (kind !== 'impl') return /^\w+/.exec(rest)?.[0]
    const subject = rest.replace(/^<[^{]*?>\s+(?=\w)/, '').replace(/^.*\bfor\s+/, '')
    return /^\w+/.exec(subject.trim())?.[0]
  }
  return undefined
}
