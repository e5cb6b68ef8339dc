// `:chip[words]{#name}`: a challenge of the figure in whose caption it stands, in words. Script makes a button of it (www/src/challenges.ts).
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import { h } from 'hastscript'
import { readIfThere, StepError } from '../lib.mjs'
import { attribute, inline } from './context.mjs'

/** A figure's challenges in their order, as it told them last (scripts/elements.mjs). @param {string} root @param {string} tag @returns {import('../elements.mjs').Chip[]} */
function chipsOf(root, tag) {
  const told = readIfThere(join(root, '.cache', 'figures.json'))
  if (told === undefined) throw new StepError('The figures have not told yet which challenges they have.', 'npm run build asks them.')
  return JSON.parse(told).find((/** @type {{ tag: string }} */ figure) => figure.tag === tag)?.chips ?? []
}

/** Names of a figure's challenges, in their order. @param {string} root @param {string} tag */
export const challengesOf = (root, tag) => chipsOf(root, tag).map(({ name }) => name)

/** Names of those that there is something to reach in. @param {string} root @param {string} tag */
export const goalsOf = (root, tag) => chipsOf(root, tag).filter(({ goal }) => goal !== '').map(({ name }) => name)

/** @type {import('./context.mjs').Handler} */
export function chip(context, state, node) {
  const name = attribute(node, 'id') ?? ''
  const { figure } = context
  if (!figure) context.problems.add(context.file, node, ':chip has its place in the caption of a figure')
  else if (!figure.challenges.includes(name)) context.problems.add(context.file, node, `${figure.tag} has no challenge ${name}, only ${figure.challenges.join(', ')}`)
  figure?.told.push(name)
  return h('span.chip', { dataChallenge: name }, inline(state, node))
}

/** A caption has all of the figure's challenges in their order, as its list has their numbers; or none. @param {import('./context.mjs').Context} context @param {any} node */
export function judgeChips({ figure, file, problems }, node) {
  if (!figure || figure.told.length === 0 || figure.told.join() === figure.challenges.join()) return
  problems.add(file, node, `the caption has the challenges ${figure.told.join(', ')}, and ${figure.tag} has ${figure.challenges.join(', ')}`)
}

/** `:task[bend]{of="proposal"}`: a challenge of a figure as the figure calls it, in the language of the page. @type {import('./context.mjs').Handler} */
export function task({ root, file, language, problems }, _, node) {
  const [name, of = ''] = [node.children[0]?.value ?? '', attribute(node, 'of')]
  const called = JSON.parse(readFileSync(join(root, 'widgets', 'words', `${language}.json`), 'utf8'))[of.replaceAll('-', '_')]?.[`chip_${name.replaceAll('-', '_')}`]
  if (!called) problems.add(file, node, `${of} has no challenge ${name} with a name`)
  return h('em', called ?? '')
}
