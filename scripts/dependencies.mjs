// What others' packages may be: from where, under which licence, and without known holes.
import { createRequire } from 'node:module'
import { capture, root, run, StepError } from './lib.mjs'

/** Licences under which a crate may be linked into what we ship: they ask for no more than to be named. */
const allowed = ['MIT', 'Apache-2.0', 'Apache-2.0 WITH LLVM-exception', 'BSD-2-Clause', 'BSD-3-Clause', 'Zlib', 'Unicode-3.0']
const cratesIo = 'registry+https://github.com/rust-lang/crates.io-index'

/** Every crate that the lock file names: from crates.io or of our own, and under one of the licences. */
export async function checkCrates() {
  const metadata = capture('cargo', 'metadata', '--locked', '--format-version', '1')
  if (metadata === undefined) throw new StepError('cargo metadata --locked fails.', 'Cargo.lock may not fit Cargo.toml: cargo update --workspace writes it anew.')
  /** @type {{ name: string, version: string, source: string | null, license: string | null, manifest_path: string }[]} */
  const crates = JSON.parse(metadata).packages
  const wrong = crates.flatMap(({ name, version, source, license, manifest_path }) => {
    const found = []
    if (source === null ? !manifest_path.startsWith(root) : source !== cratesIo) found.push(`comes from ${source ?? manifest_path}`)
    if (!permits(license)) found.push(`has the licence ${license ?? '(none named)'}`)
    return found.map(what => `${name} ${version} ${what}`)
  })
  const rule = `Crates come from crates.io, under ${allowed.join(', ')}.`
  if (wrong.length > 0) throw new StepError(wrong.join('\n'), rule)
  return `${crates.length} crates`
}

/** @param {string | null} license as a manifest has it: an SPDX expression, or in old ones names apart by `/` */
function permits(license) {
  const satisfies = createRequire(import.meta.url)('spdx-satisfies') // which set-up may only just have installed
  try {
    return license !== null && satisfies(license.replaceAll('/', ' OR '), allowed)
  } catch {
    return false // no expression at all
  }
}

/** The npm packages by the registry's list of known holes, where the registry has one. Not one of the tests: a hole found tomorrow does not make today's code wrong. */
export async function audit() {
  try {
    await run('npm', ['audit', '--audit-level', 'high'])
    return 'none of high severity'
  } catch (error) {
    const { output = '' } = /** @type {{ output?: string }} */ (error)
    if (/audit endpoint returned an error|ENOTFOUND|ECONNREFUSED|ECONNRESET|ETIMEDOUT/.test(output)) return 'skipped: the registry does not tell of any'
    throw error
  }
}
