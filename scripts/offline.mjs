// npm run offline: each figure, and the whole chapter, as one HTML file that works from a stick or an e-mail, opened by a double click;
// and each figure as a SCORM 1.2 package for learning systems, which keeps a learner's state. All in packages/offline/. Each carries the
// program of its figure, and of what that uses besides; `-- --singles lap,em` makes them for these alone, and the others carry the chapter's.
import { existsSync, mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs'
import { dirname, join, posix } from 'node:path'
import { askForSite, site, wholeLinks } from './address.mjs'
import { build, dist, singlesAsked } from './build.mjs'
import { figures } from './elements.mjs'
import { fillFolds } from './folds.mjs'
import { isMain, kilobytes, main, root, say, step, StepError } from './lib.mjs'
import { chapterPrograms, partsOf, programFile, programs, singlePrograms, wholeOf } from './registry.mjs'
import { singleFile } from './single.mjs'
import { judge } from './sizes.mjs'

export const offline = join(root, 'packages', 'offline')
/** Of a file that carries all it needs. */
/** @type {string} */
const policy = JSON.parse(readFileSync(join(root, 'www', 'src', 'offline-policy.json'), 'utf8'))

/** @type {Record<string, string>} */
const types = { '.svg': 'image/svg+xml', '.png': 'image/png', '.woff2': 'font/woff2', '.webp': 'image/webp', '.jpg': 'image/jpeg' }

/** @param {string} folder @param {string} address */
const local = (folder, address) => (/^(\w+:|#|\/\/)/.test(address) ? undefined : join(dist, posix.join(folder, address.replace(/[?#].*$/, ''))))

/** @param {string} path */
function dataAddress(path) {
  const type = types[posix.extname(path)]
  if (!type) throw new StepError(`${path} is of no type that a file for offline use can hold.`)
  return `data:${type};base64,${readFileSync(path).toString('base64')}`
}

/**
 * A page of dist/ with all it loads inside, and its script as one that carries its program along. Pictures of figures stay out, as
 * there is nothing here that could fail to arrive.
 * @param {string} file @param {string} script
 */
function inlined(file, script) {
  const folder = posix.dirname(file)
  const styles = (/** @type {string} */ address) => {
    const path = local(folder, address) ?? ''
    const from = posix.dirname(posix.join(folder, address))
    return readFileSync(path, 'utf8').replace(/url\((['"]?)([^'")]+)\1\)/g, (whole, _, inner) => {
      const asset = local(from, inner)
      return asset ? `url(${dataAddress(asset)})` : whole
    })
  }
  let html = fillFolds(readFileSync(join(dist, file), 'utf8'), dist)
  html = html
    .replace(/<link[^>]*rel="(?:preload|modulepreload|canonical|alternate)"[^>]*>\s*/g, '')
    // All is inside, and nothing may come from outside, which the site's policy could not say.
    .replace(/(<meta http-equiv="Content-Security-Policy" content=")[^"]+/, `$1${policy}`)
    .replace(/<meta property="og:[^>]*>\s*/g, '')
    .replace(/<link[^>]*rel="stylesheet"[^>]*href="([^"]+)"[^>]*>/g, (_, address) => `<style>\n${styles(address)}</style>`)
    .replace(/(<link[^>]*rel="icon"[^>]*href=")([^"]+)("[^>]*>)/g, (_, before, address, after) => before + dataAddress(local(folder, address) ?? '') + after)
  html = html.replace(/<picture>.*?<\/picture>/gs, '').replace(/(<fastslam-[a-z-]+[^>]*>)\s*<img[^>]*>/g, '$1')
  html = html.replace(/(<img[^>]*src=")([^"]+)("[^>]*>)/g, (whole, before, address, after) => {
    const path = local(folder, address)
    return path ? before + dataAddress(path) + after : whole
  })
  html = html.replace(/<script[^>]*src="[^"]+"[^>]*><\/script>\s*/g, '')
  // The file is a version of its own, whatever becomes of the figures.
  html = wholeLinks(html, site()).replace(/(<div id="figure">\s*<fastslam-[a-z-]+)/, '$1 v="latest"')
  return html.replace('</body>', () => `<script type="module">\n${script.replaceAll('</script', '<\\/script')}</script>\n  </body>`)
}

const isMade = (/** @type {string} */ program) => existsSync(programFile(program))

/** What a figure's file carries: one program with all that it uses, or these apart; where they were not made, that of the chapter. @param {import('./elements.mjs').FigureInfo} figure */
function programsOf({ tag, name }) {
  const whole = wholeOf(name)
  if (isMade(whole)) return [whole]
  return partsOf(whole).every(isMade) ? partsOf(whole) : [programs.get(tag) ?? '']
}

/** What the chapter's file carries. */
function programsOfChapter() {
  const whole = wholeOf('log')
  return isMade(whole) ? [...chapterPrograms.filter(program => !partsOf(whole).includes(program)), whole] : chapterPrograms
}

/** The chapter as one file, with what unfolds in it. */
export const offlineChapter = async () => inlined('index.html', await singleFile(join(root, 'www', 'src', 'main.ts'), programsOfChapter()))

/** What writes the manifests of packages, which the page on embedding has as well. */
async function manifests() {
  const { runnerImport } = await import('vite')
  const { module } = await runnerImport(join(root, 'www', 'src', 'ims-manifest.ts'), { configFile: false, logLevel: 'silent' })
  return /** @type {typeof import('../www/src/ims-manifest')} */ (module)
}

/** Every figure's file and package, and the chapter. @returns {Promise<string[]>} the files */
export async function writeOffline() {
  const { zipSync, strToU8 } = await import('fflate')
  const { imsManifest } = await manifests()
  rmSync(offline, { recursive: true, force: true })
  mkdirSync(offline, { recursive: true })
  /** @type {string[]} */
  const files = []
  const put = (/** @type {string} */ name, /** @type {string | Uint8Array} */ content) => {
    const path = join(offline, name)
    mkdirSync(dirname(path), { recursive: true })
    writeFileSync(path, content)
    files.push(path)
    say(`  ${kilobytes(statSync(path).size).padStart(10)}  ${name}`)
    return statSync(path).size
  }
  const licences = readFileSync(join(dist, 'licences.txt'), 'utf8')
  put('licences.txt', licences)
  const sbom = readFileSync(join(dist, 'sbom.cdx.json'), 'utf8')
  put('sbom.cdx.json', sbom)
  const scorm = readFileSync(join(root, 'widgets', 'scorm', 'scorm.js'), 'utf8')
  for (const figure of figures()) {
    const carried = programsOf(figure)
    const script = await singleFile(join(root, 'www', 'src', 'embed.ts'), carried)
    const page = inlined(`embed-${figure.name}.html`, script)
    const size = put(`${figure.tag}.html`, page)
    if (carried[0] === wholeOf(figure.name)) say(`  ${await judge(`offline.${figure.name}`, size)}`)
    const started = page.replace('</body>', () => '<script defer src="scorm.js"></script>\n  </body>')
    // The same time in every package, so that the same figure gives the same file.
    const inside = { 'index.html': started, 'scorm.js': scorm, 'licences.txt': licences, 'sbom.cdx.json': sbom }
    const entries = { 'imsmanifest.xml': imsManifest({ identifier: figure.tag, title: figure.title, start: 'index.html', files: Object.keys(inside) }), ...inside }
    put(`${figure.tag}-scorm.zip`, zipSync(Object.fromEntries(Object.entries(entries).map(([name, text]) => [name, strToU8(text)])), { level: 9, mtime: '1980-01-01T00:00:00' }))
  }
  put('chapter.html', await offlineChapter())
  return files
}

if (isMain(import.meta)) {
  await main(async () => {
    await askForSite()
    await build(singlesAsked(singlePrograms), { offline: true })
    await step('Files for offline use, and SCORM packages', async () => `${(await writeOffline()).length} files in packages/offline/`)
  })
}
