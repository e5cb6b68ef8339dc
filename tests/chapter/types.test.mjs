// Types and manifest of the elements are what their code has.
import assert from 'node:assert/strict'
import { readdirSync, readFileSync } from 'node:fs'
import { join } from 'node:path'
import { test } from 'node:test'
import { membersIn, options, unsaidIn } from '../../scripts/elements.mjs'
import { root } from '../../scripts/lib.mjs'

const elements = join(root, 'widgets', 'elements')

/** @param {string} folder */
const sourcesOf = folder => readdirSync(folder).filter(file => file.endsWith('.ts')).map(file => ({ name: file.replace(/\.ts$/, ''), text: readFileSync(join(folder, file), 'utf8') }))

test('members are those that a class says something of, as it declares them', () => {
  const declaration = `export declare class Figure extends Parts {
    #private;
    constructor();
    connectedCallback(): void;
    /** Plays on. */
    play(): void;
    /** Of the figure itself. */
    protected show(frame: Frame): void;
    /** One step on. */
    get step(): () => void;
    set step(step: number | string);
    /** The step asked for. */
    get current(): number;
    set current(step: number);
    /** Whether it plays. */
    get playing(): boolean;
    markup: string;
    get unsaid(): string;
    wave(hand: Hand): void;
    /** Reads a log. */
    open(file: Blob, name?: string): Promise<void>;
}
`
  const brief = membersIn(declaration).map(({ text, help, method, type }) => [text, help, method, type])
  assert.deepEqual(brief, [
    ['play(): void', 'Plays on.', true, ''],
    ['step: () => void', 'One step on.', true, '() => void'],
    ['current: number', 'The step asked for.', false, 'number'],
    ['readonly playing: boolean', 'Whether it plays.', false, 'boolean'],
    ['open(file: Blob, name?: string): Promise<void>', 'Reads a log.', true, ''],
  ])
  assert.deepEqual(unsaidIn(declaration), ['markup', 'unsaid', 'wave'])
})

test('every event is made where only those can be that the types name', () => {
  const makers = sourcesOf(elements).filter(({ text }) => text.includes('new CustomEvent'))
  assert.deepEqual(makers.map(({ name }) => name), ['events'])
})

test('attributes that are no parameters are described with the values that they take', async () => {
  const { runnerImport } = await import('vite')
  const { module } = await runnerImport(join(elements, 'options.ts'), { configFile: false, logLevel: 'silent' })
  const { OPTIONS } = /** @type {typeof import('../../widgets/elements/options')} */ (module)
  assert.deepEqual(options.map(({ name }) => name), Object.keys(OPTIONS))
  for (const { name, values } of options) assert.deepEqual(values && [...values].sort(), OPTIONS[name]?.filter(Boolean).sort(), name)
})

test('there is one class of elements: what only some figures have is in extras', () => {
  const standing = sourcesOf(elements).flatMap(({ name, text }) => [...text.matchAll(/\bclass (?:\w+ )?extends (\w*(?:Element|Figure))\b/g)].map(([, base]) => `${name} extends ${base}`))
  assert.deepEqual(standing, ['define extends FigureElement', 'figure-element extends HTMLElement'])
})

test('no file of the elements needs itself by way of others', () => {
  const needs = new Map(sourcesOf(elements).map(({ name, text }) => [name, [...text.matchAll(/(?:from|import\() ?'\.\/([\w-]+)'/g)].map(([, needed = '']) => needed)]))
  /** @type {Set<string>} */
  const free = new Set()
  /** @param {string} name @param {string[]} way */
  const follow = (name, way) => {
    assert.ok(!way.includes(name), [...way, name].join(' → '))
    if (!free.has(name)) for (const needed of needs.get(name) ?? []) follow(needed, [...way, name])
    free.add(name)
  }
  for (const name of needs.keys()) follow(name, [])
})
