// `:::figure`: the live element, with its picture for readers without script, for paper, and until it wakes.
import { existsSync, readFileSync } from 'node:fs'
import { join } from 'node:path'
import { h } from 'hastscript'
import { attribute, content, idOf, latest } from './context.mjs'
import { captioned } from './blocks.mjs'
import { challengesOf, judgeChips } from './challenges.mjs'

const own = new Set(['id', 'class', 'tag', 'alt', 'hero', 'poster'])

/** Width and height [px] from a PNG's header. @param {Buffer} png */
const sizeOf = png => ({ width: png.readUInt32BE(16), height: png.readUInt32BE(20) })

/** In both themes. @param {string} name */
export const pictures = name => ['light', 'dark'].map(theme => `widgets/pictures/${name}-${theme}.png`)

/** A picture in the theme of the reader's screen. @param {string} root @param {string} light @param {string} dark @param {string} [alt] */
export const sized = (root, light, dark, alt) => {
  const size = existsSync(join(root, light)) ? sizeOf(readFileSync(join(root, light))) : {}
  return h('picture', [
    // Paper is light.
    h('source', { srcset: `../${dark}`, media: 'screen and (prefers-color-scheme: dark)' }),
    h('img', { src: `../${light}`, ...size, loading: 'lazy', alt }),
  ])
}

/** What the figure beside the title has not while it is folded: all of the picture but its first part, and all controls but its pause. */
const folded = { show: 'map', controls: 'play', chips: 'off', fit: 'on' }

/** A list of its challenges. @param {any} node */
const isTries = node => node.type === 'list' && node.children.every((/** @type {any} */ item) => item.children[0]?.children?.[0]?.name === 'chip')

/** @type {import('./context.mjs').Handler} */
export function figure(context, state, node) {
  const { file, problems, root } = context
  const tag = attribute(node, 'tag') ?? ''
  const alt = attribute(node, 'alt')
  if (!/^fastslam-[a-z-]+$/.test(tag)) problems.add(file, node, `:::figure has no tag of ours, but “${tag}”`)
  if (!alt) problems.add(file, node, ':::figure has no alt: say in words what its picture shows')
  // One that opens in a state of its own has a picture of that.
  const [light = '', dark = ''] = pictures(attribute(node, 'poster') ?? tag)
  for (const picture of [light, dark]) {
    if (!existsSync(join(root, picture))) problems.add(file, node, `there is no picture ${picture} for this figure`)
  }
  const passed = Object.entries(node.attributes ?? {}).filter(([name]) => !own.has(name))
  const id = idOf(node)
  context.figure = { tag, challenges: challengesOf(root, tag), told: [] }
  // What there is to try unfolds: the chips over the picture have the same.
  const parts = node.children.map((/** @type {any} */ child) => (isTries(child) ? h('details.tries', h('summary', 'Things to try'), content(state, [child])) : content(state, [child])))
  const caption = captioned(context, node, parts.flat())
  judgeChips(context, node)
  context.figure = undefined
  // Beside the title it is folded to its picture and plays by itself: from a step to a step, and then rests at one (www/src/hero.ts).
  const hero = attribute(node, 'hero')
  return h(hero ? 'figure.hero' : 'figure.wide', { id, dataPlays: hero, dataFolds: hero && Object.keys(folded).join(' ') }, [
    h(tag || 'div', { ...latest, ...(hero && folded), ...Object.fromEntries(passed) }, [
      sized(root, light, dark, alt),
    ]),
    h('figcaption', caption, h('p.address', `Live: #${id}`)),
  ])
}

/** `:::picture{#fig-x src="x.png" alt="…"}`: a still picture of www/data, for what cannot be run on the page. @type {import('./context.mjs').Handler} */
export function picture(context, state, node) {
  const { file, problems, root } = context
  const [src, alt] = [attribute(node, 'src') ?? '', attribute(node, 'alt')]
  const path = join(root, 'www', 'data', src)
  if (!alt) problems.add(file, node, ':::picture has no alt: say in words what it shows')
  if (!src || !existsSync(path)) problems.add(file, node, `there is no picture www/data/${src}`)
  const size = src && existsSync(path) ? sizeOf(readFileSync(path)) : {}
  return h('figure.wide', { id: idOf(node) }, h('img', { src: `./data/${src}`, ...size, loading: 'lazy', alt }), h('figcaption', captioned(context, node, content(state, node.children))))
}
