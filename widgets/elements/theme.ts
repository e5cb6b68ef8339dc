// Light or dark, and the same two with high contrast: from the reader's system, unless the attribute `theme` decides.
import { printing } from './paper'

const dark = matchMedia('(prefers-color-scheme: dark)')
const contrast = matchMedia('(prefers-contrast: more)')
const forced = matchMedia('(forced-colors: active)')

export const reducedMotion = matchMedia('(prefers-reduced-motion: reduce)')

export function themeName(attribute: string | null): string {
  if (printing) return 'light'
  const shade = attribute === 'light' || attribute === 'dark' ? attribute : dark.matches ? 'dark' : 'light'
  return contrast.matches || forced.matches ? `contrast-${shade}` : shade
}

export function onThemeChange(listener: () => void, signal: AbortSignal): void {
  for (const query of [dark, contrast, forced]) query.addEventListener('change', listener, { signal })
}
