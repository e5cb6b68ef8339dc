// A link carries one figure's whole state in the fragment of the page's address: #key?query, for example #fastslam-lap?universes=32&step=40.
// The key is the element's id; without one, its tag, and `.2`, `.3` … for the second, third … of that tag in the document. Where the fragment
// is the host's own, a route of its site, that stays, and the same stands in the query: ?fastslam=key%3Fquery#/lesson/3.

export function linkKey(element: Element): string {
  if (element.id) return element.id
  const tag = element.localName
  const root = element.getRootNode() as Document | ShadowRoot
  const index = [...root.querySelectorAll(tag)].indexOf(element)
  return index > 0 ? `${tag}.${index + 1}` : tag
}

/** What a link without a word means: the figure as it opened when links said nothing of their version. */
const FIRST_VERSION = 'v=1'

/** In the query of a page whose fragment is a route. */
const IN_QUERY = /([?&])fastslam=([^&]*)/

/** The route that the page was opened at: on another one, its query is not meant any more. */
const opened = globalThis.location?.hash

/** The query that the page's address holds for this element, or undefined where it speaks of another one. */
export function linkedQuery(element: Element): string | undefined {
  const { hash, search } = location
  return queryFor(element, hash.slice(1)) ?? (hash === opened ? queryFor(element, decode(IN_QUERY.exec(search)?.[2] ?? '')) : undefined)
}

function queryFor(element: Element, text: string): string | undefined {
  const [key, ...query] = text.split('?')
  return query.length > 0 && decode(key!) === linkKey(element) ? query.join('?') || FIRST_VERSION : undefined
}

/** A figure's state, and what the link has about its Lab, which is no part of it. */
export function withoutLab(link: string): [query: string, lab: string | null] {
  const asked = new URLSearchParams(link)
  const lab = asked.get('lab')
  if (lab === null) return [link, lab]
  asked.delete('lab')
  return [asked.toString(), lab]
}

/** The address of this page with the state of a figure. `home` is the folder of our site, or empty. */
export function linkTo(element: Element, query: string, home: string): string {
  const text = `${encodeURIComponent(linkKey(element))}?${query}`
  const [address, fragment = ''] = location.href.split(/#(.*)/s)
  // A page for frames is no place to come to, nor is a document without an address: the chapter has the figure as well.
  const placeless = !/^(https?|file):/.test(address!) || (address!.startsWith(home) && /^embed(-[\w-]+)?\.html/.test(address!.slice(home.length)))
  if (home && placeless) return `${home}#${element.localName}?${query}`
  if (!isRoute(element, fragment)) return `${address}#${text}`
  const given = `fastslam=${encodeURIComponent(text)}`
  const page = IN_QUERY.test(address!) ? address!.replace(IN_QUERY, `$1${given}`) : `${address}${address!.includes('?') ? '&' : '?'}${given}`
  return `${page}#${fragment}`
}

/** Whether a fragment is neither a figure's link nor a place on the page: the host's router has to find it again. */
function isRoute(element: Element, fragment: string): boolean {
  const key = decode(fragment.split('?')[0]!)
  return key !== '' && !key.startsWith('fastslam-') && key !== linkKey(element) && !document.getElementById(key)
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
