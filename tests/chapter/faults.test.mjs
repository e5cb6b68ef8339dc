// Each deliberate fault still applies, and breaks what the code does: one that the build stumbles over shows nothing of the tests.
import assert from 'node:assert/strict'
import { execFileSync } from 'node:child_process'
import { cpSync, existsSync, mkdirSync, mkdtempSync, readdirSync, rmSync, symlinkSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { dirname, join } from 'node:path'
import { test } from 'node:test'
import { withUnused } from '../../scripts/elements.mjs'
import { capture, npmBin, root, run } from '../../scripts/lib.mjs'

const folder = join(root, 'tests', 'faults')

/** What git would have of the sources, and what the build has written for tsc. */
const written = ['widgets/elements/generated', 'widgets/pkg', 'www/generated']

/** A copy of the sources in a folder of its own, which is gone afterwards. @param {(copy: string) => Promise<void>} use */
async function inCopy(use) {
  const copy = mkdtempSync(join(tmpdir(), 'faults-'))
  try {
    const files = (capture('git', 'ls-files', '-z') ?? assert.fail('git tells no files')).split('\0').filter(file => file !== '' && existsSync(join(root, file)))
    for (const file of [...files, ...written]) {
      mkdirSync(dirname(join(copy, file)), { recursive: true })
      cpSync(join(root, file), join(copy, file), { recursive: true })
    }
    symlinkSync(join(root, 'node_modules'), join(copy, 'node_modules'))
    await use(copy)
  } finally {
    rmSync(copy, { recursive: true })
  }
}

/** Whether a patch applies, or can be taken back. @param {string} copy of the sources @param {string} patch @param {string[]} [how] */
function applies(copy, patch, how = []) {
  try {
    execFileSync('git', ['apply', ...how, join(folder, patch)], { cwd: copy, stdio: 'ignore' })
    return true
  } catch {
    return false
  }
}

test('every fault applies, and none is one of types', async () => {
  const faults = readdirSync(folder).filter(file => file.endsWith('.patch'))
  assert.ok(faults.length > 80, `${faults.length} faults`)
  await inCopy(async copy => {
    // As many at once as can be: where two are about the same lines, the second waits until the others are taken back.
    for (let left = faults; left.length > 0;) {
      const applied = left.filter(patch => applies(copy, patch))
      assert.equal(applied[0], left[0], `${left[0]} no longer applies: make the same fault in the code of today`)
      for (const project of ['.', 'scripts']) await run(npmBin('tsc'), ['--noEmit', ...withUnused, '-p', join(copy, project)], { quiet: true })
      for (const patch of applied.toReversed()) assert.ok(applies(copy, patch, ['--reverse']), patch)
      left = left.filter(patch => !applied.includes(patch))
    }
  })
})
