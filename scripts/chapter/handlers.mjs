// Which module renders what. A directive that is not in these lists is a mistake of the writer.
import { h } from 'hastscript'
import { algorithm } from './algorithm.mjs'
import { goal } from './bank.mjs'
import { deeper, derivation, equation, exercise, hint, lapTable, margin, predict, solution, table, theorem } from './blocks.mjs'
import { chip, task } from './challenges.mjs'
import { choice, count, reach, takeaway, unfold } from './checks.mjs'
import { citation } from './citation.mjs'
import { heading } from './contents.mjs'
import { inline } from './context.mjs'
import { slide } from './deck.mjs'
import { figure, picture } from './figure.mjs'
import { footnoteReference, inlineMath, link, math, minutes, num, term, text } from './inline.mjs'
import { code, listing } from './listing.mjs'
import { vignette } from './vignette.mjs'
import { ask, name, shown, write } from './worksheet.mjs'

/**
 * @typedef {import('./context.mjs').Context} Context
 * @typedef {import('./context.mjs').Handler} Handler
 */

/** The works cited on the page, known when all of it has been rendered. @type {Handler} */
const references = () => /** @type {any} */ ({ type: 'element', tagName: 'references', properties: {}, children: [] })

/** What a site has that was put somewhere for others (scripts/downloads.mjs). @type {Handler} */
const downloads = () => h('div', { id: 'made' }, h('p', 'This copy of the site was built without its downloads. ', h('code', 'npm run site'), ' makes them.'))

/** @type {Record<string, Handler>} */
const containers = { algorithm, choice, count, deeper, derivation, equation, exercise, figure, hint, 'lap-table': lapTable, margin, picture, predict, reach, slide, solution, state: shown, table, takeaway, theorem, vignette, write }
/** @type {Record<string, Handler>} */
const leaves = { ask, citation, downloads, goal, 'lap-table': lapTable, listing, name, references, unfold }
/** @type {Record<string, Handler>} */
const texts = { chip, minutes, num, task, term }

/** @param {string} colons @param {Record<string, Handler>} known @returns {Handler} */
const directive = (colons, known) => (context, state, node) => {
  const handler = Object.hasOwn(known, node.name) ? known[node.name] : undefined
  if (handler) return handler(context, state, node)
  // A colon before a letter is often just a colon: 1:n.
  if (node.type === 'textDirective' && node.children.length === 0 && Object.keys(node.attributes ?? {}).length === 0) {
    return { type: 'text', value: `:${node.name}` }
  }
  const where = node.name === 'line' ? ' at the end of a line of an :::algorithm only' : `; known are ${Object.keys(known).join(', ')}`
  context.problems.add(context.file, node, `there is no directive ${colons}${node.name}${where}`)
  return []
}

/** @type {Handler} */
const html = (context, _, node) => {
  if (!/^<!--[^]*-->$/.test(node.value)) context.problems.add(context.file, node, `HTML has no place in the Markdown: ${node.value.split('\n')[0]}`)
  return []
}

/** @type {Handler} */
const paragraph = (context, state, node) => {
  context.last = ''
  return h('p', inline(state, node))
}

/** @type {Handler} */
const inlineCode = (context, _, node) => {
  context.last = 'x'
  return h('code', node.value)
}

/** @type {Record<string, Handler>} */
const all = {
  code,
  containerDirective: directive(':::', containers),
  footnoteReference,
  heading,
  html,
  inlineCode,
  inlineMath,
  leafDirective: directive('::', leaves),
  link,
  math,
  paragraph,
  text,
  textDirective: directive(':', texts),
}

/** @param {Context} context @returns {import('mdast-util-to-hast').Handlers} */
export const handlers = context =>
  Object.fromEntries(Object.entries(all).map(([type, handler]) => [type, (/** @type {any} */ state, /** @type {any} */ node) => handler(context, state, node)]))
