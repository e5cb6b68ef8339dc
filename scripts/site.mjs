// Checks of the built site: every link leads somewhere, and the HTML is what the standard says.
import { existsSync, readdirSync, readFileSync, statSync } from 'node:fs'
import { dirname, join, relative } from 'node:path'
import { fromHtml } from 'hast-util-from-html'
import { FileSystemConfigLoader, formatterFactory, HtmlValidate } from 'html-validate'
import { visit } from 'unist-util-visit'
import { dist } from './build.mjs'
import { site } from './frames.mjs'
import { StepError } from './lib.mjs'

/** @param {string} folder */
const pagesOf = folder => readdirSync(folder, { recursive: true, encoding: 'utf8' }).filter(file => file.endsWith('.html')).sort()

/** @typedef {{ ids: Set<string>, tags: Set<string>, links: string[], twice: string[] }} Page */

/** @param {string} html @returns {Page} */
function read(html) {
  /** @type {Page} */
  const page = { ids: new Set(), tags: new Set(), links: [], twice: [] }
  visit(fromHtml(html), 'element', ({ tagName, properties }) => {
    const { id, href, src, srcSet } = properties
    page.tags.add(tagName)
    if (typeof id === 'string') {
      if (page.ids.has(id)) page.twice.push(id)
      page.ids.add(id)
    }
    for (const link of [href, src, ...[srcSet ?? []].flat()]) if (link) page.links.push(String(link).trim().split(' ')[0] ?? '')
  })
  return page
}

/**
 * What is wrong with the links of a folder of pages. Links to other sites are looked at, not followed: a check that needs the network fails
 * for reasons that are not ours.
 * @param {string} folder @param {string} [home] where the folder is served, for links that have to be whole addresses
 * @returns {{ wrong: string[], count: number }}
 */
export function brokenLinks(folder, home) {
  const pages = new Map(pagesOf(folder).map(file => [join(folder, file), read(readFileSync(join(folder, file), 'utf8'))]))
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

export async function checkLinks() {
  const { wrong, count } = brokenLinks(dist, site())
  if (count === 0) throw new StepError('There is not one link: has the site been built?')
  if (wrong.length > 0) throw new StepError(`Links that lead nowhere:\n${wrong.join('\n')}`)
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
