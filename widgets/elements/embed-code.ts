// The code that puts a figure, as it stands, into another page: for the menu, and for the page that documents embedding.

import { elements as english } from '../words/en.json'
import { usualHeight } from './heights'

/** A figure as its author would write it: tag, and attributes in their order. */
export interface FigureMarkup {
  tag: string
  attributes: [string, string][]
}

/** What there is code for, and how a menu names it. */
export const CODES = { element: 'HTML element', iframe: 'iframe', myst: 'MyST', python: 'Python' } as const
export type CodeName = keyof typeof CODES

/** Width of a frame as it is pasted [px]: the controls stand beside the picture, and all is on one screen. */
export const FRAME_WIDTH = 900

const EDGE = 4 // [px], for what a browser rounds otherwise

/** Lives in a worker, which a sandboxed frame, without an origin, cannot have under the policy of our pages. */
const NEEDS_WORKER = 'fastslam-log'

/** Height that shows all of a figure in a frame of that width, what is folded closed [px]. */
export const frameHeight = (tag: string): number => usualHeight(tag, FRAME_WIDTH) + EDGE

/** What an address says of a figure, for the page for frames and for that on embedding. */
export const frameQuery = ({ tag, attributes }: FigureMarkup): string => String(new URLSearchParams([['figure', tag.replace('fastslam-', '')], ...attributes]))

/**
 * The code, for figures whose files are in the folder `home` (an address with a slash at its end). Until its script has arrived, and where
 * it never does, an element is what is in it: a picture that leads to the figure, and why it is none. The slot is one that no element has.
 */
export function embedCode(name: CodeName, { tag, attributes }: FigureMarkup, home: string, title: string, noScript: string = english.no_script): string {
  const short = tag.replace('fastslam-', '')
  if (name === 'element') {
    const text = attributes.map(([key, value]) => ` ${key}="${escape(value)}"`).join('')
    const page = escape(`${home}embed-${short}`)
    const instead = `<p slot="no-script"><a href="${page}.html"><img src="${page}.png" alt="${escape(title)}" width="100%" loading="lazy"></a><br>${escape(noScript)}</p>`
    return `<script type="module" src="${home}fastslam.js"></script>\n<${tag}${text}>${home && instead}</${tag}>`
  }
  if (name === 'iframe') {
    return (
      `<iframe src="${escape(`${home}embed.html?${frameQuery({ tag, attributes })}`)}" title="${escape(title)}" width="${FRAME_WIDTH}" height="${frameHeight(tag)}" ` +
      `${tag === NEEDS_WORKER ? '' : 'sandbox="allow-scripts allow-downloads allow-modals allow-popups allow-popups-to-escape-sandbox" '}credentialless allowfullscreen></iframe>`
    )
  }
  if (name === 'myst') {
    const model = JSON.stringify({ figure: short, ...Object.fromEntries(attributes) }, undefined, 2)
    return '```{anywidget} ' + `${home}fastslam-anywidget.js\n${model}\n` + '```'
  }
  const keywords = attributes.map(([key, value]) => `${key.replaceAll('-', '_')}=${python(value)}`).join(', ')
  return `from fastslam_widgets import ${className(tag)}\n\n${className(tag)}(${keywords})`
}

/** FastslamLap for fastslam-lap: the class of the element, and of the widget in Python. */
export function className(tag: string): string {
  return tag.replace(/(?:^|-)(.)/g, (_, letter: string) => letter.toUpperCase())
}

function python(value: string): string {
  if (value === 'on' || value === 'off') return value === 'on' ? 'True' : 'False'
  return value !== '' && Number.isFinite(Number(value)) ? value : JSON.stringify(value)
}

/** For an attribute in quotes, and for text. */
export function escape(text: string): string {
  return text.replaceAll('&', '&amp;').replaceAll('"', '&quot;').replaceAll('<', '&lt;')
}
