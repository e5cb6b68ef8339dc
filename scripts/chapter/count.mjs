// How long a page is, by section: what is open, and all of it. Formulas, listings, captions, works and terms are not counted.

/**
 * @typedef {import('hast').Nodes} Node
 * @typedef {{ id: string, open: number, whole: number }} Count of one section
 */

const uncounted = new Set(['math', 'pre', 'figcaption', 'picture', 'input'])
const unread = new Set(['references', 'glossary', 'src'])

/** What is read without unfolding anything, and what else there is. @param {Node} node @param {boolean} [folded] @returns {[open: number, whole: number]} */
function countOf(node, folded = false) {
  if (node.type === 'text') {
    const words = node.value.split(/\s+/).filter(word => /[\p{L}\p{N}]/u.test(word)).length
    return [folded ? 0 : words, words]
  }
  if (!('children' in node)) return [0, 0]
  if (node.type === 'element') {
    const classes = [node.properties.className ?? []].flat()
    if (uncounted.has(node.tagName) || classes.some(name => unread.has(String(name)))) return [0, 0]
  }
  let [open, whole] = [0, 0]
  for (const child of node.children) {
    // The line that is pressed is read; what it unfolds is not.
    const inside = folded || (node.type === 'element' && node.tagName === 'details' && !(child.type === 'element' && child.tagName === 'summary'))
    const [more, all] = countOf(child, inside)
    open += more
    whole += all
  }
  return [open, whole]
}

/** @param {Node} node @returns {string | undefined} the anchor of a section that begins with a heading */
const anchorOf = node => {
  const first = node.type === 'element' && node.tagName === 'section' ? node.children[0] : undefined
  return first?.type === 'element' && /^h[23]$/.test(first.tagName) ? String(first.properties.id) : undefined
}

/** The words of each section of a page, without those of the sections in it. @param {Node} node @returns {Count[]} */
export function wordsOf(node) {
  if (!('children' in node)) return []
  const inner = node.children.filter(child => anchorOf(child) !== undefined)
  const below = node.children.flatMap(child => wordsOf(child))
  const id = anchorOf(node)
  if (id === undefined) return below
  const [open, whole] = countOf(/** @type {Node} */ ({ ...node, children: node.children.filter(child => !inner.includes(child)) }))
  return [{ id, open, whole }, ...below]
}

/** @param {Count[]} counts @returns {Count} */
export const total = counts => ({ id: 'all', open: counts.reduce((sum, { open }) => sum + open, 0), whole: counts.reduce((sum, { whole }) => sum + whole, 0) })
