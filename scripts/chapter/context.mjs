// What the handlers share: where they are, and what has been gathered.
import { parse } from './parse.mjs'

/**
 * @typedef {import('hast').ElementContent} ElementContent
 * @typedef {import('mdast-util-to-hast').State} State
 * @typedef {import('mdast-util-directive').Directives} Directive
 * @typedef {import('mdast-util-directive').ContainerDirective} Container
 * @typedef {(context: Context, state: State, node: any) => ElementContent | ElementContent[]} Handler
 * @typedef {{ depth: number, id: string, content: ElementContent[] }} Head a heading, for the table of contents
 * @typedef {Map<string, { figure: string, can: string }>} Aims
 */

/**
 * @typedef {object} Context
 * @property {string} file the file in hand, from the repository's root
 * @property {string} root
 * @property {import('./problems.mjs').Problems} problems
 * @property {import('./labels.mjs').Labels} labels
 * @property {import('./math.mjs').Maths} maths
 * @property {import('./numbers.mjs').Numbers} numbers
 * @property {import('./citations.mjs').Citations} citations
 * @property {import('./glossary.mjs').Glossary} glossary
 * @property {import('./source.mjs').Sources} sources
 * @property {Map<string, { id: string, piece: import('./source.mjs').Piece }>} listings those of the page, by id
 * @property {Set<string>} lines ids of the lines in listings that something links to
 * @property {string} repository its address, for source that no listing shows
 * @property {{ tag: string, challenges: string[], told: string[] } | undefined} figure whose caption is in hand, with the challenges it has, and those told
 * @property {Aims} aims what a student can do after work with each figure, by its name
 * @property {Map<string, string>} titles those of the chapter's sections, by anchor
 * @property {{ of: string, figure: string, asked: number } | undefined} bank where questions of the bank are: the figure whose goal is in hand, by its name in
 *   addresses and by its title, and how many have been asked
 * @property {import('./translation.mjs').Language} language
 * @property {Map<string, import('./bank.mjs').Asked>} asked questions of the bank, by id, for the pages that come after it
 * @property {{ solved: boolean, tasks: number } | undefined} sheet of a worksheet: whether it has its solutions, and how many tasks so far
 * @property {Head[]} heads
 * @property {number} depth of the last heading
 * @property {number} notes side notes so far
 * @property {string} last the last character that was set, for quotes
 */

/** The text of an attribute. @param {Directive} node @param {string} name */
export const attribute = (node, name) => node.attributes?.[name] ?? undefined

/** The id that the labels left on a node. @param {import('unist').Node} node @returns {string | undefined} */
export const idOf = node => /** @type {{ id?: string } | undefined} */ (node.data)?.id

/** A container's `[label]`, and what follows it. @param {Container} node */
export function parts(node) {
  const [first, ...rest] = node.children
  const labelled = first?.type === 'paragraph' && /** @type {any} */ (first.data)?.directiveLabel
  return { label: labelled ? first : undefined, body: labelled ? rest : node.children }
}

/** @param {State} state @param {import('mdast').Nodes[]} nodes @returns {ElementContent[]} */
export const content = (state, nodes) => state.wrap(nodes.flatMap(node => state.one(node, undefined) ?? []), true).filter(isContent)

/** @param {import('hast').Nodes} node @returns {node is ElementContent} */
export const isContent = node => node.type === 'element' || node.type === 'text'

/** @param {State} state @param {import('mdast').Nodes} node */
export const inline = (state, node) => /** @type {ElementContent[]} */ (state.all(/** @type {any} */ (node)))

/** The text of an attribute, which may hold formulas and code as any sentence. @param {Context} context @param {State} state @param {string} text */
export function sentence(context, state, text) {
  const [paragraph] = parse(context.file, text, context.problems).tree.children
  context.last = ''
  return paragraph ? inline(state, paragraph) : []
}

/** “Figure 17.1” and the like, as captions and boxes begin. @param {Context} context @param {import('unist').Node} node */
export const nameOf = (context, node) => context.labels.get(idOf(node) ?? '')?.name ?? ''
/** The chapter goes with its figures: no default of theirs is kept for it. */
export const latest = { v: 'latest' }
