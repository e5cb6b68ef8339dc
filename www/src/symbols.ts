// A symbol that a reader points at, taps, or comes to with the arrow keys in a formula is lit wherever it is written: in formulas, in
// listings by the name that programs give it, and in the pictures in sight. The table of symbols says which there are.
const SCRIPTS = ['msub', 'msup', 'msubsup', 'mover']
const ACCENTS: Record<string, string> = { ˆ: '^', '^': '^', '˜': '~', '~': '~', '¯': '-' }

interface Lights extends HTMLElement {
  light(symbol: string): void
}

/** Names of the table's symbols, with what programs call them. */
const names = new Map<string, string[]>()
for (const row of document.querySelectorAll('#tab-notation tbody tr')) {
  const [symbols, , code] = row.children
  const called = code!.textContent!.split(', ')
  symbols!.querySelectorAll('math').forEach((math, i) => {
    const name = nameOf(symbolAt(math.querySelector('mi')!))
    names.set(name, called[i]?.match(/\w/) ? [called[i]] : [])
  })
}

/** All that listings write for symbols, the longest first: what is a part of another name is not meant. */
const all = [...names].flat(2).sort((a, b) => b.length - a.length)
const words = new RegExp(`(?<![\\p{L}_\\d])(?:${all.map(word => word.replace(/[.*]/g, '\\$&')).join('|')})(?![\\p{L}_\\d])`, 'gu')

/** The symbol that a letter is of, with its index and accent: all of them are lit together. */
function symbolAt(letter: Element): Element {
  const up = letter.parentElement!
  const script = SCRIPTS.includes(up.localName)
  if (script && (letter.localName !== 'mrow' || letter !== up.firstElementChild)) return symbolAt(up)
  const row = up.parentElement
  return up.localName === 'mrow' && row && SCRIPTS.includes(row.localName) && up !== row.firstElementChild ? symbolAt(row) : letter
}

/** `S`, `H_m`, `w~`; exponents are none of a name, but for marks like the star. */
function nameOf({ localName, children: [base, first, second], textContent }: Element): string {
  if (!SCRIPTS.includes(localName)) return textContent!
  const name = nameOf(base!)
  if (localName === 'mover') return name + (ACCENTS[first!.textContent!] ?? '')
  const sup = localName === 'msup' ? first!.textContent! : (second?.textContent ?? '')
  const mark = /^[−⋆*′]$/.test(sup) ? sup : ''
  return (localName === 'msup' ? name : `${name}_${first!.textContent}`) + mark
}

/** The table's own name for it: an index that only counts may be another one there, or left out. */
function listed(symbol: Element): string | undefined {
  const name = nameOf(symbol)
  if (names.has(name)) return name
  const [base, index = ''] = name.split('_')
  if (index ? !/^[tjkn\d]/.test(index) : base === 'x') return undefined
  const others = index ? [`${base}_${index[0]}`, base!, `${base}_t`, `${base}_j`] : [`${base}_j`, /[a-z]/.test(base!) ? `${base}_t` : '']
  return others.find(other => names.has(other))
}

/** Letters of a formula that begin a symbol of the table, with the symbol: each once. */
function* symbolsIn(root: ParentNode): Generator<[Element, string]> {
  const seen = new Set<Element>()
  for (const letter of root.querySelectorAll('mi')) {
    const symbol = symbolAt(letter)
    const name = seen.has(symbol) ? undefined : listed(symbol)
    seen.add(symbol)
    if (name) yield [symbol, name]
  }
}

/** What listings write for it: its name there, and in comments the symbol itself. */
function* written(name: string): Generator<Range> {
  for (const code of document.querySelectorAll('.listing code')) {
    // Colours part a name into several texts.
    const texts: [Text, number][] = []
    const walker = document.createTreeWalker(code, NodeFilter.SHOW_TEXT)
    let end = 0
    for (let text = walker.nextNode() as Text | null; text; text = walker.nextNode() as Text | null) texts.push([text, (end += text.length)])
    for (const { index, 0: word } of code.textContent!.matchAll(words)) {
      if (word !== name && !names.get(name)!.includes(word)) continue
      const range = new Range()
      const place = (at: number): [Text, number] => {
        const [text, end] = texts.find(([, end]) => at <= end)!
        return [text, at - end + text.length]
      }
      range.setStart(...place(index))
      range.setEnd(...place(index + word.length))
      yield range
    }
  }
}

let lit: string | undefined
let figures: Lights[] = []

function light(name: string | undefined): void {
  if (name === lit) return
  lit = name
  for (const symbol of document.querySelectorAll('math .lit')) symbol.classList.remove('lit')
  for (const figure of figures) figure.light('')
  figures = []
  CSS.highlights?.delete('symbol')
  if (!name) return
  for (const [symbol, its] of symbolsIn(document)) if (its === name) symbol.classList.add('lit')
  CSS.highlights?.set('symbol', new Highlight(...written(name)))
  if (name === 'm') return // pictures write metres so
  const isSeen = (figure: Element) => {
    const { top, bottom } = figure.getBoundingClientRect()
    return bottom > 0 && top < innerHeight
  }
  figures = [...document.querySelectorAll<Lights>('main :defined')].filter(element => 'light' in element && isSeen(element))
  for (const figure of figures) figure.light(name.replace(/[~^]$/, '_$&'))
}

function nameAt({ target }: Event): string | undefined {
  const letter = target instanceof Element ? target.closest('math *') : null
  return letter ? listed(symbolAt(letter)) : undefined
}

// Not by what comes below a pointer that rests, when the page moves.
document.addEventListener('pointermove', event => {
  if (event.pointerType !== 'touch') light(nameAt(event))
})
document.addEventListener('click', event => light(nameAt(event)))

// A formula with a number is a stop of the Tab key; in it arrow keys go from symbol to symbol.
const formulas = document.querySelectorAll<MathMLElement>('.eq math')
for (const formula of formulas) {
  formula.tabIndex = 0
  let at = -1
  formula.addEventListener('focus', () => (at = -1))
  formula.addEventListener('blur', () => light(undefined))
  formula.addEventListener('keydown', event => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key]
    if (event.key === 'Escape') light(undefined)
    if (!step) return
    event.preventDefault()
    const symbols = [...symbolsIn(formula)]
    at = Math.max(0, Math.min(symbols.length - 1, at + step))
    const [symbol, name] = symbols[at] ?? []
    symbol?.scrollIntoView({ block: 'nearest', inline: 'nearest' })
    light(name)
  })
}
