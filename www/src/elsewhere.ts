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
  return load
})

const nothing = () => {}
takeToPaper({ load: () => Promise.all(loads.map(load => load())).then(nothing), toPaper: nothing, offPaper: nothing }, new AbortController().signal)
