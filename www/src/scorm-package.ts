// A SCORM 1.2 package of an assignment, zipped here in the browser from the site's own files: nothing is uploaded anywhere.
import { strToU8, zipSync } from 'fflate'
import scorm from '../../widgets/scorm/scorm.js?raw'
import type { FigureMarkup } from '../../widgets/elements/embed-code'
import { imsManifest } from './ims-manifest'
import type { Task } from './task/task'

/** What the build writes of the files of an assignment (scripts/frames.mjs): those of every figure, and those of each besides. */
interface TaskFiles {
  common: string[]
  figures: Record<string, string[] | undefined>
}

export interface Assigned {
  figure: FigureMarkup
  title: string
  task: Task
  mastery?: number
}

async function fetched(address: string): Promise<Uint8Array> {
  const response = await fetch(address)
  if (!response.ok) throw new Error(`${address}: the server answered ${response.status}`)
  return new Uint8Array(await response.arrayBuffer())
}

/** The page of the assignment, with its figure and its question in it, and with what speaks to the learning system before all else. */
function startPage(html: string, home: string, { figure: { tag, attributes }, title, task }: Assigned): string {
  const page = new DOMParser().parseFromString(html, 'text/html')
  const figure = page.createElement(tag)
  for (const [name, value] of attributes) figure.setAttribute(name, value)
  figure.setAttribute('fit', '')
  page.querySelector('#figure')!.prepend(figure)
  page.title = title
  page.head.append(Object.assign(page.createElement('meta'), { name: 'site', content: home }))
  const given = page.createElement('script')
  given.type = 'application/json'
  given.id = 'given'
  given.textContent = JSON.stringify(task).replaceAll('<', '\\u003c')
  page.body.append(given)
  const script = page.createElement('script')
  script.setAttribute('src', 'scorm.js')
  script.defer = true
  page.querySelector('script')!.before(script)
  return `<!doctype html>\n${page.documentElement.outerHTML}\n`
}

/**
 * Figures that find themselves on a site offer its other pages and codes for it. In a package there are none: the script by whose name they
 * would know gets another one.
 */
const SITE = /\bfastslam(-[\w-]{8}\.js)\b/g

/** The package, for figures whose files are in the folder `home`. */
export async function scormPackage(home: string, assigned: Assigned): Promise<Blob> {
  const name = assigned.figure.tag.replace('fastslam-', '')
  const { common, figures } = JSON.parse(new TextDecoder().decode(await fetched(`${home}task-files.json`))) as TaskFiles
  const paths = [...common, ...(figures[name] ?? [])]
  const entries = await Promise.all(paths.map(async path => [path, await fetched(home + path)] as const))
  const files: Record<string, Uint8Array> = {}
  for (const [path, bytes] of entries) {
    const isText = /\.(js|css|html)$/.test(path)
    const text = isText ? new TextDecoder().decode(bytes).replace(SITE, 'shared$1') : ''
    if (path === 'task.html') files['index.html'] = strToU8(startPage(text, home, assigned))
    else files[path.replace(SITE, 'shared$1')] = isText ? strToU8(text) : bytes
  }
  files['scorm.js'] = strToU8(scorm)
  files['imsmanifest.xml'] = strToU8(
    imsManifest({
      identifier: `fastslam-${name}-${fingerprint(JSON.stringify(assigned))}`,
      title: assigned.title,
      start: 'index.html',
      files: Object.keys(files).sort(),
      ...(assigned.mastery !== undefined && { mastery: assigned.mastery }),
    }),
  )
  // The same time in every package, so that the same assignment gives the same file.
  return new Blob([zipSync(files, { level: 9, mtime: '1980-01-01T00:00:00' }) as Uint8Array<ArrayBuffer>], { type: 'application/zip' })
}

/** Of two assignments in one course each has a name of its own; the same one again has the same. */
function fingerprint(text: string): string {
  let hash = 2166136261
  for (const byte of strToU8(text)) hash = Math.imul(hash ^ byte, 16777619)
  return (hash >>> 0).toString(16).padStart(8, '0')
}
