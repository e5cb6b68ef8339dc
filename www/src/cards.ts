// A term, a work or an equation that the text refers to, shown in a card beside the reference: on pointing, on focus, on touch.
// The link itself stays what it is.
const selector = 'main :is(a.term, a.cite, a.eqref)'
const card = Object.assign(document.createElement('div'), { className: 'card', id: 'card', popover: 'manual' })
card.role = 'tooltip'
document.body.append(card)

let shown: HTMLAnchorElement | undefined
let timer = 0

function show(link: HTMLAnchorElement): void {
  clearTimeout(timer)
  const target = document.getElementById(decodeURIComponent(link.hash.slice(1)))
  if (!target || link === shown) return
  hide()
  const copy = (target.querySelector('math[display]') ?? target).cloneNode(true) as Element
  for (const element of copy.querySelectorAll('[id]')) element.removeAttribute('id')
  card.replaceChildren(...(copy.localName === 'math' ? [copy] : copy.childNodes))
  card.showPopover()
  link.setAttribute('aria-describedby', card.id)
  shown = link
  place(link)
}

/** Under the link, or over it where there is no room; never beyond the sides of the window. */
function place(link: HTMLAnchorElement): void {
  const at = link.getClientRects()[0]!
  const { offsetWidth: width, offsetHeight: height } = card
  const below = at.bottom + 8 + height < innerHeight || at.top < height + 8
  card.style.top = `${scrollY + (below ? at.bottom + 8 : at.top - height - 8)}px`
  card.style.left = `${scrollX + Math.max(16, Math.min(at.left, document.documentElement.clientWidth - width - 16))}px`
}

function hide(): void {
  clearTimeout(timer)
  shown?.removeAttribute('aria-describedby')
  shown = undefined
  if (card.matches(':popover-open')) card.hidePopover()
}

const linkAt = (event: Event): HTMLAnchorElement | null =>
  event.target instanceof Element ? event.target.closest<HTMLAnchorElement>(selector) : null

function later(action: () => void, delay: number): void {
  clearTimeout(timer)
  timer = setTimeout(action, delay)
}

// A pointer that only crosses the link opens nothing; one on its way to the card does not close it.
document.addEventListener('pointerover', event => {
  if (event.pointerType === 'touch') return
  const link = linkAt(event)
  if (link) later(() => show(link), 150)
  else if (card.contains(event.target as Node)) clearTimeout(timer)
  else if (shown && document.activeElement !== shown) later(hide, 250)
  else clearTimeout(timer)
})
document.addEventListener('focusin', event => {
  const link = linkAt(event)
  if (link?.matches(':focus-visible')) show(link)
  else if (!card.contains(event.target as Node)) hide()
})
document.addEventListener('focusout', () => later(hide, 250))
document.addEventListener('keydown', event => event.key === 'Escape' && hide())
// A finger has no way to point: the first touch opens the card, the second follows the link.
document.addEventListener('click', event => {
  const link = linkAt(event)
  const touch = (event as PointerEvent).pointerType === 'touch'
  // A few lead to another page.
  if (link && touch && link !== shown && document.getElementById(decodeURIComponent(link.hash.slice(1)))) {
    event.preventDefault()
    show(link)
  } else if (!card.contains(event.target as Node)) hide()
})
