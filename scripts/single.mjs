// A script, and all it needs, as one file that carries the figures' program along: for notebooks, and for pages opened from a file.
import { readFileSync } from 'node:fs'
import { dirname, join } from 'node:path'
import { gzipSync } from 'node:zlib'
import { catalogue, figures } from './elements.mjs'
import { root, StepError, targets } from './lib.mjs'
import { chapterPrograms, partsOf, programFile, programs as programOf } from './registry.mjs'

const elements = join(root, 'widgets', 'elements')
export const notebook = join(elements, 'notebook.ts')

/** One script of a source and all it imports. @param {string} entry @param {'es' | 'iife'} format @param {import('vite').Plugin[]} plugins */
async function bundle(entry, format, plugins = []) {
  const { build } = await import('vite')
  const built = await build({
    configFile: false,
    root: elements,
    base: './',
    logLevel: 'error', // it warns of addresses that only modules have, which nothing here asks for
    build: {
      write: false,
      ...targets,
      assetsInlineLimit: 0,
      reportCompressedSize: false,
      rollupOptions: { input: entry, preserveEntrySignatures: 'strict', output: { format, entryFileNames: '[name].js', codeSplitting: false } },
    },
    plugins,
  })
  const output = [built].flat().flatMap(result => ('output' in result ? result.output : []))
  const scripts = output.filter(file => file.type === 'chunk')
  if (scripts.length !== 1 || !scripts[0]) throw new StepError(`${entry} came out as ${scripts.length} scripts: ${scripts.map(({ fileName }) => fileName).join(', ')}`)
  return scripts[0].code
}

/** Languages that it speaks besides English. */
const languages = (process.env.FASTSLAM_LANGUAGES ?? '').split(/[\s,]+/).filter(Boolean)

/**
 * The script, as text.
 * @param {string} entry its source @param {string[]} [names] the programs that it carries: that of logs with the example
 * @returns {Promise<string>}
 */
export async function singleFile(entry, names = chapterPrograms) {
  const packed = (/** @type {string} */ name) => gzipSync(readFileSync(programFile(name)), { level: 9 }).toString('base64')
  const programs = Object.fromEntries(names.map(name => [name, packed(name)]))
  const carriedParts = names.flatMap(partsOf)
  // No module: pages opened from a file may not start workers that are modules.
  const worker = await bundle(join(elements, 'worker.ts'), 'iife')
  const example = carriedParts.includes('log') ? readFileSync(join(root, 'www', 'public', 'example.clf.gz')).toString('base64') : ''
  const words = Object.fromEntries(languages.map(language => [language, catalogue(language)]))
  const carried = `export const example = ${JSON.stringify(example)}; export const programs = ${JSON.stringify(programs)}; export const worker = ${JSON.stringify(worker)}; export const words = ${JSON.stringify(words)}`
  const present = figures().filter(({ tag, name }) => carriedParts.includes(programOf.get(tag) ?? '') || carriedParts.includes(name))
  /** Code of elements that would find no program in it. */
  const without = [...programOf.keys()].filter(tag => !present.some(figure => figure.tag === tag)).map(tag => join(elements, tag))
  if (!present.some(({ counted }) => counted)) without.push(join(elements, 'count-study'))
  return bundle(entry, 'es', [
    {
      name: 'fastslam-files',
      enforce: 'pre',
      resolveId(source, importer) {
        if (source === 'virtual:fastslam-files') return `\0${source}`
        if (importer && without.includes(join(dirname(importer), source.replace(/\.ts$/, '')))) return '\0none'
        return source === './files' && importer?.startsWith(elements) ? join(elements, 'files-inline.ts') : undefined
      },
      load: id => (id === '\0virtual:fastslam-files' ? carried : id === '\0none' ? 'export {}' : undefined),
    },
  ])
}
