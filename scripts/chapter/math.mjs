// TeX to MathML by Temml, made smaller, without inline styles (which the content security policy forbids), and set tighter in scripts.
import { fromHtml } from 'hast-util-from-html'
import temml from 'temml'
import { visit } from 'unist-util-visit'

/** @typedef {import('hast').Element} Element */

const scripts = new Set(['msub', 'msup', 'msubsup', 'munder', 'mover', 'munderover'])
/** Classes of Temml that no style of ours uses. */
const unused = /^tml-(display|prime|sml-pad|med-pad|lrg-pad|jot)$|^(chr|wbk)-/

export class Maths {
  /** Classes by the style that Temml would have written on the element. @type {Map<string, string>} */
  #styles = new Map()

  /** @param {string} tex @param {boolean} display @returns {Element} */
  render(tex, display) {
    const html = temml.renderToString(tex, { displayMode: display, throwOnError: true, strict: true, wrap: 'none' })
    const root = fromHtml(html, { fragment: true })
    const math = /** @type {Element} */ (root.children[0])
    this.#tidy(math, false)
    return math
  }

  /** The rules that stand for inline styles. */
  css() {
    return [...this.#styles].map(([style, name]) => `.${name}{${style}}`).join('\n')
  }

  /** @param {Element} element @param {boolean} script whether it stands in a sub- or superscript */
  #tidy(element, script) {
    const { properties, tagName } = element
    // What every current browser knows by itself, of parentheses and commas.
    if (properties.fence) delete properties.form
    for (const name of ['fence', 'separator']) delete properties[name]
    const classes = [properties.className ?? []].flat().filter(name => !unused.test(String(name)))
    const style = String(properties.style ?? '').replace('display:block math;', '')
    delete properties.style
    if (style) classes.push(this.#classOf(style))
    delete properties.className
    if (classes.length > 0) properties.className = classes.map(String)
    // As in TeX, relations and operators have no space around them in scripts: x₁:ₜ, not x₁ : ₜ.
    if (script && tagName === 'mo' && !properties.stretchy) Object.assign(properties, { lspace: '0', rspace: '0' })
    element.children.forEach((child, i) => {
      if (child.type === 'element') this.#tidy(child, script || (scripts.has(tagName) && i > 0))
    })
    // A minus behind a parenthesis that was made large by hand is a sign, not a difference.
    element.children.forEach((child, i) => {
      const before = element.children[i - 1]
      if (isOperator(child, /^[−+±]$/) && isOperator(before, /^[([{⟨]$/)) child.properties.form = 'prefix'
    })
    element.children = element.children.flatMap(child => {
      if (child.type !== 'element' || child.tagName !== 'mrow' || Object.keys(child.properties).length > 0) return [child]
      // A row of one is that one, unless it is an operator, whose form depends on where in a row it stands.
      const [only] = child.children
      return child.children.length === 1 && only?.type === 'element' && only.tagName !== 'mo' ? [only] : [child]
    })
  }

  /** @param {string} style */
  #classOf(style) {
    if (!this.#styles.has(style)) this.#styles.set(style, `m${this.#styles.size}`)
    return /** @type {string} */ (this.#styles.get(style))
  }
}

/** @param {import('hast').Nodes | undefined} node @param {RegExp} [symbols] @returns {node is Element} */
function isOperator(node, symbols = /./) {
  if (node?.type !== 'element' || node.tagName !== 'mo') return false
  const [symbol] = node.children
  return symbol?.type === 'text' && symbols.test(symbol.value)
}

const relation = /^[=≈≠≤≥<>←→↦∝∼∈≡]$/
const operator = /^[=≈≠≤≥<>←→↦∝∼∈≡+−·×,]$/

/**
 * A long formula in running text, in pieces between which a line may end: after a relation and, in very long ones, after any operator, as in print. No browser breaks a formula.
 * @param {Element} math @returns {Element[]}
 */
export function breakable(math) {
  const [only] = math.children
  const row = math.children.length === 1 && only?.type === 'element' && only.tagName === 'mrow' ? only : math
  const width = widthOf(math)
  if (width < 9) return [math]
  const breaks = width > 13 ? operator : relation
  /** @type {Element[]} */
  const pieces = []
  let piece = { ...math, children: /** @type {Element['children']} */ ([]) }
  for (const child of row.children) {
    piece.children.push(child)
    // Also behind a factor in parentheses, unless what follows belongs to it.
    const factor = breaks === operator && child.type === 'element' && child.tagName === 'mrow' && !isOperator(row.children[row.children.indexOf(child) + 1])
    if (piece.children.length === 1 || !(factor || isOperator(child, breaks))) continue
    // At the end of its piece an operator would pass for a postfix, with no space before it.
    if (!factor) child.properties.form ??= 'infix'
    pieces.push(piece)
    piece = { ...math, data: undefined, children: [] } // the first has the TeX of all
  }
  return piece.children.length > 0 ? [...pieces, piece] : pieces
}

/** About how wide a formula is set [em]: enough to tell one that fits the column from one that does not. @param {import('hast').Nodes} node @returns {number} */
export function widthOf(node) {
  if (node.type === 'text') return 0.55 * node.value.length
  if (node.type !== 'element') return 0
  const { tagName, properties } = node
  const widths = node.children.map(widthOf)
  const sum = widths.reduce((a, b) => a + b, 0)
  const most = Math.max(0, ...widths)
  if (tagName === 'mo') return sum === 0 ? 0 : properties.stretchy ? 0.4 : 0.9
  if (tagName === 'mspace') return Number.parseFloat(String(properties.width ?? 0))
  if (tagName === 'msubsup') return (widths[0] ?? 0) + 0.7 * Math.max(widths[1] ?? 0, widths[2] ?? 0)
  if (tagName === 'msub' || tagName === 'msup') return (widths[0] ?? 0) + 0.7 * (widths[1] ?? 0)
  if (/^m(frac|under|over|underover)$/.test(tagName)) return most * (tagName === 'mfrac' ? 0.9 : 1)
  if (tagName === 'mtable') {
    const rows = node.children.flatMap(row => (row.type === 'element' ? [row.children.map(widthOf)] : []))
    return Array.from({ length: Math.max(0, ...rows.map(row => row.length)) }, (_, i) => Math.max(...rows.map(row => row[i] ?? 0)) + 0.6).reduce((a, b) => a + b, 0)
  }
  return sum
}

const alphabet = 'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz'
const greek = 'ΑΒΓΔΕΖΗΘΙΚΛΜΝΞΟΠΡϴΣΤΥΦΧΨΩ∇αβγδεζηθικλμνξοπρςστυφχψω∂ϵϑϰϕϱϖ'

/** The letter that a browser shows for a lone one in <mi>: italic, from Unicode's mathematical alphabets. @param {string} letter */
export function italic(letter) {
  if (letter === 'h') return 'ℎ'
  const latin = alphabet.indexOf(letter)
  if (latin >= 0) return String.fromCodePoint(0x1d434 + latin)
  const at = greek.indexOf(letter)
  return at >= 0 ? String.fromCodePoint(0x1d6e2 + at) : letter
}

/** Every character that a formula shows. @param {Element} math */
export function lettersOf(math) {
  let letters = ''
  visit(math, 'element', element => {
    if (/^m(sqrt|root)$/.test(element.tagName)) letters += '√'
    for (const child of element.children) {
      if (child.type !== 'text') continue
      const lone = element.tagName === 'mi' && element.properties.mathvariant !== 'normal' && [...child.value].length === 1
      letters += lone ? italic(child.value) : child.value
    }
  })
  return letters
}
