// Breadth: what is tested besides npm test, in units of six minutes at most. All of them are `npm run test:all`; CI takes a share at a time.

/**
 * `seconds` is what it usually takes on two quiet cores, when all is built. The command is one of a shell in the repository's folder,
 * with the programs of npm packages on PATH.
 * @typedef {{ name: string, seconds: number, command: string }} Unit
 */

const page = (/** @type {string} */ specs) => `playwright test --config tests/e2e --grep @breadth ${specs}`

/** @type {Unit[]} */
export const units = [
  { name: 'page-one-screen', seconds: 100, command: page('one-screen') },
]

/** A share is meant to take no longer [s]. */
const usual = 10 * 60

/** @param {Unit[]} some */
export const takes = some => some.reduce((sum, { seconds }) => sum + seconds, 0)

/** The units in shares that take about the same time: the longest first, each to the share that has least. @type {Unit[][]} */
export const shares = Array.from({ length: Math.ceil(takes(units) / usual) }, () => [])
for (const unit of units.toSorted((a, b) => b.seconds - a.seconds)) shares.reduce((least, share) => (takes(share) < takes(least) ? share : least)).push(unit)

/** Turns change every three hours. */
const turnOf = (/** @type {number} */ time) => Math.floor(time / (3 * 3600))

/**
 * The share whose turn it was at a time [s since 1970]. A slow machine leaves its last units for later, so each time it begins with
 * another one.
 * @param {number} time
 */
export function shareOf(time) {
  const turn = turnOf(time)
  const number = turn % shares.length
  const share = shares[number] ?? []
  const first = Math.floor(turn / shares.length) % share.length
  return { number, units: [...share.slice(first), ...share.slice(0, first)] }
}
