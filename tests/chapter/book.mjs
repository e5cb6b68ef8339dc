// A small repository for a test to build a chapter from.
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { dirname, join } from 'node:path'
import { serialize } from '../../scripts/chapter/page.mjs'
import { renderChapter } from '../../scripts/chapter/chapter.mjs'

const title = '---\ntitle: A Title\nnumber: 17\nlead: What it *says*.\n---\n'
/** The first bytes of a PNG, 120 by 60 pixels. */
const png = Buffer.concat([Buffer.from('89504e470d0a1a0a0000000d49484452', 'hex'), Buffer.from([0, 0, 0, 120, 0, 0, 0, 60])])

/** What the figures have told: that of the lap has these challenges, each with its goal. @param {Record<string, string>} goals */
export const told = goals => ({ '.cache/figures.json': JSON.stringify([{ tag: 'fastslam-lap', chips: Object.entries(goals).map(([name, goal]) => ({ name, goal })) }]) })

const always = {
  ...told({}),
  'Cargo.toml': 'repository = "https://example.org/repo"\n',
  'widgets/pictures/fastslam-lap-light.png': png,
  'widgets/pictures/fastslam-lap-dark.png': png,
  'www/chapter/00-title.md': title,
}

/** The chapter of one section, and other files by path. @param {string} text @param {Record<string, string | Buffer>} [others] */
export async function book(text, others = {}) {
  const root = mkdtempSync(join(tmpdir(), 'chapter-'))
  try {
    for (const [path, content] of Object.entries({ ...always, 'www/chapter/01-text.md': text, ...others })) {
      mkdirSync(dirname(join(root, path)), { recursive: true })
      writeFileSync(join(root, path), content)
    }
    return await renderChapter(root)
  } finally {
    rmSync(root, { recursive: true })
  }
}

/** Its main part as HTML. @param {string} text @param {Record<string, string | Buffer>} [others] */
export async function html(text, others) {
  const { pages } = await book(text, others)
  return /<main[^>]*>([^]*)<\/main>/.exec(serialize(pages['index.html']?.body ?? []))?.[1] ?? ''
}

/** What is wrong with it, by lines; empty if nothing is. @param {string} text @param {Record<string, string | Buffer>} [others] @returns {Promise<string[]>} */
export async function wrong(text, others) {
  try {
    await book(text, others)
    return []
  } catch (error) {
    return /** @type {Error} */ (error).message.split('\n').slice(1)
  }
}
