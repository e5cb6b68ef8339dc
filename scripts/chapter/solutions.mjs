// The solutions of exercises, on a page of their own: nobody who reads the chapter to its end has to load them. Where each stood, a fold
// fetches it (`elsewhere`), and links between the two pages follow.
import { h } from 'hastscript'
import { visit } from 'unist-util-visit'

/** @typedef {import('hast').Element} Element */
/** @typedef {import('hast').ElementContent} ElementContent */

export const solutionsPage = 'solutions.html'

/** @param {Element} element @param {string} name */
const isOf = (element, name) => [element.properties.className ?? []].flat().includes(name)

/** @param {ElementContent[]} nodes @returns {import('hast').Root} */
const rootOf = nodes => ({ type: 'root', children: nodes })

/**
 * Takes the solutions out of a page's nodes.
 * @param {ElementContent[]} nodes
 * @returns {{ heads: import('./context.mjs').Head[], sections: Element[] }} of the page that they are on
 */
export function takeSolutions(nodes) {
  /** @type {import('./context.mjs').Head[]} */
  const heads = []
  /** @type {Element[]} */
  const sections = []
  visit(rootOf(nodes), 'element', exercise => {
    if (!isOf(exercise, 'exercise')) return
    const solution = exercise.children.find(child => child.type === 'element' && isOf(child, 'solution'))
    const fold = solution?.type === 'element' ? solution.children.find(child => child.type === 'element' && isOf(child, 'fold')) : undefined
    if (solution?.type !== 'element' || fold?.type !== 'element') return
    const asked = String(exercise.properties.id)
    const id = `solution-${asked}`
    /** @type {ElementContent[]} */
    let title = []
    visit(exercise, 'element', element => void (/^h[2-6]$/.test(element.tagName) && (title = structuredClone(element.children))))
    heads.push({ depth: 2, id, content: title })
    // The way back to what is asked.
    sections.push(h('section', h('h2', { id }, h('a', { href: `#${asked}` }, title)), fold.children))
    fold.children = [h('p', h('a', { href: `${solutionsPage}#${id}` }, 'Solution, on a page of its own'))]
    solution.properties.className = ['solution', 'elsewhere']
  })
  /** @type {Set<string>} */
  const moved = new Set()
  visit(rootOf(sections), 'element', ({ properties: { id } }) => void (id && moved.add(String(id))))
  const follow = (/** @type {ElementContent[]} */ pages, /** @type {(id: string) => string} */ to) =>
    visit(rootOf(pages), 'element', ({ tagName, properties }) => {
      const id = tagName === 'a' ? /^#(.+)$/.exec(String(properties.href ?? ''))?.[1] : undefined
      if (id !== undefined) properties.href = to(id)
    })
  follow(sections, id => (moved.has(id) ? `#${id}` : `./index.html#${id}`))
  follow(nodes, id => (moved.has(id) ? `${solutionsPage}#${id}` : `#${id}`))
  return { heads, sections }
}
