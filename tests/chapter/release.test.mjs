// What releases: one version everywhere, and a workflow that runs what there is.
import assert from 'node:assert/strict'
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import { test } from 'node:test'
import { root } from '../../scripts/lib.mjs'
import { places, theVersion } from '../../scripts/release.mjs'

const read = (/** @type {string} */ file) => readFileSync(join(root, file), 'utf8')

test('the version is one, and so is that of a tag, for which the changelog has a heading', () => {
  const version = theVersion(read)
  assert.match(version, /^\d+\.\d+\.\d+$/)
  for (const [place] of places) {
    const changed = (/** @type {string} */ file) => (file === place ? read(file).replace(version, '9.9.9') : read(file))
    assert.throws(() => theVersion(changed), new RegExp(`The version is not one: .*${place} has 9\\.9\\.9`), place)
  }
  const released = (/** @type {string} */ file) => (file === 'CHANGELOG.md' ? `# Changelog\n\n## [${version}] – 2030-01-01\n` : read(file))
  assert.equal(theVersion(released, `v${version}`), version)
  assert.throws(() => theVersion(released, version), /the tag of a release is v and its version/)
  assert.throws(() => theVersion(file => (file === 'CHANGELOG.md' ? '# Changelog\n' : read(file)), `v${version}`), /no heading/)
})

test('the workflow that releases runs scripts and crates that there are, and tries all before it uploads', () => {
  const workflow = read('.github/workflows/release.yml')
  const { scripts } = JSON.parse(read('package.json'))
  const asked = [...workflow.matchAll(/npm run ([\w:]+)/g)].map(([, name]) => String(name))
  assert.deepEqual(asked.filter(name => !(name in scripts)), [])
  const published = [...workflow.matchAll(/cargo publish -p ([\w-]+)/g)].map(([, name]) => name)
  assert.deepEqual(published, ['fastslam', 'fastslam-log', 'fastslam-lab', 'fastslam-figures-catalogue', 'fastslam-figures-kit', 'fastslam-widgets', 'fastslam-cli'])
  const steps = workflow.match(/- (run|uses): .*/g) ?? []
  const upload = steps.findIndex(line => /publish/.test(line))
  assert.ok(steps.findIndex(line => line.includes('npm run release -- --tag')) < upload && upload > 0, steps.join('\n'))
})
