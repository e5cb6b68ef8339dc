// The deck: a figure a slide, in a state, with a question of the bank and what to look for.
import { h } from 'hastscript'
import { visit } from 'unist-util-visit'
import { after } from './checks.mjs'
import { content, inline, parts } from './context.mjs'
import { say } from './translation.mjs'
import { askedOf, figureIn } from './worksheet.mjs'

/** @typedef {import('hast').ElementContent} ElementContent */

/** `:::slide[Title]{#slide-lap tag="fastslam-lap" ask="bank-lap-copy" step="83"}`: below it what to look for. @type {import('./context.mjs').Handler} */
export function slide(context, state, node) {
  const { id, tag = '', ask = '', ...passed } = node.attributes
  const { label, body } = parts(node)
  const asked = askedOf(context, node, ask)
  if (!label) context.problems.add(context.file, node, ':::slide has no title')
  if (!id) context.problems.add(context.file, node, ':::slide has no anchor: give it {#id}')
  if (body.length === 0) context.problems.add(context.file, node, ':::slide does not say what to look for')
  const says = h('div.says', asked ? questionOf(asked, context.language) : [], h('div.look', content(state, body)))
  // The figure takes what room there is, with the letters of a projector.
  return h('section.slide', { id }, h('h2', label ? inline(state, label) : []), says, h('figure', figureIn(context, node, tag, { fit: 'on', size: 'presentation', chips: 'off', ...passed })))
}

/** @param {import('./bank.mjs').Asked} asked @param {import('./translation.mjs').Language} language @returns {ElementContent[]} */
function questionOf(asked, language) {
  const question = h('p.question', asked.text)
  // What it leads to is on the slide.
  visit(question, 'element', element => {
    if (element.tagName === 'a') Object.assign(element, { tagName: 'span', properties: {} })
  })
  const answer = (/** @type {ElementContent[]} */ reason, /** @type {string} */ word) => h('details', h('summary', say(language, 'Answer')), h('div.fold', after(h('b', word), reason)))
  if (!('choices' in asked)) return [question, answer(asked.reason, 'shown' in asked ? asked.shown : say(language, 'Done.'))]
  const right = asked.choices.findIndex(choice => choice.right)
  return [question, h('ol', asked.choices.map(({ text }) => h('li', text))), answer(asked.choices[right]?.reason ?? [], `${'ABCD'[right]}.`)]
}
