// Headings with anchors, sections around what belongs to them, and the table of contents.
import { h } from 'hastscript'
import { idOf, inline } from './context.mjs'

/**
 * @typedef {import('hast').Element} Element
 * @typedef {import('hast').ElementContent} ElementContent
 * @typedef {import('./context.mjs').Head} Head
 */

/** @type {import('./context.mjs').Handler} */
export function heading(context, state, node) {
  const id = idOf(node) ?? ''
  context.last = ''
  const text = inline(state, node)
  context.depth = node.depth
  context.heads.push({ depth: node.depth, id, content: text })
  // The heading is its own anchor: what is pressed is what is linked to.
  return h(`h${node.depth}`, { id }, h('a', { href: `#${id}` }, text))
}

/** @param {ElementContent} node */
const depthOf = node => (node.type === 'element' && /^h[2-4]$/.test(node.tagName) && node.properties.id ? Number(node.tagName[1]) : undefined)

/** Wraps every heading and what follows it, down to the next of its rank, in a section. @param {ElementContent[]} nodes @param {number} [depth] @returns {ElementContent[]} */
export function sections(nodes, depth = 2) {
  if (depth > 4) return nodes
  const starts = nodes.flatMap((node, i) => (depthOf(node) === depth ? [i] : []))
  if (starts.length === 0) return sections(nodes, depth + 1)
  const before = nodes.slice(0, starts[0])
  const parts = starts.map((start, i) => nodes.slice(start, starts[i + 1]))
  return [...sections(before, depth + 1), ...parts.map(([first, ...rest]) => h('section', /** @type {Element} */ (first), sections(rest, depth + 1)))]
}

/** A list of links, two ranks deep. @param {Head[]} heads */
export function contents(heads) {
  /** @type {Element[]} */
  const items = []
  for (const { depth, id, content } of heads) {
    const item = h('li', h('a', { href: `#${id}` }, structuredClone(content).map(plain)))
    const last = items.at(-1)
    if (depth === 2 || !last) items.push(item)
    else if (depth === 3) {
      const list = last.children.find(child => child.type === 'element' && child.tagName === 'ol')
      if (list?.type === 'element') list.children.push(item)
      else last.children.push(h('ol', item))
    }
  }
  return h('ol', items)
}

/** No link may stand in a link. @param {ElementContent} node */
function plain(node) {
  if (node.type === 'element' && node.tagName === 'a') node.tagName = 'span'
  return node
}
