// What things may weigh: tests/sizes.toml, and the judge of it.
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import { kilobytes, red, root, StepError } from './lib.mjs'

/** @typedef {{ target: number, baseline: number }} Budget in bytes */

const file = join('tests', 'sizes.toml')

/** The budget of this name: of a table, or of one in a table. @param {string} name @returns {Promise<Budget | undefined>} */
async function budgetOf(name) {
  // Imported late: set-up may be what installs it.
  const { parse } = await import('smol-toml')
  /** @type {any} */
  let found = parse(readFileSync(join(root, file), 'utf8'))
  for (const key of name.split('.')) found = found?.[key]
  return found
}

/** By how much a size may be over its baseline: what a line of prose or a compiler's mood takes. */
const SLACK = 0.01

/**
 * A size against its target, in words, with ✗ where it is over that. More than 1 % above its baseline it is refused.
 * @param {string} name as in the table @param {number} bytes @param {Budget} [given]
 */
export async function judge(name, bytes, given = undefined) {
  const budget = given ?? (await budgetOf(name))
  if (!budget) throw new StepError(`${file} has no line for ${name}, which has ${kilobytes(bytes)}.`)
  const { target, baseline } = budget
  if (bytes > baseline * (1 + SLACK)) throw new StepError(`Too heavy: ${name} has ${kilobytes(bytes)}, more than 1 % above its baseline of ${kilobytes(baseline)}.`, `Make it lighter; or move the baseline in ${file} and say there why.`)
  return bytes > target ? `${red('✗')} ${name} ${kilobytes(bytes)}, ${kilobytes(bytes - target)} over its target of ${kilobytes(target)}` : `✓ ${name} ${kilobytes(bytes)} of ${kilobytes(target)}`
}

/**
 * Several sizes at once: whatever is too heavy is told, not the first alone.
 * @param {[name: string, bytes: number][]} sizes
 */
export async function judgeAll(sizes) {
  const judged = await Promise.allSettled(sizes.map(([name, bytes]) => judge(name, bytes)))
  const refused = judged.flatMap(result => (result.status === 'rejected' ? [result.reason] : []))
  if (refused.length > 0) throw new StepError(refused.map(({ message }) => message).join('\n'), refused[0].hint)
  return judged.map(result => (result.status === 'fulfilled' ? result.value : ''))
}
