// To lay out all of the chapter takes longer than a reader should wait for an answer. So the sections that nobody sees yet are left
// out at first (style.css), and laid out one by one while the page is idle.
const left = [...document.querySelectorAll('main > section:nth-of-type(n + 3), main > section:nth-of-type(n + 3) > section')]
// Safari has no idle callback, and has to leave time for input by the clock.
const idle: (run: () => void) => void = 'requestIdleCallback' in window ? run => requestIdleCallback(run, { timeout: 500 }) : run => setTimeout(run, 50)

function next(): void {
  left.shift()?.classList.add('laid')
  if (left.length > 0) requestAnimationFrame(() => idle(next))
}

// Who comes by a link to a place, or comes back to it, has sections above: they get their heights before the place is looked up.
const [visit] = performance.getEntriesByType('navigation') as PerformanceNavigationTiming[]
if (location.hash !== '' || visit?.type !== 'navigate') for (const section of left.splice(0)) section.classList.add('laid')
else idle(next)

export {}
