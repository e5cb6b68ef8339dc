// Whoever gets a package gets the licences of all that is in it.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import { cratesShipped, notices } from '../../scripts/notices.mjs'

test('the notices name every crate of the programs and have the texts that ask to go along', () => {
  const [text, crates] = [notices(), cratesShipped()]
  assert.ok(crates.length > 20)
  for (const { name, version, licence } of crates) {
    assert.ok(name && version && licence, `${name} ${version} ${licence}`)
    assert.ok(text.includes(`  ${name} ${version}: ${licence}`), name)
  }
  for (const words of ['SIL OPEN FONT LICENSE', 'Copyright (c) 2011 Google Inc.', 'Permission is hereby granted, free of charge', 'Version 2.0, January 2004']) assert.ok(text.includes(words), words)
})
