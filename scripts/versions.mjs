// Versions that are kept: v/<version>/ of the site has fastslam.js, the pages for frames and all that these load, for pages that name a version
// and go on getting exactly those bytes. What its fastslam.js loads it checks by hashes, and its own hash is in v/versions.json.
import { createHash } from 'node:crypto'
import { copyFileSync, cpSync, existsSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { dirname, join } from 'node:path'
import { root, StepError } from './lib.mjs'

/** The version that this is. @returns {string} */
export const version = () => JSON.parse(readFileSync(join(root, 'package.json'), 'utf8')).version

/** What an attribute `integrity` says of a file. @param {string | Buffer} content */
export const integrityOf = content => `sha384-${createHash('sha384').update(content).digest('base64')}`

/**
 * These files of the site, and what they load: found by the names in what is found, as a page finds them.
 * @param {string} folder of the site @param {string[]} begin @returns {string[]}
 */
export function filesOf(folder, begin) {
  const there = readdirSync(folder, { recursive: true, encoding: 'utf8' }).map(file => file.replaceAll('\\', '/')).sort()
  const named = there.filter(file => /^(assets\/)?[\w-]+-[\w-]{8}\.(js|css|json|wasm|png)$|^(arrived\.js|favicon\.svg|example\.clf\.gz)$/.test(file))
  const found = new Set(begin)
  // A set that grows while it is walked: what is added is visited.
  for (const file of found) {
    if (!/\.(html|js|css)$/.test(file)) continue
    const text = readFileSync(join(folder, file), 'utf8')
    for (const other of named) if (text.includes(other.replace(/^assets\//, ''))) found.add(other)
  }
  return [...found]
}

/**
 * Puts a version of the site in `folder` into v/<version>/ there, in place of what is there of it.
 * @param {string} folder @param {string} name of the version
 */
export function writeVersion(folder, name) {
  const to = join(folder, 'v', name)
  rmSync(to, { recursive: true, force: true })
  const there = readdirSync(folder).sort()
  const frames = there.filter(file => /^embed(-[a-z-]+)?\.html$/.test(file))
  const files = filesOf(folder, ['fastslam.js', ...frames])
  for (const file of [...files, ...there.filter(file => /^(embed-[a-z-]+\.png|licences\.txt|sbom\.cdx\.json)$/.test(file))]) {
    mkdirSync(dirname(join(to, file)), { recursive: true })
    copyFileSync(join(folder, file), join(to, file))
  }
  const read = (/** @type {string} */ file) => readFileSync(join(to, file))
  const rewrite = (/** @type {string} */ file, /** @type {RegExp} */ what, /** @type {string} */ by) => {
    const text = read(file).toString()
    if (!what.test(text)) return false
    writeFileSync(join(to, file), text.replace(what, () => by))
    return true
  }
  // The answer to oEmbed is the site's.
  for (const file of frames) rewrite(file, /<link rel="alternate"[^>]*>\s*/, '')
  // Without what few pages load later: a browser checks no scripts of workers, and the table of laps would be a quarter of all there is to load.
  const scripts = filesOf(folder, ['fastslam.js']).filter(file => file.endsWith('.js') && file !== 'fastslam.js' && !/^assets\/(worker|lap-table)-/.test(file))
  // What scripts fetch may be one of these, first, as that changes scripts.
  const fetched = files.filter(file => /\.(wasm|json|gz)$/.test(file)).map(file => integrityOf(read(file)))
  if (!scripts.filter(file => rewrite(file, /\bintegrity:(""|''|``)/, `integrity:${JSON.stringify(fetched.join(' '))}`)).length) throw new StepError('No script of the figures says where it checks what it fetches.')
  const sums = Object.fromEntries(scripts.map(file => [file, integrityOf(read(file))]))
  if (!rewrite('fastslam.js', /(?<=^const sums = )\{\}/m, JSON.stringify(sums))) throw new StepError('fastslam.js has no place for the hashes of what it loads.')
}

/** Writes v/versions.json: the hash of each version's fastslam.js. @param {string} folder */
export function listVersions(folder) {
  const names = readdirSync(join(folder, 'v'), { withFileTypes: true }).flatMap(entry => (entry.isDirectory() ? [entry.name] : []))
  const all = names.sort((a, b) => a.localeCompare(b, 'en', { numeric: true })).map(name => [name, integrityOf(readFileSync(join(folder, 'v', name, 'fastslam.js')))])
  writeFileSync(join(folder, 'v', 'versions.json'), `${JSON.stringify(Object.fromEntries(all), undefined, 1)}\n`)
}

/**
 * Puts a site into a folder that may have an earlier one. Versions that are there stay what they are, and nothing is taken away: pages that are open
 * still ask for files of before.
 * @param {string} site @param {string} folder @returns {string[]} the versions that are there and would be others by now
 */
export function publish(site, folder) {
  const names = existsSync(join(folder, 'v')) ? readdirSync(join(folder, 'v')) : []
  const isKept = (/** @type {string} */ path) => names.some(name => path === join(site, 'v', name))
  cpSync(site, folder, { recursive: true, filter: path => !isKept(path) })
  listVersions(folder)
  const script = (/** @type {string} */ at, /** @type {string} */ name) => readFileSync(join(at, 'v', name, 'fastslam.js'), 'utf8')
  return names.filter(name => existsSync(join(site, 'v', name, 'fastslam.js')) && script(site, name) !== script(folder, name))
}
