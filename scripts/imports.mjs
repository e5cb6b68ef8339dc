// npm run imports: which file of a crate, and which of the elements, uses which, as a picture of each folder: arrows lead to what is used, and red are files
// that use each other in a circle, which can only be read, moved and tested together. A module and the files in its folder are one thing in parts, so that it
// counts what these use of it, and not what it uses of them.
import { existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs'
import { join, posix, relative, resolve } from 'node:path'
import { parseArgs } from 'node:util'
import { cache, isMain, main, root, say, StepError } from './lib.mjs'

/** Files of other crates, which lie in the folder of `fastslam`. */
const others = /^(log|bin|examples)\//

/** Files of tests, which may use whatever they test. */
const tests = /(^|\/)tests(\/|\.)/

/** Where files are that must not use each other in a circle: crates, each by itself, and the elements. */
export const folders = ['src', 'src/log', 'src/bin/fastslam', 'lab/src', 'widgets/kit/src', 'widgets/src', 'widgets/elements']

/** @typedef {Map<string, Set<string>>} Uses of each file, by its path in the folder, those that it uses */

/** Paths of files in a folder, as they are written in code. @param {string} folder @param {string} ending @param {string} checkout */
const filesIn = (folder, ending, checkout) =>
  readdirSync(join(checkout, folder), { recursive: true, encoding: 'utf8' })
    .map(file => file.replaceAll('\\', '/'))
    .filter(file => file.endsWith(ending) && !tests.test(file) && !(folder === 'src' && others.test(file)))
    .sort()

/** The paths that a `use` names, each with all its parts: what stands in braces once for each. @param {string} tree @param {string[]} [before] @returns {string[][]} */
export function named(tree, before = []) {
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

/** What the files of a crate use of it, by their `use` lines and by paths that begin with `crate` or `super`; tests within a file apart. @param {string} folder @param {string} checkout @returns {Uses} */
function usesInRust(folder, checkout) {
  const modules = new Map(filesIn(folder, '.rs', checkout).map(file => [file.replace(/\.rs$/, '').replace(/(^|\/)(mod|lib|main)$/, ''), file]))
  const found = (/** @type {string[]} */ path) => {
    for (let parts = path.length; parts > 0; parts--) {
      const file = modules.get(path.slice(0, parts).join('/'))
      if (file) return file
    }
    return undefined
  }
  const uses = [...modules].map(([module, file]) => {
    const code = readFileSync(join(checkout, folder, file), 'utf8').replace(/\/\/[^\n]*/g, '').replace(/#\[cfg\(test\)\]\s*mod \w+ \{.*/s, '')
    const lines = [...code.matchAll(/\buse\s+((?:crate|super|self)\b[^;]*);/g)].flatMap(([, tree = '']) => named(tree))
    const paths = [...code.matchAll(/\b(?:crate|super)(?:::\w+)+/g)].map(([path]) => path.split('::'))
    const here = module.split('/').filter(Boolean)
    // What a macro at the top of a crate is given may be a path that it writes `crate::` before.
    const given = here.length === 1 ? [...code.matchAll(/^\w+! \{.*?^\}/gms)].flatMap(([rows]) => [...rows.matchAll(/\b(?<!::)[a-z]\w*(?:::\w+)+/g)]) : []
    const rows = given.map(([path]) => ['crate', ...path.replace(/^crate::/, '').split('::')])
    const whole = [...lines, ...paths, ...rows].map(([first, ...rest]) => {
      const above = first === 'crate' ? [] : here.slice(0, here.length - Number(first === 'super'))
      while (rest[0] === 'super') above.length -= Number(rest.shift() !== undefined)
      return found([...above, ...rest])
    })
    const own = new Set([...modules].filter(([other]) => other.startsWith(`${module}/`)).map(([, other]) => other))
    return /** @type {const} */ ([file, new Set(whole.filter(other => other !== undefined && other !== file && !own.has(other)))])
  })
  return /** @type {Uses} */ (new Map(uses))
}

/** What scripts import of each other, types apart. @param {string} folder @param {string} checkout @returns {Uses} */
function usesInScripts(folder, checkout) {
  const files = filesIn(folder, '.ts', checkout)
  const uses = files.map(file => {
    const code = readFileSync(join(checkout, folder, file), 'utf8')
    const sources = [...code.matchAll(/^(?:import|export)\s+(?!type\s)[^;'"]*?from\s+'(\.[^']+)'/gm)].map(([, source = '']) => `${posix.join(posix.dirname(file), source)}.ts`)
    return /** @type {const} */ ([file, new Set(sources.filter(source => files.includes(source)))])
  })
  return new Map(uses)
}

/** Files each of which leads to each of the others (Tarjan 1972). @param {Uses} uses @returns {string[]} a line for each circle */
export function circles(uses) {
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

/** What the files of a folder use of each other. @param {string} folder one of `folders` @param {string} [checkout] @returns {Uses} */
export const usesIn = (folder, checkout = root) => (folder === 'widgets/elements' ? usesInScripts : usesInRust)(folder, checkout)

/** @typedef {{ attributes: Record<string, string | number> }} Drawn */

/**
 * The picture as Graphviz draws it: the files of one level, and each folder there as one thing, with the number of its files.
 * @param {Uses} uses @param {string} [level] a folder in the one that was read, with `/` at its end
 * @returns {Omit<import('@viz-js/viz').Graph, 'nodes' | 'edges'> & { nodes: (Drawn & { name: string })[], edges: (Drawn & { tail: string, head: string })[] }}
 */
export function picture(uses, level = '') {
  const inCircle = new Set(circles(uses).flatMap(circle => circle.split(' ')))
  const thingOf = (/** @type {string} */ file) => file.slice(level.length).replace(/\/.*/, '/')
  const files = [...uses.keys()].filter(file => file.startsWith(level))
  /** @type {Map<string, { files: number, red: boolean }>} */
  const things = new Map()
  /** @type {Map<string, { tail: string, head: string, uses: number, red: boolean }>} */
  const arrows = new Map()
  for (const file of files) {
    const [tail, red] = [thingOf(file), inCircle.has(file)]
    const thing = things.get(tail)
    things.set(tail, { files: (thing?.files ?? 0) + 1, red: red || (thing?.red ?? false) })
    for (const other of uses.get(file) ?? []) {
      const head = thingOf(other)
      if (!other.startsWith(level) || head === tail) continue
      const arrow = arrows.get(`${tail} ${head}`)
      arrows.set(`${tail} ${head}`, { tail, head, uses: (arrow?.uses ?? 0) + 1, red: (red && inCircle.has(other)) || (arrow?.red ?? false) })
    }
  }
  /** @param {boolean} red @returns {Drawn['attributes']} */
  const colour = red => (red ? { color: 'red', fontcolor: 'red' } : {})
  return {
    graphAttributes: { ranksep: 0.6, nodesep: 0.15, bgcolor: 'white' },
    nodeAttributes: { shape: 'box', fontname: 'sans-serif', fontsize: 11, height: 0.3, margin: '0.08,0.03' },
    edgeAttributes: { color: '#00000070', arrowsize: 0.6 },
    nodes: [...things].map(([name, { files, red }]) => ({
      name,
      attributes: { ...(name.endsWith('/') ? { label: `${name} ${files}`, style: 'filled', fillcolor: '#e3ecf5' } : {}), ...colour(red) }
    })),
    edges: [...arrows.values()].map(({ tail, head, uses, red }) => ({ tail, head, attributes: { penwidth: Math.min(1 + uses / 8, 4), ...colour(red) } }))
  }
}

if (isMain(import.meta)) {
  await main(async () => {
    const { values, positionals } = parseArgs({ options: { in: { type: 'string', default: root } }, allowPositionals: true })
    const checkout = resolve(values.in)
    const places = positionals.length > 0 ? positionals : folders.filter(folder => existsSync(join(checkout, folder)))
    if (places.length === 0) throw new StepError(`${values.in} has none of ${folders.join(', ')}.`)
    const { instance } = await import('@viz-js/viz')
    const graphviz = await instance()
    mkdirSync(cache('imports'), { recursive: true })
    for (const place of places) {
      const path = posix.normalize(`${place}/`)
      const folder = folders.findLast(folder => path.startsWith(`${folder}/`))
      if (!folder || !existsSync(join(checkout, path))) throw new StepError(`${place} is no folder in ${folders.join(', ')}.`)
      const [uses, level] = [usesIn(folder, checkout), path.slice(folder.length + 1)]
      const file = cache('imports', `${path.slice(0, -1).replaceAll('/', '-')}.svg`)
      writeFileSync(file, graphviz.renderString(picture(uses, level), { format: 'svg' }))
      const found = circles(uses)
      say([`${relative('.', file)}: ${[...uses.keys()].filter(file => file.startsWith(level)).length} files; circles in ${folder}: ${found.length}`, ...found.map(circle => `  ${circle}`)].join('\n'))
    }
  })
}
