// `:::algorithm`: pseudo-code, each line linked to the line of Rust that does it, and named so that it can light up when a figure steps.
import { h } from 'hastscript'
import { attribute, content, idOf, inline, nameOf, parts } from './context.mjs'
import { textOf } from './inline.mjs'
import { addressOf } from './listing.mjs'

/** @typedef {import('./context.mjs').Context} Context */

/** @type {import('./context.mjs').Handler} */
export function algorithm(context, state, node) {
  const { label, body } = parts(node)
  const figure = attribute(node, 'figure')
  if (figure && context.labels.get(figure)?.kind !== 'Figure') context.problems.add(context.file, node, `there is no figure #${figure}`)
  const id = idOf(node)
  const lists = body.filter(child => child.type === 'list')
  if (lists.length !== 1) context.problems.add(context.file, node, `:::algorithm holds one numbered list, not ${lists.length}`)
  const children = body.map(child => (child.type === 'list' ? lines(context, state, child) : content(state, [child]))).flat()
  const title = h('p.head', { id: `${id}-title` }, h('b', nameOf(context, node)), ' ', h('span.title', label ? inline(state, label) : []))
  return h('div.algorithm', { id, role: 'group', ariaLabelledBy: `${id}-title`, dataFigure: figure }, title, children)
}

/** @param {Context} context @param {any} state @param {any} list @returns {import('hast').Element} */
function lines(context, state, list) {
  return h('ol', list.children.map((/** @type {any} */ item) => {
    const [first, ...rest] = item.children
    const last = first?.type === 'paragraph' ? first.children.at(-1) : undefined
    const named = last?.type === 'textDirective' && last.name === 'line' ? last : undefined
    const shown = named ? { ...first, children: first.children.slice(0, -1) } : first
    const nested = rest.map((/** @type {any} */ child) => (child.type === 'list' ? lines(context, state, child) : content(state, [child]))).flat()
    return h('li', { dataLine: named ? textOf(named) : undefined }, h('span.step', shown ? inline(state, shown) : [], named ? [' ', sourceLink(context, named)] : []), nested)
  }))
}

/** @param {Context} context @param {any} node `:line[key]{src="file#anchor"}` */
function sourceLink(context, node) {
  const src = attribute(node, 'src')
  if (!src) return []
  const piece = context.sources.piece(src)
  if (typeof piece === 'string') {
    context.problems.add(context.file, node, `:line: ${piece}`)
    return []
  }
  const name = piece.file.split('/').slice(-1)[0]
  return [h('a.src', { href: addressOf(context, piece.file, piece.first) }, `${name}:${piece.first}`)]
}
