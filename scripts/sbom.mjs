// What is in all that we ship, as a list for machines: an SBOM in CycloneDX's format, which goes where the licences go.
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import { capture, root, StepError } from './lib.mjs'
import { cratesShipped } from './notices.mjs'

/** @typedef {{ name: string, version: string, licence: string, purl: string, what?: string }} Shipped */

/** An npm package of which something is shipped. @param {string} name @param {string} [what] @returns {Shipped} */
function npmPackage(name, what) {
  const { version, license } = JSON.parse(readFileSync(join(root, 'node_modules', name, 'package.json'), 'utf8'))
  return { name, version, licence: license, purl: `pkg:npm/${name.replace('@', '%40')}@${version}`, ...(what && { what }) }
}

/** Of npm packages, those whose code or fonts are in the site or in a package. */
export const npmShipped = () => [
  npmPackage('fflate', 'zips packages on the page on embedding'),
  npmPackage('@fontsource/stix-two-text', 'the text, a subset'),
  npmPackage('@fontsource/stix-two-math', 'formulas, a subset'),
  npmPackage('@fontsource/source-code-pro', 'listings, a subset'),
]

/** The version of the font from which the letters in pictures are, as the font itself tells it: in OpenType, a fixed-point number of its head. */
function inter() {
  const font = readFileSync(join(root, 'widgets', 'kit', 'fonts', 'Inter-Regular-subset.otf'))
  const tables = Array.from({ length: font.readUInt16BE(4) }, (_, i) => font.subarray(12 + 16 * i, 28 + 16 * i))
  const head = tables.find(table => table.toString('latin1', 0, 4) === 'head')
  if (!head) throw new StepError('The font Inter has no head.')
  return String(Number((font.readInt32BE(head.readUInt32BE(8) + 4) / 65536).toFixed(3)))
}

/** All of it. @returns {Shipped[]} */
export function shipped() {
  const rust = /^rustc (\S+)/.exec(capture('rustc', '-V') ?? '')?.[1]
  if (!rust) throw new StepError('rustc -V tells no version.')
  return [
    ...cratesShipped().map(({ name, version, licence }) => ({ name, version, licence, purl: `pkg:cargo/${name}@${version}` })),
    { name: 'rust-std', version: rust, licence: 'MIT OR Apache-2.0', purl: `pkg:generic/rust-std@${rust}`, what: 'the standard library, as far as it is used' },
    { name: 'Inter', version: inter(), licence: 'OFL-1.1', purl: `pkg:generic/inter@${inter()}`, what: 'letters in pictures, a subset as outlines' },
    ...npmShipped(),
  ]
}

/** The list. It has neither a time nor a number of its own, so that the same contents give the same file. @returns {Promise<string>} */
export async function sbom() {
  // Imported late: set-up may be what installs it.
  const { Enums, Models, Serialize, Spec } = await import('@cyclonedx/cyclonedx-library')
  const { version } = JSON.parse(readFileSync(join(root, 'package.json'), 'utf8'))
  const component = (/** @type {InstanceType<typeof Models.Component>['type']} */ type, /** @type {Shipped} */ { name, version, licence, purl, what }) => {
    const made = new Models.Component(type, name, { version, purl, bomRef: purl, ...(what && { description: what }) })
    licence = licence.replaceAll('/', ' OR ') // in old manifests
    made.licenses.add(/ (OR|AND|WITH) /.test(licence) ? new Models.LicenseExpression(licence) : new Models.SpdxLicense(licence))
    return made
  }
  const bom = new Models.Bom()
  bom.metadata.component = component(Enums.ComponentType.Application, { name: 'fastslam', version, licence: 'MIT OR Apache-2.0', purl: `pkg:generic/fastslam@${version}` })
  for (const each of shipped()) bom.components.add(component(each.licence === 'OFL-1.1' ? Enums.ComponentType.File : Enums.ComponentType.Library, each))
  for (const each of bom.components) bom.metadata.component.dependencies.add(each.bomRef)
  return new Serialize.JsonSerializer(new Serialize.JSON.Normalize.Factory(Spec.Spec1dot6)).serialize(bom, { sortLists: true, space: 1 })
}
