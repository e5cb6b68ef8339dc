// The bank of questions as learning systems read it: GIFT, a text that a lecturer can read as well, and Moodle's XML, which keeps tags and ids.
// Formulas are TeX between \( and \), which MathJax sets there.
import { toHtml } from 'hast-util-to-html'
import { visit } from 'unist-util-visit'
import { say } from './translation.mjs'

/** @typedef {import('./bank.mjs').Asked} Asked */
/** @typedef {import('hast').ElementContent} ElementContent */
/** @typedef {import('./translation.mjs').Language} Language */

const title = 'FastSLAM'

/** @param {Asked[]} bank @param {Language} language */
export const titleOf = (bank, language) => say(language, '{n} questions on FastSLAM and Rao-Blackwellization', bank.length)

/** A question's name in a list. @param {Asked} asked */
export const nameOf = ({ number, figure }) => `${title} ${String(number).padStart(2, '0')}: ${figure}`

/** @param {Asked} asked @param {Language} language */
const tagsOf = ({ level, goal, section }, language) => [`${say(language, 'level')} ${level}`, `${say(language, 'goal')} ${goal}`, `${say(language, 'section')} ${section}`]

/** Apart by languages: in a system that has both, a question of one has not the place of that of the other. @param {Asked} asked @param {Language} language */
const categoryOf = ({ figure }, language) => `$course$/top/${title}${language === 'de' ? ' (deutsch)' : ''}/${figure}`

/**
 * HTML for another site: no element of ours, links whole. Where nobody knows the site's address, a link is its text with the place behind it.
 * @param {ElementContent[]} nodes @param {string} address of the site, or empty @param {boolean} [xml] whether it has to be XML as well
 */
export function elsewhere(nodes, address, xml = false) {
  const root = { type: /** @type {const} */ ('root'), children: structuredClone(nodes) }
  visit(root, 'element', (element, index, parent) => {
    if (!parent || index === undefined) return undefined
    if (element.tagName === 'math') {
      const { tex } = /** @type {{ tex?: string }} */ (element.data ?? {})
      const [open, close] = element.properties.display ? ['\\[', '\\]'] : ['\\(', '\\)']
      parent.children[index] = { type: 'text', value: tex === undefined ? '' : `${open}${tex}${close}` }
    } else if (element.tagName === 'a') {
      const href = String(element.properties.href)
      if (address) element.properties = { href: new URL(href, address).href }
      else {
        parent.children.splice(index, 1, ...element.children, { type: 'text', value: ` (${href.replace('./', '')})` })
        return index // what was in it has its turn
      }
    }
    return undefined
  })
  return toHtml(root, xml ? { closeSelfClosing: true } : { characterReferences: { useNamedReferences: true } }).replace(/\s+/g, ' ').trim()
}

/** A number as it is written for a program: as many figures as any tolerance asks for. @param {number} value */
export const plain = value => String(Number(value.toPrecision(6)))

/** What a question says, with what its answer has to be given in. @param {Asked} asked @param {string} address @param {Language} language */
function textOf(asked, address, language) {
  const text = elsewhere(asked.text, address)
  if ('way' in asked) return `<p>${text}</p><p>${elsewhere([asked.way], address).replace(/^<p>|<\/p>$/g, '')}. ${say(language, 'Hand in the link of the state that you reached: <em>Copy link</em> in the menu of the figure.')}</p>`
  return `<p>${text}${'value' in asked && asked.unit ? ` (${say(language, 'in')} ${asked.unit})` : ''}</p>`
}

/** @param {string} text */
const gift = text => text.replace(/[\\~=#{}:]/g, '\\$&')

/** @param {Asked} asked @param {string} address */
function giftAnswer(asked, address) {
  const said = (/** @type {ElementContent[]} */ nodes) => gift(elsewhere(nodes, address))
  if ('choices' in asked) return asked.choices.map(({ right, text, reason }) => `${right ? '=' : '~'}${said(text)}#${said(reason)}`).join('\n')
  if ('value' in asked) return `#${plain(asked.value)}:${plain(asked.within * Math.abs(asked.value))}####${said(asked.reason)}`
  return `####${said(asked.reason)}`
}

/** @param {Asked[]} bank @param {string} address of the site, or empty @param {Language} [language] */
export function toGift(bank, address, language = 'en') {
  const questions = bank.map((asked, i) => {
    const category = asked.goal === bank[i - 1]?.goal ? '' : `$CATEGORY: ${categoryOf(asked, language)}\n\n`
    const tags = [`[id:${asked.id}]`, ...tagsOf(asked, language).map(tag => `[tag:${tag}]`)].join(' ')
    return `${category}// ${tags}\n::${gift(nameOf(asked))}::[html]${gift(textOf(asked, address, language))} {\n${giftAnswer(asked, address)}\n}\n`
  })
  return `// ${titleOf(bank, language)}, GIFT. Text: CC BY 4.0.\n\n${questions.join('\n')}`
}

/** @param {string} text */
export const escaped = text => text.replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/>/g, '&gt;').replace(/"/g, '&quot;')

/** @param {string} name @param {string} content @param {Record<string, string>} [attributes] */
export const tag = (name, content, attributes = {}) => `<${name}${Object.entries(attributes).map(([key, value]) => ` ${key}="${escaped(value)}"`).join('')}>${content}</${name}>`

/** A text as Moodle wraps each, in HTML. @param {string} name @param {string} html @param {Record<string, string>} [attributes] @param {string} [more] */
const html = (name, html, attributes = {}, more = '') => tag(name, tag('text', escaped(html)) + more, { ...attributes, format: 'html' })

/** @param {Asked} asked @param {string} address @param {Language} language */
function moodleQuestion(asked, address, language) {
  const said = (/** @type {ElementContent[]} */ nodes) => elsewhere(nodes, address)
  const reason = 'reason' in asked ? said(asked.reason) : ''
  const kind = 'choices' in asked ? 'multichoice' : 'value' in asked ? 'numerical' : 'essay'
  const parts = [
    tag('name', tag('text', escaped(nameOf(asked)))),
    html('questiontext', textOf(asked, address, language)),
    html('generalfeedback', reason),
    tag('defaultgrade', '1'),
    tag('penalty', '0.3333333'),
    tag('hidden', '0'),
    tag('idnumber', asked.id),
  ]
  if ('choices' in asked) {
    parts.push(tag('single', 'true'), tag('shuffleanswers', 'true'), tag('answernumbering', 'ABCD'))
    for (const { right, text, reason } of asked.choices) parts.push(html('answer', said(text), { fraction: right ? '100' : '0' }, html('feedback', said(reason))))
  } else if ('value' in asked) {
    const feedback = html('feedback', '')
    parts.push(tag('answer', tag('text', plain(asked.value)) + feedback + tag('tolerance', plain(asked.within * Math.abs(asked.value))), { fraction: '100', format: 'moodle_auto_format' }))
  } else {
    parts.push(tag('responseformat', 'editor'), tag('responserequired', '1'), tag('responsefieldlines', '5'), tag('attachments', '0'), html('graderinfo', reason))
  }
  parts.push(tag('tags', tagsOf(asked, language).map(name => tag('tag', tag('text', name))).join('')))
  return `  ${tag('question', `\n    ${parts.join('\n    ')}\n  `, { type: kind })}\n`
}

/** @param {Asked[]} bank @param {string} address of the site, or empty @param {Language} [language] */
export function toMoodle(bank, address, language = 'en') {
  const questions = bank.map((asked, i) => {
    const category = tag('question', tag('category', tag('text', escaped(categoryOf(asked, language)))), { type: 'category' })
    return (asked.goal === bank[i - 1]?.goal ? '' : `  ${category}\n`) + moodleQuestion(asked, address, language)
  })
  return `<?xml version="1.0" encoding="UTF-8"?>\n<!-- ${titleOf(bank, language)}, Moodle XML. Text: CC BY 4.0. -->\n${tag('quiz', `\n${questions.join('')}`)}\n`
}
