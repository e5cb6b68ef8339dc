// No script, no WebAssembly, no network, panics, and nodes that come and go.
import type { Page } from '@playwright/test'
import { expect, test } from './fixtures'
import { Figure, openChapterOf } from './figure'
import { openAlone, openCourse } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

/**
 * Puts a layer between the glue and the wasm: counts figures made and freed, and lets a test fail a call as a panic does.
 */
async function tapWasm(page: Page): Promise<void> {
  await page.addInitScript(() => {
    const tap = ((window as unknown as { tap: object }).tap = { alive: 0, made: 0, panics: 0 })
    const wrap = (instance: WebAssembly.Instance): WebAssembly.Instance => {
      const exports: Record<string, unknown> = { ...instance.exports }
      const around = (name: string, before: () => void) => {
        const call = exports[name] as (...args: unknown[]) => unknown
        if (!call) throw new Error(`the wasm has no export ${name}`)
        exports[name] = (...args: unknown[]) => {
          before()
          return call(...args)
        }
      }
      around('figure_new', () => void (tap.alive++, tap.made++))
      around('__wbg_figure_free', () => void tap.alive--)
      around('figure_work', () => {
        if (tap.panics > 0) {
          tap.panics--
          throw new WebAssembly.RuntimeError('unreachable')
        }
      })
      return Object.create(WebAssembly.Instance.prototype, { exports: { value: exports } }) as WebAssembly.Instance
    }
    const instantiate = WebAssembly.instantiate as (module: WebAssembly.Module, imports: WebAssembly.Imports) => Promise<WebAssembly.Instance>
    WebAssembly.instantiate = (async (...args: Parameters<typeof instantiate>) => wrap(await instantiate(...args))) as never
  })
}

interface Tap {
  alive: number
  made: number
  panics: number
}
const tapped = (page: Page) => page.evaluate(() => ({ ...(window as unknown as { tap: Tap }).tap }))
const panicNext = (page: Page, times: number) =>
  page.evaluate(n => void ((window as unknown as { tap: Tap }).tap.panics = n), times)

/** The programs and pictures that the page asks for. */
function watchFiles(page: Page): string[] {
  const fetched: string[] = []
  page.on('request', request => /\.(wasm|png)$/.test(request.url()) && fetched.push(new URL(request.url()).pathname))
  return fetched
}

test.describe('without JavaScript', () => {
  test.use({ javaScriptEnabled: false })
  test('the picture of the page’s colours and its description stand in', async ({ page }) => {
    await page.goto('./')
    const picture = page.locator('fastslam-lap img')
    await picture.scrollIntoViewIfNeeded()
    await expect(picture).toBeVisible()
    await expect(picture).toHaveAttribute('alt', /mosaic/)
    for (const colorScheme of ['light', 'dark'] as const) {
      await page.emulateMedia({ colorScheme })
      await expect.poll(() => picture.evaluate((image: HTMLImageElement) => image.currentSrc)).toContain(colorScheme)
      expect(await picture.evaluate((image: HTMLImageElement) => image.decode().then(() => image.naturalWidth))).toBeGreaterThan(300)
    }
  })
})

/** The figure's own picture is in view, with a reason in one line, and nothing else is broken. */
async function expectPicture(lap: Figure, reason: RegExp): Promise<void> {
  await lap.element.scrollIntoViewIfNeeded()
  await expect(lap.alert).toContainText(reason)
  await expect(lap.element.locator('img')).toBeVisible()
}

test('where a policy forbids WebAssembly, the picture stays and the reason is said', async ({ page, complaints }) => {
  await openChapterOf(page, ['fastslam-lap'], sent => ({
    ...sent,
    'content-security-policy': sent['content-security-policy']!.replace("'wasm-unsafe-eval'", ''),
  }))
  await expectPicture(new Figure(page, 'fastslam-lap'), /security policy of this page/)
  complaints.splice(0, Infinity, ...complaints.filter(line => !/wasm|WebAssembly/i.test(line)))
})

test('where a host sends no policy, the page has its own, and lives under it', async ({ page, complaints }) => {
  await openChapterOf(page, ['fastslam-lap'], ({ 'content-security-policy': _, ...others }) => others)
  const lap = new Figure(page, 'fastslam-lap')
  await lap.element.scrollIntoViewIfNeeded()
  await lap.live()
  const ran = await page.evaluate(() => {
    const script = document.createElement('script')
    script.textContent = 'document.title = "injected"'
    document.head.append(script)
    return document.title
  })
  expect(ran).not.toBe('injected')
  expect(complaints.join()).toMatch(/inline script/)
  complaints.length = 0
})

test('where there is no WebAssembly at all, the picture stays and the reason is said', async ({ page }) => {
  await page.addInitScript(() => Reflect.deleteProperty(window, 'WebAssembly'))
  await openChapterOf(page, ['fastslam-lap'])
  await expectPicture(new Figure(page, 'fastslam-lap'), /runs no WebAssembly/)
})

test('where the network fails, the picture stays, and a second try brings the figure to life, with the link that the first one had', async ({ page, complaints }) => {
  await page.route('**/*.wasm', route => route.abort())
  await openCourse(page, '<fastslam-lap id="a"></fastslam-lap><fastslam-lap id="b"></fastslam-lap>', { link: '#b?universes=4&step=5' })
  const [a, b] = [new Figure(page, '#a'), new Figure(page, '#b')]
  for (const lap of [a, b]) await expectPicture(lap, /could not be fetched/)
  await page.unroute('**/*.wasm')
  for (const [lap, step, universes] of [[a, 0, '16'], [b, 5, '4']] as const) {
    await lap.element.scrollIntoViewIfNeeded()
    await lap.alert.getByRole('button', { name: 'Try again' }).click()
    await lap.live()
    await expect(lap.alert).toBeEmpty()
    expect(await lap.position()).toBe(step)
    await lap.openSettings()
    await expect(lap.box('universes')).toHaveValue(universes)
  }
  complaints.splice(0, Infinity, ...complaints.filter(line => !/Failed to load resource/.test(line)))
})

test('where the file is missing, the answer of the server is said', async ({ page, complaints }) => {
  await page.route('**/*.wasm', route => route.fulfill({ status: 404, body: 'gone' }))
  await openAlone(page, 'fastslam-lap')
  await expectPicture(new Figure(page, 'fastslam-lap'), /answered 404/)
  complaints.splice(0, Infinity, ...complaints.filter(line => !/404/.test(line)))
})

test('after a panic the figure says so and is as it was before', async ({ page, complaints }) => {
  await tapWasm(page)
  const lap = await new Figure(page, 'fastslam-lap').alone()
  await lap.scrubTo(11)
  const before = [await lap.readouts(), await lap.picture()]
  await panicNext(page, 1)
  await lap.step.click()
  await expect(lap.alert).toContainText(/rebuilt/)
  await lap.settled()
  expect([await lap.readouts(), await lap.picture()]).toEqual(before)
  await lap.step.click()
  await lap.settled()
  expect(await lap.position()).toBe(12)
  expect((await tapped(page)).made).toBe(2)
  complaints.splice(0, Infinity, ...complaints.filter(line => !/unreachable/.test(line)))
})

test('after a second panic it stops, others go on, and Reset brings it back', async ({ page, complaints }) => {
  await tapWasm(page)
  await new Figure(page, 'fastslam-lap').alone()
  const lap = new Figure(page, 'fastslam-lap:not(#other)')
  await panicNext(page, 1000)
  await lap.step.click()
  await expect(lap.alert).toContainText(/rebuilt/)
  await lap.step.click()
  await expect(lap.alert).toContainText(/has stopped/)
  await expect(lap.element.locator('[part=transport]')).toHaveAttribute('inert')
  await panicNext(page, 0)

  await page.evaluate(() =>
    document.querySelector('main')!.prepend(Object.assign(document.createElement('fastslam-lap'), { id: 'other' })),
  )
  const other = new Figure(page, '#other')
  await other.element.scrollIntoViewIfNeeded()
  await other.live()
  await other.step.click()
  await other.settled()
  expect(await other.position()).toBe(1)

  await lap.alert.getByRole('button', { name: 'Reset' }).click()
  await lap.live()
  await expect(lap.alert).toBeEmpty()
  await lap.step.click()
  await lap.settled()
  expect(await lap.position()).toBe(1)
  complaints.splice(0, Infinity, ...complaints.filter(line => !/unreachable/.test(line)))
})

test('a node that is moved or taken out and put back is freed and restored', async ({ page }) => {
  await tapWasm(page)
  await openCourse(page, '<main><figure><fastslam-lap></fastslam-lap></figure></main><footer></footer>', { link: '#fastslam-lap?seed=5&step=2' })
  const lap = new Figure(page, 'fastslam-lap')
  await lap.live()
  await lap.openSettings()
  await lap.box('universes').fill('8')
  await lap.box('universes').press('Enter')
  await lap.scrubTo(14)
  const before = [await lap.readouts(), await lap.picture()]
  expect((await tapped(page)).alive).toBe(1)
  await lap.element.evaluate(element => document.querySelector('footer')!.append(element))
  await lap.element.scrollIntoViewIfNeeded()
  await lap.live()
  await lap.settled()
  expect((await tapped(page)).alive).toBe(1)
  expect(await lap.readouts()).toEqual(before[0])

  await lap.element.evaluate(element => {
    ;(window as unknown as { kept: Element }).kept = element
    element.remove()
  })
  expect((await tapped(page)).alive).toBe(0)
  await page.evaluate(() => {
    const { kept } = window as unknown as { kept: Element }
    kept.setAttribute('raw', 'on') // a change while it is out must not be lost
    document.querySelector('figure')!.prepend(kept)
  })
  await lap.element.scrollIntoViewIfNeeded()
  await lap.live()
  await lap.settled()
  expect((await tapped(page)).alive).toBe(1)
  expect(await lap.readouts()).toEqual(before[0])
  await expect(lap.element.locator('input[name=raw]')).toBeChecked()
})

test('nothing is fetched before a figure is seen', async ({ page }) => {
  const fetched = watchFiles(page)
  await page.setViewportSize({ width: 1000, height: 300 })
  await openCourse(page, '<div style="height: 3000px"></div><fastslam-lap></fastslam-lap>')
  await page.waitForLoadState('networkidle')
  expect(fetched).toEqual([])
})

test('the wasm is fetched once for all figures, and every one is freed', async ({ page }) => {
  await tapWasm(page)
  // After three seconds a figure takes the network for slow and shows a picture meanwhile: here it never is, however busy the machine.
  await page.addInitScript(() => {
    const { setTimeout } = window
    window.setTimeout = ((act: TimerHandler, after?: number) => setTimeout(act, after === 3000 ? 1e9 : after)) as typeof window.setTimeout
  })
  const fetched = watchFiles(page)
  await page.setViewportSize({ width: 1000, height: 300 })
  await openChapterOf(page, ['fastslam-lap'])
  const lap = new Figure(page, 'fastslam-lap')
  await lap.element.scrollIntoViewIfNeeded()
  await lap.live()
  for (let i = 0; i < 5; i++) {
    await page.evaluate(async () => {
      const one = document.createElement('fastslam-lap')
      document.querySelector('main')!.prepend(one)
      one.scrollIntoView({ behavior: 'instant' })
      await new Promise<void>(done => one.addEventListener('fastslam-step', () => done(), { once: true }))
      one.remove()
    })
  }
  expect((await tapped(page)).made).toBe(6)
  expect((await tapped(page)).alive).toBe(1)
  // One fetch, and not the picture, which is for those without WebAssembly.
  expect(fetched).toEqual([expect.stringMatching(/wasm$/)])
})
