// Folds of the chapter whose text is on a page of its own: it is fetched when a reader unfolds it. Without script, and where nothing can be
// fetched, a link leads there.
import { isReached } from '../../widgets/elements/reached'
import { watch } from './scrollers'

const pages = new Map<string, Promise<Document>>()

function fetched(address: string): Promise<Document> {
  const page = pages.get(address) ?? fetch(address).then(async answer => {
    if (!answer.ok) throw new Error(`${address}: ${answer.status}`)
    return new DOMParser().parseFromString(await answer.text(), 'text/html')
  })
  pages.set(address, page)
  return page
}

/** What the link of a fold leads to, in its place; of a file that carries all it needs it is there already. */
async function fill(fold: HTMLElement): Promise<void> {
  const link = fold.querySelector<HTMLAnchorElement>(':scope > p:only-child > a:only-child')
  if (link) {
    const address = link.href.replace(/#.*/, '')
    const page = await fetched(address).catch(error => {
      pages.delete(address) // the next time may be a better one
      throw error
    })
    const [, ...content] = page.getElementById(link.hash.slice(1))!.parentElement!.childNodes
    fold.replaceChildren(...content)
    // Its links to the chapter are links within this page.
    for (const inner of fold.querySelectorAll('a')) inner.setAttribute('href', inner.getAttribute('href')!.replace(/^(\.\/)?index\.html(?=#)/, ''))
    watch(fold)
  }
  const { follow } = await import('./checks')
  follow(fold, isReached)
}

for (const details of document.querySelectorAll<HTMLDetailsElement>('details.elsewhere')) {
  let filling: Promise<void> | undefined
  details.addEventListener('toggle', () => {
    // Without it the link is still there.
    if (details.open) filling ??= fill(details.querySelector('.fold')!).catch(() => void (filling = undefined))
  })
}
