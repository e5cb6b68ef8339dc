// Browsers end lines on either side of a formula, also before the comma that follows it. What touches a formula is kept on its line.
import { h } from 'hastscript'

/** @typedef {import('hast').ElementContent} ElementContent */

/** @param {ElementContent | undefined} node */
const isFormula = node => node?.type === 'element' && node.tagName === 'math' && !node.properties.display

/** @param {ElementContent[]} nodes @returns {ElementContent[]} */
export function together(nodes) {
  /** @type {ElementContent[]} */
  const result = []
  for (let i = 0; i < nodes.length; i++) {
    const node = /** @type {ElementContent} */ (nodes[i])
    const [before, after] = [result.at(-1), nodes[i + 1]]
    if (!isFormula(node)) {
      result.push(node)
      continue
    }
    /** @type {ElementContent[]} */
    const kept = [node]
    const head = before?.type === 'text' ? /\S+$/.exec(before.value)?.[0] : undefined
    const tail = after?.type === 'text' ? /^\S+/.exec(after.value)?.[0] : undefined
    if (head && before?.type === 'text') {
      before.value = before.value.slice(0, -head.length)
      kept.unshift({ type: 'text', value: head })
    }
    if (tail && after?.type === 'text') {
      after.value = after.value.slice(tail.length)
      kept.push({ type: 'text', value: tail })
    }
    result.push(kept.length > 1 ? h('span.w', kept) : node)
  }
  return result.filter(node => node.type !== 'text' || node.value !== '')
}
