// Markdown to a tree: GitHub's dialect, TeX between dollars, directives, front matter.
import remarkDirective from 'remark-directive'
import remarkFrontmatter from 'remark-frontmatter'
import remarkGfm from 'remark-gfm'
import remarkMath from 'remark-math'
import remarkParse from 'remark-parse'
import { unified } from 'unified'
import { visit } from 'unist-util-visit'
import { parse as parseYaml } from 'yaml'

/**
 * @typedef {import('mdast').Root} Root
 * @typedef {{ file: string, tree: Root, front: Record<string, unknown> }} Source
 */

const processor = unified().use(remarkParse).use(remarkGfm).use(remarkMath).use(remarkDirective).use(remarkFrontmatter)

/** @param {string} file as problems name it @param {string} text @param {import('./problems.mjs').Problems} problems @returns {Source} */
export function parse(file, text, problems) {
  const tree = processor.parse(text)
  // A formula between double dollars that has a paragraph to itself is a display, also on one line.
  visit(tree, 'paragraph', (node, index, parent) => {
    const [only] = node.children
    if (node.children.length !== 1 || only?.type !== 'inlineMath' || !parent || index === undefined) return
    if (text.slice(only.position?.start.offset).startsWith('$$')) parent.children[index] = { type: 'math', value: only.value, position: node.position }
  })
  /** @type {Record<string, unknown>} */
  let front = {}
  const first = tree.children[0]
  if (first?.type === 'yaml') {
    tree.children.shift()
    try {
      front = parseYaml(first.value) ?? {}
    } catch (error) {
      problems.add(file, first, `front matter: ${/** @type {Error} */ (error).message}`)
    }
  }
  return { file, tree, front }
}
