// Inside a sentence: measured numbers, terms, references, citations, side notes, formulas.
import { h } from 'hastscript'
import { attribute, inline } from './context.mjs'
import { breakable, widthOf } from './math.mjs'
import { curly } from './quotes.mjs'

/** @typedef {import('./context.mjs').Handler} Handler */

/** `:num[key]{digits=2 unit=false percent}` @type {Handler} */
export function num(context, _, node) {
  const key = textOf(node)
  const digits = attribute(node, 'digits')
  const allowed = ['digits', 'unit', 'percent']
  for (const name of Object.keys(node.attributes ?? {})) {
    if (!allowed.includes(name)) context.problems.add(context.file, node, `:num has no option ${name}, only ${allowed.join(', ')}`)
  }
  const text = context.numbers.text(key, {
    digits: digits === undefined ? undefined : Number(digits),
    unit: attribute(node, 'unit') !== 'false',
    percent: attribute(node, 'percent') !== undefined,
    language: context.language,
  })
  if (text === undefined) context.problems.add(context.file, node, `www/data/numbers.json has no number ${key}`)
  context.last = 'x'
  return { type: 'text', value: text ?? '' }
}

/** `:minutes[open]` or `:minutes[whole]`: how long the page takes to read, known when all of it has been rendered. @type {Handler} */
export function minutes(context, _, node) {
  const of = textOf(node)
  if (of !== 'open' && of !== 'whole') context.problems.add(context.file, node, `:minutes is of what is open or of the whole, not of “${of}”`)
  context.last = 'x'
  return h('minutes', { dataOf: of })
}

/** `:term[effective sample size]{#ess}` @type {Handler} */
export function term(context, state, node) {
  const key = attribute(node, 'id') ?? ''
  if (!context.glossary.use(key)) context.problems.add(context.file, node, `${context.glossary.file} has no entry ${key}`)
  return h('a.term', { href: `#gloss-${key}` }, inline(state, node))
}

/** A link to a state of a figure on this page. Whether the page has that figure, the check of the whole site says. */
const FIGURE_STATE = /^#fastslam-[a-z-]+\?/

/** `[](#id)`, `[own text](#id)`, and links to states of figures and to elsewhere. @type {Handler} */
export function link(context, state, node) {
  const target = FIGURE_STATE.test(node.url) ? undefined : /^#(.+)$/.exec(node.url)?.[1]
  const label = target === undefined ? undefined : context.labels.get(target)
  if (target !== undefined && !label) context.problems.add(context.file, node, `there is nothing with the anchor #${target}`)
  const text = inline(state, node)
  if (text.length === 0 && target === undefined) context.problems.add(context.file, node, `the link to ${node.url} has no text`)
  // A name stays in one piece: “Figure” at the end of a line and “17.1” on the next would be read apart.
  const name = label?.number ? label.name.replace(' ', '\u00a0') : (label?.name ?? '')
  return h(label?.kind === 'Equation' ? 'a.eqref' : 'a', { href: node.url, title: node.title ?? undefined }, text.length > 0 ? text : name)
}

/** Citations in running text. @type {Handler} */
export function text(context, _, node) {
  if (node.value.includes(':::')) context.problems.add(context.file, node, 'a stray ::: (a container that holds others has more colons than they)')
  const trimmed = curly(node.value.replace(/[ \t]*(\r?\n)[ \t]*/g, '$1'), context.last)
  context.last = trimmed.at(-1) ?? context.last
  return context.citations.link(trimmed, key => context.problems.add(context.file, node, `www/references.json has no work ${key}`))
}

/** A footnote is a note in the margin; where there is none, it unfolds behind its mark. @type {Handler} */
export function footnoteReference(context, state, node) {
  const definition = state.footnoteById.get(node.identifier.toUpperCase())
  if (!definition) return []
  const number = ++context.notes
  const paragraphs = definition.children.flatMap((/** @type {any} */ child, i) => {
    if (child.type === 'paragraph') return [...(i > 0 ? [h('br')] : []), ...inline(state, child)]
    context.problems.add(context.file, child, 'a side note is of paragraphs only; :::margin may hold more')
    return []
  })
  const mark = h('sup', String(number))
  return [
    h('label.nref', h('input', { type: 'checkbox', ariaLabel: `Side note ${number}` }), mark),
    h('span.sidenote', { role: 'note' }, h('sup', String(number)), ' ', paragraphs),
  ]
}

/** `$…$` @type {Handler} */
export function inlineMath(context, _, node) {
  context.last = 'x'
  return breakable(formula(context, node, false))
}

/** `$$…$$` @type {Handler} */
export function math(context, _, node) {
  return display(formula(context, node, true))
}

/** A formula on a line of its own; one too long for the column may use the margin. @param {import('hast').Element} formula @param {string} [id] @param {string} [name] */
export function display(formula, id, name) {
  const long = widthOf(formula) > (name ? 26 : 30)
  return h(long ? 'div.eq.long' : 'div.eq', { id }, h('div.scroll', formula), name ? h('a.number', { href: `#${id}` }, name) : [])
}

/** @param {import('./context.mjs').Context} context @param {any} node @param {boolean} display */
export function formula(context, node, display) {
  try {
    // Learning systems set TeX themselves (exports.mjs).
    return Object.assign(context.maths.render(node.value, display), { data: { tex: node.value } })
  } catch (error) {
    context.problems.add(context.file, node, `TeX: ${/** @type {Error} */ (error).message.replaceAll('\n', ' ')} in ${node.value.replaceAll('\n', ' ')}`)
    return h('math')
  }
}

/** The plain text of a directive's label. @param {any} node @returns {string} */
export const textOf = node => node.children.map((/** @type {any} */ child) => child.value ?? textOf(child)).join('').trim()
