// Citations, from a list in CSL-JSON whose `note` says what to read a work for: [@key] is part of the sentence, “Thrun et al. (2005)”;
// ([@key, §IV; @other]), in parentheses, is “(Thrun et al. 2005, §IV; Rao 1945)”; [-@key] is the year alone.
import { h } from 'hastscript'

/**
 * @typedef {import('hast').ElementContent} ElementContent
 * @typedef {{ family?: string, given?: string, literal?: string }} Author
 * @typedef {{ id: string, author?: Author[], editor?: Author[], title: string, issued?: { 'date-parts': number[][] }, DOI?: string, URL?: string,
 *   note?: string, volume?: string | number, issue?: string | number, page?: string, publisher?: string, type?: string,
 *   'container-title'?: string, edition?: string | number }} Work
 */

const pattern = /\[(-?@[\w:-]+(?:,[^\];]+)?(?:;\s*-?@[\w:-]+(?:,[^\];]+)?)*)\]/g
const single = /^(-?)@([\w:-]+)(?:,\s*(.+))?$/

/** @param {Author} author */
const family = author => author.family ?? author.literal ?? ''
/** @param {Work} work */
const year = work => String(work.issued?.['date-parts']?.[0]?.[0] ?? 'n.d.')

/** Who wrote it; of a collection, who edited it. @param {Work} work */
const people = work => work.author ?? work.editor ?? []

/** The same, as it is said in a sentence. @param {Work} work */
function authors(work) {
  const names = people(work).map(family)
  if (names.length > 2) return `${names[0]} et al.`
  return names.length > 0 ? names.join(' and ') : work.title
}

/** @param {Author} author */
const inList = author => (author.given ? `${family(author)}, ${author.given}` : family(author))

export class Citations {
  /** @type {Map<string, Work>} */
  #works
  /** Cited anywhere. @type {Set<string>} */
  #cited = new Set()
  /** Cited on the page in hand. @type {Set<string>} */
  #here = new Set()

  /** @param {Work[]} works */
  constructor(works) {
    this.#works = new Map(works.map(work => [work.id, work]))
  }

  beginPage() {
    this.#here = new Set()
  }

  get citedHere() {
    return this.#here.size > 0
  }

  /**
   * A text with its citations as links.
   * @param {string} text @param {(key: string) => void} unknown called for a key that the list does not have
   * @returns {ElementContent[]}
   */
  link(text, unknown) {
    /** @type {ElementContent[]} */
    const parts = []
    let end = 0
    for (const match of text.matchAll(pattern)) {
      const before = text.slice(0, match.index)
      parts.push({ type: 'text', value: text.slice(end, match.index) })
      end = match.index + match[0].length
      const cited = (match[1] ?? '').split(/;\s*/).flatMap(one => {
        const [, bare, key = '', place] = single.exec(one.trim()) ?? []
        const work = this.#works.get(key)
        if (!work) unknown(key)
        return work ? [{ work, key, yearOnly: bare === '-', place: place ? `, ${place}` : '' }] : []
      })
      for (const { key } of cited) {
        this.#cited.add(key)
        this.#here.add(key)
      }
      const inParentheses = before.endsWith('(')
      cited.forEach(({ work, key, yearOnly, place }, i) => {
        const when = inParentheses ? `${year(work)}${place}` : `(${year(work)}${place})`
        if (i > 0) parts.push({ type: 'text', value: '; ' })
        parts.push(h('a.cite', { href: `#ref-${key}` }, yearOnly ? when : `${authors(work)} ${when}`))
      })
    }
    parts.push({ type: 'text', value: text.slice(end) })
    return parts.filter(part => part.type !== 'text' || part.value !== '')
  }

  /** The works that the page cites, by author and year. */
  list() {
    const works = [...this.#here].flatMap(key => this.#works.get(key) ?? [])
    works.sort((a, b) => authors(a).localeCompare(authors(b), 'en') || year(a).localeCompare(year(b)))
    return h('ul.references', works.map(work => h('li', { id: `ref-${work.id}` }, ...entry(work))))
  }

  unused() {
    return [...this.#works.keys()].filter(key => !this.#cited.has(key))
  }
}

/** @param {Work} work @returns {(ElementContent | string)[]} */
function entry(work) {
  const link = work.DOI ? `https://doi.org/${work.DOI}` : work.URL
  const title = link ? h('a', { href: link }, work.title) : work.title
  const names = people(work).map(inList).join('; ') + (work.editor && !work.author ? ' (eds.)' : '')
  const where = [
    work['container-title'] ? h('i', work['container-title']) : undefined,
    work.volume === undefined ? undefined : `${work.volume}${work.issue === undefined ? '' : ` (${work.issue})`}`,
    work.page?.replace('-', '–'),
    work.edition === undefined ? undefined : `edition ${work.edition}`,
    work.publisher,
  ].filter(part => part !== undefined)
  const joined = where.flatMap((part, i) => (i === 0 ? [' ', part] : [', ', part]))
  const stop = /[.?!]$/.test(work.title) ? '' : '.'
  return [h('span', names ? `${names} (${year(work)}). ` : `(${year(work)}). `, title, stop, ...joined, where.length > 0 ? '.' : ''), ...(work.note ? [' ', h('span.note', work.note)] : [])]
}
