// Worksheets: questions of the bank and open ones, with room to write, and figures in the state that they are about. One text makes two pages:
// for students, and with the solutions.
import { h } from 'hastscript'
import { after } from './checks.mjs'
import { dots } from './blocks.mjs'
import { attribute, content, inline, latest, parts } from './context.mjs'
import { pictures, sized } from './figure.mjs'
import { say } from './translation.mjs'

/** @typedef {import('./context.mjs').Context} Context */
/** @typedef {import('./context.mjs').Handler} Handler */
/** @typedef {import('hast').ElementContent} ElementContent */

/** Room to write a word or a number. @param {string} [size] */
const blank = size => h('span', { className: size ? ['blank', size] : ['blank'] })

/** @param {Context} context @param {any} node */
function sheetOf(context, node) {
  if (!context.sheet) context.problems.add(context.file, node, `::${node.name} has its place in a worksheet`)
  return context.sheet ?? { solved: false, tasks: 0 }
}

/** `::name{minutes="20"}`: whose sheet it is, and for how long. @type {Handler} */
export function name(context, _, node) {
  const { language } = context
  const minutes = `${attribute(node, 'minutes') ?? ''} ${say(language, 'minutes')}`
  if (sheetOf(context, node).solved) return h('p.name', `${say(language, 'With solutions')}, ${minutes}`)
  return h('p.name', `${say(language, 'Name')} `, blank('long'), ` ${say(language, 'Date')} `, blank(), ` ${minutes}`)
}

/**
 * A task with its number, room for the answer, and the answer where it is wanted.
 * @param {{ tasks: number, solved: boolean }} sheet @param {ElementContent[]} text @param {ElementContent[]} room @param {ElementContent[]} answer
 */
const task = (sheet, text, room, answer) => h('div.task', h('p', h('b', `${++sheet.tasks}.`), ' ', text), room, sheet.solved && answer.length > 0 ? h('div.solved', answer) : [])

/** A copy of a question of the bank, for a page of its own. @param {Context} context @param {any} node @param {string} of */
export function askedOf(context, node, of) {
  const asked = structuredClone(context.asked.get(of))
  if (!asked) context.problems.add(context.file, node, `the bank has no question ${of}`)
  return asked
}

/** `::ask{of="bank-lap-copy"}`: a question of the bank. @type {Handler} */
export function ask(context, _, node) {
  const sheet = sheetOf(context, node)
  const asked = askedOf(context, node, attribute(node, 'of') ?? '')
  if (!asked) return []
  const text = [...asked.text, /** @type {const} */ ({ type: 'text', value: ' ' }), h('span.kind', dots(asked.level, context.language))]
  if ('choices' in asked) {
    const items = asked.choices.map(({ right, text, reason }) => (sheet.solved ? h('li', { className: right ? ['right'] : undefined }, text, h('div.reason', after(h('b', say(context.language, right ? 'Right.' : 'No.')), reason))) : h('li', text)))
    return task(sheet, text, [h('ol.boxes', items)], [])
  }
  if ('value' in asked) return task(sheet, text, [h('p', `${say(context.language, 'Answer')} `, blank(), asked.unit ? ` ${asked.unit}` : '')], after(h('b', asked.shown), asked.reason))
  return task(sheet, text, [h('p', `${say(context.language, 'What you set, or the link of the state')} `, blank('long'))], asked.reason)
}

/** `:::write[Question]{lines="3"}`: an open question; below it what an answer should say. @type {Handler} */
export function write(context, state, node) {
  const sheet = sheetOf(context, node)
  const { label, body } = parts(node)
  const lines = Number(attribute(node, 'lines') ?? 3)
  if (!label) context.problems.add(context.file, node, ':::write has no question')
  if (body.length === 0) context.problems.add(context.file, node, ':::write has no answer')
  if (!(lines >= 1 && lines <= 12)) context.problems.add(context.file, node, ':::write has 1 to 12 lines')
  const room = sheet.solved ? [] : [h('div.room', { ariaHidden: 'true' }, Array.from({ length: lines || 0 }, () => h('div')))]
  return task(sheet, label ? inline(state, label) : [], room, content(state, body))
}

/** A figure of ours in a state. @param {Context} context @param {any} node @param {string} tag @param {Record<string, string>} state its attributes */
export function figureIn({ root, problems, file }, node, tag, state) {
  if (!/^fastslam-[a-z-]+$/.test(tag)) problems.add(file, node, `:::${node.name} has no tag of ours, but “${tag}”`)
  // The picture for readers without script is of the figure as it opens: of another state it would be a wrong one.
  const [light = '', dark = ''] = pictures(tag)
  return h(tag || 'div', { ...latest, ...state }, Object.keys(state).length === 0 ? sized(root, light, dark, '') : [])
}

/** `:::state{tag="fastslam-lap" step="83"}`: a figure in a state, and below it what it is of. @type {Handler} */
export function shown(context, state, node) {
  const { tag = '', ...passed } = node.attributes
  return h('figure.wide.state', figureIn(context, node, tag, passed), h('figcaption', content(state, node.children)))
}
