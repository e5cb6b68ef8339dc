// The chapter: www/chapter/*.md, and the pages beside it, to pages.
import { existsSync, readdirSync, readFileSync } from 'node:fs'
import { join, relative } from 'node:path'
import { h } from 'hastscript'
import { toHast } from 'mdast-util-to-hast'
import { toString } from 'mdast-util-to-string'
import { visit } from 'unist-util-visit'
import { site } from '../address.mjs'
import { aimsIn, askedIn } from './bank.mjs'
import { Citations } from './citations.mjs'
import { isContent } from './context.mjs'
import { sections } from './contents.mjs'
import { total, wordsOf } from './count.mjs'
import { toGift, toMoodle } from './exports.mjs'
import { Glossary } from './glossary.mjs'
import { handlers } from './handlers.mjs'
import { Labels, takeHeadingId } from './labels.mjs'
import { readLine, readListing } from './listing.mjs'
import { lettersOf, Maths } from './math.mjs'
import { Numbers } from './numbers.mjs'
import { page } from './page.mjs'
import { parse } from './parse.mjs'
import { Problems } from './problems.mjs'
import { solutionsPage, takeSolutions } from './solutions.mjs'
import { toQti } from './qti.mjs'
import { Sources } from './source.mjs'
import { together } from './together.mjs'
import { complete, inGerman, say } from './translation.mjs'

/**
 * @typedef {import('hast').ElementContent} ElementContent
 * @typedef {import('./context.mjs').Context} Context
 * @typedef {import('./parse.mjs').Source} Source
 * @typedef {ReturnType<typeof page>} Rendered
 * @typedef {{ pages: Record<string, Rendered>, downloads: Record<string, string>, packages: Record<string, Uint8Array>, css: string, files: string[] }} Chapter
 *   `downloads` and `packages`: files beside the pages; `files`: what it was made from
 */

/** Plans of a lesson that have a worksheet [minutes]. */
const sheets = [20, 45, 90]
/** @typedef {{ name: string, text?: string, script: string, live?: boolean, solved?: boolean }} Beside a page beside the chapter, with its text and what it runs */
/** Pages that are there in German as well. Those that ask questions of the bank come after it. @type {Beside[]} */
const bilingual = [
  { name: 'bank', script: './src/practice.ts' },
  ...sheets.flatMap(minutes =>
    [false, true].map(solved => ({ name: `worksheet-${minutes}${solved ? '-solutions' : ''}`, text: `worksheet-${minutes}`, script: './src/sheet.ts', live: true, solved })),
  ),
  { name: 'deck', script: './src/deck.ts', live: true },
]
/** @type {(Beside & { language?: import('./translation.mjs').Language })[]} */
const beside = [
  ...['model', 'trust', 'hosting', 'downloads'].map(name => ({ name, script: './src/page.ts' })),
  { name: 'practice', script: './src/practice.ts' },
  ...bilingual,
  ...bilingual.map(page => ({ ...page, name: inGerman(page.name), text: inGerman(page.text ?? page.name), script: page.script.replace('practice', 'practice-de'), language: /** @type {const} */ ('de') })),
]
/** The files of all pages, with their languages. @param {string} www @returns {Map<string, import('./translation.mjs').Language>} */
export function pageFiles(www) {
  const there = beside.filter(({ name, text = name }) => existsSync(join(www, `${text}.md`)))
  return new Map([['index.html', 'en'], [solutionsPage, 'en'], ...there.map(({ name, language = 'en' }) => /** @type {const} */ ([`${name}.html`, language]))])
}

/** What is the same of every page. */
const plain = { hero: [], previous: undefined, next: undefined, live: false, language: /** @type {const} */ ('en'), other: undefined, foot: 'Text: CC BY 4.0. Code: MIT or Apache-2.0', fonts: ['text', 'italic', 'bold', 'math', 'mono'] }

/**
 * @param {string} root of the repository
 * @returns {Promise<Chapter>}
 * @throws {import('../lib.mjs').StepError} that lists everything wrong, each with file and line
 */
export async function renderChapter(root) {
  const problems = new Problems()
  const www = join(root, 'www')
  /** @type {string[]} */
  const files = []
  const name = (/** @type {string} */ path) => relative(root, path)
  const read = (/** @type {string} */ path) => {
    files.push(path)
    return parse(name(path), readFileSync(path, 'utf8'), problems)
  }
  const json = (/** @type {string} */ path, /** @type {any} */ empty) => {
    files.push(path)
    return existsSync(path) ? JSON.parse(readFileSync(path, 'utf8')) : empty
  }
  const texts = readdirSync(join(www, 'chapter')).filter(file => /^\d\d-.*\.md$/.test(file)).sort()
  const [first, ...rest] = texts.map(file => read(join(www, 'chapter', file)))
  if (!first || !first.file.endsWith('00-title.md')) problems.add('www/chapter/00-title.md', 1, 'the chapter has no title page')

  const glossaryFile = join(www, 'glossary.md')
  files.push(glossaryFile)
  const [numbersFile, logsFile, worksFile] = [join(www, 'data', 'numbers.json'), join(www, 'data', 'logs.json'), join(www, 'references.json')]
  // Numbers of recorded logs are kept apart: only who has the logs can measure them again.
  const ofLogs = json(logsFile, {})
  const numbers = new Numbers({ ...json(numbersFile, {}), ...ofLogs })
  const citations = new Citations(json(worksFile, []))
  const glossary = new Glossary(existsSync(glossaryFile) ? read(glossaryFile) : parse(name(glossaryFile), '', problems), problems)
  const sources = await new Sources(root).open()
  const maths = new Maths()
  const titles = new Map([first, ...rest].flatMap(text => (text ? titlesIn(text) : [])))
  const modelFile = join(www, 'model.md')
  const aims = aimsIn(existsSync(modelFile) ? readFileSync(modelFile, 'utf8') : '')
  const shared = { root, problems, maths, numbers, citations, glossary, sources, aims, titles, repository: repositoryOf(root) }

  /** Questions of the bank, by language. */
  const asked = { en: new Map(), de: new Map() }

  /** @type {Record<string, Rendered>} */
  const pages = {}
  const front = first?.front ?? {}
  const number = String(front.number ?? '')
  if (first) {
    for (const key of ['title', 'number', 'lead']) if (!front[key]) problems.add(first.file, 1, `the front matter has no ${key}`)
    pages['index.html'] = renderPage({ ...shared, language: 'en', asked: asked.en, chapter: number, texts: [first, ...rest], front, kicker: `Chapter ${number}`, script: './src/main.ts', live: true })
  }
  const kickerIn = (/** @type {import('./translation.mjs').Language} */ language) => h('a', { href: 'index.html' }, `${say(language, 'Chapter')} ${number}`)
  const { heads, sections: solutions } = takeSolutions(pages['index.html']?.body ?? [])
  if (solutions.length > 0) {
    const title = 'Solutions'
    pages[solutionsPage] = page({ ...plain, title, heading: [{ type: 'text', value: title }], kicker: kickerIn('en'), lead: [], description: `${title} of the exercises of chapter ${number}`, script: './src/page.ts', heads, main: solutions })
  }
  for (const { name, text: stem = name, script, live = false, solved, language = 'en' } of beside) {
    const path = join(www, `${stem}.md`)
    if (!existsSync(path)) continue
    const text = read(path)
    const original = name.replace('-de', '')
    if (language === 'de') complete(text, read(join(www, `${stem.replace('-de', '')}.md`)), problems)
    const other = language === 'de' ? original : existsSync(join(www, `${inGerman(stem)}.md`)) ? inGerman(name) : undefined
    const sheet = solved === undefined ? undefined : { solved, tasks: 0 }
    const front = { ...titleOf(text, problems), ...text.front }
    const own = { language, asked: asked[language], other: other && `${other}.html`, kicker: kickerIn(language) }
    pages[`${name}.html`] = renderPage({ ...shared, ...own, chapter: number, texts: [text], front, script, live, sheet })
    for (const question of askedIn(pages[`${name}.html`]?.body ?? [])) asked[language].set(question.id, question)
  }

  // A number, a work or a term that nobody uses was forgotten, by the text or in its list.
  for (const key of numbers.unused()) {
    const file = key in ofLogs ? logsFile : numbersFile
    problems.add(name(file), lineWith(file, `"${key}"`), `no page uses the number ${key}`)
  }
  for (const key of citations.unused()) problems.add(name(worksFile), lineWith(worksFile, `"${key}"`), `nobody cites ${key}`)
  for (const [key, { line }] of glossary.unused()) problems.add(glossary.file, line, `nobody uses the term ${key}`)
  problems.throwIfAny()
  /** @type {Pick<Chapter, 'downloads' | 'packages'>} */
  const { downloads, packages } = { downloads: {}, packages: {} }
  for (const [language, name] of /** @type {const} */ ([['en', 'bank'], ['de', 'bank-de']])) {
    const bank = [...asked[language].values()]
    if (bank.length > 0) Object.assign(downloads, { [`${name}.gift.txt`]: toGift(bank, site(), language), [`${name}.xml`]: toMoodle(bank, site(), language) })
    if (bank.length > 0) packages[`${name}.qti.zip`] = toQti(bank, site(), language)
  }
  return { pages, downloads, packages, css: maths.css(), files: [...files, ...sources.files] }
}

/** Headings with an anchor, before anything is made of them. @param {Source} source @returns {[anchor: string, title: string][]} */
function titlesIn({ tree }) {
  /** @type {[string, string][]} */
  const found = []
  visit(tree, 'heading', heading => {
    const [, title, id] = /^(.*?)\s*\{#([\w-]+)\}\s*$/s.exec(toString(heading)) ?? []
    if (title && id) found.push([id, title])
  })
  return found
}

/** @param {string} path @param {string} text */
const lineWith = (path, text) => readFileSync(path, 'utf8').slice(0, readFileSync(path, 'utf8').indexOf(text)).split('\n').length

/** The repository's address, from the crate's metadata. @param {string} root */
function repositoryOf(root) {
  const found = /^repository = "(.*)"$/m.exec(readFileSync(join(root, 'Cargo.toml'), 'utf8'))
  return found?.[1] ?? ''
}

/** A page that stands alone begins with its title, and may say in a paragraph what it is. @param {Source} source @param {Problems} problems */
function titleOf({ file, tree }, problems) {
  const heading = tree.children.find(child => child.type === 'heading')
  if (!heading || tree.children[0] !== heading) {
    problems.add(file, 1, 'the page does not begin with its title')
    return {}
  }
  tree.children.shift()
  takeHeadingId(heading)
  // Whatever rank the title was written in, it is the page's first, and the others follow it.
  visit(tree, 'heading', other => void (other.depth = /** @type {1 | 2 | 3 | 4 | 5 | 6} */ (Math.max(2, other.depth - heading.depth + 1))))
  return { title: toString(heading) }
}

/**
 * @param {Pick<Context, 'root' | 'problems' | 'maths' | 'numbers' | 'citations' | 'glossary' | 'sources' | 'aims' | 'titles' | 'asked' | 'language' | 'repository'>
 *   & { chapter: string, texts: Source[], front: Record<string, any>, kicker: ElementContent | string, script: string, live: boolean, other?: string | undefined, sheet?: Context['sheet'] }} options
 * @returns {Rendered}
 */
function renderPage({ chapter, texts, front, kicker, script, live, other, sheet, ...shared }) {
  const labels = new Labels(chapter)
  /** @type {Context} */
  const context = { ...shared, file: '', labels, listings: new Map(), lines: new Set(), figure: undefined, bank: undefined, sheet, heads: [], depth: 1, notes: 0, last: '' }
  context.citations.beginPage()
  context.glossary.beginPage()
  for (const text of texts) labels.collect(text, context.problems)
  for (const { file, tree } of texts) {
    context.file = file
    visit(tree, { type: 'leafDirective', name: 'listing' }, node => readListing(context, node))
  }
  // Only lines that an algorithm links to get an anchor, and the algorithm may stand below the listing.
  for (const { tree } of texts) visit(tree, { type: 'textDirective', name: 'line' }, node => void readLine(context, node))
  const nodes = texts.flatMap(({ file, tree }) => {
    context.file = file
    return toContent(context, tree)
  })
  replaceReferences(context, nodes)
  const terms = context.glossary.here()
  // The figure beside the title is written before the first heading.
  const hero = nodes.filter(isHero)
  const main = [...sections(nodes.filter(node => !isHero(node))), ...(terms.length > 0 ? [glossarySection(context, terms)] : [])]
  replaceMinutes(main)
  const lead = inlineMarkdown(context, texts[0]?.file ?? '', String(front.lead ?? ''))
  return page({
    ...plain,
    title: String(front.title ?? ''),
    heading: unbroken(String(front.title ?? '')),
    kicker,
    lead,
    description: String(front.description ?? front.lead ?? front.title ?? ''),
    script,
    heads: sheet ? [] : context.heads,
    hero,
    main,
    previous: front.previous,
    next: front.next,
    live: live && texts.some(({ tree }) => tree.children.length > 0),
    language: shared.language,
    other,
  })
}

/** @param {ElementContent} node */
const isHero = node => node.type === 'element' && [node.properties.className].flat().includes('hero')

/** @param {Context} context @param {import('mdast').Root} tree @returns {ElementContent[]} */
function toContent(context, tree) {
  const root = toHast(tree, { handlers: handlers(context) })
  const nodes = root.type === 'root' ? root.children.filter(isContent) : isContent(root) ? [root] : []
  visit({ type: 'root', children: nodes }, 'element', element => {
    if (![element.properties.className].flat().includes('w')) element.children = together(element.children)
    if (element.tagName === 'th') nameHeader(element)
    if (element.properties.align) {
      element.properties.className = [`to-${element.properties.align}`]
      delete element.properties.align
    }
  })
  return nodes
}

/** A corner without words is no header; one of a formula alone is named by its letters, which screen readers may not find in it. @param {import('hast').Element} cell */
function nameHeader(cell) {
  const [only] = cell.children
  if (!only) cell.tagName = 'td'
  else cell.properties.scope ??= 'col'
  if (cell.children.length === 1 && only?.type === 'element' && only.tagName === 'math') cell.properties.ariaLabel = lettersOf(only)
}

/** @param {Context} context @param {string} file @param {string} text @returns {ElementContent[]} */
function inlineMarkdown(context, file, text) {
  if (!text) return []
  const [paragraph] = toContent({ ...context, file }, parse(file, text, context.problems).tree)
  return paragraph?.type === 'element' ? paragraph.children : []
}

/** The list of works, where the text asks for it; at the end, where it does not. @param {Context} context @param {ElementContent[]} nodes */
function replaceReferences(context, nodes) {
  let placed = false
  visit({ type: 'root', children: nodes }, 'element', element => {
    if (element.tagName !== 'references') return
    placed = true
    Object.assign(element, context.citations.list())
  })
  if (placed || !context.citations.citedHere) return
  context.heads.push({ depth: 2, id: 'references', content: [{ type: 'text', value: 'References' }] })
  nodes.push(h('h2', { id: 'references' }, h('a', { href: '#references' }, 'References')), context.citations.list())
}

/** Words that are read in a minute, where they are about mathematics; formulas are not counted. */
const PACE = 200

/** The minutes that a page takes to read, where its text says them: in steps of five. @param {ElementContent[]} main */
function replaceMinutes(main) {
  const words = total(wordsOf({ type: 'root', children: main }))
  visit({ type: 'root', children: main }, 'element', (element, index, parent) => {
    if (element.tagName !== 'minutes' || !parent || index === undefined) return
    const of = element.properties.dataOf === 'whole' ? words.whole : words.open
    parent.children[index] = { type: 'text', value: String(5 * Math.max(1, Math.round(of / PACE / 5))) }
  })
}

/** @param {Context} context @param {[key: string, entry: import('./glossary.mjs').Entry][]} terms */
function glossarySection(context, terms) {
  context.heads.push({ depth: 2, id: 'glossary', content: [{ type: 'text', value: 'Terms' }] })
  const entries = terms.map(([key, { name, also, text }]) =>
    h('div', { id: `gloss-${key}` }, h('dt', name, also.length > 0 ? h('span.also', `, ${also.join(', ')}`) : []), h('dd', inlineOf({ ...context, file: context.glossary.file }, text))),
  )
  return h('section.glossary', h('h2', { id: 'glossary' }, h('a', { href: '#glossary' }, 'Terms')), h('dl', entries))
}

/** @param {Context} context @param {import('mdast').Paragraph} paragraph */
function inlineOf(context, paragraph) {
  const [rendered] = toContent(context, { type: 'root', children: [paragraph] })
  return rendered?.type === 'element' ? rendered.children : []
}

/** A title, in which a word with a hyphen is not broken where there is room for it. @param {string} title @returns {ElementContent[]} */
const unbroken = title => title.split(/(\S*-\S*)/).map(part => (part.includes('-') ? h('span.whole', part) : { type: /** @type {const} */ ('text'), value: part }))

