// What can be referred to: every id of a page, its number, and how a reference to it is written.
import { toString } from 'mdast-util-to-string'
import { visit } from 'unist-util-visit'

/**
 * @typedef {import('mdast').Heading} Heading
 * @typedef {import('mdast-util-directive').Directives} Directive
 * @typedef {{ id: string, name: string, number: string, kind: string }} Label `name` stands for an empty reference; `number` is ""
 *   for what has none
 */

/** The kinds that are counted, by directive. Listings, tables and so on each have a count of their own. @type {Record<string, string>} */
export const counted = {
  algorithm: 'Algorithm',
  derivation: 'Derivation',
  equation: 'Equation',
  exercise: 'Exercise',
  figure: 'Figure',
  'lap-table': 'Table',
  listing: 'Listing',
  picture: 'Figure',
  table: 'Table',
  theorem: 'Theorem',
}

/** Takes `{#id}` from the end of a heading. @param {Heading} heading @returns {string | undefined} */
export function takeHeadingId(heading) {
  const last = heading.children.at(-1)
  const found = last?.type === 'text' ? /\s*\{#([\w-]+)\}\s*$/.exec(last.value) : null
  if (last?.type !== 'text' || !found) return undefined
  last.value = last.value.slice(0, found.index)
  return found[1]
}

/** @param {string} text */
const slug = text => text.toLowerCase().replace(/[^a-z0-9]+/g, '-').replace(/^-|-$/g, '')

/** @param {import('unist').Node} node @returns {node is Directive} */
export const isDirective = node => /Directive$/.test(node.type)

export class Labels {
  /** @type {Map<string, Label>} */
  #all = new Map()
  /** @type {Record<string, number>} */
  #counts = {}

  /** @param {string} chapter its number, which begins those of equations and figures */
  constructor(chapter) {
    this.chapter = chapter
  }

  /** Finds what a file labels, and leaves each id on its node as `data.id`. @param {import('./parse.mjs').Source} source @param {import('./problems.mjs').Problems} problems */
  collect({ file, tree }, problems) {
    visit(tree, node => {
      if (node.type === 'heading') {
        const id = takeHeadingId(node)
        const name = toString(node)
        if (!id && node.depth === 2) problems.add(file, node, `the section “${name}” has no anchor: write ## ${name} {#id}`)
        this.#add({ id: id ?? slug(name), name, number: '', kind: 'heading' }, file, node, problems)
      } else if (isDirective(node)) {
        const kind = counted[node.name]
        const id = node.attributes?.id
        if (kind === undefined) return
        const count = (this.#counts[kind] = (this.#counts[kind] ?? 0) + 1)
        const number = kind === 'Exercise' ? `${count}` : `${this.chapter}.${count}`
        if (!id) problems.add(file, node, `:::${node.name} has no anchor: give it {#id}`)
        else this.#add({ id, name: kind === 'Equation' ? `(${number})` : `${kind} ${number}`, number, kind }, file, node, problems)
      }
    })
  }

  /** @param {Label} label @param {string} file @param {import('unist').Node} node @param {import('./problems.mjs').Problems} problems */
  #add(label, file, node, problems) {
    node.data = { ...node.data, .../** @type {{}} */ ({ id: label.id }) }
    if (this.#all.has(label.id)) problems.add(file, node, `the anchor #${label.id} is there twice`)
    this.#all.set(label.id, label)
  }

  /** @param {string} id @returns {Label | undefined} */
  get(id) {
    return this.#all.get(id)
  }
}
