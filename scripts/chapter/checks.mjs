// Questions that a reader answers alone: `:::choice`, `:::count` (a number within a tolerance) and `:::reach` (a state of a figure). Without
// script the answer unfolds; www/src/checks.ts grades. `::unfold` is a fold of the chapter that takes what it unfolds from another page.
import { h } from 'hastscript'
import { banked } from './bank.mjs'
import { goalsOf } from './challenges.mjs'
import { attribute, content, inline, parts } from './context.mjs'
import { typeset } from './numbers.mjs'
import { say } from './translation.mjs'

/** @typedef {import('./context.mjs').Context} Context */
/** @typedef {import('./context.mjs').Handler} Handler */

const letters = ['A', 'B', 'C', 'D']

/**
 * @param {Context} context @param {any} state @param {any} node @param {Record<string, unknown>} properties @param {any[]} asked @param {any[]} answer
 * @param {import('./bank.mjs').Kind} kind what the bank has to know of it
 */
function question(context, state, node, properties, asked, answer, kind) {
  const { label } = parts(node)
  const id = attribute(node, 'id')
  if (!label) context.problems.add(context.file, node, `:::${node.name} has no question`)
  if (!id) context.problems.add(context.file, node, `:::${node.name} has no anchor: give it {#id}`)
  const words = label ? inline(state, label) : []
  const bank = context.bank && banked(context, node, structuredClone(words), kind)
  const legend = h('legend', bank ? [h('b', `${bank.number}.`), ' '] : [], words)
  const fieldset = h('fieldset.check', { id, ...properties }, legend, bank?.line ?? [], asked, h('details.answer', h('summary', say(context.language, 'Answer')), h('div.fold', answer)))
  if (bank) fieldset.data = /** @type {any} */ ({ asked: bank.asked })
  return fieldset
}

/** A list of tasks, of which the right one is ticked; what follows in an item is the reason. @type {Handler} */
export function choice(context, state, node) {
  const items = parts(node).body.flatMap(child => (child.type === 'list' ? child.children : []))
  const id = attribute(node, 'id')
  if (items.length < 2 || items.length > letters.length) context.problems.add(context.file, node, `:::choice has ${items.length} answers, not two to ${letters.length}`)
  if (items.filter(item => item.checked).length !== 1) context.problems.add(context.file, node, ':::choice has one right answer, ticked [x]')
  if (items.some(item => item.children.length < 2)) context.problems.add(context.file, node, ':::choice has a reason for each of its answers')
  const choices = items.map(({ checked, children: [first, ...reason] }) => ({ right: checked === true, text: first ? inline(state, first) : [], reason: content(state, reason) }))
  const kept = structuredClone(choices)
  const asked = choices.map(({ text }, i) => h('label', h('input', { type: 'radio', name: id }), ' ', h('span', h('b', letters[i]), ' ', text)))
  const answer = choices.map(({ right, reason }, i) => h('li', { className: right ? ['right'] : undefined }, after(h('b', `${letters[i]}: ${say(context.language, right ? 'yes' : 'no')}.`), reason)))
  return question(context, state, node, {}, asked, [h('ul', answer)], { choices: kept })
}

/** `is="(2 * 24 + 3) ** 2"` or `is="100 * (1 - a.key / another.key)"`, `within` a share of it. @type {Handler} */
export function count(context, state, node) {
  const formula = attribute(node, 'is') ?? ''
  const within = Number(attribute(node, 'within') ?? NaN)
  const value = valueOf(context, node, formula)
  if (!(within >= 0 && within < 0.2)) context.problems.add(context.file, node, ':::count has a tolerance, within="0.02" of its value')
  const unit = attribute(node, 'unit')
  const field = h('label', `${say(context.language, 'Your answer')} `, h('input', { type: 'text', inputMode: 'decimal', autocomplete: 'off' }), unit ? ` ${unit}` : [])
  const digits = Number(attribute(node, 'digits') ?? (Number.isInteger(value) ? 0 : 2))
  const shown = `${typeset(value, digits, context.language)}${unit ? `\u00a0${unit}` : ''}.`
  const reason = content(state, parts(node).body)
  const kept = structuredClone(reason)
  return question(context, state, node, { dataIs: value, dataWithin: within }, [field], after(h('b', shown), reason), { value, within, unit, shown, reason: kept })
}

/** What is to be done in a figure of the chapter, whose goal says whether it is. @type {Handler} */
export function reach(context, state, node) {
  const [figure = '', tag = '', challenge = ''] = ['figure', 'tag', 'challenge'].map(name => attribute(node, name))
  const goals = goalsOf(context.root, tag)
  if (!goals.includes(challenge)) context.problems.add(context.file, node, `${tag} has no goal ${challenge}, only ${goals.join(', ')}`)
  const way = h('p', h('a', { href: `./index.html#${figure}` }, say(context.language, 'Set the figure up for it')))
  const reason = content(state, parts(node).body)
  return question(context, state, node, { dataTag: tag, dataChallenge: challenge }, [way], reason, { way: structuredClone(way), reason: structuredClone(reason) })
}

/** Begins a text with a word of its own. @param {import('hast').Element} word @param {import('hast').ElementContent[]} nodes */
export function after(word, nodes) {
  const first = nodes.find(node => node.type === 'element')
  if (first?.type === 'element' && first.tagName === 'p') first.children.unshift(word, { type: 'text', value: ' ' })
  return nodes
}

/** The value of what a question's text lets a reader compute: a calculation with numbers, and with measured ones by their keys. @param {Context} context @param {any} node @param {string} formula */
function valueOf(context, node, formula) {
  /** @type {string[]} */
  const unknown = []
  const calculation = formula.replace(/[a-z][\w-]*(?:\.[\w-]+)+/g, key => {
    const number = context.numbers.all[key]
    if (!number) unknown.push(key)
    return `(${number?.value ?? NaN})`
  })
  for (const key of unknown) context.problems.add(context.file, node, `www/data/numbers.json has no number ${key}`)
  const plain = calculation.replace(/\b(?:sqrt|exp|log|floor)(?=\()/g, '')
  const value = /^[\d\s.()e+*/-]+$/.test(plain) ? calculated(calculation) : NaN
  if (!Number.isFinite(value) && unknown.length === 0) context.problems.add(context.file, node, `is="${formula}" is no calculation`)
  return value
}

/** @param {string} calculation of numbers and four functions */
function calculated(calculation) {
  try {
    return Number(Function(`const { sqrt, exp, log, floor } = Math; return ${calculation}`)())
  } catch {
    return NaN
  }
}

/** `::unfold[What is in it]{from="practice.html#id"}` @type {Handler} */
export function unfold(context, state, node) {
  const from = attribute(node, 'from') ?? ''
  if (!/^[\w-]+\.html#[\w-]+$/.test(from)) context.problems.add(context.file, node, '::unfold says where its text is: from="page.html#id"')
  const words = inline(state, node)
  if (words.length === 0) context.problems.add(context.file, node, '::unfold has no title')
  return h('details.deeper.elsewhere', h('summary', words), h('div.fold', h('p', h('a', { href: from }, structuredClone(words), ', on a page of its own'))))
}

/** What is to be remembered of a section: two lines. @type {Handler} */
export function takeaway(context, state, node) {
  const list = node.children.filter((/** @type {any} */ child) => child.type === 'list')
  if (list.length !== 1 || node.children.length !== 1 || list[0].children.length !== 2) context.problems.add(context.file, node, ':::takeaway is a list of two lines')
  return h('div.takeaway', h('p', h('b', 'To take away')), content(state, list))
}
