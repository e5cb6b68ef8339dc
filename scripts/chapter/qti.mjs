// The bank of questions as QTI 2.1, which most other learning systems import: a package with an item for each question.
import { strToU8, zipSync } from 'fflate'
import { elsewhere, escaped, nameOf, plain, tag, titleOf } from './exports.mjs'
import { say } from './translation.mjs'

/** @typedef {import('./bank.mjs').Asked} Asked */
/** @typedef {import('./translation.mjs').Language} Language */

const letters = 'ABCD'
const head = '<?xml version="1.0" encoding="UTF-8"?>\n'

/** @param {string} name @param {Record<string, string>} [attributes] */
const empty = (name, attributes = {}) => tag(name, '', attributes).replace(/><\/[\w]+>$/, '/>')

const response = empty('variable', { identifier: 'RESPONSE' })
const [right, wrong] = [1, 0].map(score => tag('setOutcomeValue', tag('baseValue', String(score), { baseType: 'float' }), { identifier: 'SCORE' }))
const judged = (/** @type {string} */ condition) => tag('responseCondition', tag('responseIf', condition + right) + tag('responseElse', wrong ?? ''))
const feedback = (/** @type {string} */ value) => tag('setOutcomeValue', value, { identifier: 'FEEDBACK' })
const declared = (/** @type {string} */ identifier, /** @type {string} */ baseType, content = '') => tag('outcomeDeclaration', content, { identifier, cardinality: 'single', baseType })
const score = declared('SCORE', 'float', tag('defaultValue', tag('value', '0')))
const told = declared('FEEDBACK', 'identifier')
const says = (/** @type {string} */ identifier, /** @type {string} */ html) => tag('modalFeedback', html, { outcomeIdentifier: 'FEEDBACK', showHide: 'show', identifier })

/** @param {Asked} asked @param {string} address @param {Language} language */
function item(asked, address, language) {
  const xhtml = (/** @type {import('hast').ElementContent[]} */ nodes) => elsewhere(nodes, address, true)
  const text = xhtml(asked.text)
  const wanted = (/** @type {string} */ value, /** @type {string} */ baseType) => tag('responseDeclaration', tag('correctResponse', tag('value', value)), { identifier: 'RESPONSE', cardinality: 'single', baseType })
  if ('choices' in asked) {
    const choices = asked.choices.map((choice, i) => tag('simpleChoice', xhtml(choice.text), { identifier: letters[i] ?? '' }))
    const interaction = tag('choiceInteraction', tag('prompt', text) + choices.join(''), { responseIdentifier: 'RESPONSE', shuffle: 'true', maxChoices: '1' })
    return [
      wanted(letters[asked.choices.findIndex(choice => choice.right)] ?? '', 'identifier'),
      score,
      told,
      tag('itemBody', interaction),
      tag('responseProcessing', judged(tag('match', response + empty('correct', { identifier: 'RESPONSE' }))) + feedback(response)),
      ...asked.choices.map(({ reason }, i) => says(letters[i] ?? '', xhtml(reason))),
    ]
  }
  if ('value' in asked) {
    const within = plain(asked.within * Math.abs(asked.value))
    const close = tag('equal', response + empty('correct', { identifier: 'RESPONSE' }), { toleranceMode: 'absolute', tolerance: `${within} ${within}` })
    const field = empty('textEntryInteraction', { responseIdentifier: 'RESPONSE', expectedLength: '12' })
    return [
      wanted(plain(asked.value), 'float'),
      score,
      told,
      tag('itemBody', tag('p', text) + tag('p', `${say(language, 'Your answer')}: ${field}${asked.unit ? ` ${escaped(asked.unit)}` : ''}`)),
      tag('responseProcessing', judged(close) + feedback(tag('baseValue', 'answer', { baseType: 'identifier' }))),
      says('answer', xhtml(asked.reason)),
    ]
  }
  // What was reached is looked at by whoever grades.
  return [
    empty('responseDeclaration', { identifier: 'RESPONSE', cardinality: 'single', baseType: 'string' }),
    score,
    tag(
      'itemBody',
      tag('p', text) +
        tag('p', `${xhtml([asked.way]).replace(/^<p>|<\/p>$/g, '')}. ${say(language, 'Hand in the link of the state that you reached: <em>Copy link</em> in the menu of the figure.')}`) +
        tag('rubricBlock', xhtml(asked.reason), { view: 'scorer' }) +
        empty('extendedTextInteraction', { responseIdentifier: 'RESPONSE', expectedLines: '3' }),
    ),
  ]
}

/** The files of the package, by name. @param {Asked[]} bank @param {string} address of the site, or empty @param {Language} language @returns {Record<string, string>} */
export function qtiFiles(bank, address, language) {
  const items = bank.map(asked => {
    const attributes = { xmlns: 'http://www.imsglobal.org/xsd/imsqti_v2p1', identifier: asked.id, title: nameOf(asked), adaptive: 'false', timeDependent: 'false', 'xml:lang': language }
    return /** @type {[string, string]} */ ([`${asked.id}.xml`, `${head}${tag('assessmentItem', `\n  ${item(asked, address, language).join('\n  ')}\n`, attributes)}\n`])
  })
  const resources = items.map(([file]) => tag('resource', empty('file', { href: file }), { identifier: `resource-${file.replace('.xml', '')}`, type: 'imsqti_item_xmlv2p1', href: file }))
  const manifest = tag(
    'manifest',
    `\n  ${tag('metadata', tag('schema', 'QTIv2.1 Package') + tag('schemaversion', '1.0.0'))}\n  ${empty('organizations')}\n  ${tag('resources', `\n    ${resources.join('\n    ')}\n  `)}\n`,
    { xmlns: 'http://www.imsglobal.org/xsd/imscp_v1p1', identifier: `fastslam-bank-${language}` },
  )
  const told = `<!-- ${titleOf(bank, language)}, QTI 2.1. Text: CC BY 4.0. -->\n`
  return { 'imsmanifest.xml': `${head}${told}${manifest}\n`, ...Object.fromEntries(items) }
}

/** @param {Asked[]} bank @param {string} address of the site, or empty @param {Language} language */
export function toQti(bank, address, language) {
  const files = Object.entries(qtiFiles(bank, address, language)).map(([name, text]) => [name, strToU8(text)])
  // The same time in every package, so that the same questions give the same file.
  return zipSync(Object.fromEntries(files), { level: 9, mtime: '1980-01-01T00:00:00' })
}
