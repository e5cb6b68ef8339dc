// Whose work is in what we ship, and under which licences: one text, which goes into every package and lies on the site.
import { readdirSync, readFileSync } from 'node:fs'
import { dirname, join } from 'node:path'
import { licences } from './chapter/fonts.mjs'
import { capture, root, StepError } from './lib.mjs'

/** Name, version and licence of each crate in the figures' programs. @returns {{ name: string, version: string, licence: string }[]} */
export function cratesShipped() {
  const tree = capture('cargo', 'tree', '--locked', '-p', 'fastslam-widgets', '--target', 'wasm32-unknown-unknown', '-e', 'normal,no-proc-macro', '--prefix', 'none', '--no-dedupe', '--format', '{p}|{l}')
  if (!tree) throw new StepError('cargo tree says nothing of fastslam-widgets.')
  const lines = [...new Set(tree.split('\n'))].filter(line => !line.includes('fastslam'))
  return lines.map(line => {
    const [, name = '', version = '', licence = ''] = /^(\S+) v(\S+).*\|(.*)$/.exec(line) ?? []
    return { name, version, licence }
  })
}

/** What a crate's package has of licences and notices. @param {string} folder */
const textsIn = folder =>
  readdirSync(folder)
    .filter(file => /^(licen[cs]e|copying|notice|unlicense)/i.test(file) && !/\.(rs|toml)$/.test(file))
    .sort()
    .map(file => readFileSync(join(folder, file), 'utf8').trim())

/** The whole text. */
export function notices() {
  /** @type {{ name: string, version: string, manifest_path: string }[]} */
  const all = JSON.parse(capture('cargo', 'metadata', '--locked', '--format-version', '1') ?? '{"packages":[]}').packages
  const crates = cratesShipped()
  /** The crates of each text, as many have the same. @type {Map<string, string[]>} */
  const texts = new Map()
  for (const { name, version } of crates) {
    const found = all.find(crate => crate.name === name && crate.version === version)
    for (const text of found ? textsIn(dirname(found.manifest_path)) : []) texts.set(text, [...(texts.get(text) ?? []), name])
  }
  const list = crates.map(({ name, version, licence }) => `  ${name} ${version}: ${licence}`)
  const line = '='.repeat(80)
  return [
    'The figures and the library fastslam are under the MIT licence or the Apache licence 2.0, as you like; the text of the chapter is under CC BY 4.0.',
    readFileSync(join(root, 'LICENSE-MIT'), 'utf8').trim(),
    `In the figures' programs are these crates, and the standard library of Rust (MIT OR Apache-2.0):\n${list.join('\n')}`,
    'Letters in the pictures are outlines of Inter.',
    readFileSync(join(root, 'widgets', 'kit', 'fonts', 'OFL.txt'), 'utf8').trim(),
    'Fonts of the chapter.',
    licences(root).trim(),
    `fflate, which zips packages on the page on embedding.\n\n${readFileSync(join(root, 'node_modules', 'fflate', 'LICENSE'), 'utf8').trim()}`,
    ...[...texts].map(([text, names]) => `${names.join(', ')}\n\n${text}`),
  ].join(`\n\n${line}\n\n`)
}
