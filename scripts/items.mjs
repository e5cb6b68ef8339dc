// npm run items: the public items of the crate `fastslam` by kind, as its documentation lists them on one page.
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import { capture, isMain, main, run, say, step, StepError } from './lib.mjs'

/** As many as there are: one more is decided here, and one less lowers it. */
const MOST = 197

/** How many of each kind. @param {string} page rustdoc’s, of all items of a crate */
export function itemsIn(page) {
  const [, ...parts] = page.split('<h3 id="')
  return Object.fromEntries(parts.map(part => [part.slice(0, part.indexOf('"')), part.split('<li>').length - 1]))
}

/** @param {Record<string, number>} items by kind @param {number} [most] */
export function judgeItems(items, most = MOST) {
  const counted = Object.values(items).reduce((sum, count) => sum + count, 0)
  const kinds = Object.entries(items).map(([kind, count]) => `${count} ${kind}`).join(', ')
  if (counted > most) throw new StepError(`The crate fastslam has ${counted} public items (${kinds}), ${counted - most} more than it had.`, '`pub(crate)` keeps an item to the crate.')
  if (counted < most) throw new StepError(`The crate fastslam has ${counted} public items (${kinds}), and ${most} stand in scripts/items.mjs.`, 'Lower the number there.')
  return `${counted} public items: ${kinds}`
}

/** Judges the items of the documentation that is there. */
export async function checkItems() {
  const target = JSON.parse(capture('cargo', 'metadata', '--no-deps', '--format-version', '1') ?? '{}').target_directory
  return judgeItems(itemsIn(readFileSync(join(target, 'doc', 'fastslam', 'all.html'), 'utf8')))
}

if (isMain(import.meta)) {
  await main(async () => {
    await step('Documentation (cargo doc)', () => run('cargo', ['doc', '--package', 'fastslam', '--no-deps', '--all-features']))
    say(`  ${await checkItems()}`)
  })
}
