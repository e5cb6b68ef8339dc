// In what a figure differs between two browsers, in plain sentences.

/**
 * @typedef {import('./page.mjs').Seen} Seen
 * @typedef {{ part: 'state' | 'sentence' | 'readouts' | 'picture', told: string }} Difference
 */

/** Of a figure, what is compared. @type {Difference['part'][]} */
export const PARTS = ['state', 'sentence', 'readouts', 'picture']

/**
 * Where what was found is not what was expected.
 * @param {Seen} expected @param {Seen} found
 * @returns {Difference[]}
 */
export function differences(expected, found) {
  /** @type {Difference[]} */
  const all = []
  if (found.state !== expected.state) all.push({ part: 'state', told: `Its state is ${found.state} instead of ${expected.state}.` })
  if (found.sentence !== expected.sentence) all.push({ part: 'sentence', told: `It says “${found.sentence}” instead of “${expected.sentence}”.` })
  const [is, shouldBe] = [new Map(found.readouts), new Map(expected.readouts)]
  for (const name of new Set([...shouldBe.keys(), ...is.keys()])) {
    const [value, wanted] = [is.get(name) ?? 'missing', shouldBe.get(name) ?? 'missing']
    if (value !== wanted) all.push({ part: 'readouts', told: `The readout ${name} is ${value} instead of ${wanted}.` })
  }
  const size = (/** @type {Seen} */ seen) => seen.size.join(' × ')
  if (size(found) !== size(expected)) {
    all.push({ part: 'picture', told: `The picture has ${size(found)} px instead of ${size(expected)} px.` })
  } else {
    const rows = found.rows.flatMap((row, y) => (row === expected.rows[y] ? [] : [y]))
    if (rows.length > 0) all.push({ part: 'picture', told: `${rows.length} of the picture’s ${found.rows.length} rows of pixels differ, the first is row ${rows[0]} and the last row ${rows.at(-1)}.` })
  }
  return all
}
