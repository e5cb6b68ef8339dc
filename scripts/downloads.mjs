// Downloads of the site: wheel, npm package, offline files and SCORM packages in its folder downloads/, and their list on downloads.html. Only what
// is put somewhere for others has them (npm run site, npm run release): they take a minute, and nobody needs them to see the chapter.
import { copyFileSync, mkdirSync, readFileSync, statSync, writeFileSync } from 'node:fs'
import { basename, join } from 'node:path'
import { h } from 'hastscript'
import { toHtml } from 'hast-util-to-html'
import { figures } from './elements.mjs'
import { StepError } from './lib.mjs'
import { writeOffline } from './offline.mjs'
import { packNpm, packWheel } from './package.mjs'

/** Where the page says that there are none: what scripts/chapter makes of `::downloads`. */
const place = /<div id="made">[^]*?<\/div>/

/** Makes them from the site that was built. @returns {Promise<string[]>} the files */
export const makeDownloads = async () => [await packNpm(), await packWheel(), ...(await writeOffline())]

/**
 * Puts files into downloads/ of a site, beside what is there of earlier versions, and lists them on its page.
 * @param {string} folder of the site @param {string[]} files
 */
export function putDownloads(folder, files) {
  const page = join(folder, 'downloads.html')
  const html = readFileSync(page, 'utf8')
  if (!place.test(html)) throw new StepError('downloads.html has no place for what there is.')
  mkdirSync(join(folder, 'downloads'), { recursive: true })
  for (const file of files) copyFileSync(file, join(folder, 'downloads', basename(file)))
  const named = (/** @type {RegExp} */ name) => {
    const file = files.find(file => name.test(basename(file)))
    if (!file) throw new StepError(`There is no download named ${name.source}.`)
    return h('td', h('a', { href: `./downloads/${basename(file)}`, download: true }, basename(file)), `, ${(statSync(file).size / 1e6).toFixed(2)}\u00a0MB`)
  }
  const row = (/** @type {string} */ title, /** @type {import('hast').Element[]} */ ...cells) => h('tr', h('td', title), cells)
  const packages = [
    row('npm package', named(/\.tgz$/)),
    row('Wheel for notebooks', named(/\.whl$/)),
    row('The whole chapter', named(/^chapter\.html$/)),
    row('Licences of what they hold', named(/^licences\.txt$/)),
    row('What they consist of (CycloneDX)', named(/^sbom\.cdx\.json$/)),
  ]
  const each = figures().map(({ tag, title }) => row(title, named(new RegExp(`^${tag}\\.html$`)), named(new RegExp(`^${tag}-scorm\\.zip$`))))
  const head = (/** @type {string[]} */ ...names) => h('thead', h('tr', names.map(name => h('th', { scope: 'col' }, name))))
  const list = h('div', { id: 'made' }, [
    h('figure.table', h('div.scroll', h('table', head('What', 'File'), h('tbody', packages)))),
    h('figure.table', h('div.scroll', h('table', head('Figure', 'One file', 'SCORM 1.2'), h('tbody', each)))),
  ])
  writeFileSync(page, html.replace(place, () => toHtml(list)))
}
