// The lap table as HTML, from the measured numbers: what readers without JavaScript see, and what <fastslam-lap-table>
// (www/src/lap-table.ts) puts its buttons into.

/** @typedef {Record<string, { value: number }>} Numbers by key, of www/data/numbers.json */

/** What the columns are called, as in the keys and as in the head of the table. */
const proposals = { aware: 'Measurement-aware', motion: 'Motion prior' }
const matchers = { cell: 'cell score', subcell: 'sub-cell score' }
const rows = [4, 8, 16, 24, 40]

/** Millimetres: the spread over seeds makes any more of them no wiser. @param {number} metres */
const metres = metres => metres.toFixed(3)

/** @param {Numbers} numbers @returns {string} */
export function renderLapTable(numbers) {
  const columns = Object.keys(proposals).flatMap(proposal => Object.keys(matchers).map(matcher => `${proposal}.${matcher}`))
  const groups = Object.values(proposals).map(title => `<th scope="colgroup" colspan="${Object.keys(matchers).length}">${title}</th>`)
  const titles = columns.map(column => `<th scope="col">${Object.entries(matchers).find(([matcher]) => column.endsWith(`.${matcher}`))?.[1]}</th>`)
  // A pose graph has no particles: one number for all rows, beside the score that its matches are made with.
  const graph = (/** @type {number} */ k) => (k === 0 ? cell(numbers, 'graph', ` data-cell="graph" rowspan="${rows.length}" class="graph"`) : '')
  const body = rows.map((row, k) => `<tr><th scope="row"><i>M</i> = ${row}</th>${columns.map(column => cell(numbers, `${column}.m${row}`, ` data-cell="${column}.m${row}"`)).join('')}${graph(k)}</tr>`)
  return [
    `<fastslam-lap-table seeds="${numbers['lap.runs']?.value}"><table>`,
    `<thead><tr><td rowspan="2">error [m]</td>${groups.join('')}<th scope="colgroup">Pose graph</th></tr><tr>${titles.join('')}<th scope="col">sub-cell score</th></tr></thead>`,
    `<tbody>${body.join('')}</tbody>`,
    '</table></fastslam-lap-table>',
  ].join('\n')
}

/** Median, its 95 % interval, 90th percentile and worst. @param {Numbers} numbers @param {string} name @param {string} attributes */
function cell(numbers, name, attributes) {
  const value = (/** @type {string} */ key) => {
    const number = numbers[`lap.${name}.${key}`]
    if (!number) throw new Error(`www/data/numbers.json has no number lap.${name}.${key}: npm run numbers makes it`)
    return metres(number.value)
  }
  return [
    `<td${attributes}>`,
    `<b data-of="median">${value('median')}</b>`,
    ` <span class="interval" title="95 % confidence interval of the median"><span data-of="low">${value('median_low')}</span>–<span data-of="high">${value('median_high')}</span></span>`,
    ` <span class="tail">p90 <span data-of="p90">${value('p90')}</span></span>`,
    ` <span class="tail">worst <span data-of="worst">${value('worst')}</span></span>`,
    '</td>',
  ].join('')
}
