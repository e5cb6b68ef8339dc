// The site that `npm run site -- .cache/site` has put there.
import assert from 'node:assert/strict'
import { existsSync, readFileSync, statSync } from 'node:fs'
import { join } from 'node:path'
import { test } from 'node:test'
import { unzipSync } from 'fflate'
import { cache, run } from '../../scripts/lib.mjs'
import { brokenLinks, readPages } from '../../scripts/site.mjs'

const site = cache('site')
const downloads = [...readFileSync(join(site, 'downloads.html'), 'utf8').matchAll(/href="\.\/(downloads\/[^"]+)"/g)].map(([, file = '']) => file)

test('no link of its pages leads nowhere, and its downloads are among them', () => {
  const pages = readPages(site)
  for (const path of pages.keys()) if (path.startsWith(join(site, 'downloads/'))) pages.delete(path) // they stand alone
  assert.ok(downloads.length > 20, `${downloads.length} downloads`)
  assert.deepEqual(brokenLinks(site, undefined, pages).wrong, [])
})

test('each download is what it is called, whole, with its licences', async () => {
  for (const file of downloads) {
    const path = join(site, file)
    assert.ok(existsSync(path) && statSync(path).size > 5000, file)
    if (/\.html$/.test(file)) assert.match(readFileSync(path, 'utf8'), /^<!doctype html>[^]*<\/html>\s*$/, file)
    if (/\.(zip|whl)$/.test(file)) {
      const inside = Object.keys(unzipSync(readFileSync(path)))
      assert.ok(inside.some(name => name.endsWith('licences.txt')), file)
    }
    if (/\.tgz$/.test(file)) assert.match((await run('tar', ['-tzf', path])).output, /licences\.txt/)
  }
})
