// What a parameter is to a page: an attribute that is observed, and a property of the element. A figure's class is registered with
// both; which parameters there are is known from the build, before any program runs.
import { FIGURES } from './generated/figures'
import { OPTIONS } from './options'

/** An element whose parameters can be given and asked for by name. */
export interface Parametric extends HTMLElement {
  getParameter(name: string): unknown
  setParameter(name: string, value: unknown): void
}

/** Defines a figure's tag, once, with its parameters as observed attributes and as properties: rangeStd for `range-std`. */
export function register(tag: string, element: CustomElementConstructor): void {
  if (customElements.get(tag)) return
  Object.defineProperty(element, 'observedAttributes', { value: observed(tag) })
  for (const name of parametersOf(tag)) {
    const property = camelCase(name)
    if (property in element.prototype) continue // `step` stays the method
    Object.defineProperty(element.prototype, property, {
      configurable: true,
      enumerable: true,
      get(this: Parametric) {
        return this.getParameter(name)
      },
      set(this: Parametric, value: unknown) {
        this.setParameter(name, value)
      },
    })
  }
  customElements.define(tag, element)
}

/** Properties that a script set before the class was known are set again, as they would hide those of the class. */
export function takeEarlyProperties(element: Parametric): void {
  for (const name of parametersOf(element.localName)) {
    const property = camelCase(name)
    const early = Object.getOwnPropertyDescriptor(element, property)
    if (!early) continue
    delete (element as unknown as Record<string, unknown>)[property]
    element.setParameter(name, early.value)
  }
}

/** Tells of attributes that nobody knows and so nobody can observe: they are mistakes, and the figure says so. */
export function watchUnknown(element: Element, onAttribute: (name: string) => void): void {
  const known = observed(element.localName)
  new MutationObserver(records => {
    const names = new Set(records.map(record => record.attributeName!))
    for (const name of names) if (!known.includes(name)) onAttribute(name)
  }).observe(element, { attributes: true })
}

// Attributes that are not parameters and are no mistake: those of every element, and those frameworks add.
const COMMON = new Set(['class', 'part', 'is', 'role', 'exportparts', ...Object.keys(properties(HTMLElement.prototype))])
const FOREIGN = /^(aria|data|hx|js|ng|v|wire|x)-|[^a-z0-9-]/

/** Whether an attribute of this name is meant to be a parameter. */
export function isParameter(attribute: string): boolean {
  return !(attribute in OPTIONS) && !COMMON.has(attribute) && !FOREIGN.test(attribute)
}

export function fromText(value: string | null | undefined): unknown {
  if (value === undefined || value === null) return undefined
  if (value === 'on' || value === 'off') return value === 'on'
  return value === '' || Number.isNaN(Number(value)) ? value : Number(value)
}

export function toText(value: unknown): string {
  return value === true ? 'on' : value === false ? 'off' : String(value)
}

function parametersOf(tag: string): string[] {
  return FIGURES[tag]?.parameters ?? []
}

/** The tag of a figure by its name, with or without what all of them begin with; undefined where there is none. */
export function tagOf(name: string): string | undefined {
  const tag = `fastslam-${name.replace(/^fastslam-/, '')}`
  return FIGURES[tag] && tag
}

/** What is said of a name that is no figure's. */
export const noFigure = (name: string): string => `There is no figure “${name.slice(0, 40)}”.`

function observed(tag: string): string[] {
  return [...parametersOf(tag), ...Object.keys(OPTIONS)]
}

function camelCase(name: string): string {
  return name.replace(/-(.)/g, (_, letter: string) => letter.toUpperCase())
}

function properties(prototype: object): Record<string, true> {
  const names: Record<string, true> = {}
  for (const name in prototype) names[name.toLowerCase()] = true
  return names
}
