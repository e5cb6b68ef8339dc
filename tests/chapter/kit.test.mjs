// The kit draws anybody's figure: it stands on none of our crates, and a whole figure is short.
import assert from 'node:assert/strict'
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import { test } from 'node:test'
import { capture, root } from '../../scripts/lib.mjs'

test('of our crates the kit stands on its catalogue of messages alone, also for its tests', () => {
  const tree = capture('cargo', 'tree', '--locked', '-p', 'fastslam-figures-kit', '-e', 'all', '--prefix', 'none', '--format', '{p}') ?? ''
  const ours = new Set([...tree.matchAll(/^fastslam\S*/gm)].map(([name]) => name))
  assert.deepEqual([...ours].sort(), ['fastslam-figures-catalogue', 'fastslam-figures-kit'])
})

test('a whole figure, its test included, has at most 40 lines of code', () => {
  const lines = readFileSync(join(root, 'widgets', 'kit', 'examples', 'pi.rs'), 'utf8').split('\n')
  const code = lines.filter(line => line.trim() !== '' && !line.trim().startsWith('//'))
  assert.ok(code.length <= 40, `${code.length} lines`)
})
