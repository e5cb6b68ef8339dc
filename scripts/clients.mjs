// npm run test:clients: the packages in the slow clients that courses use: JupyterLab, marimo, a fresh React project. Builds and packs first.
// The last line is the total, as that of npm test.
import { rmSync } from 'node:fs'
import { join } from 'node:path'
import { build } from './build.mjs'
import { cache, isMain, main, npmBin, readIfThere, root, run, step } from './lib.mjs'
import { packNpm, packWheel } from './package.mjs'
import { python } from './python.mjs'
import { setUp } from './setup.mjs'

/** A Python with the notebooks and our wheel. */
export async function notebooks() {
  const interpreter = await python('clients', 'jupyterlab==4.*', 'marimo', 'anywidget==0.9.*', 'pandas')
  await run(interpreter, ['-m', 'pip', 'install', '--quiet', '--disable-pip-version-check', '--no-deps', '--force-reinstall', await packWheel()])
  return interpreter
}

if (isMain(import.meta)) {
  await main(async () => {
    await setUp({ browser: true })
    await build()
    await step('npm package', packNpm)
    await step('Notebooks with the Python wheel', notebooks)
    const report = cache('clients.json')
    rmSync(report, { force: true })
    try {
      await step('Tests in JupyterLab, marimo and React', () => run(npmBin('playwright'), ['test', '--config', join(root, 'tests', 'clients')]))
    } finally {
      const stats = JSON.parse(readIfThere(report) ?? '{}').stats
      const failed = stats ? stats.unexpected + stats.flaky : 1
      console.log(`${stats?.expected ?? 0} passed, ${failed} failed, ${stats?.skipped ?? 0} skipped`)
    }
  })
}
