// The works as files to download: CSL-JSON, which reference managers read, and BibTeX. Both are made from www/references.json, without its
// `checked`, which says how an entry was compared with others.

/** @typedef {import('./citations.mjs').Work & { checked?: string, number?: string, 'publisher-place'?: string }} Work */

/** @param {Work[]} works */
export const toCsl = works => `${JSON.stringify(works.map(({ checked: _, ...work }) => work), undefined, 2)}\n`

/** @type {Record<string, string>} */
const kinds = { 'article-journal': 'article', 'paper-conference': 'inproceedings', book: 'book', report: 'techreport' }

/** What TeX would read as a command. @param {string} text */
const escaped = text => text.replace(/[&%#_$]/g, '\\$&')

/** @param {import('./citations.mjs').Author[] | undefined} people */
const names = people => people?.map(({ family, given, literal }) => (family ? [family, given].filter(Boolean).join(', ') : `{${literal}}`)).join(' and ')

/** @param {Work[]} works */
export const toBibtex = works =>
  works
    .map(work => {
      const kind = kinds[work.type ?? ''] ?? 'misc'
      const place = { article: 'journal', inproceedings: 'booktitle' }[kind]
      const publisher = kind === 'techreport' ? 'institution' : 'publisher'
      /** @type {Record<string, string | undefined>} */
      const fields = {
        author: names(work.author),
        editor: names(work.editor),
        title: `{${work.title}}`,
        ...(place && { [place]: work['container-title'] }),
        volume: work.volume?.toString(),
        number: work.issue?.toString() ?? work.number,
        pages: work.page?.replaceAll('–', '--'),
        edition: work.edition?.toString(),
        [publisher]: work.publisher,
        address: work['publisher-place'],
        year: work.issued?.['date-parts'][0]?.[0]?.toString(),
      }
      // Addresses are read as they are.
      const lines = Object.entries(fields).flatMap(([name, value]) => (value ? [`  ${name} = {${escaped(value)}},`] : []))
      lines.push(...[['doi', work.DOI], ['url', work.URL]].flatMap(([name, value]) => (value ? [`  ${name} = {${value}},`] : [])))
      return `@${kind}{${work.id},\n${lines.join('\n')}\n}\n`
    })
    .join('\n')
