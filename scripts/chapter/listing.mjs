// `::listing`: a piece of the crate's own source. Other fenced code is highlighted alike.
import { h } from 'hastscript'
import { attribute, idOf, nameOf } from './context.mjs'
import { textOf } from './inline.mjs'
import { curly } from './quotes.mjs'

/**
 * @typedef {import('./context.mjs').Context} Context
 * @typedef {import('./context.mjs').Handler} Handler
 */

/** Reads every listing of a page before anything is rendered, so that algorithms above them can link to their lines. @param {Context} context @param {any} node */
export function readListing(context, node) {
  const piece = context.sources.piece(attribute(node, 'src') ?? '')
  if (typeof piece === 'string') context.problems.add(context.file, node, `::listing: ${piece}`)
  else context.listings.set(idOf(node) ?? '', { id: idOf(node) ?? '', piece })
}

/** Marks the line of a listing that a line of an algorithm links to. @param {Context} context @param {any} node */
export function readLine(context, node) {
  const piece = context.sources.piece(attribute(node, 'src') ?? '')
  if (typeof piece === 'string') return
  for (const { id, piece: shown } of context.listings.values()) if (shows(shown, piece.file, piece.first)) context.lines.add(`${id}-${piece.first}`)
}

/** @param {import('./source.mjs').Piece} piece @param {string} file @param {number} line */
const shows = (piece, file, line) => piece.file === file && piece.lines.some(({ number }) => number === line)

/** Where a line of the source is shown: on the page if a listing has it, else in the repository. @param {Context} context @param {string} file @param {number} line */
export function addressOf(context, file, line) {
  for (const { id, piece } of context.listings.values()) {
    if (shows(piece, file, line)) return `#${id}-${line}`
  }
  return repositoryAddress(context, file, line)
}

/** @param {Context} context @param {string} file @param {number} [line] @param {number} [last] */
const repositoryAddress = (context, file, line, last) => `${context.repository}/blob/main/${file}${line ? `#L${line}` : ''}${last ? `-L${last}` : ''}`

/** @type {Handler} */
export function listing(context, _, node) {
  const found = context.listings.get(idOf(node) ?? '')
  if (!found) return []
  const { id, piece } = found
  const tokens = context.sources.highlight(piece.lines.map(({ text }) => text).join('\n'), 'rust')
  const lines = tokens.flatMap((line, i) => {
    const anchor = `${id}-${piece.lines[i]?.number}`
    const spans = colours(line)
    return [...(context.lines.has(anchor) ? [h('span', { id: anchor }, spans)] : spans), { type: /** @type {const} */ ('text'), value: '\n' }]
  })
  const caption = attribute(node, 'caption') ?? textOf(node)
  const name = h('a.file', { href: repositoryAddress(context, piece.file, piece.first, piece.last) }, piece.file)
  return h('figure.wide.listing', { id }, h('figcaption', h('p', h('b', nameOf(context, node)), ' ', inlineCode(caption), ' ', name)), h('pre.scroll', h('code', lines)))
}

/** A caption is an attribute, so its `code` is not Markdown yet. @param {string} text */
const inlineCode = text => text.split('`').map((part, i) => (i % 2 === 1 ? h('code', part) : curly(part, i === 0 ? '' : 'x')))

/** @type {Handler} */
export function code(context, _, node) {
  const tokens = context.sources.highlight(node.value, node.lang ?? 'text')
  return h('pre.scroll', h('code', tokens.flatMap(line => [...colours(line), { type: /** @type {const} */ ('text'), value: '\n' }])))
}

/** @param {import('./source.mjs').Token[]} line */
const colours = line => line.map(({ text, kind }) => (kind ? h(`span.${kind}`, text) : { type: /** @type {const} */ ('text'), value: text }))
