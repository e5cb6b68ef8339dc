// `::citation`: how to cite the whole, from CITATION.cff, which tools read.
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import { h } from 'hastscript'
import { parse } from 'yaml'
import { site } from '../address.mjs'

/** @type {import('./context.mjs').Handler} */
export function citation(context) {
  const { title, authors, version, 'date-released': date } = parse(readFileSync(join(context.root, 'CITATION.cff'), 'utf8'))
  const names = authors.map((/** @type {Record<string, string>} */ author) => author.name ?? `${author['given-names']} ${author['family-names']}`).join(' and ')
  const fields = { title: `{${title}}`, author: `{${names}}`, version, year: date.slice(0, 4), date, ...(site() && { url: site() }) }
  return h('pre', h('code', `@software{fastslam,\n${Object.entries(fields).map(([name, value]) => `  ${name} = {${value}},\n`).join('')}}`))
}
