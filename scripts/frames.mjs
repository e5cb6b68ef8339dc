// What lies beside the chapter for other pages: a page of each figure for frames, with its oEmbed answer, the manifest and the types of
// the elements, and the script of one file for notebooks.
import { readdirSync, readFileSync } from 'node:fs'
import { join } from 'node:path'
import { dist } from './build.mjs'
import { figures, manifest, types, write } from './elements.mjs'
import { root, StepError } from './lib.mjs'
import { notebook, singleFile } from './single.mjs'

/** Where the site will be: oEmbed needs whole addresses. @returns {string} */
export const site = () => (process.env.FASTSLAM_SITE ?? 'http://localhost:8017/').replace(/\/*$/, '/')

/** @typedef {import('./elements.mjs').FigureInfo} FigureInfo */

/** @param {string} text */
export const escape = text => text.replace(/[&"<>]/g, character => `&#${character.charCodeAt(0)};`)

/** The picture of a figure, as the build named it. @param {FigureInfo} figure @param {string} shade */
export function pictureFile({ tag }, shade) {
  const name = readdirSync(join(dist, 'assets')).find(file => new RegExp(`^${tag}-${shade}-[\\w-]{8}\\.png$`).test(file))
  if (!name) throw new StepError(`The build did not write a ${shade} picture of ${tag}.`)
  return `assets/${name}`
}

/** Width and height of a PNG [px]. @param {string} path */
function pngSize(path) {
  const bytes = readFileSync(path)
  return [bytes.readUInt32BE(16), bytes.readUInt32BE(20)]
}

/** The element with its picture, as a page without script shows it. @param {FigureInfo} figure */
export function element(figure) {
  const light = pictureFile(figure, 'light')
  const [width, height] = pngSize(join(dist, light))
  return (
    `<${figure.tag} fit><picture><source srcset="./${pictureFile(figure, 'dark')}" media="(prefers-color-scheme: dark)" />` +
    `<img src="./${light}" width="${width}" height="${height}" loading="lazy" alt="${escape(`${figure.title}. ${figure.describe}`)}" /></picture></${figure.tag}>`
  )
}

/** @param {FigureInfo} figure @param {typeof import('../widgets/elements/embed-code')} codes */
function oembed(figure, codes) {
  const [width, height] = [codes.FRAME_WIDTH, codes.frameHeight(figure.tag)]
  const light = pictureFile(figure, 'light')
  const [thumbnailWidth, thumbnailHeight] = pngSize(join(dist, light))
  return {
    version: '1.0',
    type: 'rich',
    title: figure.title,
    provider_name: 'FastSLAM and Rao-Blackwellization',
    provider_url: site(),
    width,
    height,
    html: codes.embedCode('iframe', { tag: figure.tag, attributes: [['v', String(figure.version)]] }, site(), figure.title),
    thumbnail_url: site() + light,
    thumbnail_width: thumbnailWidth,
    thumbnail_height: thumbnailHeight,
  }
}

/** The functions that write embed codes, which the elements have as well. */
export async function embedCodes() {
  const { runnerImport } = await import('vite')
  const { module } = await runnerImport(join(root, 'widgets', 'elements', 'embed-code.ts'), { configFile: false, logLevel: 'silent' })
  return /** @type {typeof import('../widgets/elements/embed-code')} */ (module)
}

export async function writeFrames() {
  const [all, codes] = [figures(), await embedCodes()]
  const page = readFileSync(join(dist, 'embed.html'), 'utf8')
  for (const figure of all) {
    const file = `embed-${figure.name}.html`
    const head = [
      `<link rel="canonical" href="${site()}${file}" />`,
      `<link rel="alternate" type="application/json+oembed" href="./oembed/${figure.name}.json" title="${escape(figure.title)}" />`,
      `<meta property="og:title" content="${escape(figure.title)}" />`,
      `<meta property="og:image" content="${site()}${pictureFile(figure, 'light')}" />`,
    ]
    const own = page
      .replace(/<title>.*?<\/title>/, `<title>${escape(figure.title)}</title>\n    ${head.join('\n    ')}`)
      .replace(/(<div id="figure">)/, `$1\n      ${element(figure)}`)
    if (!own.includes(head[0] ?? '') || !own.includes(`<${figure.tag}`)) throw new StepError('dist/embed.html has no title or no box to put a figure in.')
    write(join(dist, file), own)
    write(join(dist, 'oembed', `${figure.name}.json`), `${JSON.stringify(oembed(figure, codes), undefined, 2)}\n`)
  }
  write(join(dist, 'custom-elements.json'), `${JSON.stringify(manifest(all), undefined, 2)}\n`)
  write(join(dist, 'fastslam.d.ts'), types(all))
  // The code for MyST names it, and MyST copies that one file when a book is built: it must stand alone.
  write(join(dist, 'fastslam-anywidget.js'), await singleFile(notebook))
  return `of ${all.length} figures`
}
