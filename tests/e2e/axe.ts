// What axe, an independent checker of accessibility, holds against a page.
import AxeBuilder from '@axe-core/playwright'
import type { Page } from '@playwright/test'

const TAGS = ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice']

interface Looked {
  of?: string | string[]
  but?: string | string[]
  frames?: boolean
  contrast?: boolean | 'only'
}

/**
 * The rules that are broken, a line each with the elements that break it: in the whole page, or in what `of` selects, without what `but`
 * selects.
 *
 * What passes is not described, and axe runs within the page: both take most of the time on a long one. Frames of other origins are looked
 * into only if `frames` is set. `contrast: false` leaves out the rule that takes most of the rest, `'only'` everything else.
 */
export async function brokenRules(page: Page, { of = [], but = [], frames = false, contrast = true }: Looked = {}): Promise<string[]> {
  const axe = new AxeBuilder({ page }).options({ resultTypes: ['violations'], selectors: false }).setLegacyMode(!frames)
  if (contrast === 'only') axe.withRules('color-contrast')
  else axe.withTags(TAGS)
  if (!contrast) axe.disableRules('color-contrast')
  for (const selector of [of].flat()) axe.include(selector)
  for (const selector of [but].flat()) axe.exclude(selector)
  const { violations } = await axe.analyze()
  return violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html).join(' | ')}`)
}

/** Leaves nothing of the page but this element and what it lies in: axe goes through all that there is, whatever it is told to look at. */
export const leaveOnly = (page: Page, selector: string): Promise<void> =>
  page.evaluate(selector => {
    for (let element = document.querySelector(selector)!; element !== document.body; element = element.parentElement!) {
      for (const sibling of [...element.parentElement!.children]) if (sibling !== element) sibling.remove()
    }
  }, selector)

/**
 * Leaves one text of each kind, and what it lies in. Of a kind are those with the same tags and classes from the root down: they have
 * their colours from the same rules of the style sheet. A formula is one text.
 */
export const leaveOneOfEachKind = (page: Page): Promise<number> =>
  page.evaluate(() => {
    const [kinds, left] = [new Set<string>(), new Set<Element>()]
    const visit = (element: Element, path: string) => {
      const kind = `${path}>${element.localName}.${element.getAttribute('class')}`
      const formula = element.localName === 'math'
      const text = formula || [...element.childNodes].some(node => node.nodeType === Node.TEXT_NODE && node.textContent!.trim()) || element.matches('input, select')
      if (text && !kinds.has(kind)) {
        kinds.add(kind)
        for (let around: Element | null = element; around && !left.has(around); around = around.parentElement) left.add(around)
        if (formula) for (const part of element.querySelectorAll('*')) left.add(part)
      }
      if (!formula) for (const child of element.children) visit(child, kind)
    }
    visit(document.body, '')
    for (const element of document.body.querySelectorAll('*')) if (!left.has(element)) element.remove()
    return kinds.size
  })
