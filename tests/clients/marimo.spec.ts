// The wheel in marimo, whose cells run by themselves when a figure's value changes.
import { mkdtempSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { expect, test } from '@playwright/test'
import { cache } from '../../scripts/lib.mjs'
import { freePort, serve } from './server.mjs'

const app = `import marimo

app = marimo.App()


@app.cell
def _():
    import marimo as mo
    from fastslam_widgets import FastslamProposal
    figure = mo.ui.anywidget(FastslamProposal(samples=64, seed=9))
    figure
    return figure, mo


@app.cell
def _(figure, mo):
    mo.md(f"Kernel: seed {figure.value['seed']}, samples {figure.value['samples']}, readouts {len(figure.value['readouts'])}")
    return


if __name__ == "__main__":
    app.run()
`

test('a figure and the cells that read it follow each other in marimo', async ({ page }) => {
  const folder = mkdtempSync(join(tmpdir(), 'fastslam-marimo-'))
  writeFileSync(join(folder, 'figures.py'), app)
  const port = await freePort()
  const flags = ['run', 'figures.py', '--headless', '--port', String(port), '--no-token']
  const end = await serve(cache('python', 'clients', 'bin', 'python'), ['-m', 'marimo', ...flags], folder, `http://127.0.0.1:${port}/`)
  try {
    await page.goto(`http://127.0.0.1:${port}/`)
    const figure = page.locator('fastslam-proposal')
    await expect(figure.locator('.stage.live')).toBeVisible()
    await expect(figure.locator('input[type=number][name=samples]')).toHaveValue('64')
    await expect(page.getByText(/Kernel: seed 9, samples 64, readouts [1-9]/)).toBeVisible()
    await figure.getByRole('spinbutton', { name: 'Seed' }).fill('31')
    await figure.getByRole('spinbutton', { name: 'Seed' }).press('Enter')
    await expect(page.getByText(/Kernel: seed 31, samples 64/)).toBeVisible()
  } finally {
    await end()
  }
})
