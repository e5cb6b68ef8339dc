// The faces of the book, each cut down to the letters that its pages set in it. All are under the SIL Open Font License, which is served
// beside them: STIX Two Text and STIX Two Math, drawn for each other, and Source Code Pro. (Libertinus, as npm has it, lost the table that
// makes parentheses and roots grow.)
import { createHash } from 'node:crypto'
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import subsetFont from 'subset-font'
import { cache, readIfThere } from '../lib.mjs'
import { italic, lettersOf } from './math.mjs'

/**
 * @typedef {import('hast').ElementContent} ElementContent
 * @typedef {'text' | 'italic' | 'bold' | 'math' | 'mono'} Face
 */

/** @type {Record<Face, { file: string, features: string[] }>} */
const faces = {
  text: { file: 'stix-two-text/files/stix-two-text-latin-400-normal.woff2', features: ['kern', 'liga'] },
  italic: { file: 'stix-two-text/files/stix-two-text-latin-400-italic.woff2', features: ['kern', 'liga'] },
  bold: { file: 'stix-two-text/files/stix-two-text-latin-600-normal.woff2', features: ['kern'] },
  math: { file: 'stix-two-math/files/stix-two-math-latin-400-normal.woff2', features: [] },
  mono: { file: 'source-code-pro/files/source-code-pro-latin-400-normal.woff2', features: [] },
}

/** Letters of German, in files of their own that pages in German have besides (www/src/german.css): the chapter does not pay for them. */
const umlauts = 'ÄÖÜßäöü„'

/** Elements set in another face than what surrounds them; what style.css says of them must agree. @type {Record<string, Face>} */
const faceOf = { b: 'bold', strong: 'bold', dt: 'bold', em: 'italic', i: 'italic', code: 'mono' }
/** Whole paragraphs in italics. */
const italicClasses = ['lead', 'title', 'kind']

/** Which letters are set in which face. Upright Latin letters and figures in formulas are those of the text: the two faces share them. */
export class Letters {
  /** @type {Record<Face, Set<string>>} */
  sets = { text: new Set(), italic: new Set(), bold: new Set(), math: new Set(), mono: new Set() }

  /** @param {ElementContent[]} nodes @param {Face} [face] */
  collect(nodes, face = 'text') {
    for (const node of nodes) {
      if (node.type === 'text') this.add(face, node.value)
      if (node.type !== 'element') continue
      if (node.tagName === 'math') {
        for (const letter of lettersOf(node)) this.add(/[A-Za-z0-9.%]/.test(letter) ? 'text' : 'math', letter)
        continue
      }
      const classes = /** @type {string[]} */ ([node.properties.className ?? []].flat())
      const own = classes.some(name => italicClasses.includes(name)) || /^h[34]$/.test(node.tagName) ? 'italic' : faceOf[node.tagName]
      this.collect(node.children, own ?? face)
    }
  }

  /** @param {Face} face @param {string} text */
  add(face, text) {
    for (const letter of text) if (letter > ' ') this.sets[face].add(letter)
  }

  /** The letters of a page in German. @param {ElementContent[]} nodes */
  collectGerman(nodes) {
    const own = new Letters()
    own.collect(nodes)
    for (const face of /** @type {Face[]} */ (Object.keys(faces))) this.add(face, [...own.sets[face]].filter(letter => !umlauts.includes(letter)).join(''))
  }
}

/**
 * Writes the faces that are needed, each under its name; those made before of the same letters are taken from the cache.
 * @param {string} root @param {string} folder @param {Letters} letters
 */
export async function writeFonts(root, folder, letters) {
  mkdirSync(folder, { recursive: true })
  mkdirSync(cache('fonts'), { recursive: true })
  // What scripts write: numbers in an algorithm's lines.
  for (const face of /** @type {const} */ (['text', 'bold'])) letters.add(face, '0123456789.,−-')
  letters.add('math', italic('x'))
  const files = Object.entries(faces).flatMap(([name, face]) => {
    const own = { name, ...face, text: [...letters.sets[/** @type {Face} */ (name)]].sort().join('') }
    return ['text', 'italic', 'bold'].includes(name) ? [own, { ...own, name: `${name}-german`, text: umlauts }] : [own]
  })
  for (const { name, file, features, text } of files) {
    const source = join(root, 'node_modules', '@fontsource', file)
    const font = readFileSync(source)
    const key = createHash('sha256').update(font).update(features.join()).update(text).digest('hex').slice(0, 32)
    const kept = cache('fonts', `${name}-${key}.woff2`)
    if (readIfThere(kept) === undefined) {
      writeFileSync(kept, await subsetFont(font, ` ${text}`, { targetFormat: 'woff2', keepFeatures: features, noHinting: true }))
    }
    const [target, made] = [join(folder, `${name}.woff2`), readFileSync(kept)]
    if (!readIfExists(target)?.equals(made)) writeFileSync(target, made)
  }
}

/** @param {string} path */
function readIfExists(path) {
  try {
    return readFileSync(path)
  } catch {
    return undefined
  }
}

/** The licences, as they must go with the fonts. @param {string} root */
export const licences = root =>
  ['stix-two-text', 'source-code-pro'].map(name => readFileSync(join(root, 'node_modules', '@fontsource', name, 'LICENSE'), 'utf8')).join('\n\n')
