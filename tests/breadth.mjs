// Breadth: what is tested besides npm test, in units of six minutes at most. All of them are `npm run test:all`; CI takes a share at a time.

import { posix } from 'node:path'
import { singlePrograms } from '../scripts/registry.mjs'

/**
 * `seconds` is what it usually takes on two quiet cores, when all is built. The command is one of a shell in the repository's folder,
 * with the programs of npm packages on PATH.
 * @typedef {{ name: string, seconds: number, command: string }} Unit
 */

const page = (/** @type {string} */ specs) => `playwright test --config tests/e2e --grep @breadth --grep-invert @programs ${specs}`
/** Tests in Rust that npm test ignores. @param {string} which programs @param {string} [names] of tests */
const ignored = (which, names = '') => `cargo test --workspace --no-fail-fast ${which} -- --ignored --show-output ${names}`
/** For packages outside the workspace: where most of what they need is built. */
const shared = 'CARGO_TARGET_DIR="${CARGO_TARGET_DIR:-../../target}"'
/** Of what is run from a release: compiled without the optimisations across crates, which take minutes. */
const quick = 'CARGO_PROFILE_RELEASE_LTO=off CARGO_PROFILE_RELEASE_CODEGEN_UNITS=16 CARGO_PROFILE_BENCH_LTO=off CARGO_PROFILE_BENCH_CODEGEN_UNITS=16'

/** Programs of single figures, made, carried along by files for offline use, looked at to the last pixel, and weighed. @param {string[]} names */
const singles = names => `npm run offline -- --singles ${names} && playwright test --config tests/e2e --grep @programs && npm run size -- --singles ${names}`

/** Those of most work, in units of their own: what has landmarks, and what has grids. */
const [landmarks, grids] = [['conditioning', 'worked-example', 'joint', 'doors'], ['lap', 'resampling', 'graph', 'universes']]

/** @type {Unit[]} */
export const units = [
  // All sizes, themes, languages and figures on the page.
  { name: 'page-chapter', seconds: 60, command: page('/chapter.spec.ts') },
  { name: 'page-figures', seconds: 70, command: page('/conditioning.spec.ts /doors.spec.ts /em.spec.ts /graph.spec.ts /joint.spec.ts /prediction.spec.ts /reference.spec.ts /smoothing.spec.ts /universes.spec.ts') },
  { name: 'page-challenges', seconds: 60, command: page('/challenges.spec.ts') },
  { name: 'page-compare', seconds: 40, command: page('/compare.spec.ts /resampling.spec.ts') },
  { name: 'page-logs', seconds: 130, command: page('/log.spec.ts') },
  { name: 'page-one-screen', seconds: 60, command: page('/one-screen.spec.ts') },
  { name: 'page-screens', seconds: 85, command: page('/screens.spec.ts /heights.spec.ts') },
  { name: 'page-whole', seconds: 170, command: page('/whole.spec.ts') },
  { name: 'page-tasks', seconds: 120, command: page('/tasks.spec.ts') },
  { name: 'page-themes', seconds: 160, command: page('/checks.spec.ts /deck.spec.ts /german.spec.ts /options.spec.ts /styles.spec.ts /vignettes.spec.ts') },
  { name: 'page-embed', seconds: 160, command: page('/assign.spec.ts /embed.spec.ts /embed-docs.spec.ts /course.spec.ts /teachers.spec.ts /walk.spec.ts /worksheets.spec.ts') },
  // On a browser that tells late what is in sight and what has arrived, as a busy machine's does.
  { name: 'page-late', seconds: 200, command: 'FASTSLAM_LATE=150 playwright test --config tests/e2e --grep-invert @breadth /chapter.spec.ts /course.spec.ts /hosts.spec.ts /links.spec.ts /log.spec.ts /playback.spec.ts /programs.spec.ts /seen.spec.ts /trouble.spec.ts' },
  { name: 'page-packages', seconds: 60, command: page('/offline.spec.ts /package.spec.ts /pixels.spec.ts') },
  { name: 'programs-landmarks', seconds: 350, command: singles(landmarks) },
  { name: 'programs-grids', seconds: 360, command: singles(grids) },
  { name: 'programs-others', seconds: 330, command: singles(singlePrograms.filter(name => ![...landmarks, ...grids].includes(name))) },

  // Statistics over many seeds, whole recorded logs, all kept links, and the chapter's numbers by all their seeds.
  { name: 'laws-mapper', seconds: 200, command: ignored('--test all', 'mapper:: ring:: turned::') },
  { name: 'laws-others', seconds: 200, command: ignored('--test all', '--skip mapper:: --skip ring:: --skip turned::') },
  { name: 'laws-lab', seconds: 200, command: ignored('--lib') },
  { name: 'logs', seconds: 200, command: ignored('--test command_line') },
  { name: 'logs-numbers', seconds: 120, command: 'cargo build --workspace --profile test --bin fastslam && node --test --test-reporter=tap tests/readme/recorded.test.mjs' },
  { name: 'wasm-numbers', seconds: 150, command: 'node scripts/wasm-tests.mjs --include-ignored by_all_their_seeds' },

  // Deliberate faults, by the first figure of their names: filters, landmarks and fits, logs and laboratory, figures, boundary and
  // elements, instances and hosts, styles, scripts.
  { name: 'faults-filters', seconds: 300, command: 'npm run test:faults -- 0' },
  { name: 'faults-fits-and-logs', seconds: 300, command: 'npm run test:faults -- 1 2' },
  { name: 'faults-figures', seconds: 300, command: 'npm run test:faults -- 3' },
  { name: 'faults-elements', seconds: 240, command: 'npm run test:faults -- 4 5' },
  { name: 'faults-hosts', seconds: 150, command: 'npm run test:faults -- 6' },
  { name: 'faults-styles-and-scripts', seconds: 200, command: 'npm run test:faults -- 7 8' },

  // Somebody else's code beside ours.
  { name: 'factrs', seconds: 60, command: `cd tests/factrs && ${shared} cargo test -- --show-output` },
  { name: 'outside', seconds: 60, command: 'cargo test -p outside' },
  { name: 'fuzz', seconds: 20, command: `cd tests/fuzz && ${shared} cargo check` },

  // Other engines, and the packages in the programs that courses use.
  { name: 'engine-firefox', seconds: 120, command: 'node tests/engines/run.mjs firefox' },
  { name: 'engine-webkit', seconds: 90, command: 'node tests/engines/run.mjs webkit' },
  { name: 'clients', seconds: 150, command: 'npm run test:clients' },

  // The whole of dist/ once more from nothing, elsewhere: to the byte what is here.
  { name: 'reproducible', seconds: 340, command: 'node scripts/reproduce.mjs' },

  // What widgets/README.md says of adding a figure, done in a copy of the sources.
  { name: 'newcomer', seconds: 200, command: 'node tests/newcomer/run.mjs' },

  // What README promises, each in its cheapest form.
  { name: 'readme-check', seconds: 150, command: 'npm run check' },
  { name: 'readme-bench', seconds: 240, command: `${quick} npm run bench -- --quick` },
  { name: 'readme-threads', seconds: 90, command: `${quick} npm run threads` },
  { name: 'readme-size', seconds: 40, command: 'npm run size -- --singles proposal' },
  { name: 'readme-numbers', seconds: 210, command: `${quick} npm run numbers -- --only worked && git diff --exit-code www/data` },
  { name: 'readme-pdf', seconds: 30, command: 'npm run pdf' },
  { name: 'readme-package', seconds: 60, command: 'npm run package -- --singles proposal' },
  { name: 'readme-release', seconds: 120, command: 'npm run release -- --singles proposal' },
  // The file of logs carries one program in place of two.
  { name: 'readme-offline', seconds: 120, command: 'npm run offline -- --singles proposal && playwright test --config tests/e2e /offline.spec.ts -g "file://|one file"' },
  { name: 'readme-build', seconds: 80, command: 'npm run build && npm run site -- .cache/site && node --test --test-reporter=tap tests/readme/site.test.mjs && npm start -- --no-serve' },
  { name: 'readme-wasm-pack', seconds: 120, command: `${quick} wasm-pack build widgets --target web --out-dir ../.cache/wasm-pack && test -s .cache/wasm-pack/fastslam_widgets_bg.wasm` },
  { name: 'readme-breadth', seconds: 5, command: 'npm run test:all -- --list && npm run test:all -- --due && npm run test:all -- --touched HEAD' },
  { name: 'readme-command-line', seconds: 60, command: 'cargo build --workspace --profile test --bin fastslam --bin fastslam-lab && node --test --test-reporter=tap tests/readme/command-line.test.mjs' },
]

/** What units stand on, by their names: paths in the repository. @type {[units: RegExp, paths: RegExp][]} */
export const grounds = [
  [/^page-/, /^(widgets|www)\//],
  [/^programs-/, /^((widgets|src|lab)\/|scripts\/(build|registry|unasked|single|offline|size))/],
  [/^(laws|logs|wasm|faults-fi|factrs|outside|fuzz)/, /^(src|lab|tests\/(laws|outside))\//],
  [/^faults-[efhs]/, /^(widgets|www|scripts)\//],
  [/^(engine|clients)/, /^((widgets|www)\/|scripts\/(package|python|frames|single))/],
  [/^reproducible/, /^(scripts\/|Cargo|package|\.cargo\/)/],
  [/^newcomer/, /^(widgets\/(README|src\/|kit\/)|scripts\/(build|registry|elements))/],
  [/^readme-/, /^(README\.md|scripts\/|package\.json)/],
  [/^readme-(check|bench|threads|numbers|command)/, /^(src|lab)\//],
  [/^readme-(bench|build|offline|package|pdf|release|size|wasm)/, /^(widgets|www)\//],
]

/** By a line of the above, or because its command names the file or its folder in tests/. @param {Unit} unit @param {string} file */
const standsOn = ({ name, command }, file) =>
  grounds.some(([names, paths]) => names.test(name) && paths.test(file)) || [/^tests\/[^/]+/.exec(file)?.[0] ?? file, `/${posix.basename(file)}`].some(path => command.includes(path))

/** Units that stand on one of these files. @param {string[]} files */
export const touched = files => units.filter(unit => files.some(file => standsOn(unit, file)))

/** A share is meant to take no longer [s]. */
const usual = 10 * 60

/** @param {Unit[]} some */
export const takes = some => some.reduce((sum, { seconds }) => sum + seconds, 0)

/** The units in shares that take about the same time: the longest first, each to the share that has least. @type {Unit[][]} */
export const shares = Array.from({ length: Math.ceil(takes(units) / usual) }, () => [])
for (const unit of units.toSorted((a, b) => b.seconds - a.seconds)) shares.reduce((least, share) => (takes(share) < takes(least) ? share : least)).push(unit)

/** Turns change every three hours [s]. */
export const turn = 3 * 3600
const turnOf = (/** @type {number} */ time) => Math.floor(time / turn)

/**
 * The share whose turn it was at a time [s since 1970]. A slow machine leaves its last units for later, so each time it begins with
 * another one.
 * @param {number} time
 */
export function shareOf(time) {
  const now = turnOf(time)
  const number = now % shares.length
  const share = shares[number] ?? []
  const first = Math.floor(now / shares.length) % share.length
  return { number, units: [...share.slice(first), ...share.slice(0, first)] }
}
