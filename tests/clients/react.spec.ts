// The npm package in a fresh React 19 project: types in JSX, properties and events, and a figure that comes and goes with its component.
import { execFileSync } from 'node:child_process'
import { cpSync, mkdirSync, readdirSync, rmSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import { expect, test } from '@playwright/test'
import { cache, root } from '../../scripts/lib.mjs'
import { startServer } from '../../scripts/serve.mjs'

const files = {
  'package.json': JSON.stringify({ name: 'fresh', private: true, type: 'module' }),
  'index.html': '<!doctype html><html lang="en"><title>React</title><link rel="icon" href="data:,"><div id="root"></div><script type="module" src="./main.tsx"></script></html>',
  'tsconfig.json': JSON.stringify({
    compilerOptions: { strict: true, jsx: 'react-jsx', module: 'esnext', moduleResolution: 'bundler', target: 'es2022', lib: ['es2022', 'dom'], noEmit: true, types: [] },
    include: ['main.tsx'],
  }),
  'main.tsx': `import { StrictMode, useState } from 'react'
import { createRoot } from 'react-dom/client'
import 'fastslam-widgets/react'

function App() {
  const [shown, show] = useState(true)
  const [universes, set] = useState(4)
  const [step, tell] = useState(-1)
  return (
    <main>
      <button onClick={() => show(!shown)}>show</button>
      <button onClick={() => set(universes + 1)}>more</button>
      <output>{step}</output>
      {shown && <fastslam-lap universes={universes} range-std={0.05} seed={7} truth onfastslam-step={event => tell(event.detail.step)} />}
    </main>
  )
}

createRoot(document.getElementById('root')!).render(<StrictMode><App /></StrictMode>)
`,
  'wrong.tsx': `import 'fastslam-widgets/react'\nexport const wrong = <fastslam-lap proposal="psychic" />\n`,
}

test('a figure works in a fresh React 19 project', async ({ page }) => {
  const project = cache('clients', 'react-project')
  rmSync(project, { recursive: true, force: true })
  mkdirSync(project, { recursive: true })
  for (const [name, text] of Object.entries(files)) writeFileSync(join(project, name), text)
  const packed = readdirSync(join(root, 'packages')).find(file => file.endsWith('.tgz'))!
  cpSync(join(root, 'packages', packed), join(project, packed))
  const npx = (...args: string[]) => execFileSync('npx', ['--no-install', ...args], { cwd: project, encoding: 'utf8', stdio: 'pipe' })
  execFileSync('npm', ['install', '--no-audit', '--no-fund', `./${packed}`, 'react@19', 'react-dom@19', '@types/react@19', '@types/react-dom@19', 'vite@8', 'typescript'], { cwd: project, stdio: 'pipe' })
  npx('tsc')
  writeFileSync(join(project, 'tsconfig.json'), files['tsconfig.json'].replace('main.tsx', 'wrong.tsx'))
  expect(() => npx('tsc')).toThrow() // the types know the words that a parameter takes
  npx('vite', 'build', '--base', './')

  const server = await startServer({ folder: join(project, 'dist') })
  try {
    const wrong: string[] = []
    page.on('pageerror', error => wrong.push(String(error)))
    page.on('console', message => message.type() === 'error' && wrong.push(message.text()))
    await page.goto(server.url)
    const lap = page.locator('fastslam-lap')
    await expect(lap.locator('.stage.live')).toBeVisible()
    await expect(lap.locator('input[type=number][name=universes]')).toHaveValue('4')
    await expect(lap.locator('input[type=number][name=range-std]')).toHaveValue('0.05')
    await expect(lap.locator('input[name=truth]')).toBeChecked()
    await lap.getByRole('button', { name: 'Step', exact: true }).click()
    await expect(page.locator('main > output')).toHaveText('1')
    await page.getByRole('button', { name: 'more' }).click()
    await expect(lap.locator('input[type=number][name=universes]')).toHaveValue('5')
    await page.getByRole('button', { name: 'show' }).click()
    await expect(lap).toHaveCount(0)
    await page.getByRole('button', { name: 'show' }).click()
    await expect(lap.locator('.stage.live')).toBeVisible()
    await expect(lap.locator('input[type=number][name=universes]')).toHaveValue('5')
    // What a component gives is the author's: a reader's link stands over it, and what the component gives later over the link.
    await page.goto('about:blank')
    await page.goto(`${server.url}#fastslam-lap?universes=6&step=9`)
    await expect(lap.locator('.stage.live')).toBeVisible()
    await expect(lap.locator('input[type=number][name=universes]')).toHaveValue('6')
    await expect(lap.locator('input[type=number][name=range-std]')).toHaveValue('0.02')
    await expect(lap.locator('input[name=truth]')).not.toBeChecked()
    await expect(page.locator('main > output')).toHaveText('9')
    await page.getByRole('button', { name: 'more' }).click()
    await expect(lap.locator('input[type=number][name=universes]')).toHaveValue('5')
    expect(wrong).toEqual([])
  } finally {
    await server.close()
  }
})
