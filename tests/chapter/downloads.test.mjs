// Downloads of the site: listed where they are, and said to be missing where they are not.
import assert from 'node:assert/strict'
import { copyFileSync, existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { test } from 'node:test'
import { dist } from '../../scripts/build.mjs'
import { putDownloads } from '../../scripts/downloads.mjs'
import { figures } from '../../scripts/elements.mjs'

const page = readFileSync(join(dist, 'downloads.html'), 'utf8')
const linked = (/** @type {string} */ html) => [...html.matchAll(/href="\.\/(downloads\/[^"]+)"/g)].map(([, file = '']) => file)
const names = (/** @type {string} */ version) => [`fastslam-widgets-${version}.tgz`, `fastslam_widgets-${version}-py3-none-any.whl`, 'chapter.html', 'licences.txt', 'sbom.cdx.json', ...figures().flatMap(({ tag }) => [`${tag}.html`, `${tag}-scorm.zip`])]

test('a site that was built without its downloads says so, and links to none', () => {
  assert.match(page, /built without its downloads\. <code>npm run site<\/code>/)
  assert.deepEqual(linked(page), [])
})

test('downloads are put where the page links to them, each with its size, beside those of earlier versions', () => {
  const folder = mkdtempSync(join(tmpdir(), 'downloads-'))
  try {
    mkdirSync(join(folder, 'made'))
    const files = (/** @type {string} */ version) => names(version).map((name, i) => {
      writeFileSync(join(folder, 'made', name), 'x'.repeat(1000 * (i + 1)))
      return join(folder, 'made', name)
    })
    const site = join(folder, 'site')
    mkdirSync(site)
    for (const version of ['1.0.0', '1.1.0']) {
      copyFileSync(join(dist, 'downloads.html'), join(site, 'downloads.html'))
      putDownloads(site, files(version))
      const html = readFileSync(join(site, 'downloads.html'), 'utf8')
      assert.deepEqual(linked(html).map(file => file.replace('downloads/', '')).sort(), names(version).sort())
      for (const file of linked(html)) assert.ok(existsSync(join(site, file)), file)
      assert.match(html, new RegExp(`fastslam-widgets-${version}\\.tgz</a>, 0\\.00\u00a0MB`))
      assert.doesNotMatch(html, /built without/)
    }
    assert.ok(existsSync(join(site, 'downloads', 'fastslam-widgets-1.0.0.tgz')))
    const [missing] = files('1.1.0').slice(-1)
    copyFileSync(join(dist, 'downloads.html'), join(site, 'downloads.html'))
    assert.throws(() => putDownloads(site, files('1.1.0').filter(file => file !== missing)), /no download named/)
  } finally {
    rmSync(folder, { recursive: true })
  }
})
