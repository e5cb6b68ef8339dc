// Figures are guests: in a book whose arrow keys turn the page, in slides that Space moves on, on a page that has keys of its own.
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import type { Locator, Page } from '@playwright/test'
import { root } from '../../scripts/lib.mjs'
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { openCourse } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

/** Keys that the page hears, down, pressed and up, when they are pressed in a control. */
async function heard(page: Page, control: Locator, keys: string[]): Promise<string[]> {
  await page.evaluate(() => {
    const heard: string[] = []
    Object.assign(self, { heard })
    if ('listening' in self) return
    Object.assign(self, { listening: true })
    for (const type of ['keydown', 'keypress', 'keyup']) {
      document.addEventListener(type, event => (self as unknown as { heard: string[] }).heard.push((event as KeyboardEvent).key))
    }
  })
  for (const key of keys) {
    await control.focus()
    await page.keyboard.press(key)
  }
  return page.evaluate(() => [...new Set((self as unknown as { heard: string[] }).heard)].filter(key => key !== 'Control'))
}

// F2 and Escape stand for all that no figure has a use for, b and k for the page's own short cuts.
const CONTROLS: { of: string; name: string; find: (figure: Figure) => Locator; used: string[]; free: string[] }[] = [
  { of: 'lap', name: 'the picture', find: ({ element }) => element.locator('.stage'), used: ['ArrowRight', 'ArrowLeft', 'Home', 'End', 'Space', 'Space'], free: ['b', 'ArrowUp', 'PageDown', 'Enter', 'F2', 'Escape', 'Control+k'] },
  { of: 'lap', name: 'a box of numbers', find: figure => figure.box('universes'), used: ['b', '1', 'e', 'Space', 'ArrowUp', 'ArrowLeft', 'Home', 'Backspace', 'Enter', 'Control+a'], free: ['F2', 'Escape', 'PageDown', 'Control+k'] },
  { of: 'lap', name: 'a slider', find: figure => figure.slider('universes'), used: ['ArrowRight', 'ArrowUp', 'Home', 'End', 'PageUp', 'Space', 'Space'], free: ['b', 'Enter', 'F2', 'Escape', 'Control+k'] },
  { of: 'lap', name: 'a list', find: ({ element }) => element.locator('select[name=proposal]'), used: ['ArrowDown', 'ArrowUp', 'm', 'Home', 'End'], free: ['F2', 'Control+k'] },
  { of: 'lap', name: 'a tick box', find: ({ element }) => element.locator('input[name=raw]'), used: ['Space'], free: ['b', 'ArrowRight', 'F2', 'Escape', 'Control+k'] },
  { of: 'lap', name: 'a button', find: figure => figure.reset, used: ['Space', 'Enter'], free: ['b', 'ArrowRight', 'Home', 'F2', 'Escape', 'Control+k'] },
  { of: 'lap', name: 'the settings', find: ({ element }) => element.locator('[part=settings] summary'), used: ['Space', 'Enter'], free: ['b', 'ArrowRight', 'F2', 'Escape', 'Control+k'] },
  { of: 'proposal', name: 'a point that is moved', find: figure => figure.grasp('landmark'), used: ['ArrowRight', 'ArrowUp', 'Shift+ArrowLeft', 'Alt+ArrowLeft', 'Home', 'PageUp'], free: ['b', 'Space', 'F2', 'Escape', 'Control+k'] },
]

for (const of of ['lap', 'proposal']) {
  test(`keys that the controls of ${of} use go no further, and all others do`, async ({ page }) => {
    await openCourse(page, `<fastslam-${of}></fastslam-${of}>`)
    const figure = new Figure(page, `fastslam-${of}`)
    await figure.live()
    await figure.openSettings()
    for (const { name, find, used, free } of CONTROLS.filter(control => control.of === of)) {
      const held = used.map(key => /^(Shift|Alt)(?=\+)/.exec(key)?.[0]).filter(key => key !== undefined)
      expect(await heard(page, find(figure), used), `what ${name} uses`).toEqual(held)
      expect(await heard(page, find(figure), free), `what ${name} does not use`).toEqual(free.map(key => key.replace('Control+', '').replace('Space', ' ')))
      expect(await figure.playing(), `whether it plays after the keys in ${name}`).toBe(false)
    }
  })
}

test('Escape closes a figure’s menu and is then the page’s again', async ({ page }) => {
  await openCourse(page, '<fastslam-lap></fastslam-lap><fastslam-log></fastslam-log>')
  for (const tag of ['fastslam-lap', 'fastslam-log']) {
    const summary = page.locator(`${tag} button[aria-label=Menu]`)
    await summary.click()
    expect(await heard(page, page.locator(tag).getByRole('menuitem', { name: /Copy link/ }), ['Escape'])).toEqual([])
    await expect(page.locator(tag).getByRole('menuitem', { name: /Copy link/ })).toBeHidden()
    expect(await heard(page, summary, ['Escape'])).toEqual(['Escape'])
  }
})

test('the keys of a map are the page’s until there is a map to move', async ({ page }) => {
  await openCourse(page, '<fastslam-log></fastslam-log>')
  const figure = page.locator('fastslam-log')
  const stage = figure.locator('.stage')
  expect(await heard(page, stage, ['ArrowRight', 'Space', '+'])).toEqual(['ArrowRight', ' ', '+'])
  const buffer = readFileSync(join(root, 'tests', 'figures', 'golden', 'tiny.clf'))
  await figure.locator('input[type=file]').setInputFiles({ name: 'tiny.clf', mimeType: '', buffer })
  await expect(figure.locator('[part=sentence]')).toContainText('91 scans')
  expect(await heard(page, stage, ['ArrowRight', 'ArrowUp', '+', '-', '0'])).toEqual([])
  expect(await heard(page, stage, ['b', 'PageDown', 'F2', 'Control+k'])).toEqual(['b', 'PageDown', 'F2', 'k'])
})

test('a log that is dropped beside the figure does not make the browser leave, and the page’s own zones and boxes take theirs', async ({ page }) => {
  await openCourse(
    page,
    `<fastslam-log></fastslam-log><p id="beside" style="height: 200px">beside</p><input id="box" type="file" /><p id="zone" style="height: 100px">zone</p>
    <script>
      zone.addEventListener('dragover', event => event.preventDefault())
      zone.addEventListener('drop', event => { event.preventDefault(); zone.textContent = event.dataTransfer.files[0].name })
    </script>`,
  )
  await expect(page.locator('fastslam-log').getByRole('button', { name: 'Map this building' })).toBeVisible()
  const client = await page.context().newCDPSession(page)
  const drop = async (where: string) => {
    await page.locator(where).scrollIntoViewIfNeeded()
    const box = (await page.locator(where).boundingBox())!
    const data = { items: [], files: [join(root, 'tests', 'figures', 'golden', 'tiny.clf')], dragOperationsMask: 1 }
    for (const type of ['dragEnter', 'dragOver', 'drop'] as const) {
      await client.send('Input.dispatchDragEvent', { type, x: box.x + box.width / 2, y: box.y + box.height / 2, data })
    }
  }
  // Whether the browser is kept from doing what it does with a file by itself; headless it does nothing.
  const kept = await page.evaluateHandle(() => {
    const kept: boolean[] = []
    addEventListener('dragover', event => kept.push(event.defaultPrevented))
    return kept
  })
  const address = page.url()
  await drop('#beside')
  expect(await kept.evaluate(list => [...new Set(list.splice(0))])).toEqual([true])
  await drop('#zone')
  await expect(page.locator('#zone')).toHaveText('tiny.clf')
  await kept.evaluate(list => list.splice(0))
  await drop('#box')
  expect(await kept.evaluate(list => [...new Set(list.splice(0))])).toEqual([false])
  expect(await page.locator('#box').evaluate((box: HTMLInputElement) => box.files!.length)).toBe(1)
  await drop('fastslam-log .stage')
  await expect(page.locator('fastslam-log').getByRole('status')).toHaveText('tiny.clf')
  expect(page.url()).toBe(address)
})
