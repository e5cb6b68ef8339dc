// What lies beside the chapter for other pages: a page of each figure for frames, with its oEmbed answer, the manifest and the types of
// the elements, and the script of one file for notebooks.
import { copyFileSync, readdirSync, readFileSync } from 'node:fs'
import { join } from 'node:path'
import { site } from './address.mjs'
import { dist } from './build.mjs'
import { declare, figures, manifest, types, write } from './elements.mjs'
import { root, StepError } from './lib.mjs'
import { alsoUsed, programs } from './registry.mjs'
import { notebook, singleFile } from './single.mjs'
import { filesOf, listVersions, version, writeVersion } from './versions.mjs'

/** @typedef {import('./elements.mjs').FigureInfo} FigureInfo */

/** @param {string} text */
export const escape = text => text.replace(/[&"<>]/g, character => `&#${character.charCodeAt(0)};`)

/** @typedef {Pick<FigureInfo, 'tag' | 'name' | 'title' | 'describe' | 'version'>} Framed */

/** The picture of a figure, as the build named it; undefined of one that is new and has none yet. @param {Pick<Framed, 'tag'>} figure @param {string} shade @param {string} folder */
function pictureFile({ tag }, shade, folder) {
  const name = readdirSync(join(folder, 'assets')).find(file => new RegExp(`^${tag}-${shade}-[\\w-]{8}\\.png$`).test(file))
  return name && `assets/${name}`
}

/** Width and height of a PNG [px]. @param {string} path */
function pngSize(path) {
  const bytes = readFileSync(path)
  return [bytes.readUInt32BE(16), bytes.readUInt32BE(20)]
}

/** The element with its picture, as a page without script shows it. @param {Framed} figure @param {string} folder */
function element(figure, folder) {
  const light = pictureFile(figure, 'light', folder)
  if (!light) return `<${figure.tag} fit></${figure.tag}>`
  const [width, height] = pngSize(join(folder, light))
  return (
    `<${figure.tag} fit><picture><source srcset="./${pictureFile(figure, 'dark', folder)}" media="(prefers-color-scheme: dark)" />` +
    `<img src="./${light}" width="${width}" height="${height}" loading="lazy" alt="${escape(`${figure.title}. ${figure.describe}`)}" /></picture></${figure.tag}>`
  )
}

/** @param {Framed} figure @param {Codes} codes @param {string} folder @param {string} address */
function oembed(figure, codes, folder, address) {
  const [width, height] = [codes.FRAME_WIDTH, codes.frameHeight(figure.tag)]
  const light = pictureFile(figure, 'light', folder)
  const [thumbnailWidth, thumbnailHeight] = light ? pngSize(join(folder, light)) : []
  return {
    version: '1.0',
    type: 'rich',
    title: figure.title,
    provider_name: 'FastSLAM and Rao-Blackwellization',
    provider_url: address,
    width,
    height,
    html: codes.embedCode('iframe', { tag: figure.tag, attributes: [['v', String(figure.version)]] }, address, figure.title),
    ...(light && { thumbnail_url: address + light, thumbnail_width: thumbnailWidth, thumbnail_height: thumbnailHeight }),
  }
}

/** @typedef {typeof import('../widgets/elements/embed-code')} Codes */

/** The functions that write embed codes, which the elements have as well. */
export async function embedCodes() {
  const { runnerImport } = await import('vite')
  const { module } = await runnerImport(join(root, 'widgets', 'elements', 'embed-code.ts'), { configFile: false, logLevel: 'silent' })
  return /** @type {Codes} */ (module)
}

/**
 * A page for frames for each figure. What needs a whole address (canonical links, pictures for other sites, oEmbed) is left out where there is none.
 * @param {string} folder of the site @param {string} address where it will be, or empty @param {Framed[]} all @param {Codes} codes
 */
export function writePages(folder, address, all, codes) {
  const page = readFileSync(join(folder, 'embed.html'), 'utf8')
  for (const figure of all) {
    const file = `embed-${figure.name}.html`
    const [title, picture] = [escape(figure.title), pictureFile(figure, 'light', folder)]
    const head = [
      `<title>${title}</title>`,
      `<meta property="og:title" content="${title}" />`,
      ...(address && [
        `<link rel="canonical" href="${address}${file}" />`,
        `<link rel="alternate" type="application/json+oembed" href="./oembed/${figure.name}.json" title="${title}" />`,
        ...(picture ? [`<meta property="og:image" content="${address}${picture}" />`] : []),
      ]),
    ].join('\n    ')
    const own = page.replace(/<title>.*?<\/title>/, head).replace(/(<div id="figure">)/, `$1\n      ${element(figure, folder)}`)
    if (!own.includes(head) || !own.includes(`<${figure.tag}`)) throw new StepError('embed.html has no title or no box to put a figure in.')
    write(join(folder, file), own)
    if (address) write(join(folder, 'oembed', `${figure.name}.json`), `${JSON.stringify(oembed(figure, codes, folder, address), undefined, 2)}\n`)
  }
}

/**
 * The files of an assignment, from which the page on embedding zips packages: what its page loads whatever the figure, and what each figure has
 * besides; of other figures nothing is taken.
 * @param {string} folder of the site @param {Pick<Framed, 'tag' | 'name'>[]} all
 */
export function taskFiles(folder, all) {
  const [there, found] = [readdirSync(folder), filesOf(folder, ['task.html'])]
  /** Programs and pictures are those of figures, and the example that of logs; undefined for what any page may need. @param {string} file */
  const owners = file => {
    const program = /^fastslam-([a-z-]+)-[\w-]{8}\.wasm$/.exec(file)?.[1]
    if (program) return all.filter(figure => programsAsked(figure, there).includes(program)).map(({ name }) => name)
    const picture = /^assets\/fastslam-([a-z-]+?)(-poster)?-(light|dark)-[\w-]{8}\.png$/.exec(file)?.[1]
    return picture ? [picture] : file === 'example.clf.gz' ? ['log'] : undefined
  }
  const common = found.filter(file => !owners(file))
  const own = all.map(({ name }) => [name, found.filter(file => owners(file)?.includes(name)).sort()])
  return { common: [...common, 'licences.txt', 'sbom.cdx.json'].sort(), figures: Object.fromEntries(own) }
}

/** The programs that a figure may ask for on a page of its own. @param {Pick<Framed, 'tag' | 'name'>} figure @param {string[]} there files of the site */
function programsAsked({ tag, name }, there) {
  const own = [name, ...(alsoUsed[name] ?? [])]
  const isThere = (/** @type {string} */ program) => there.some(file => new RegExp(`^fastslam-${program}-[\\w-]{8}\\.wasm$`).test(file))
  return own.every(isThere) ? own : [...own, programs.get(tag) ?? '']
}

export async function writeFrames() {
  const [all, address] = [figures(), site()]
  writePages(dist, address, all, await embedCodes())
  // Under names that stay: codes on other pages have them for where the script does not arrive.
  for (const figure of all) {
    const picture = pictureFile(figure, 'light', dist)
    if (picture) copyFileSync(join(dist, picture), join(dist, `embed-${figure.name}.png`))
  }
  await declare()
  write(join(dist, 'custom-elements.json'), `${JSON.stringify(manifest(all), undefined, 2)}\n`)
  write(join(dist, 'fastslam.d.ts'), types(all))
  // Imported late: set-up may be what installs the packages that it stands on.
  const { notices } = await import('./notices.mjs')
  write(join(dist, 'licences.txt'), notices())
  const { sbom } = await import('./sbom.mjs')
  write(join(dist, 'sbom.cdx.json'), `${await sbom()}\n`)
  write(join(dist, 'task-files.json'), `${JSON.stringify(taskFiles(dist, all), undefined, 1)}\n`)
  // The code for MyST names it, and MyST copies that one file when a book is built: it must stand alone.
  write(join(dist, 'fastslam-anywidget.js'), await singleFile(notebook))
  writeVersion(dist, version())
  listVersions(dist)
  return `of ${all.length} figures${address ? `, for ${address}` : '; no canonical links and no oEmbed, as FASTSLAM_SITE does not say where the site will be'}`
}
