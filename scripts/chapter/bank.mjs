// The bank of questions for lecturers (www/bank.md): the questions of checks.mjs below a `::goal`, each with a number, a level and the section of
// the chapter that answers it. What is needed to ask them elsewhere is kept apart from how the page shows them.
import { h } from 'hastscript'
import { visit } from 'unist-util-visit'
import { dots } from './blocks.mjs'
import { attribute, inline, sentence } from './context.mjs'
import { say } from './translation.mjs'

/**
 * @typedef {import('hast').ElementContent} ElementContent
 * @typedef {{ right: boolean, text: ElementContent[], reason: ElementContent[] }} Choice
 * @typedef {{ choices: Choice[] }
 *   | { value: number, within: number, unit: string | undefined, shown: string, reason: ElementContent[] }
 *   | { way: ElementContent, reason: ElementContent[] }} Kind choices, a number (`shown`: as the page writes it), or a state of a figure that is to be reached
 * @typedef {{ id: string, number: number, level: number, goal: string, figure: string, section: string, text: ElementContent[] } & Kind} Asked `goal`: the
 *   figure by its name in addresses, `figure`: by its title, `section`: an anchor of the chapter
 */

/** The goals of the page for teachers: its table is their only list. @param {string} model its text @returns {import('./context.mjs').Aims} */
export const aimsIn = model => new Map([...model.matchAll(/^\| \[(.+?)\]\(#model-([\w-]+)\) \| (.+?) \| .+ \|$/gm)].map(([, figure = '', of = '', can = '']) => [of, { figure, can }]))

/** `::goal{of="lap"}`: what the questions that follow test; in a translation with that, `::goal[say it in another language]{figure="Runde"}`. @type {import('./context.mjs').Handler} */
export function goal(context, state, node) {
  const of = attribute(node, 'of') ?? ''
  const aim = context.aims.get(of)
  if (!aim) context.problems.add(context.file, node, `www/model.md has no goal of ${of}, only of ${[...context.aims.keys()].join(', ')}`)
  const { language } = context
  context.bank = { of, figure: attribute(node, 'figure') ?? aim?.figure ?? '', asked: context.bank?.asked ?? 0 }
  const can = node.children.length > 0 ? inline(state, node) : sentence(context, state, aim?.can ?? '')
  return h('p', h('b', say(language, 'Goal.')), ` ${say(language, 'A student can')} `, can, ' (', h('a', { href: `./model.html#model-${of}` }, say(language, 'what the figure computes')), ').')
}

/** What a question of the bank has besides. @param {import('./context.mjs').Context} context @param {any} node @param {ElementContent[]} text @param {Kind} kind */
export function banked(context, node, text, kind) {
  const { bank, titles, problems, file, language } = context
  if (!bank) throw new Error('There is no bank here.')
  const [id = '', section = ''] = ['id', 'section'].map(name => attribute(node, name))
  const level = Number(attribute(node, 'level') ?? NaN)
  if (!(level >= 1 && level <= 3)) problems.add(file, node, 'a question of the bank has a level from 1 to 3')
  if (!titles.has(section)) problems.add(file, node, `the chapter has no section ${section}`)
  const number = ++bank.asked
  /** @type {Asked} */
  const asked = { id, number, level, goal: bank.of, figure: bank.figure, section, text, ...kind }
  return { number, asked, line: h('p.kind', dots(level, language), ' ', h('a', { href: `./index.html#${section}`, lang: language === 'en' ? undefined : 'en' }, titles.get(section) ?? '')) }
}

/** The questions of a page. @param {ElementContent[]} nodes @returns {Asked[]} */
export function askedIn(nodes) {
  /** @type {Asked[]} */
  const found = []
  visit({ type: 'root', children: nodes }, 'element', ({ data }) => {
    const { asked } = /** @type {{ asked?: Asked }} */ (data ?? {})
    if (asked) found.push(asked)
  })
  return found
}
