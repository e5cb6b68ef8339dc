// What axe, an independent checker of accessibility, holds against a page.
import AxeBuilder from '@axe-core/playwright'
import type { Page } from '@playwright/test'

const TAGS = ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice']

/**
 * The rules that are broken, a line each with the elements that break it: in the whole page, or in what `of` selects, without what `but`
 * selects.
 *
 * What passes is not described, and axe runs within the page: both take most of the time on a long one. Frames of other origins are looked
 * into only if `frames` is set.
 */
export async function brokenRules(page: Page, { of = [], but = [], frames = false }: { of?: string | string[]; but?: string | string[]; frames?: boolean } = {}): Promise<string[]> {
  const axe = new AxeBuilder({ page }).options({ resultTypes: ['violations'], selectors: false }).withTags(TAGS).setLegacyMode(!frames)
  for (const selector of [of].flat()) axe.include(selector)
  for (const selector of [but].flat()) axe.exclude(selector)
  const { violations } = await axe.analyze()
  return violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html).join(' | ')}`)
}
