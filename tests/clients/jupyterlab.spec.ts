// The wheel in JupyterLab: Python sets the figure, the reader's hand comes back to Python, and readouts make a row of a table.
import { mkdtempSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { expect, test } from '@playwright/test'
import { cache } from '../../scripts/lib.mjs'
import { freePort, serve } from './server.mjs'

const cells = [
  'from fastslam_widgets import FastslamLap, FastslamProposal\nlap = FastslamLap(universes=8, seed=5, step=3, decimal="comma")\nlap',
  'lap.universes = 4\nlap.step = 7\nprint("set")',
  'import pandas\nrow = pandas.DataFrame([lap.record]).iloc[0]\nprint("row", row.universes, row.seed, row.step, row.proposal, row.ess)',
  'try:\n    lap.universes = 999\nexcept Exception as error:\n    print("refused:", error)',
  'FastslamProposal(range_std=0.1)',
]

test('a figure and the kernel follow each other in JupyterLab', async ({ page }) => {
  const folder = mkdtempSync(join(tmpdir(), 'fastslam-lab-'))
  writeFileSync(
    join(folder, 'figures.ipynb'),
    JSON.stringify({
      nbformat: 4,
      nbformat_minor: 5,
      metadata: { kernelspec: { name: 'python3', display_name: 'Python 3', language: 'python' } },
      cells: cells.map((source, i) => ({ id: `cell-${i}`, cell_type: 'code', source, metadata: {}, outputs: [], execution_count: null })),
    }),
  )
  const port = await freePort()
  const flags = ['--no-browser', '--allow-root', `--port=${port}`, '--IdentityProvider.token=', `--ServerApp.root_dir=${folder}`, '--ServerApp.port_retries=0']
  const end = await serve(cache('python', 'clients', 'bin', 'python'), ['-m', 'jupyter', 'lab', ...flags], folder, `http://127.0.0.1:${port}/api`)
  try {
    const wrong: string[] = []
    page.on('pageerror', error => wrong.push(String(error)))
    await page.goto(`http://127.0.0.1:${port}/doc/tree/figures.ipynb`)
    const code = page.locator('.jp-CodeCell')
    await expect(code).toHaveCount(cells.length)
    const run = async (i: number) => {
      const prompt = code.nth(i).locator('.jp-InputPrompt')
      const before = await prompt.textContent()
      // A notebook that still settles may lose a key.
      await expect(async () => {
        await code.nth(i).locator('.cm-content').click()
        await page.keyboard.press('Control+Enter')
        await expect(prompt).not.toHaveText(before!, { timeout: 5_000 })
      }).toPass()
    }
    const output = (i: number) => code.nth(i).locator('.jp-OutputArea-output')
    await expect(page.locator('.jp-Notebook-ExecutionIndicator[data-status=idle]')).toBeAttached()

    await run(0)
    const lap = page.locator('fastslam-lap')
    // A kernel that has just been installed compiles what it imports for the first time.
    await expect(lap.locator('.stage.live')).toBeVisible({ timeout: 120_000 })
    const universes = lap.locator('input[type=number][name=universes]')
    await expect(universes).toHaveValue('8')
    await expect(lap.locator('.timeline .position')).toHaveText(/^3 \//)
    await expect(lap.getByText(/^\d,\d+$/).first()).toBeAttached()

    await run(1)
    await expect(universes).toHaveValue('4')
    await expect(lap.locator('.timeline .position')).toHaveText(/^7 \//)

    // The reader's hand.
    await lap.getByRole('button', { name: 'Step', exact: true }).click()
    await lap.getByRole('spinbutton', { name: 'Seed' }).fill('11')
    await lap.getByRole('spinbutton', { name: 'Seed' }).press('Enter')
    await expect(lap.locator('.timeline .position')).toHaveText(/^8 \//)
    await page.waitForTimeout(1000)
    await run(2)
    await expect(output(2)).toContainText(/row 4 11 8 aware/)
    expect(await output(2).textContent()).toMatch(/aware \d/)

    await run(3)
    await expect(output(3)).toContainText(/refused: .*universes.*(256|999)/)
    await expect(universes).toHaveValue('4')

    await run(4)
    await page.locator('fastslam-proposal').scrollIntoViewIfNeeded()
    await expect(page.locator('fastslam-proposal .stage.live')).toBeVisible()
    await expect(page.locator('fastslam-proposal input[type=number][name=range-std]')).toHaveValue('0.1')
    expect(wrong).toEqual([])
  } finally {
    await end()
  }
})
