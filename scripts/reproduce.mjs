// Builds the site once more from nothing, in a folder elsewhere, under another time zone and language, and compares all of dist/ with the one that is
// here, byte by byte. The tools and the packages are those of here; what they make is made anew.
import { cpSync, existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, statSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { dist } from './build.mjs'
import { capture, isMain, main, root, run, say, step, StepError } from './lib.mjs'
import { programFile, singlePrograms } from './registry.mjs'

/** The files of a folder. @param {string} folder */
const filesIn = folder => readdirSync(folder, { recursive: true, encoding: 'utf8' }).filter(file => statSync(join(folder, file)).isFile()).sort()

/** What two folders do not have alike, in words. @param {string} here @param {string} there */
export function differences(here, there) {
  const [mine, theirs] = [new Set(filesIn(here)), new Set(filesIn(there))]
  return [...new Set([...mine, ...theirs])].sort().flatMap(file => {
    if (!mine.has(file) || !theirs.has(file)) return [`${file}: only ${mine.has(file) ? 'here' : 'there'}`]
    const [one, other] = [here, there].map(folder => readFileSync(join(folder, file)))
    if (!one || !other || one.equals(other)) return []
    const at = one.findIndex((byte, i) => byte !== other[i])
    return [`${file}: ${one.length} and ${other.length} bytes, apart from byte ${at < 0 ? one.length : at}: ${JSON.stringify(one.toString('latin1', Math.max(0, at - 30), at + 30))}`]
  })
}

if (isMain(import.meta)) {
  await main(async () => {
    const folder = mkdtempSync(join(tmpdir(), 'fastslam elsewhere '))
    try {
      await step('A copy of the sources elsewhere', async () => {
        const sources = (capture('git', 'ls-files', '--cached', '--others', '--exclude-standard', '-z') ?? '').split('\0').filter(file => file !== '')
        for (const file of sources) cpSync(join(root, file), join(folder, file))
        await run('cp', ['-a', join(root, 'node_modules'), folder])
        return `${sources.length} files`
      })
      // What is kept between runs would hide what they do not have in common.
      const env = { CARGO_TARGET_DIR: join(folder, 'target'), FASTSLAM_DIST: join(folder, 'dist'), TZ: 'Asia/Tokyo', LC_ALL: 'C', CARGO_INCREMENTAL: '0' }
      const singles = singlePrograms.filter(program => existsSync(programFile(program)))
      await step('A build from nothing', () => run(process.execPath, [join(folder, 'scripts', 'build.mjs'), ...(singles.length > 0 ? ['--singles', singles.join()] : [])], { cwd: folder, env }))
      await step('dist/ of here and dist/ of there', async () => {
        const apart = differences(dist, join(folder, 'dist'))
        if (apart.length > 0) throw new StepError(`Not alike:\n${apart.join('\n')}`)
        return `${filesIn(dist).length} files, alike to the byte`
      })
      say('1 passed, 0 failed')
    } finally {
      rmSync(folder, { recursive: true, force: true })
    }
  })
}
