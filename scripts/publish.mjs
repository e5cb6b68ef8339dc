// npm run site -- FOLDER: builds the site and puts it into a folder with its downloads; the folder keeps the versions that it has.
// `-- FOLDER --singles` as for a build.
import { resolve } from 'node:path'
import { askForSite } from './address.mjs'
import { build, dist, singlesAsked } from './build.mjs'
import { makeDownloads, putDownloads } from './downloads.mjs'
import { main, say, step, StepError } from './lib.mjs'
import { publish } from './versions.mjs'

await main(async () => {
  const named = process.argv[2]
  if (!named || named.startsWith('--')) throw new StepError('Into which folder?', 'npm run site -- FOLDER')
  await askForSite()
  await build(singlesAsked(), { offline: true })
  /** @type {string[]} */
  let made = []
  await step('Downloads', async () => void (made = await makeDownloads()))
  await step(`The site in ${resolve(named)}`, async () => {
    for (const name of publish(dist, resolve(named))) say(`v/${name}/ stays as it was published, and what was built now differs from it: raise the version when you release it.`)
    putDownloads(resolve(named), made)
  })
})
