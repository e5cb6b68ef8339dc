// The document around the text: title, contents, main part, terms, neighbours.
import { toHtml } from 'hast-util-to-html'
import { h } from 'hastscript'
import { contents } from './contents.mjs'
import { say } from './translation.mjs'

/**
 * @typedef {import('hast').ElementContent} ElementContent
 * @typedef {{ title: string, href: string }} Neighbour
 */

/**
 * @typedef {object} Page
 * @property {string} title
 * @property {ElementContent[]} heading the title as it is set
 * @property {ElementContent | string} kicker
 * @property {ElementContent[]} lead
 * @property {string} description for search engines
 * @property {string} script the module that the page runs
 * @property {import('./context.mjs').Head[]} heads
 * @property {ElementContent[]} hero the figure beside the title, if there is one
 * @property {ElementContent[]} main
 * @property {Neighbour | undefined} previous
 * @property {Neighbour | undefined} next
 * @property {boolean} live whether there are figures on it
 * @property {import('./translation.mjs').Language} language
 * @property {string | undefined} other its address in the other language
 * @property {string} foot who may do what with it
 * @property {string[]} fonts those to fetch at once
 */

/** What stands beside the chapter, from every page. */
const doors = [['model.html', 'For teachers'], ['embed/', 'Embed'], ['model.html#cite', 'Cite']]

/** @param {Page} page @returns {{ head: ElementContent[], body: ElementContent[], language: import('./translation.mjs').Language }} */
export function page({ title, heading, kicker, lead, description, script, heads, hero, main, previous, next, live, language, other, foot, fonts }) {
  const ways = doors.flatMap(([href, name = '']) => [' · ', h('a', { href }, say(language, name))])
  const translation = language === 'de' ? { name: 'English', to: 'en' } : { name: 'Deutsch', to: 'de' }
  if (other) ways.push(' · ', h('a', { href: other, lang: translation.to, hrefLang: translation.to }, translation.name))
  const neighbour = (/** @type {string} */ rel, /** @type {string} */ name, /** @type {Neighbour | undefined} */ to) =>
    to ? [h('a', { href: to.href, rel }, h('small', name), ' ', to.title)] : []
  const around = [...neighbour('prev', 'Previous', previous), ...neighbour('next', 'Next', next)]
  return {
    language,
    head: [
      h('meta', { charset: 'utf-8' }),
      h('meta', { name: 'viewport', content: 'width=device-width, initial-scale=1' }),
      h('title', title),
      h('meta', { name: 'description', content: description }),
      h('meta', { name: 'color-scheme', content: 'light dark' }),
      h('link', { rel: 'icon', href: './favicon.svg', type: 'image/svg+xml' }),
      ...fonts.map(font => h('link', { rel: 'preload', href: `./generated/${font}.woff2`, as: 'font', type: 'font/woff2', crossorigin: '' })),
      h('link', { rel: 'stylesheet', href: './src/style.css' }),
      ...(language === 'de' ? [h('link', { rel: 'stylesheet', href: './src/german.css' })] : []),
      h('script', { type: 'module', src: script }),
    ],
    body: [
      h('a.skip', { href: '#chapter' }, say(language, 'Skip to the chapter')),
      h('header', h('div', h('nav.kicker', { ariaLabel: say(language, 'Site') }, kicker, h('span', ways)), h('h1', heading), lead.length > 0 ? h('p.lead', lead) : []), hero),
      heads.length > 1 ? h('nav.contents', { ariaLabel: say(language, 'Contents') }, h('details', h('summary', say(language, 'Contents')), contents(heads))) : [],
      h('main', { id: 'chapter', tabIndex: -1 }, [
        ...(live ? [h('noscript', h('p.hint', say(language, 'The figures run with JavaScript and WebAssembly. Without them you see them at rest.')))] : []),
        ...main,
      ]),
      around.length > 0 ? h('nav.around', { ariaLabel: 'Other chapters' }, around) : [],
      h('footer', h('p', say(language, foot), h('span', ways, ' · ', h('a', { href: 'trust.html' }, say(language, 'Privacy and accessibility'))))),
    ].flat(),
  }
}

/** @param {ElementContent[]} nodes */
export const serialize = nodes => toHtml(nodes, { characterReferences: { useNamedReferences: true } })
