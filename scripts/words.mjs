// npm run words: how long the chapter is, by section: what is open, and all of it. Formulas, listings, captions, works and terms are not counted.
import { renderChapter } from './chapter/chapter.mjs'
import { total, wordsOf } from './chapter/count.mjs'
import { isMain, main, root, say } from './lib.mjs'

/** The words of the chapter as it stands. */
export async function chapterWords() {
  const { pages } = await renderChapter(root)
  const [chapter, solutions] = ['index.html', 'solutions.html'].map(name => wordsOf({ type: 'root', children: pages[name]?.body ?? [] }))
  // Solutions are folds of the chapter, though on a page of their own.
  return (chapter ?? []).map(count => (count.id === 'exercises' ? { ...count, whole: count.whole + total(solutions ?? []).whole } : count))
}

if (isMain(import.meta)) {
  await main(async () => {
    const counts = await chapterWords()
    const row = (/** @type {{ id: string, open: string | number, whole: string | number }} */ { id, open, whole }) => say(`${id.padEnd(24)}${String(open).padStart(8)}${String(whole).padStart(8)}`)
    row({ id: 'section', open: 'open', whole: 'whole' })
    for (const count of counts) row(count)
    row(total(counts))
  })
}
