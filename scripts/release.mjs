// npm run release: makes and checks all that a release consists of, and uploads nothing; what uploads is .github/workflows/release.yml, after this.
// `-- --tag v0.1.0`: for this tag, which must be the version everywhere. `--singles lap,em` as for a build.
import { readFileSync, rmSync } from 'node:fs'
import { join } from 'node:path'
import { build, dist, singlesAsked } from './build.mjs'
import { buildPackages } from './check.mjs'
import { putDownloads } from './downloads.mjs'
import { cache, isMain, main, root, run, say, step, StepError } from './lib.mjs'
import { writeOffline } from './offline.mjs'
import { packNpm, packWheel } from './package.mjs'
import { python } from './python.mjs'
import { singlePrograms } from './registry.mjs'
import { publish } from './versions.mjs'

/** Where the version stands, and how: the first match is it. @type {[file: string, version: RegExp][]} */
export const places = [
  ['Cargo.toml', /^version = "(.+?)"/m],
  ['package.json', /^ {2}"version": "(.+?)"/m],
  ['widgets/npm/package.json', /^ {2}"version": "(.+?)"/m],
  ['widgets/python/pyproject.toml', /^version = "(.+?)"/m],
  ['CITATION.cff', /^version: (\S+)/m],
]

/**
 * The version, which is one in all its places; of a tag it is that, and the changelog has a heading for it.
 * @param {(file: string) => string} read @param {string} [tag]
 */
export function theVersion(read, tag) {
  const found = places.map(([file, version]) => /** @type {const} */ ([file, version.exec(read(file))?.[1] ?? 'none']))
  const [[, version]] = /** @type {[readonly [string, string]]} */ (/** @type {unknown} */ (found))
  if (found.some(([, other]) => other !== version)) throw new StepError(`The version is not one: ${found.map(([file, other]) => `${file} has ${other}`).join(', ')}.`)
  if (tag !== undefined && tag !== `v${version}`) throw new StepError(`The tag is ${tag}, and the version ${version}: the tag of a release is v and its version.`)
  if (tag !== undefined && !read('CHANGELOG.md').includes(`\n## [${version}]`)) throw new StepError(`CHANGELOG.md has no heading [${version}].`, '*Unreleased* becomes it.')
  return version
}

/** As npm would upload it, without uploading. @param {string} packed */
const tryNpm = packed => run('npm', ['publish', '--dry-run', packed])

/** @param {string} wheel */
const tryWheel = async wheel => run(await python('release', 'twine'), ['-m', 'twine', 'check', '--strict', wheel])

/** Into a folder that is new, as nothing is published by this. @param {string[]} downloads */
function trySite(downloads) {
  const folder = cache('release', 'site')
  rmSync(folder, { recursive: true, force: true })
  publish(dist, folder)
  putDownloads(folder, downloads)
}

if (isMain(import.meta)) {
  await main(async () => {
    const given = process.argv.indexOf('--tag')
    const tag = given < 0 ? undefined : (process.argv[given + 1] ?? '')
    await step('One version in all places', async () => theVersion(file => readFileSync(join(root, file), 'utf8'), tag))
    await build(singlesAsked(singlePrograms), { offline: true })
    let [npm, wheel] = ['', '']
    await step('npm package', async () => tryNpm((npm = await packNpm())))
    await step('Python wheel', async () => tryWheel((wheel = await packWheel())))
    await step('Crates, built from their packages', buildPackages)
    await step('Site with its downloads', async () => trySite([npm, wheel, ...(await writeOffline())]))
    say('Nothing was uploaded.')
  })
}
