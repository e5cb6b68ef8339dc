// Folds of the chapter whose text is on a page of its own: it is fetched when a reader unfolds it. Without script, and where nothing can be
// fetched, a link leads there.
import { takeToPaper } from '../../widgets/elements/paper'
import { isReached } from '../../widgets/elements/reached'
import { watch } from './scrollers'

const pages = new Map<string, Promise<Document>>()

function fetched(address: string): Promise<Document> {
  const known = pages.get(address)
  if (known) return known
  const page = fetch(address).then(async answer => {
    if (!answer.ok) throw new Error(`${address}: ${answer.status}`)
    return new DOMParser().parseFromString(await answer.text(), 'text/html')
  })
  page.catch(() => pages.delete(address))
  pages.set(address, page)
  return page
}

/** Lets links lead to this page where their places are here now, and to the other where they are not. */
function follow(fold: Element, file: string): void {
  const isHere = (hash: string) => document.getElementById(decodeURIComponent(hash)) !== null
  for (const link of fold.querySelectorAll('a')) {
    const [, page, hash] = /^(?:\.\/)?(index\.html)?#(.*)$/.exec(link.getAttribute('href')!) ?? []
    if (hash !== undefined) link.setAttribute('href', page || isHere(hash) ? `#${hash}` : `${file}#${hash}`)
  }
  for (const link of document.querySelectorAll<HTMLAnchorElement>(`a[href^="${file}#"]`)) {
    if (isHere(link.hash.slice(1))) link.setAttribute('href', link.hash)
  }
}

/** What the link of a fold leads to, in its place; of a file that carries all it needs it is there already. */
async function fill(fold: HTMLElement): Promise<void> {
  const link = fold.querySelector<HTMLAnchorElement>(':scope > p:only-child > a:only-child')
  if (link) {
    const address = link.href.replace(/#.*/, '')
    const page = await fetched(address)
    const [, ...content] = page.getElementById(link.hash.slice(1))!.parentElement!.childNodes
    fold.replaceChildren(...content)
    follow(fold, link.getAttribute('href')!.replace(/#.*/, ''))
    watch(fold)
  }
  if (!fold.querySelector('.check')) return
  const { follow: grade } = await import('./checks')
  grade(fold, isReached)
}

const loads = [...document.querySelectorAll<HTMLDetailsElement>('details.elsewhere')].map(details => {
  let filling: Promise<void> | undefined
  // Where it fails the link is still there, and the next time may be a better one.
  const load = () => (filling ??= fill(details.querySelector('.fold')!).catch(() => void (filling = undefined)))
  details.addEventListener('toggle', () => void (details.open && load()))
  return { details, load }
})

/** Leads on whoever followed an old link: its place was on this page, and is in a fold now that is fetched. */
async function arrive(): Promise<void> {
  const id = location.hash.slice(1)
  if (!id || id.includes('?') || document.getElementById(id)) return
  for (const { details, load } of loads) {
    const link = details.querySelector<HTMLAnchorElement>('.fold > p:only-child > a:only-child')
    const page = link && (await fetched(link.href.replace(/#.*/, '')))
    if (!page?.getElementById(link!.hash.slice(1))?.parentElement?.contains(page.getElementById(id))) continue
    details.open = true
    await load()
    // Goes there as to any place, and unfolds what it stands in.
    if (location.hash.slice(1) === id) location.replace(location.hash)
    return
  }
}
const nothing = () => {}
// Where nothing can be fetched the page stays at its beginning, with links to the others.
const lead = () => void arrive().catch(nothing)

takeToPaper({ load: () => Promise.all(loads.map(({ load }) => load())).then(nothing), toPaper: nothing, offPaper: nothing }, new AbortController().signal)
lead()
addEventListener('hashchange', lead)
