// A link carries one figure's whole state in the page's fragment: #key?query, for example #fastslam-lap?universes=32&step=40.
// The key is the element's id; without one, its tag, and `.2`, `.3` … for the second, third … of that tag in the document.

export function linkKey(element: Element): string {
  if (element.id) return element.id
  const tag = element.localName
  const root = element.getRootNode() as Document | ShadowRoot
  const index = [...root.querySelectorAll(tag)].indexOf(element)
  return index > 0 ? `${tag}.${index + 1}` : tag
}

/** What a link without a word means: the figure as it opened when links said nothing of their version. */
const FIRST_VERSION = 'v=1'

/** The query that the page's address holds for this element, or undefined where it speaks of another one. */
export function linkedQuery(element: Element): string | undefined {
  const [key, ...query] = location.hash.slice(1).split('?')
  return query.length > 0 && decode(key!) === linkKey(element) ? query.join('?') || FIRST_VERSION : undefined
}

export function linkTo(element: Element, query: string): string {
  return `${location.href.split('#')[0]}#${encodeURIComponent(linkKey(element))}?${query}`
}

function decode(text: string): string {
  try {
    return decodeURIComponent(text)
  } catch {
    return text // not ours, or damaged on its way: then it is nobody's key
  }
}

/** Whether the page is the chapter itself, whose folder the figures come from. */
export function inChapter(home: string): boolean {
  return [home, `${home}index.html`].includes(location.href.replace(/[?#].*/, ''))
}
