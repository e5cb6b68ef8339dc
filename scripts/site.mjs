// Checks of the built site: every link leads somewhere, and the HTML is what the standard says.
import { existsSync, readdirSync, readFileSync, statSync } from 'node:fs'
import { dirname, join, relative } from 'node:path'
import { fromHtml } from 'hast-util-from-html'
import { FileSystemConfigLoader, formatterFactory, HtmlValidate } from 'html-validate'
import { visit } from 'unist-util-visit'
import { site } from './address.mjs'
import { dist } from './build.mjs'
import { StepError } from './lib.mjs'

/** Without the versions that are kept: they are copies, and nothing can be mended in them. @param {string} folder */
const pagesOf = folder => readdirSync(folder, { recursive: true, encoding: 'utf8' }).filter(file => file.endsWith('.html') && !/^v[/\\]/.test(file)).sort()

/** @typedef {{ ids: Set<string>, tags: Set<string>, links: string[], ways: string[], twice: string[] }} Page `ways`: links that a reader can follow */

/** The pages of a folder. @param {string} folder */
export const readPages = folder => new Map(pagesOf(folder).map(file => [join(folder, file), read(readFileSync(join(folder, file), 'utf8'))]))

/** @param {string} html @returns {Page} */
function read(html) {
  /** @type {Page} */
  const page = { ids: new Set(), tags: new Set(), links: [], ways: [], twice: [] }
  visit(fromHtml(html), 'element', ({ tagName, properties }) => {
    const { id, href, src, srcSet } = properties
    page.tags.add(tagName)
    if (typeof id === 'string') {
      if (page.ids.has(id)) page.twice.push(id)
      page.ids.add(id)
    }
    if (tagName === 'a' && href) page.ways.push(String(href).trim())
    for (const link of [href, src, ...[srcSet ?? []].flat()]) if (link) page.links.push(String(link).trim().split(' ')[0] ?? '')
  })
  return page
}

/**
 * What is wrong with the links of a folder of pages. Links to other sites are looked at, not followed: a check that needs the network fails
 * for reasons that are not ours.
 * @param {string} folder @param {string} [home] where the folder is served, for links that have to be whole addresses
 * @param {Map<string, Page>} [pages] of the folder, where they were read before
 * @returns {{ wrong: string[], count: number }}
 */
export function brokenLinks(folder, home, pages = readPages(folder)) {
  /** @type {string[]} */
  const wrong = []
  let count = 0
  for (const [path, { links, twice }] of pages) {
    const complain = (/** @type {string} */ text) => wrong.push(`${relative(folder, path)}: ${text}`)
    for (const id of twice) complain(`the id ${id} is there twice`)
    for (const address of links) {
      count++
      const link = home && address.startsWith(home) ? relative(dirname(path), join(folder, address.slice(home.length) || 'index.html')) : address
      if (/^[a-z]+:/i.test(link)) {
        if (!URL.canParse(link) || !/^(https|mailto|data|blob):/.test(link)) complain(`${link} is no address, or not a secure one`)
        continue
      }
      const [, file = '', , fragment] = /^([^?#]*)(\?[^#]*)?(?:#(.*))?$/.exec(link) ?? []
      const target = file === '' ? path : join(dirname(path), decodeURIComponent(file))
      const found = existsSync(target) && statSync(target).isDirectory() ? join(target, 'index.html') : target
      if (!existsSync(found)) complain(`${link} leads to no file`)
      else if (fragment) {
        // A link to a figure's state is #key?query; the key is its id or, without one, its tag.
        const [key = '', query] = decodeURIComponent(fragment).split('?')
        const there = pages.get(found)
        if (there && !there.ids.has(key) && !(query !== undefined && there.tags.has(key))) complain(`${link}: there is no such place`)
      }
    }
  }
  return { wrong, count }
}

/** A page for frames that is told which figure: without that it can only say what there is. @param {string} link */
const isBareFrame = link => /(^|\/)embed\.html(?!\?(.*&)?figure=)/.test(link)

/**
 * Which pages of a folder no reader finds who begins at index.html, and which links of theirs lead to a frame without a figure.
 * @param {string} folder @param {Map<string, Page>} [pages] of the folder, where they were read before @returns {string[]}
 */
export function unreached(folder, pages = readPages(folder)) {
  const bare = [...pages].flatMap(([path, { ways }]) => ways.filter(isBareFrame).map(way => `${relative(folder, path)}: ${way} is a frame without a figure`))
  const reached = new Set([join(folder, 'index.html')])
  // A set that grows while it is walked: what is added is visited.
  for (const path of reached) {
    for (const way of pages.get(path)?.ways ?? []) {
      const file = way.replace(/[?#].*/, '')
      if (file === '' || /^[a-z]+:/i.test(way)) continue
      const target = join(dirname(path), decodeURIComponent(file))
      for (const found of [target, join(target, 'index.html')]) if (pages.has(found)) reached.add(found)
    }
  }
  return [...bare, ...[...pages.keys()].filter(path => !reached.has(path)).map(path => `${relative(folder, path)}: no way leads there from index.html`)]
}

/** Files of a folder that name the machine on which they were built. @param {string} folder @returns {string[]} */
export const atHome = folder =>
  readdirSync(folder, { recursive: true, encoding: 'utf8' })
    .filter(file => /\.(html|json|js|css|ts|svg|txt|pdf)$/.test(file) && /\/\/(localhost|127\.0\.0\.1)(?![\w.-])/.test(readFileSync(join(folder, file), 'latin1')))
    .map(file => `${file}: says localhost`)

export async function checkLinks() {
  const pages = readPages(dist)
  const { wrong, count } = brokenLinks(dist, site() || undefined, pages)
  wrong.push(...unreached(dist, pages), ...atHome(dist))
  if (count === 0) throw new StepError('There is not one link: has the site been built?')
  if (wrong.length > 0) throw new StepError(`Links that lead nowhere, and pages that no link leads to:\n${wrong.join('\n')}`)
  return `${count} links`
}

export async function checkHtml() {
  const loader = new FileSystemConfigLoader({
    root: true,
    extends: ['html-validate:recommended'],
    rules: {
      // The serializer's way of writing is as good as another.
      'attribute-boolean-style': 'off',
      'attribute-empty-style': 'off',
      'void-style': 'off',
      'no-trailing-whitespace': 'off',
      'long-title': 'off',
      'doctype-style': 'off',
      // A note beside the text is a note, which HTML has no element for.
      'prefer-native-element': ['error', { exclude: ['note'] }],
    },
  })
  const validator = new HtmlValidate(loader)
  const files = pagesOf(dist).map(file => join(dist, file))
  if (files.length === 0) throw new StepError('There is not one page: has the site been built?')
  const report = await validator.validateMultipleFiles(files)
  if (!report.valid) throw new StepError(`HTML that is not valid:\n${formatterFactory('text')(report.results)}`)
  return `${files.length} pages`
}
