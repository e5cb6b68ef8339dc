// Which file of a crate, and which of the elements, uses which: files that use each other in a circle can only be read, moved and tested together. A module
// and the files in its folder are one thing in parts, so that it counts what these use of it, and not what it uses of them.
import assert from 'node:assert/strict'
import { readdirSync, readFileSync } from 'node:fs'
import { join, posix } from 'node:path'
import { test } from 'node:test'
import { root } from '../../scripts/lib.mjs'

/** Files of other crates, which lie in the folder of `fastslam`. */
const others = /^(log|bin|examples)\//

/** Files of tests, which may use whatever they test. */
const tests = /(^|\/)tests(\/|\.)/

/** @typedef {Map<string, Set<string>>} Uses of each file, by its path in the folder, those that it uses */

/** Paths of files in a folder, as they are written in code. @param {string} folder @param {string} ending */
const filesIn = (folder, ending) =>
  readdirSync(join(root, folder), { recursive: true, encoding: 'utf8' })
    .map(file => file.replaceAll('\\', '/'))
    .filter(file => file.endsWith(ending) && !tests.test(file) && !(folder === 'src' && others.test(file)))
    .sort()

/** The paths that a `use` names, each with all its parts: what stands in braces once for each. @param {string} tree @param {string[]} [before] @returns {string[][]} */
function named(tree, before = []) {
  const parts = (/** @type {string} */ path) => path.replace(/\sas\s.*$/s, '').split('::').map(part => part.trim()).filter(Boolean)
  const brace = tree.indexOf('{')
  if (brace < 0) return [[...before, ...parts(tree)]]
  const head = [...before, ...parts(tree.slice(0, brace))]
  const branches = ['']
  let depth = 0
  for (const character of tree.slice(brace + 1, tree.lastIndexOf('}'))) {
    depth += Number(character === '{') - Number(character === '}')
    if (character === ',' && depth === 0) branches.push('')
    else branches.push(branches.pop() + character)
  }
  return branches.filter(branch => branch.trim() !== '').flatMap(branch => named(branch, head))
}

/** What the files of a crate use of it, by their `use` lines and by paths that begin with `crate` or `super`; tests within a file apart. @param {string} folder @returns {Uses} */
function usesInRust(folder) {
  const modules = new Map(filesIn(folder, '.rs').map(file => [file.replace(/\.rs$/, '').replace(/(^|\/)(mod|lib|main)$/, ''), file]))
  const found = (/** @type {string[]} */ path) => {
    for (let parts = path.length; parts > 0; parts--) {
      const file = modules.get(path.slice(0, parts).join('/'))
      if (file) return file
    }
    return undefined
  }
  const uses = [...modules].map(([module, file]) => {
    const code = readFileSync(join(root, folder, file), 'utf8').replace(/\/\/[^\n]*/g, '').replace(/#\[cfg\(test\)\]\s*mod \w+ \{.*/s, '')
    const lines = [...code.matchAll(/\buse\s+((?:crate|super|self)\b[^;]*);/g)].flatMap(([, tree = '']) => named(tree))
    const paths = [...code.matchAll(/\b(?:crate|super)(?:::\w+)+/g)].map(([path]) => path.split('::'))
    const here = module.split('/').filter(Boolean)
    const whole = [...lines, ...paths].map(([first, ...rest]) => {
      const above = first === 'crate' ? [] : here.slice(0, here.length - Number(first === 'super'))
      while (rest[0] === 'super') above.length -= Number(rest.shift() !== undefined)
      return found([...above, ...rest])
    })
    const own = new Set([...modules].filter(([other]) => other.startsWith(`${module}/`)).map(([, other]) => other))
    return /** @type {const} */ ([file, new Set(whole.filter(other => other !== undefined && other !== file && !own.has(other)))])
  })
  return /** @type {Uses} */ (new Map(uses))
}

/** What scripts import of each other, types apart. @param {string} folder @returns {Uses} */
function usesInScripts(folder) {
  const files = filesIn(folder, '.ts')
  const uses = files.map(file => {
    const code = readFileSync(join(root, folder, file), 'utf8')
    const sources = [...code.matchAll(/^(?:import|export)\s+(?!type\s)[^;'"]*?from\s+'(\.[^']+)'/gm)].map(([, source = '']) => `${posix.join(posix.dirname(file), source)}.ts`)
    return /** @type {const} */ ([file, new Set(sources.filter(source => files.includes(source)))])
  })
  return new Map(uses)
}

/** Files each of which leads to each of the others (Tarjan 1972). @param {Uses} uses @returns {string[]} a line for each circle */
function circles(uses) {
  /** @type {Map<string, { number: number, low: number, open: boolean }>} */
  const seen = new Map()
  /** @type {string[]} */
  const stack = []
  /** @type {string[]} */
  const found = []
  const visit = (/** @type {string} */ file) => {
    const state = { number: seen.size, low: seen.size, open: true }
    seen.set(file, state)
    stack.push(file)
    for (const other of uses.get(file) ?? []) {
      const there = seen.get(other) ?? visit(other)
      if (there.open) state.low = Math.min(state.low, there.low)
    }
    if (state.low === state.number) {
      const circle = stack.splice(stack.indexOf(file))
      for (const member of circle) /** @type {{ open: boolean }} */ (seen.get(member)).open = false
      if (circle.length > 1) found.push(circle.sort().join(' '))
    }
    return state
  }
  for (const file of uses.keys()) if (!seen.has(file)) visit(file)
  return found.sort()
}

for (const folder of ['src', 'src/log', 'src/bin/fastslam', 'lab/src', 'widgets/kit/src', 'widgets/src', 'widgets/elements']) {
  test(`no files of ${folder} use each other in a circle`, () => {
    const uses = folder === 'widgets/elements' ? usesInScripts(folder) : usesInRust(folder)
    assert.ok([...uses.values()].some(others => others.size > 0))
    assert.deepEqual(circles(uses), [])
  })
}

test('a circle is found, and a chain is none', () => {
  const uses = (/** @type {Record<string, string[]>} */ all) => new Map(Object.entries(all).map(([file, others]) => [file, new Set(others)]))
  assert.deepEqual(circles(uses({ a: ['b', 'd'], b: ['c'], c: ['a'], d: [] })), ['a b c'])
  assert.deepEqual(circles(uses({ a: ['b', 'c'], b: ['c'], c: [] })), [])
  assert.deepEqual(named('super::{one::{self, Two}, three as four}'), [['super', 'one', 'self'], ['super', 'one', 'Two'], ['super', 'three']])
})
