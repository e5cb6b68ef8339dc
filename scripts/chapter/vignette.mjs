// `:::vignette`: a small figure between two paragraphs, with its picture for readers without script, and one line below it. It has no number.
import { existsSync } from 'node:fs'
import { join } from 'node:path'
import { h } from 'hastscript'
import { toString } from 'mdast-util-to-string'
import { attribute, content } from './context.mjs'
import { pictures, sized } from './figure.mjs'

const MOST_WORDS = 25

/** One that stands in the text again has an id of its own. @type {import('./context.mjs').Handler} */
export function vignette({ file, problems, root }, state, node) {
  const [which = '', at = '0', alt] = ['which', 'at', 'alt'].map(name => attribute(node, name))
  const complain = (/** @type {string} */ message) => problems.add(file, node, message)
  if (!alt) complain(':::vignette has no alt: say in words what its picture shows')
  const [light = '', dark = ''] = pictures(`vignette-${which}`)
  for (const picture of [light, dark]) if (!existsSync(join(root, picture))) complain(`there is no picture ${picture} for this vignette`)
  const words = toString(node).split(/\s+/).filter(word => /[\p{L}\p{N}]/u.test(word)).length
  if (words > MOST_WORDS) complain(`the caption of a vignette has ${MOST_WORDS} words at most, and not ${words}`)
  const id = `vignette-${node.attributes?.id ?? which}`
  return h('figure.vignette', { id }, [h('fastslam-vignette', { which, at }, sized(root, light, dark, alt)), h('figcaption', content(state, node.children))])
}
