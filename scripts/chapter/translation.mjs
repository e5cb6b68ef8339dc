// Pages in German: what a translation does not say again (attributes of directives, in their order) is that of the page it translates, and what the
// builder writes by itself.
import { toString } from 'mdast-util-to-string'
import { visit } from 'unist-util-visit'

/** @typedef {'en' | 'de'} Language */
/** @typedef {import('./parse.mjs').Source} Source */

/** @type {Record<string, string>} */
const german = {
  'For teachers': 'Für Lehrende',
  Embed: 'Einbetten',
  Cite: 'Zitieren',
  Chapter: 'Kapitel',
  'Skip to the chapter': 'Zum Text springen',
  Site: 'Website',
  Contents: 'Inhalt',
  'The figures run with JavaScript and WebAssembly. Without them you see them at rest.': 'Die Abbildungen laufen mit JavaScript und WebAssembly. Ohne diese sehen Sie sie in Ruhe.',
  'Text: CC BY 4.0. Code: MIT or Apache-2.0': 'Text: CC BY 4.0. Code: MIT oder Apache-2.0',
  'Privacy and accessibility': 'Datenschutz und Barrierefreiheit',
  'Goal.': 'Ziel.',
  'A student can': 'Sie können',
  'what the figure computes': 'was die Abbildung berechnet, auf Englisch',
  'level {n} of 3': 'Schwierigkeit {n} von 3',
  Answer: 'Antwort',
  'Your answer': 'Ihre Antwort',
  yes: 'ja',
  no: 'nein',
  'Set the figure up for it': 'Die Abbildung dafür einstellen',
  'Done.': 'Geschafft.',
  'Right.': 'Richtig.',
  'No.': 'Nein.',
  Name: 'Name',
  Date: 'Datum',
  minutes: 'Minuten',
  'With solutions': 'Mit Lösungen',
  'What you set, or the link of the state': 'Was Sie eingestellt haben, oder der Link des Zustands',
  in: 'in',
  'Hand in the link of the state that you reached: <em>Copy link</em> in the menu of the figure.': 'Geben Sie den Link des Zustands ab, den Sie erreicht haben: <em>Link kopieren</em> im Menü der Abbildung.',
  level: 'Schwierigkeit',
  goal: 'Ziel',
  section: 'Abschnitt',
  '{n} questions on FastSLAM and Rao-Blackwellization': '{n} Fragen zu FastSLAM und Rao-Blackwellisierung',
}

/** What the builder writes by itself. @param {Language} language @param {string} text @param {string | number} [n] what `{n}` in it stands for */
export function say(language, text, n = '') {
  const said = language === 'de' ? german[text] : text
  if (said === undefined) throw new Error(`There is no German for “${text}”.`)
  return said.replace('{n}', String(n))
}

/** The page beside it, in the other language. @param {string} name */
export const inGerman = name => name.replace(/^[a-z]+(?:-\d+)?/, '$&-de')

/** What a translation has to have as its original has it. @param {Source} source */
function partsOf({ tree }) {
  /** @type {{ directives: any[], anchors: string[], links: string[], numbers: string[], ticks: string[] }} */
  const parts = { directives: [], anchors: [], links: [], numbers: [], ticks: [] }
  visit(tree, node => {
    if (node.type === 'containerDirective' || node.type === 'leafDirective') parts.directives.push(node)
    if (node.type === 'heading') parts.anchors.push(/\{#([\w-]+)\}\s*$/.exec(toString(node))?.[1] ?? '')
    if (node.type === 'link') parts.links.push(node.url)
    if (node.type === 'textDirective' && node.name === 'num') parts.numbers.push(`${toString(node)} ${JSON.stringify(node.attributes)}`)
    if (node.type === 'listItem') parts.ticks.push(String(node.checked))
  })
  return parts
}

/**
 * Gives a translation what it does not say again, and says what it has in another way than its original.
 * @param {Source} translation @param {Source} original @param {import('./problems.mjs').Problems} problems
 */
export function complete(translation, original, problems) {
  const [own, given] = [partsOf(translation), partsOf(original)]
  const complain = (/** @type {any} */ where, /** @type {string} */ text) => problems.add(translation.file, where, `${text} (${original.file})`)
  own.directives.forEach((node, i) => {
    const other = given.directives[i]
    if (node.name !== other?.name) return complain(node, `${node.name} stands where the original has ${other?.name ?? 'nothing more'}`)
    for (const [name, value] of Object.entries(node.attributes)) {
      if (name in other.attributes && other.attributes[name] !== value) complain(node, `${name}="${value}", and the original has ${other.attributes[name]}`)
    }
    node.attributes = { ...other.attributes, ...node.attributes }
  })
  if (own.directives.length < given.directives.length) complain(1, `${given.directives.length - own.directives.length} directives of the original are missing`)
  // Links may lead to the German page.
  const links = own.links.map(link => link.replace(/^(\.\/[a-z]+(?:-\d+)?)-de\b/, '$1'))
  for (const [what, mine, theirs] of /** @type {const} */ ([['anchors', own.anchors, given.anchors], ['links', links.sort(), given.links.sort()], ['numbers', own.numbers.sort(), given.numbers.sort()], ['right answers', own.ticks, given.ticks]])) {
    const at = theirs.findIndex((one, i) => one !== mine[i])
    if (at >= 0 || mine.length > theirs.length) complain(1, `${what} are not those of the original: ${mine[Math.max(at, 0)]}, and there ${theirs[Math.max(at, 0)]}`)
  }
}
