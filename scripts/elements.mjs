// What the compiled figures tell of themselves, and all that is made from it: the names that elements/ needs before a program runs,
// the types, the manifest of the custom elements, and the classes of the Python package. A new parameter needs no other line.
import { existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import { readGlue, shellModule, shellTypes } from './glue.mjs'
import { cache, isMain, main, npmBin, readIfThere, root, run, step, StepError } from './lib.mjs'
import { programs } from './registry.mjs'

/**
 * @typedef {import('../widgets/elements/shell').ParamSpec} ParamSpec
 * @typedef {import('../widgets/elements/shell').Readout} Readout
 * @typedef {import('../widgets/elements/shell').Chip} Chip
 * @typedef {{ tag: string, name: string, className: string, title: string, describe: string, params: ParamSpec[], readouts: Readout[], chips: Chip[], prediction: string | null, handles: boolean, panels: string[], version: number, unsaid: number, compared: boolean, counted: Count | null }} FigureInfo
 * @typedef {{ job: string, columns: string[], title: string, settings: string, rows: [name: string, column: string, expected: string | null][] }} Count
 */

const told = cache('figures.json')

/** Asks the figures, natively. @param {string} [program] the example, where it has been built already */
export async function tellFigures(program) {
  const { output } = await (program ? run(program, []) : run('cargo', ['run', '--quiet', '-p', 'fastslam-widgets', '--example', 'figures']))
  write(told, output)
}

/** Every figure, as it was told last. @returns {FigureInfo[]} */
export const figures = () =>
  JSON.parse(readFileSync(told, 'utf8')).map((/** @type {FigureInfo} */ figure) => ({ ...figure, name: figure.tag.replace('fastslam-', ''), className: pascal(figure.tag) }))

/** @param {string} name */
const pascal = name => name.replace(/(?:^|-)(.)/g, (_, letter) => letter.toUpperCase())
/** @param {string} name */
export const camel = name => name.replace(/-(.)/g, (_, letter) => letter.toUpperCase())

/** Languages that figures speak: a file each. */
export const languages = readdirSync(join(root, 'widgets', 'words')).map(file => file.replace(/\.json$/, '')).sort()

/** All that figures say in a language: what the kit has words for, and what they have. @param {string} language @returns {Record<string, Record<string, string>>} */
export const catalogue = language => Object.assign({}, ...['widgets', 'widgets/kit'].map(folder => JSON.parse(readFileSync(join(root, folder, 'words', `${language}.json`), 'utf8'))))

/** Attributes of every figure that are no parameters. */
export const options = [
  { name: 'lang', values: undefined, help: `Language of all it says: ${languages.join(' or ')}. Where it is not given, that of the page around it; English for any other.` },
  { name: 'v', values: undefined, type: "number | 'latest'", help: 'Version of the figure that the other attributes are of: what they leave out is at the default of that version, whatever has become of it since. Copied codes have it. Without it, the version of the day on which codes began to say theirs; latest follows the figure.' },
  { name: 'theme', values: ['auto', 'light', 'dark'], help: 'Colours; auto follows the color-scheme that the page has around the figure or, where it has none, the reader’s system.' },
  { name: 'controls', values: undefined, help: 'Controls that readers see, apart by spaces: names of parameters, playback (the whole row of it), play (its button alone), numbers, chips; or none, or all. picture leaves out title and sentence as well: controls="picture" is for a slide, and controls="picture playback" has the row of playback below. controls="seed" leaves the seed; a name that is none is answered with those that there are.' },
  { name: 'lab', values: ['closed', 'open'], help: 'open: readers begin with all that can be set, the seed, the speed and the numbers in sight; they can close it. A link has it too.' },
  { name: 'chips', values: ['on', 'off'], help: 'off leaves the chips of its challenges out.' },
  { name: 'show', values: undefined, help: 'Parts of the picture to show, apart by spaces; or all.' },
  { name: 'lock', values: undefined, help: 'Names of parameters, apart by spaces, that readers cannot change; or all. lock="seed" fixes the seed.' },
  { name: 'decimal', values: ['point', 'comma'], help: 'How numbers are written; where it is not given, as the language has it.' },
  { name: 'size', values: ['normal', 'presentation'], help: 'presentation makes letters and lines half as large again, for a projector.' },
  { name: 'fit', values: ['off', 'on'], help: 'on: the picture takes the height of its box rather than all of its width; not that of a log.' },
]

/** What the figure of logs does without: its numbers have a point always, and it takes the height that it wants. */
const notOfLogs = ['decimal', 'fit']

/** The figure that maps logs has files to open, and goes back through what it has mapped. @param {{ tag: string }} figure */
const isLog = ({ tag }) => tag === 'fastslam-log'

/** @param {FigureInfo} figure */
const optionsOf = figure => options.filter(({ name }) => !(isLog(figure) && notOfLogs.includes(name)))

/** The declarations of a file of widgets/elements, as tsc writes them. @param {string} name */
const declarations = name => readFileSync(cache('types', 'widgets', 'elements', `${name}.d.ts`), 'utf8')

/** What is declared and never used is for the check of types to tell: no build fails for it. */
export const withUnused = ['--noUnusedLocals', 'false', '--noUnusedParameters', 'false']

/** Has tsc write the declarations of all elements, without what is marked as internal. */
export async function declare() {
  await run(npmBin('tsc'), ['-p', root, ...withUnused, '--noEmit', 'false', '--declaration', '--emitDeclarationOnly', '--stripInternal', '--outDir', cache('types')])
  const unsaid = unsaidIn(declarations('figure-element'))
  if (unsaid.length > 0) throw new StepError(`Nothing is said of these members of figures: ${unsaid.join(', ')}.`, 'A line above one makes it a member for pages, and @internal keeps it out of their types.')
}

/**
 * A method or a property that pages may use. `text` is how it is declared.
 * @typedef {{ name: string, text: string, help: string, method: boolean, type: string, readonly: boolean }} Member
 */

/** Those that a class declares: it says something of each, and not of what is its own affair. @param {string} declaration @returns {Member[]} */
export function membersIn(declaration) {
  const found = [...declaration.matchAll(/^ {4}\/\*\* (.+) \*\/\n {4}(?:get (\w+)\(\): (.+)|(\w+)(\(.*));$/gm)]
  return found.map(([, help = '', field, type = '', method, signature]) => {
    if (field === undefined) return { name: method ?? '', text: `${method}${signature}`, help, method: true, type: '', readonly: false }
    const readonly = !declaration.includes(`    set ${field}(`)
    return { name: field, text: `${readonly ? 'readonly ' : ''}${field}: ${type}`, help, method: type.startsWith('() =>'), type, readonly }
  })
}

/** Those of which it says nothing, though any page could use them. @param {string} declaration */
export const unsaidIn = declaration => [...declaration.matchAll(/(?<! \*\/)\n {4}(?:get )?(\w+)(?=[(:])/g)].map(([, name = '']) => name).filter(name => !/^constructor$|Callback$/.test(name))

/** Those of every figure. */
const commonMembers = () => membersIn(declarations('figure-element'))

/** Those of its own. @param {FigureInfo} figure */
const ownMembers = figure => extrasOf(figure).flatMap(extra => membersIn(declarations(extra)))

/** All that a figure has besides its parameters: its own members first. @param {FigureInfo} figure */
function membersOf(figure) {
  const own = ownMembers(figure)
  return [...own, ...commonMembers().filter(({ name }) => !own.some(other => other.name === name))]
}

/** What figures tell a page. @typedef {{ name: string, type: string, help: string }} FigureEvent @returns {FigureEvent[]} */
const events = () => [...details().matchAll(/^ {2}\/\*\* (.+) \*\/\n {2}'(fastslam-[a-z]+)': (CustomEvent<\w+>)$/gm)].map(([, help = '', name = '', type = '']) => ({ name, type, help }))

/** Of these, those of one figure: an extra says which ones not every figure has. @param {FigureInfo} figure */
export function eventsOf({ compared }) {
  const only = /@fires (\S+)/.exec(readFileSync(join(elements, 'seeds.ts'), 'utf8'))?.[1]
  return events().filter(({ name }) => compared || name !== only)
}

const elements = join(root, 'widgets', 'elements')

/** The file of a figure that names extras of its own. @param {{ tag: string }} figure */
const ownFile = ({ tag }) => join(elements, `${tag}.ts`)

/** The files of a figure's extras: those that it names, or the count, and then what all with a seed have. @param {FigureInfo} figure */
const extrasOf = figure => {
  const own = readIfThere(ownFile(figure))
  const named = [...(own ?? '').matchAll(/from '\.\/([\w-]+)'/g)].map(([, name = '']) => name).filter(name => name !== 'define')
  return [...named, ...(own === undefined && figure.counted ? ['count-study'] : []), ...(figure.compared ? ['seeds'] : [])]
}

/** The parts that a class says it has. @param {string} name of its file */
const partsIn = name => Object.fromEntries([...(readIfThere(join(elements, `${name}.ts`)) ?? '').matchAll(/^ \* @csspart ([\w-]+) - (.+)/gm)].map(([, name, what]) => [name, what]))

/** The parts of a figure: those that all have, and its own. @param {FigureInfo} figure @returns {Record<string, string>} */
const partsOf = figure => ({
  ...partsIn('figure-element'),
  ...(figure.params.some(({ name }) => name === 'seed') && { seed: 'The seed, and the die that draws one.' }),
  ...(figure.params.some(({ kind }) => kind === 'toggle') && { toggle: 'A button that is on or off.' }),
  ...(figure.handles && { handle: 'What can be grasped in the picture; there only then.' }),
  ...Object.assign({}, ...extrasOf(figure).map(partsIn)),
})

const cssProperties = ['accent', 'ink', 'muted', 'line', 'paper', 'radius', 'font', 'height'].map(name => `--fastslam-${name}`)

/** The names in an event's detail, in braces; those with a question mark are not always there. @param {string} type `CustomEvent<…>` */
function detailOf(type) {
  const name = /<(\w+)>/.exec(type)?.[1]
  const body = new RegExp(`interface ${name} \\{([^}]*)\\}`).exec(details())?.[1]
  if (!body) throw new StepError(`widgets/elements/details.ts has no ${name}.`)
  return `{ ${[...body.matchAll(/^  (\w+\??):/gm)].map(([, field]) => field).join(', ')} }`
}

/** The type of a parameter in TypeScript. @param {ParamSpec} spec */
function type({ kind, choices }) {
  const words = choices.map(({ value }) => `'${value}'`)
  if (kind === 'flag' || kind === 'toggle') return 'boolean'
  if (kind === 'text') return 'string'
  return kind === 'choice' ? words.join(' | ') : ['number', ...words].join(' | ')
}

/** The same as an attribute: text is as good. @param {ParamSpec} spec */
function attributeType(spec) {
  const text = { flag: " | 'on' | 'off'", toggle: " | 'on' | 'off'", choice: '', text: '', number: ' | `${number}`', integer: ' | `${number}`' }
  return type(spec) + text[spec.kind]
}

/** What it does, and the values it takes. @param {ParamSpec} spec */
export function describe({ kind, min, max, unit, help, choices }) {
  if (kind === 'flag' || kind === 'toggle' || kind === 'choice' || kind === 'text') return help
  const words = choices.map(({ value }) => value).join(', ')
  return `${help} ${words && `${words} or `}${kind === 'integer' ? 'A whole number from' : 'From'} ${round(min)} to ${round(max)}${unit && ` ${unit}`}.`.replace(/ or (A|From) /, found => found.toLowerCase())
}

/** @param {number} x */
export const round = x => Number(x.toPrecision(12))

/** The manifest, of the schema of custom-elements-manifest. @param {FigureInfo[]} all */
export function manifest(all) {
  const attribute = (/** @type {FigureInfo} */ _) => (/** @type {ParamSpec} */ spec) => ({
    name: spec.name,
    fieldName: spec.name === 'step' ? 'currentStep' : camel(spec.name),
    description: describe(spec),
    type: { text: type(spec) },
    default: spec.default,
  })
  const declarations = all.map(figure => ({
    kind: 'class',
    customElement: true,
    name: figure.className,
    tagName: figure.tag,
    summary: figure.title,
    attributes: [
      ...figure.params.map(attribute(figure)),
      ...optionsOf(figure).map(({ name, values, type = 'string', help }) => ({
        name,
        description: name === 'show' ? `${help} There are ${figure.panels.join(', ') || 'none: it is one piece'}.` : help,
        type: { text: values ? values.map(v => `'${v}'`).join(' | ') : type },
        ...(values && { default: values[0] }),
      })),
    ],
    members: [
      ...figure.params
        .filter(({ name }) => name !== 'step')
        .map(spec => ({ kind: 'field', name: camel(spec.name), attribute: spec.name, type: { text: type(spec) }, description: describe(spec) })),
      ...membersOf(figure).map(({ name, method, type: text, readonly, help }) => (method ? { kind: 'method', name, description: help } : { kind: 'field', name, type: { text }, readonly, description: help })),
    ],
    events: eventsOf(figure).map(({ name, type: text, help }) => ({ name, type: { text }, description: `${help} Its detail: ${detailOf(text)}.` })),
    ...Object.fromEntries(named(figure).map(([what, all]) => [what.toLowerCase(), all])),
    cssParts: Object.entries(partsOf(figure)).map(([name, description]) => ({ name, description })),
    cssProperties: cssProperties.map(name => ({ name })),
    slots: [{ name: '', description: 'A picture of the figure, for where it cannot run.' }],
  }))
  const exported = declarations.flatMap(({ name, tagName }) => [
    { kind: 'js', name, declaration: { name, module: 'fastslam.js' } },
    { kind: 'custom-element-definition', name: tagName, declaration: { name, module: 'fastslam.js' } },
  ])
  return { schemaVersion: '1.0.0', readme: 'README.md', modules: [{ kind: 'javascript-module', path: 'fastslam.js', declarations, exports: exported }] }
}

/** What a figure tells and offers by name: its readouts, as events and saved data have them, its challenges, and what it asks to be predicted. @param {FigureInfo} figure @returns {[string, { name: string, description: string }[]][]} */
const named = ({ readouts, chips, prediction, params }) => [
  ['Readouts', readouts.map(({ name, title, unit }) => ({ name, description: unit ? `${title} [${unit}]` : title }))],
  ['Challenges', chips.map(({ name, title }) => ({ name, description: title }))],
  ...(prediction ? [/** @type {[string, { name: string, description: string }[]]} */ (['Predictions', [{ name: prediction, description: params.find(({ name }) => name === 'guess')?.help ?? '' }]])] : []),
]

/** The shapes of what figures tell the page, as the elements have them: after the line that says what the file is. */
const details = () => readFileSync(join(root, 'widgets', 'elements', 'details.ts'), 'utf8').replace(/^.*\n+/, '')

/** The types of the elements. @param {FigureInfo[]} all */
export function types(all) {
  const doc = (/** @type {string} */ text) => `  /** ${text} */`
  const field = (/** @type {ParamSpec} */ spec) => `${doc(describe(spec))}\n  ${camel(spec.name)}: ${type(spec)}`
  const member = (/** @type {Member} */ { text, help }) => `${doc(help)}\n  ${text}`
  const classes = all.map(
    figure =>
      `/**\n * ${[`${figure.title}.`, ...named(figure).map(([what, all]) => `${what}: ${all.map(({ name, description }) => `${name} (${description})`).join(', ')}.`)].join('\n *\n * ')}\n */\nexport declare class ${figure.className} extends FigureElement {\n${[
        ...ownMembers(figure).map(member),
        ...figure.params.filter(({ name }) => name !== 'step').map(field),
      ].join('\n')}\n}`,
  )
  const attributes = all.map(
    figure =>
      `export interface ${figure.className}Attributes extends ${isLog(figure) ? `Omit<FigureAttributes, ${notOfLogs.map(name => `'${name}'`).join(' | ')}>` : 'FigureAttributes'} {\n${figure.params.map(spec => `  '${spec.name}'?: ${attributeType(spec)}`).join('\n')}\n}`,
  )
  return `// Made by scripts/elements.mjs from what the figures tell of themselves.

${details()}
export interface FigureEventMap extends HTMLElementEventMap, FigureEvents {}

export declare abstract class FigureElement extends HTMLElement {
${commonMembers().map(member).join('\n')}
  addEventListener<K extends keyof FigureEventMap>(type: K, listener: (this: this, event: FigureEventMap[K]) => unknown, options?: boolean | AddEventListenerOptions): void
  addEventListener(type: string, listener: EventListenerOrEventListenerObject, options?: boolean | AddEventListenerOptions): void
}

/** Attributes of every figure. */
export interface FigureAttributes {
${options.map(({ name, values, type = 'string', help }) => `${doc(help)}\n  ${name}?: ${values ? values.map(v => `'${v}'`).join(' | ') : type.replace('number', 'number | `${number}`')}`).join('\n')}
}

${classes.join('\n\n')}

${attributes.join('\n\n')}

export interface FigureTagAttributes {
${all.map(({ tag, className }) => `  '${tag}': ${className}Attributes`).join('\n')}
}

declare global {
  interface HTMLElementTagNameMap {
${all.map(({ tag, className }) => `    '${tag}': ${className}`).join('\n')}
  }
}
`
}

/** Writes a file unless it is so already, so that nothing is built anew for nothing. @param {string} path @param {string} text */
export function write(path, text) {
  mkdirSync(join(path, '..'), { recursive: true })
  if (readIfThere(path) !== text) writeFileSync(path, text)
}

/** The names that the elements need before a program runs, and the glue that runs it. */
export async function writeNames() {
  const generated = join(elements, 'generated')
  const put = (/** @type {string} */ file, /** @type {string} */ text) => write(join(generated, file), `// Made by scripts/elements.mjs from what the figures tell of themselves.\n${text}`)
  write(join(generated, 'shell.js'), shellModule(readGlue()))
  write(join(generated, 'shell.d.ts'), shellTypes)
  const all = figures()
  const row = (/** @type {FigureInfo} */ { tag, title, params, version, unsaid, compared, counted }) =>
    `  '${tag}': { title: ${JSON.stringify(title)}, program: '${programs.get(tag)}', version: '${version}', unsaid: '${unsaid}', parameters: ${JSON.stringify(params.map(({ name }) => name).join(' '))}.split(' ')${compared ? ', compared: true' : ''}${counted ? ', counted: true' : ''} },\n`
  put('figures.ts', `export const FIGURES: Record<string, { title: string; program: string; version: string; unsaid: string; parameters: string[]; compared?: true; counted?: true } | undefined> = {\n${all.map(row).join('')}}\n`)
  const count = (/** @type {FigureInfo} */ { tag, counted }) => {
    if (!counted) return ''
    const { job, columns, title, settings, rows } = counted
    const at = (/** @type {string} */ name) => {
      if (!columns.includes(name)) throw new StepError(`The count of ${tag} names a column ${name}, which its job does not have.`)
      return columns.indexOf(name)
    }
    const of = rows.map(([name, column, expected]) => [name, at(column), ...(expected === null ? [] : [at(expected)])])
    return `  '${tag}': ${JSON.stringify({ job, title, settings, rows: of })},\n`
  }
  put('counted.ts', `import type { Counted } from '../shell'\n\nexport const COUNTED: Record<string, Counted | undefined> = {\n${all.map(count).join('')}}\n`)
  const element = (/** @type {FigureInfo} */ figure) => {
    const { tag, className, counted } = figure
    if (existsSync(ownFile(figure))) return `export { ${className} } from '../${tag}'\n`
    return `export const ${className} = define('${tag}'${counted ? ', CountStudy' : ''})\n`
  }
  put('elements.ts', `import { CountStudy } from '../count-study'\nimport { define } from '../define'\n\n${all.map(element).join('')}`)
  const mapper = all.find(isLog)
  if (!mapper) throw new StepError('There is no figure that maps logs.')
  const { title, params, readouts, chips, describe } = mapper
  put('log.ts', `import type { AtRest } from '../shell'\n\nexport const AT_REST: AtRest = ${JSON.stringify({ title, params, readouts, chips, describe })}\n`)
  return `${all.length} figures`
}

if (isMain(import.meta)) {
  await main(async () => {
    await step('What the figures tell of themselves', () => tellFigures())
    await step('Names of the figures', writeNames)
  })
}
