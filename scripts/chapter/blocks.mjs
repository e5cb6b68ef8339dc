// Boxes of running text: equations with numbers, theorems, derivations that unfold, remarks in the margin, exercises, tables.
import { fromHtml } from 'hast-util-from-html'
import { h } from 'hastscript'
import { visit } from 'unist-util-visit'
import { attribute, content, idOf, inline, latest, nameOf, parts, sentence } from './context.mjs'
import { display, formula } from './inline.mjs'
import { renderLapTable } from './lap-table.mjs'
import { say } from './translation.mjs'

/** @typedef {import('./context.mjs').Handler} Handler */

/** `:::equation{#eq-x}` around one `$$…$$` @type {Handler} */
export function equation(context, _, node) {
  /** @type {any[]} */
  const formulas = []
  visit(node, 'math', found => void formulas.push(found))
  if (formulas.length !== 1) context.problems.add(context.file, node, `:::equation holds one $$ formula, not ${formulas.length}`)
  return display(formulas[0] ? formula(context, formulas[0], true) : h('math'), idOf(node), nameOf(context, node))
}

/** The first line of a box: its name, and its title. @param {import('./context.mjs').Context} context @param {any} state @param {any} node */
function head(context, state, node) {
  const { label } = parts(node)
  return [h('b', nameOf(context, node)), ...(label ? [' ', h('span.title', inline(state, label))] : [])]
}

/** @type {Handler} */
export function theorem(context, state, node) {
  return h('div.theorem', { id: idOf(node) }, h('p.head', head(context, state, node)), content(state, parts(node).body))
}

/** The anchor is inside: a link to it then opens what is folded. @type {Handler} */
export function derivation(context, state, node) {
  return h('details.derivation', h('summary', head(context, state, node)), h('div.fold', { id: idOf(node) }, content(state, parts(node).body)))
}

/** @type {Handler} */
export function margin(_, state, node) {
  return h('div.margin', { role: 'note' }, content(state, node.children))
}

/** How hard, of three. @param {number} level */
export const dots = (level, /** @type {import('./translation.mjs').Language} */ language = 'en') => h('span.level', { role: 'img', ariaLabel: say(language, 'level {n} of 3', level) }, [1, 2, 3].map(dot => (dot <= level ? '●' : '○')).join(''))

/** @type {Handler} */
export function exercise(context, state, node) {
  const { label, body } = parts(node)
  const level = Number(attribute(node, 'level') ?? NaN)
  const kind = attribute(node, 'kind')
  if (!(level >= 1 && level <= 3)) context.problems.add(context.file, node, 'an exercise has a level from 1 to 3')
  if (!kind) context.problems.add(context.file, node, 'an exercise has a kind')
  const title = h(`h${Math.min(6, context.depth + 1)}`, h('b', nameOf(context, node)), ' ', h('span.title', label ? inline(state, label) : []))
  return h('div.exercise', { id: idOf(node) }, h('div.head', title, h('p.kind', kind ?? '', ' ', dots(level))), content(state, body))
}

/** Folded until a guess is written: by style alone, so it needs no script. @type {Handler} */
export function predict(context, state, node) {
  const question = attribute(node, 'question') ?? ''
  if (!question) context.problems.add(context.file, node, ':::predict has no question')
  return h(
    'div.predict',
    { id: attribute(node, 'id') },
    h('label', h('b', 'Predict first'), ' ', sentence(context, state, question), ' ', h('input', { type: 'text', placeholder: 'Your guess unfolds what follows', autocomplete: 'off' })),
    trial(context, node),
    h('div.fold', content(state, node.children)),
  )
}

/** A small live copy of the figure that a question is about: it compares, and without script it is not there. @param {import('./context.mjs').Context} context @param {any} node */
function trial({ problems, file }, node) {
  const { question: _, id, tag, ...passed } = node.attributes
  if (!tag) return []
  if (!/^fastslam-[a-z-]+$/.test(tag)) problems.add(file, node, `:::predict has no tag of ours, but “${tag}”`)
  if (!id) problems.add(file, node, ':::predict with a figure has an id, by which links and guesses know it')
  return [h('div.trial', h(tag, { id: `${id}-figure`, predict: 'on', ...latest, ...passed }))]
}

/** @param {string} name @param {string} title @returns {Handler} */
const folded = (name, title) => (_, state, node) => h(`details.${name}`, h('summary', title), h('div.fold', content(state, node.children)))
export const hint = folded('hint', 'Hint')
export const solution = folded('solution', 'Solution')

/** `:::deeper[Title]`: what stands beside the way through the chapter. Read past it, and nothing that follows is missing. @type {Handler} */
export function deeper(context, state, node) {
  const { label, body } = parts(node)
  if (!label) context.problems.add(context.file, node, ':::deeper has no title: say in a few words what unfolds')
  return h('details.deeper', h('summary', 'Deeper: ', h('span.title', label ? inline(state, label) : [])), h('div.fold', content(state, body)))
}

/** `:::table{#tab-x}`: the table, then its caption. @type {Handler} */
export function table(context, state, node) {
  const tables = node.children.filter((/** @type {any} */ child) => child.type === 'table')
  const caption = node.children.filter((/** @type {any} */ child) => child.type !== 'table')
  if (tables.length !== 1) context.problems.add(context.file, node, `:::table holds one table, not ${tables.length}`)
  return tableFigure(context, state, node, content(state, tables), caption)
}

/** The measured laps, rendered from the numbers by their own module. @type {Handler} */
export function lapTable(context, state, node) {
  const caption = node.type === 'containerDirective' ? node.children : []
  return tableFigure(context, state, node, fromHtml(renderLapTable(context.numbers.all), { fragment: true }).children, caption)
}

/** @param {import('./context.mjs').Context} context @param {any} state @param {any} node @param {any[]} tables @param {any[]} caption */
function tableFigure(context, state, node, tables, caption) {
  return h('figure.table', { id: idOf(node) }, h('figcaption', captioned(context, node, content(state, caption), sentence(context, state, attribute(node, 'caption') ?? ''))), h('div.scroll', tables))
}

/**
 * A caption that begins with the name of what it belongs to.
 * @param {import('./context.mjs').Context} context @param {any} node @param {import('hast').ElementContent[]} caption
 * @param {import('hast').ElementContent[]} [short] the caption where it is an attribute
 */
export function captioned(context, node, caption, short = []) {
  const name = h('b', nameOf(context, node))
  const first = caption.find(child => child.type === 'element')
  if (first?.type === 'element' && first.tagName === 'p') {
    first.children.unshift(name, { type: 'text', value: ' ' })
    return caption
  }
  return [h('p', name, ' ', short), ...caption]
}
