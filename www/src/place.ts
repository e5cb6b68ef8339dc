// Figures take their room when their classes are known, which may be after the browser has gone to the place that the address
// names: then it is gone to once more, unless the reader has moved on or comes back to where they were.
const place = document.getElementById(location.hash.slice(1))
const [visit] = performance.getEntriesByType('navigation') as PerformanceNavigationTiming[]
if (place && visit?.type === 'navigate') {
  const moved = new AbortController()
  for (const type of ['wheel', 'touchstart', 'keydown', 'pointerdown']) addEventListener(type, () => moved.abort(), { once: true, passive: true })
  // The room is measured after the next layout.
  requestAnimationFrame(() => requestAnimationFrame(() => moved.signal.aborted || place.scrollIntoView()))
}

export {}
