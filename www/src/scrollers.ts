// What can be scrolled sideways can be reached by keyboard, and only while there is something to scroll.
const observer = new ResizeObserver(entries => {
  for (const { target } of entries) {
    if (target.scrollWidth > target.clientWidth + 1) target.setAttribute('tabindex', '0')
    else target.removeAttribute('tabindex')
  }
})

export function watch(root: ParentNode): void {
  for (const scroller of root.querySelectorAll('.scroll')) observer.observe(scroller)
}

watch(document)
