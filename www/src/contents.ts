// Marks in the table of contents where the reader is.
const links = new Map([...document.querySelectorAll<HTMLAnchorElement>('.contents a')].map(link => [link.hash.slice(1), link]))
const reached = new Set<Element>()

// A line a third down the screen: sections that lie across it are being read, the innermost of them most of all.
const observer = new IntersectionObserver(
  entries => {
    for (const { target, isIntersecting } of entries) reached[isIntersecting ? 'add' : 'delete'](target)
    const innermost = [...reached].reduce<Element | undefined>((best, section) => (best && !best.contains(section) ? best : section), undefined)
    for (const link of links.values()) link.removeAttribute('aria-current')
    if (innermost) linkOf(innermost)?.setAttribute('aria-current', 'location')
  },
  { rootMargin: '-33% 0px -66%' },
)

function linkOf(section: Element): HTMLAnchorElement | undefined {
  return links.get(section.firstElementChild!.id)
}

for (const section of document.querySelectorAll('main section')) if (linkOf(section)) observer.observe(section)

// On a small screen the contents are a fold over the text: it closes when a place has been chosen.
const fold = document.querySelector<HTMLDetailsElement>('.contents details')
fold?.addEventListener('click', event => {
  if (event.target instanceof Element && event.target.closest('a')) fold.open = false
})

export {}
