// What an address asks of a figure: ?figure=proposal&range-std=0.05&samples=16, for the page for frames and for that on embedding.
import type { FigureElement } from '../../widgets/elements/figure-element'
import { FIGURES } from '../../widgets/elements/generated/figures'
import { OPTIONS } from '../../widgets/elements/options'
import { tagOf } from '../../widgets/elements/parameters'

/** Short names of parameters, as formulas have them: the first that a figure has. */
const SHORT: Record<string, string[]> = {
  m: ['universes', 'samples', 'particles'],
  n: ['landmarks'],
  t: ['poses'],
  'sigma-r': ['range-std', 'range'],
  'sigma-phi': ['bearing-std'],
}

export const query = new URLSearchParams(location.search)

/** What an address says besides, to the page and not to the figure. */
const OURS = ['figure', 'task', 'print', 'tell']

/** Which figure is asked for, as it is written, and its tag where there is such a one. */
export const asked = query.get('figure') ?? ''
export const askedTag = tagOf(asked)

/** Only what a figure knows becomes an attribute: an address is nobody's to trust. The rest the figure refuses in its own words. */
export function configure(figure: FigureElement): void {
  const { parameters } = FIGURES[figure.localName]!
  for (const [key, value] of query) {
    if (OURS.includes(key)) continue
    const dashed = key.replaceAll('_', '-')
    const name = parameters.includes(dashed) ? dashed : (SHORT[dashed]?.find(long => parameters.includes(long)) ?? dashed)
    if (parameters.includes(name) || name in OPTIONS) figure.setAttribute(name, value)
    else figure.setParameter(name, value)
  }
}
