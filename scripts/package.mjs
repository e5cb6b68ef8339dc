// The packages for other pages: `npm run package` writes the npm package and the Python wheel to packages/.
// Both hold what the site's build made, so what is tested on the site is what they ship.
import { cpSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import { build, dist, singlesAsked } from './build.mjs'
import { eventsOf, figures } from './elements.mjs'
import { isMain, main, root, run, step } from './lib.mjs'
import { python, pythonFiles } from './python.mjs'
import { singlePrograms } from './registry.mjs'

const npm = join(root, 'widgets', 'npm')
export const packages = join(root, 'packages')

/** Types of the tags in React's JSX, beside those of the elements. @param {import('./elements.mjs').FigureInfo[]} all */
const reactTypes = all => `import type { HTMLAttributes, RefAttributes } from 'react'
import type { FigureEventMap, FigureTagAttributes${all.map(({ className }) => `, ${className}`).join('')} } from './fastslam.js'

export * from './fastslam.js'

/** A listener for each event, by its name. */
type Listeners<Names extends keyof FigureEventMap> = { [Name in Names as \`on\${Name}\`]?: (event: FigureEventMap[Name]) => void }

type Tag<T extends keyof FigureTagAttributes, E, Names extends keyof FigureEventMap> = Omit<HTMLAttributes<E>, keyof FigureTagAttributes[T]> & RefAttributes<E> & FigureTagAttributes[T] & Listeners<Names> & {
  class?: string
}

declare module 'react' {
  namespace JSX {
    interface IntrinsicElements {
${all.map(figure => `      '${figure.tag}': Tag<'${figure.tag}', ${figure.className}, ${eventsOf(figure).map(({ name }) => `'${name}'`).join(' | ')}>`).join('\n')}
    }
  }
}
`

/** Fills widgets/npm/dist from dist/. */
export async function npmFiles() {
  const to = join(npm, 'dist')
  rmSync(to, { recursive: true, force: true })
  mkdirSync(join(to, 'assets'), { recursive: true })
  const all = figures()
  const files = readdirSync(dist).filter(file => /^fastslam(-[\w-]{8})?\.js$|^fastslam-.*\.wasm$/.test(file))
  for (const file of [...files, 'fastslam.d.ts', 'custom-elements.json', 'example.clf.gz', 'licences.txt', 'sbom.cdx.json']) cpSync(join(dist, file), join(to, file))
  // What they name, and what that names, and nothing of the chapter's.
  const assets = new Set(readdirSync(join(dist, 'assets')))
  const take = (/** @type {string} */ script, /** @type {string} */ folder) => {
    for (const file of [...assets].filter(file => script.includes(`${folder}${file}`))) {
      assets.delete(file)
      cpSync(join(dist, 'assets', file), join(to, 'assets', file))
      if (file.endsWith('.js')) take(readFileSync(join(dist, 'assets', file), 'utf8'), './')
    }
  }
  for (const file of files.filter(file => file.endsWith('.js'))) take(readFileSync(join(dist, file), 'utf8'), 'assets/')
  // A bundler has all of them at hand, and nothing to load anew.
  const figuresFile = readdirSync(join(to, 'assets')).find(file => file.startsWith('figures-'))
  writeFileSync(join(to, 'fastslam.js'), `export * from './assets/${figuresFile}'\n`)
  cpSync(join(dist, 'fastslam-anywidget.js'), join(to, 'standalone.js'))
  writeFileSync(join(to, 'react.d.ts'), reactTypes(all))
  writeFileSync(join(to, 'server.js'), '// Pages rendered on a server hold the tags; the elements come to life in the browser.\nexport {}\n')
  for (const file of ['LICENSE-MIT', 'LICENSE-APACHE']) cpSync(join(root, file), join(npm, file))
}

/** The npm package. @returns {Promise<string>} its path */
export async function packNpm() {
  await npmFiles()
  mkdirSync(packages, { recursive: true })
  const { answer } = await run('npm', ['pack', '--json', '--ignore-scripts', '--pack-destination', packages], { cwd: npm })
  const [{ filename, size }] = JSON.parse(answer)
  console.log(`  ${filename}: ${(size / 1e6).toFixed(2)} MB`)
  return join(packages, filename)
}

/** The Python wheel. @returns {Promise<string>} its path */
export async function packWheel() {
  mkdirSync(packages, { recursive: true })
  await pythonFiles()
  for (const file of readdirSync(packages)) if (file.endsWith('.whl')) rmSync(join(packages, file))
  const interpreter = await python('build', 'build', 'hatchling')
  await run(interpreter, ['-m', 'build', '--wheel', '--no-isolation', '--outdir', packages, join(root, 'widgets', 'python')])
  return join(packages, readdirSync(packages).find(file => file.endsWith('.whl')) ?? '')
}

if (isMain(import.meta)) {
  await main(async () => {
    if (process.argv.includes('--npm-files')) return step('Files of the npm package', npmFiles)
    await build(singlesAsked(singlePrograms))
    await step('npm package', packNpm)
    await step('Python wheel', packWheel)
  })
}
