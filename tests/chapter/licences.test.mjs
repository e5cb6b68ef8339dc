// Whoever gets a package gets the licences of all that is in it.
import assert from 'node:assert/strict'
import { readdirSync, readFileSync } from 'node:fs'
import { join } from 'node:path'
import { test } from 'node:test'
import { root } from '../../scripts/lib.mjs'
import { cratesShipped, notices } from '../../scripts/notices.mjs'
import { npmShipped, sbom, shipped } from '../../scripts/sbom.mjs'

test('the notices name every crate of the programs and have the texts that ask to go along', () => {
  const [text, crates] = [notices(), cratesShipped()]
  assert.ok(crates.length > 20)
  for (const { name, version, licence } of crates) {
    assert.ok(name && version && licence, `${name} ${version} ${licence}`)
    assert.ok(text.includes(`  ${name} ${version}: ${licence}`), name)
  }
  for (const words of ['SIL OPEN FONT LICENSE', 'Copyright (c) 2011 Google Inc.', 'Permission is hereby granted, free of charge', 'Version 2.0, January 2004']) assert.ok(text.includes(words), words)
})

test('the SBOM lists all that is shipped, each with version, licence and address of its package, and is the same each time', async () => {
  const text = await sbom()
  const bom = JSON.parse(text)
  assert.deepEqual([bom.bomFormat, bom.specVersion], ['CycloneDX', '1.6'])
  assert.deepEqual(bom.components.map((/** @type {{ name: string }} */ { name }) => name).sort(), shipped().map(({ name }) => name).sort())
  for (const { name, version, purl, licenses } of bom.components) assert.ok(version && purl?.startsWith('pkg:') && (licenses?.[0]?.expression ?? licenses?.[0]?.license?.id), name)
  assert.equal(bom.metadata.component.name, 'fastslam')
  assert.equal(text, await sbom())
})

test('what scripts of pages import of npm packages is among what is shipped', () => {
  const folders = ['widgets/elements', 'www/src']
  const files = folders.flatMap(folder => readdirSync(join(root, folder), { recursive: true, encoding: 'utf8' }).filter(file => file.endsWith('.ts')).map(file => join(root, folder, file)))
  const imported = new Set(files.flatMap(file => [...readFileSync(file, 'utf8').matchAll(/^(?:import|export) .*from '([^.'][^']*)'/gm)].map(([, name]) => String(name))).filter(name => !name.startsWith('virtual:')))
  const names = npmShipped().map(({ name }) => name)
  for (const name of imported) assert.ok(names.includes(name), `${name} is imported, and not in scripts/sbom.mjs`)
  for (const name of names) assert.ok(name.startsWith('@fontsource/') || notices().includes(name), `${name} is not in the notices`)
})
