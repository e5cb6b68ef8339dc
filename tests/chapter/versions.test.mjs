// Versions of the site that are kept: what is in their folders, and that nothing changes them.
import assert from 'node:assert/strict'
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { test } from 'node:test'
import { integrityOf, listVersions, publish, writeVersion } from '../../scripts/versions.mjs'

const built = {
  'index.html': 'the chapter',
  'fastslam.js': "const sums = {} // empty\nimport('./fastslam-abcdefgh.js')\nimport('./assets/figures-abcdefgh.js')\n",
  'fastslam-abcdefgh.js': 'fetch("./fastslam-page-ABCDEFGH.wasm",{integrity:""});import("./assets/worker-abcdefgh.js")',
  'fastslam-page-ABCDEFGH.wasm': 'program',
  'assets/figures-abcdefgh.js': 'import "./lap-abcdefgh.js"',
  'assets/lap-abcdefgh.js': 'lap',
  'assets/worker-abcdefgh.js': 'worker',
  'assets/page-index-abcdefgh.js': 'of the chapter',
  'embed.html': '<script src="./assets/embed-abcdefgh.js"></script>',
  'embed-lap.html': '<link rel="alternate" type="application/json+oembed" href="./oembed/lap.json" title="x" />\n<script src="./assets/embed-abcdefgh.js"></script>',
  'embed-lap.png': 'picture',
  'assets/embed-abcdefgh.js': 'import "../fastslam-abcdefgh.js"',
  'licences.txt': 'licences',
  'sbom.cdx.json': '{}',
}

/** @param {string} folder @param {Record<string, string>} files */
function fill(folder, files) {
  for (const [path, content] of Object.entries(files)) {
    mkdirSync(join(folder, path, '..'), { recursive: true })
    writeFileSync(join(folder, path), content)
  }
}

/** @param {(site: string, folder: string) => void} use */
function inFolders(use) {
  const above = mkdtempSync(join(tmpdir(), 'versions-'))
  try {
    fill(join(above, 'site'), built)
    use(join(above, 'site'), join(above, 'published'))
  } finally {
    rmSync(above, { recursive: true })
  }
}

const filesIn = (/** @type {string} */ folder) => readdirSync(folder, { recursive: true, encoding: 'utf8' }).filter(file => /\.\w+$/.test(file)).sort()

test('a version has what its script and its frames load and nothing of the chapter, and says what each of that has to be', () =>
  inFolders(site => {
    writeVersion(site, '1.2.3')
    listVersions(site)
    const version = join(site, 'v', '1.2.3')
    assert.deepEqual(filesIn(version), Object.keys(built).filter(file => !/index/.test(file)).sort())
    const text = (/** @type {string} */ file) => readFileSync(join(version, file), 'utf8')
    assert.doesNotMatch(text('embed-lap.html'), /oembed/)
    assert.ok(text('fastslam-abcdefgh.js').includes(`{integrity:"${integrityOf('program')}"}`))
    const sums = JSON.parse(/^const sums = (\{.*\}) /m.exec(text('fastslam.js'))?.[1] ?? '')
    const checked = ['assets/figures-abcdefgh.js', 'assets/lap-abcdefgh.js', 'fastslam-abcdefgh.js']
    assert.deepEqual(sums, Object.fromEntries(checked.map(file => [file, integrityOf(text(file))])))
    assert.deepEqual(JSON.parse(readFileSync(join(site, 'v', 'versions.json'), 'utf8')), { '1.2.3': integrityOf(text('fastslam.js')) })
    // What the site itself loads is as it was.
    for (const [file, content] of Object.entries(built)) assert.equal(readFileSync(join(site, file), 'utf8'), content)
  }))

test('a version without a place for its hashes is not made', () => {
  for (const [file, place] of /** @type {const} */ ([['fastslam.js', 'const sums = {}'], ['fastslam-abcdefgh.js', 'integrity']])) {
    inFolders(site => {
      fill(site, { [file]: built[file].replace(place, '') })
      assert.throws(() => writeVersion(site, '1.2.3'), /hashes|checks/)
    })
  }
})

test('the hash is the one that browsers compare', () => assert.equal(integrityOf("alert('Hello, world.');"), 'sha384-H8BRh8j48O9oYatfu5AZzq6A9RINhZO5H16dQZngK7T62em8MUt1FLm52t+eX6xO'))

test('a site that is built again keeps the versions that were published, to the byte, and lists them in their order', () =>
  inFolders((site, folder) => {
    writeVersion(site, '1.9.0')
    assert.deepEqual(publish(site, folder), [])
    const before = Object.fromEntries(filesIn(join(folder, 'v', '1.9.0')).map(file => [file, readFileSync(join(folder, 'v', '1.9.0', file), 'utf8')]))
    // The next build, of the same version at first: its other bytes are told, and published under the next.
    fill(site, { 'index.html': 'the next', 'assets/lap-abcdefgh.js': 'another lap' })
    writeVersion(site, '1.9.0')
    assert.deepEqual(publish(site, folder), ['1.9.0'])
    rmSync(join(site, 'v'), { recursive: true })
    writeVersion(site, '1.10.0')
    assert.deepEqual(publish(site, folder), [])
    assert.equal(readFileSync(join(folder, 'index.html'), 'utf8'), 'the next')
    for (const [file, content] of Object.entries(before)) assert.equal(readFileSync(join(folder, 'v', '1.9.0', file), 'utf8'), content, file)
    const listed = JSON.parse(readFileSync(join(folder, 'v', 'versions.json'), 'utf8'))
    assert.deepEqual(Object.keys(listed), ['1.9.0', '1.10.0'])
    for (const [name, sum] of Object.entries(listed)) assert.equal(sum, integrityOf(readFileSync(join(folder, 'v', name, 'fastslam.js'))))
    assert.equal(readFileSync(join(folder, 'v', '1.10.0', 'assets', 'lap-abcdefgh.js'), 'utf8'), 'another lap')
  }))
