// The figure that maps a log: the example and files of a reader's own, pause and stop, looking around, saving, and what goes wrong.
import type { Download, Locator, Page } from '@playwright/test'
import { execFileSync } from 'node:child_process'
import { existsSync, readFileSync } from 'node:fs'
import { join } from 'node:path'
import { gzipSync } from 'node:zlib'
import { root } from '../../scripts/lib.mjs'
import { brokenRules } from './axe'
import { holdPrograms } from './figure'
import { expect, test } from './fixtures'
import { breadth, openAlone, openCourse } from './host'
import { LogFigure } from './log-figure'

const TINY = join(root, 'tests', 'figures', 'golden', 'tiny.clf')
const INTEL = join(root, '..', 'shared', 'data', 'intel.clf')

/** Coarse and few, where it does not matter how good the map is. */
const QUICK = 'v=3&universes=2&cell=0.2'

async function content(download: Download): Promise<Buffer> {
  return readFileSync(await download.path())
}

for (const [universes, options] of [['2', {}], ['16', breadth]] as const) {
  test(`the example is mapped with one click, by ${universes} universes, and map, path and report are saved`, options, async ({ page }) => {
    const log = await new LogFigure(page).open(universes === '16' ? '' : QUICK)
    await expect(log.sentence).toContainText('No log is open')
    await log.button('Map this building').click()
    await log.done(120_000)
    await expect(log.status).toHaveText('the example')
    await expect(log.readout('digest')).toHaveText(/^[0-9a-f]{16}$/)

    await log.unfold('saves')
    const save = async (name: string) => {
      const [download] = await Promise.all([page.waitForEvent('download'), log.button(name).click()])
      return download
    }
    const png = await save('Map (PNG)')
    expect(png.suggestedFilename()).toBe('map.png')
    expect((await content(png)).subarray(1, 4).toString()).toBe('PNG')

    const path = (await content(await save('Path (TUM)'))).toString().trim().split('\n')
    const last = Number((await log.readout('scan').textContent())!.split(' of ')[1])
    expect(path.length).toBe(last + 1)
    for (const line of path) expect(line.split(' ').map(Number).filter(Number.isFinite)).toHaveLength(8)

    const report = JSON.parse((await content(await save('Report (JSON)'))).toString()) as {
      log: string
      results: { digest: { text: string } }
      settings: Record<string, string>
      steps: unknown[]
    }
    expect(report.log).toBe('the example')
    expect(report.results.digest.text).toBe(await log.readout('digest').textContent())
    expect(report.settings['universes']).toBe(universes)
    expect(report.steps).toHaveLength(last + 1)

    const both: Download[] = []
    page.on('download', download => both.push(download))
    await log.button('Map for ROS (PGM, YAML)').click()
    await expect.poll(() => both.map(download => download.suggestedFilename()).sort()).toEqual(['map.pgm', 'map.yaml'])
    const [pgm, yaml] = await Promise.all(both.sort((a, b) => a.suggestedFilename().localeCompare(b.suggestedFilename())).map(content))
    expect(pgm!.subarray(0, 3).toString()).toBe('P5\n')
    expect(yaml!.toString()).toMatch(/^image: "map\.pgm"\nmode: trinary\nresolution: 0\.\d+\norigin: \[-\d+\.\d{6}, -\d+\.\d{6}, 0\.0\]\n/)
  })
}

type FigureElement = HTMLElement & { seek(scan: number): void; settled(): Promise<void>; currentStep: number }

test('before anything is mapped it shows the finished map of the example, which is the one picture that is fetched', async ({ page }) => {
  const fetched: string[] = []
  page.on('request', request => /\.(wasm|png|gz)$/.test(request.url()) && fetched.push(request.url().replace(/.*\/|-[\w-]{8}(?=\.png)/g, '')))
  for (const colorScheme of ['light', 'dark'] as const) {
    await page.goto('about:blank')
    await page.emulateMedia({ colorScheme })
    await page.unrouteAll()
    await openCourse(page, '<p style="height: 20000px">far above</p><fastslam-log></fastslam-log>')
    const log = new LogFigure(page)
    const poster = log.element.locator('.poster img')
    await page.evaluate(() => customElements.whenDefined('fastslam-log').then(() => undefined))
    expect(fetched).toEqual([])
    await log.element.scrollIntoViewIfNeeded()
    await expect(poster).toHaveAttribute('alt', /finished map .* raw odometry/)
    await expect.poll(() => poster.evaluate((image: HTMLImageElement) => image.naturalWidth)).toBeGreaterThan(300)
    expect(fetched.splice(0)).toEqual([`fastslam-log-poster-${colorScheme}.png`])
    // What nobody has seen goes on around it.
    const [around, edge] = await poster.evaluate((image: HTMLImageElement) => {
      const context = new OffscreenCanvas(1, 1).getContext('2d')!
      context.drawImage(image, 0, 0)
      return [getComputedStyle(image.closest('.idle')!).backgroundColor, `rgb(${[...context.getImageData(0, 0, 1, 1).data.slice(0, 3)].join(', ')})`]
    })
    expect(around).toBe(edge)
  }
})

test('poster and picture take the same place, at every width', async ({ page }) => {
  await openCourse(page, '<div><fastslam-log></fastslam-log></div>')
  const log = new LogFigure(page)
  const boxes = async (picture: string) => {
    const all: { x: number; y: number; width: number; height: number }[] = []
    for (const width of [832, 720, 560, 343]) {
      await page.evaluate(width => Object.assign(document.querySelector('div')!.style, { width: `${width}px` }), width)
      await log.settled()
      all.push((await log.element.locator(picture).boundingBox())!)
    }
    return all
  }
  const before = await boxes('.idle')
  await log.choose('tiny.clf', readFileSync(TINY))
  await expect(log.element.locator('.stage.live')).toBeVisible()
  for (const [k, after] of (await boxes('canvas')).entries()) {
    for (const side of ['x', 'y', 'width', 'height'] as const) expect(Math.abs(before[k]![side] - after[side]), `${side} of the ${k + 1}th`).toBeLessThan(3)
  }
})

test('picture and button are in sight together on a small laptop, in a frame and on a phone, before, on the way and at the end', async ({ page }) => {
  await openCourse(page, '<fastslam-log cell="0.2"></fastslam-log>')
  const log = new LogFigure(page)
  const inSight = async (picture: string, button: Locator) => {
    for (const [width, height, most] of [[1366, 650, 612], [1024, 618, 612], [380, 760, Infinity]] as const) {
      await page.setViewportSize({ width, height })
      await log.settled()
      await log.element.evaluate(element => element.scrollIntoView({ block: 'start', behavior: 'instant' }))
      expect((await log.element.boundingBox())!.height, `${width} px wide`).toBeLessThanOrEqual(most)
      await expect(log.element.locator(picture), `${width} px wide`).toBeInViewport({ ratio: 0.95 })
      await expect(button, `${width} px wide`).toBeInViewport({ ratio: 1 })
    }
  }
  await inSight('.idle', log.button('Map this building'))
  await log.choose('tiny.clf', readFileSync(TINY))
  await expect(log.status).toHaveText('tiny.clf')
  await inSight('canvas', log.button('Map this building'))
  await log.button('Map this building').click()
  await log.done()
  await inSight('canvas', log.button('Play'))
})

/** What the parts of a figure say at one moment; the picture by the pixels of its own count of scans. */
interface Moment {
  transport: number
  sentence: number
  readout: number
  picture: number
}

test('what is mapped is played again and gone back to, and all parts tell of one scan at every moment', async ({ page }) => {
  const log = await new LogFigure(page).open(QUICK)
  await log.choose('tiny.clf', readFileSync(TINY))
  await log.button('Map this building').click()
  await log.done()
  const end = await log.picture()
  await log.element.evaluate(element => {
    const root = element.shadowRoot!
    const canvas = root.querySelector('canvas')!
    const page = window as unknown as { seen: Moment[]; watching: boolean }
    const sample = () => {
      const number = (selector: string) => Number(/\d+/.exec(root.querySelector(selector)!.textContent)![0])
      const height = Math.floor((24 / canvas.clientHeight) * canvas.height)
      const corner = new OffscreenCanvas(Math.floor(canvas.width / 3), height).getContext('2d', { willReadFrequently: true })!
      corner.drawImage(canvas, 0, 0)
      const { data } = corner.getImageData(0, 0, Math.floor(canvas.width / 3), height)
      const picture = data.reduce((hash, byte) => Math.imul(hash ^ byte, 16777619), 2166136261)
      page.seen.push({ transport: number('.timeline .position'), sentence: number('.sentence'), readout: number('[data-name=scan] dd'), picture })
      if (page.watching) requestAnimationFrame(sample)
    }
    Object.assign(page, { seen: [], watching: true })
    requestAnimationFrame(sample)
  })
  for (const scan of [60, 20, 45]) await log.scrubTo(scan)
  await expect(log.element.locator('[part=transport] .position')).toHaveText('45 / 90')
  await log.button('Play').click()
  await expect.poll(() => log.element.evaluate(element => (element as FigureElement).currentStep)).toBeGreaterThan(55)
  await log.button('Pause').click()
  const seen = await page.evaluate(() => {
    const page = window as unknown as { seen: Moment[]; watching: boolean }
    page.watching = false
    return page.seen
  })
  const pictures = new Map<number, number>()
  for (const { transport, sentence, readout, picture } of seen) {
    // At the end there is no number in the sentence but others.
    if (transport < 90) expect([sentence, readout], `at ${transport}`).toEqual([transport, transport])
    expect(pictures.get(transport) ?? picture, `the picture at ${transport}`).toBe(picture)
    pictures.set(transport, picture)
  }
  expect(pictures.size).toBeGreaterThan(10)
  expect(new Set(pictures.values()).size, 'every scan is written otherwise').toBe(pictures.size)
  // Step by step, by keys, and back to the end: nothing was lost.
  await log.scrubTo(30)
  await log.stage.focus()
  await page.keyboard.press('.')
  await expect(log.element.locator('[part=transport] .position')).toHaveText('31 / 90')
  await page.keyboard.press(',')
  await page.keyboard.press(',')
  await expect(log.sentence).toContainText('Scan 29 of 90')
  await log.element.evaluate(element => (element as FigureElement).seek(90))
  await log.done()
  expect(await log.picture()).toBe(end)
  // What is only drawn may change where one is.
  await log.scrubTo(12)
  await expect(log.sentence).toContainText('Scan 12 of 90')
  const raw = await log.picture()
  await log.element.getByRole('checkbox', { name: 'Raw odometry' }).uncheck()
  await expect.poll(() => log.picture()).not.toBe(raw)
  await expect(log.sentence).toContainText('Scan 12 of 90')
  // A report is of the whole run.
  await log.unfold('saves')
  const [download] = await Promise.all([page.waitForEvent('download'), log.button('Report (JSON)').click()])
  const report = JSON.parse((await content(download)).toString()) as { results: { scan: { value: number }; digest: { text: string } }; steps: unknown[] }
  expect([report.results.scan.value, report.steps.length]).toEqual([90, 91])
  expect(report.results.digest.text).toMatch(/^[0-9a-f]{16}$/)
  await expect(log.sentence).toContainText('Scan 12 of 90')
})

test('buttons over the map stand on the map, also where the picture leaves room in its frame', async ({ page }) => {
  await page.goto('/embed-log.html') // which fills its frame
  const log = new LogFigure(page)
  await log.choose('tiny.clf', readFileSync(TINY))
  await expect(log.button('Map this building')).toBeVisible()
  await expect(log.sentence).toContainText('91 scans')
  for (const [width, height] of [[1024, 618], [1280, 800], [380, 760]] as const) {
    await page.setViewportSize({ width, height })
    await log.settled()
    const canvas = (await log.element.locator('canvas').boundingBox())!
    const buttons = [log.button('Map this building'), ...(await log.element.locator('.zoom button').all())]
    expect(buttons).toHaveLength(4)
    for (const button of buttons) {
      const { y, height: high } = (await button.boundingBox())!
      // Below the picture's own title, and above what a phone has below the map.
      expect(y, `at ${width} × ${height}`).toBeGreaterThan(canvas.y + 24)
      expect(y + high, `at ${width} × ${height}`).toBeLessThan(canvas.y + 0.62 * canvas.height)
    }
  }
})

test('a log is mapped to the bits of the native build, and compared scan by scan with what odometry alone would have drawn', async ({ page }) => {
  const log = await new LogFigure(page).open()
  await log.choose('tiny.clf', readFileSync(TINY))
  await log.set('cell', '0.1')
  const compare = log.element.getByRole('checkbox', { name: 'Odometry’s map' })
  const chip = log.element.getByRole('button', { name: /Compare with odometry/ })
  await log.button('Map this building').click()
  await log.done()
  const golden = readFileSync(join(root, 'tests', 'figures', 'golden', 'log-digest.txt'), 'utf8').trim()
  await expect(log.readout('digest')).toHaveText(golden)
  const alone = await log.picture()
  await expect(log.sentence).not.toContainText('raw odometry alone')
  const apart = async () => Number(await log.readout('apart').textContent().then(text => parseFloat(text!)))
  const end = await apart()
  expect(end).toBeGreaterThan(1) // the wheels led it astray

  // By keyboard, while the map stays.
  await compare.focus()
  await page.keyboard.press('Space')
  await expect(compare).toBeChecked()
  await expect(log.sentence).toContainText(`All scans are mapped. By raw odometry alone the robot would be ${end.toFixed(2)} m off.`)
  const compared = await log.picture()
  expect(compared).not.toBe(alone)
  await expect(log.readout('digest')).toHaveText(golden)

  // It goes with the slider: at the first scan both agree, and picture, sentence and readout go back to the same end.
  await log.scrubTo(1)
  await expect(log.sentence).toContainText('Scan 1 of 90')
  expect(await apart()).toBeLessThan(0.25)
  const first = await log.picture()
  await log.element.evaluate(element => (element as FigureElement).seek(90))
  await log.done()
  expect(await log.picture()).toBe(compared)
  expect(first).not.toBe(compared)
  expect(await apart()).toBe(end)

  // The chip is a link to it, and the link has it.
  await compare.uncheck()
  await expect.poll(() => log.picture()).toBe(alone)
  await chip.click()
  await expect(compare).toBeChecked()
  expect(await log.element.evaluate((element: HTMLElement & { link: string }) => element.link.split('#')[1])).toBe('fastslam-log?v=3&odometry=on')
})

test('its program is not fetched until something is asked of it, and what was asked first is not lost', async ({ page }) => {
  const fetched: string[] = []
  page.on('request', request => /fastslam-log(?!-poster).*(wasm|png)$/.test(request.url()) && fetched.push(request.url()))
  await openAlone(page, 'fastslam-log')
  const log = new LogFigure(page)
  await expect(log.button('Map this building')).toBeVisible()
  await expect(log.element.locator('input[type=number][name=universes]')).toHaveValue('16')
  await log.settled()
  expect(fetched).toEqual([])
  expect(page.workers()).toHaveLength(0)
  await log.set('universes', '7')
  await expect(log.element.locator('.stage.live')).toBeVisible()
  await expect(log.element.locator('input[type=number][name=universes]')).toHaveValue('7')
  await expect.poll(() => log.element.evaluate((element: HTMLElement & { link: string }) => element.link)).toContain('universes=7')
  expect(fetched).toHaveLength(1)
})

test('a log that is chosen wakes it, and so does an attribute', async ({ page }) => {
  await openAlone(page, 'fastslam-log')
  const log = new LogFigure(page)
  await expect(log.button('Map this building')).toBeVisible()
  await log.choose('tiny.clf', readFileSync(TINY))
  await expect(log.sentence).toContainText('91 scans')
  await page.reload()
  await expect(log.button('Map this building')).toBeVisible()
  await log.element.evaluate(element => element.setAttribute('universes', '9'))
  await expect(log.element.locator('.stage.live')).toBeVisible()
  await expect(log.element.locator('input[type=number][name=universes]')).toHaveValue('9')
})

test('it pauses and goes on, and what is mapped by then can be looked at and saved', async ({ page }) => {
  const log = await new LogFigure(page).open()
  await log.choose('tiny.clf', readFileSync(TINY))
  await expect(log.sentence).toContainText('91 scans of up to 120 beams')
  await expect(log.sentence).toContainText('16 universes with cells of 0.05 m take at most')
  await log.set('universes', '128')
  await expect(log.sentence).toContainText('128 universes')
  const at = async () => Number((await log.readout('scan').textContent())!.split(' of ')[0])

  await log.button('Map this building').click()
  await expect.poll(at).toBeGreaterThan(3)
  await expect(log.element.locator('[part=transport] .position')).toContainText('left')
  await log.button('Pause').click()
  await expect(log.button('Play')).toBeVisible()
  const paused = await at()
  await log.settled()
  expect(await at()).toBe(paused)
  expect(paused).toBeLessThan(90)
  // The keys of the picture do the same.
  await log.stage.focus()
  await page.keyboard.press('Space')
  await expect.poll(at).toBeGreaterThan(paused)
  await log.button('Pause').click()
  await expect(log.button('Play')).toBeVisible()
  const stopped = await at()
  expect(stopped).toBeLessThan(90)
  // It can be looked at and saved, and goes on from where it was.
  await log.scrubTo(1)
  await expect.poll(at).toBe(1)
  await log.unfold('saves')
  const [download] = await Promise.all([page.waitForEvent('download'), log.button('Path (TUM)').click()])
  expect((await content(download)).toString().trim().split('\n')).toHaveLength(stopped + 1)
  await log.button('Play').click()
  await expect.poll(at).toBeGreaterThan(stopped)
  await log.button('Pause').click()
  // Other settings begin anew.
  await log.set('universes', '2')
  await expect(log.button('Map this building')).toBeEnabled()
  await log.button('Map this building').click()
  await expect(log.button('Pause').or(log.button('Play'))).toBeFocused() // the button that was pressed cannot hold the focus any more
  await log.done()
})

test('a log is dropped, compressed or not', async ({ page }) => {
  const log = await new LogFigure(page).open()
  for (const [name, bytes] of [
    ['tiny.clf', readFileSync(TINY)],
    ['packed.log.gz', gzipSync(readFileSync(TINY))],
  ] as const) {
    const data = await page.evaluateHandle(
      ({ name, base64 }) => {
        const transfer = new DataTransfer()
        transfer.items.add(new File([Uint8Array.from(atob(base64), c => c.charCodeAt(0))], name))
        return transfer
      },
      { name, base64: bytes.toString('base64') },
    )
    await log.stage.dispatchEvent('dragover', { dataTransfer: data })
    await log.stage.dispatchEvent('drop', { dataTransfer: data })
    await expect(log.status).toHaveText(name)
    await expect(log.sentence).toContainText('91 scans')
    await expect(log.alert).toBeEmpty()
  }
})

test('what cannot be read is told with line and reason, and the example is a click away', async ({ page }) => {
  const log = await new LogFigure(page).open()
  for (const [name, bytes, says] of [
    ['empty.clf', '', 'empty.clf cannot be mapped: the file is empty.'],
    ['photo.png', Buffer.from([0x89, 0x50, 0x4e, 0x47, 0xd, 0xa, 0x1a, 0xa, 0, 0]), 'photo.png cannot be mapped: line 1: '],
    ['table.csv', 'x,y\n1,2\n', 'table.csv cannot be mapped: line 1: '],
    ['odometry.clf', 'ODOM 0 0 0 0 0 0 1 host 1\n', 'no FLASER'],
    ['nan.clf', 'ODOM nan 0 0 0 0 0 1 host 1\n', 'line 1: ODOM: expected '],
    ['broken.gz', Buffer.from([0x1f, 0x8b, 1, 2, 3, 4, 5, 6]), 'broken.gz cannot be mapped: it begins like a gzip file, but cannot be unpacked.'],
  ] as const) {
    await log.choose(name, bytes as string | Buffer)
    await expect(log.alert).toContainText(says)
    await expect(log.alert.getByRole('button', { name: 'Run the example' })).toBeVisible()
    await expect(log.stage, 'nothing is to be mapped').toHaveClass(/empty/)
  }
  await log.alert.getByRole('button', { name: 'Run the example' }).click()
  await expect(log.alert).toBeEmpty()
  await expect(log.status).toHaveText('the example')
})

test('while a reader’s own log is on its way, the example is not mapped in its place', async ({ page }) => {
  const arrive = await holdPrograms(page)
  const log = new LogFigure(page)
  await openCourse(page, '<fastslam-log cell="0.2"></fastslam-log>')
  await log.choose('tiny.clf', readFileSync(TINY))
  await expect(log.status).toContainText('tiny.clf')
  await expect(log.button('Map this building')).toBeDisabled()
  arrive()
  await expect(log.status).toHaveText('tiny.clf')
  await log.button('Map this building').click()
  await log.done()
  await expect(log.status).toHaveText('tiny.clf')
})

test('what is said of a log goes when another one is chosen, also one that cannot be read', async ({ page }) => {
  const log = await new LogFigure(page).open()
  await log.choose('spoilt.clf', `${readFileSync(TINY, 'utf8')}ROBOTLASER1 what\n`)
  await expect(log.alert).toContainText('spoilt.clf')
  await expect(log.button('Skip malformed lines')).toBeVisible()
  await log.choose('empty.clf', '')
  await expect(log.alert).toContainText('empty.clf cannot be mapped')
  await expect(log.button('Skip malformed lines')).toHaveCount(0)
  await expect(log.alert).not.toContainText('spoilt.clf')
})

test('on a German page, what cannot be read is told in German, by the program of logs and by that of files', async ({ page }) => {
  await openCourse(page, '<fastslam-log></fastslam-log>', { lang: 'de' })
  const log = new LogFigure(page)
  await expect(log.sentence).toContainText('Noch ist kein Log geöffnet.')
  const bag = readFileSync(join(root, 'tests', 'bags', 'odometry-zstd.mcap'))
  for (const [name, bytes, says] of [
    ['table.csv', 'x,y\n1,2\n', 'table.csv kann nicht kartiert werden: Zeile 1: erwartet ist der Name einer Nachricht'],
    ['odometry.clf', 'ODOM 0 0 0 0 0 0 1 host 1\n', 'sie enthält keine Nachricht FLASER oder ROBOTLASER1'],
    ['broken.gz', Buffer.from([0x1f, 0x8b, 1, 2, 3, 4, 5, 6]), 'broken.gz kann nicht kartiert werden: '],
    ['nothing.bag', '#ROSBAG V2.0\n', 'nothing.bag kann nicht kartiert werden: sie enthält kein Topic mit sensor_msgs/LaserScan; vorhanden: kein einziges'],
    ['half.mcap', bag.subarray(0, bag.length / 2), 'half.mcap, sie endet mitten in einem Datensatz: Wurde die Aufnahme abgebrochen?'],
  ] as const) {
    await log.choose(name, bytes as string | Buffer)
    await expect(log.alert).toContainText(says)
  }
  await log.choose('two.mcap', readFileSync(join(root, 'tests', 'bags', 'two-lasers.mcap')))
  await log.alert.getByRole('button', { name: '/rear/scan' }).click()
  await expect(log.sentence).toContainText('Hinweis: es gibt keine Odometrie: Jeder Scan wird mit denen davor abgeglichen.')
})

/** Whether its sentence stands there to its last word, and with it the button that plays. */
const readable = (log: LogFigure) =>
  log.element.evaluate(figure => {
    const inside = (name: string) => figure.shadowRoot!.querySelector<HTMLElement>(name)!
    const [sentence, body] = [inside('.sentence'), figure.getBoundingClientRect()]
    const words = document.createRange()
    words.selectNodeContents(sentence)
    const [text, box] = [words.getBoundingClientRect(), sentence.getBoundingClientRect()]
    const whole = getComputedStyle(sentence).whiteSpace === 'normal' && sentence.scrollWidth <= sentence.clientWidth && sentence.scrollHeight <= sentence.clientHeight + 1
    return { whole: whole && text.left >= box.left && text.right <= box.right && text.bottom <= body.bottom, height: Math.round(body.height) }
  })

for (const [lang, sizes] of [
  ['en', [[1366, 650], [1024, 618], [380, 760]]],
  ['de', [[1366, 650], [380, 760]]],
] as const) {
  test(`its sentence is whole before a log is open and when it is mapped, at every width, ${lang}`, async ({ page }) => {
    await openCourse(page, '<main style="max-width: 1168px; margin: auto"><fastslam-log universes="2" cell="0.2"></fastslam-log></main>', { lang })
    const log = new LogFigure(page)
    const expectWhole = async () => {
      for (const [width, height] of sizes) {
        await page.setViewportSize({ width, height })
        await log.settled()
        const seen = await readable(log)
        expect(seen.whole, `${width} px wide`).toBe(true)
        if (width >= 832) expect(seen.height, 'on one screen').toBeLessThanOrEqual(612)
      }
    }
    await expect(log.sentence).toContainText('MCAP')
    await expectWhole()
    await log.choose('tiny.clf', readFileSync(TINY))
    await log.button(lang === 'de' ? 'Dieses Gebäude kartieren' : 'Map this building').click()
    await expect(log.sentence).toContainText(lang === 'de' ? 'Alle Scans sind kartiert' : 'All scans are mapped')
    await expectWhole()
  })
}

test('malformed lines are named, and skipped if the reader says so', async ({ page }) => {
  const lines = readFileSync(TINY, 'utf8').split('\n')
  lines[4] = lines[4]!.slice(0, 60)
  lines[9] = 'ROBOTLASER1 what'
  const log = await new LogFigure(page).open(QUICK)
  await log.choose('damaged.clf', lines.join('\n'))
  await expect(log.alert).toContainText('line 5: ROBOTLASER1: expected ')
  await expect(log.alert).toContainText('2 malformed lines')
  await expect(log.button('Map this building')).toBeDisabled()
  await log.alert.getByRole('button', { name: 'Skip malformed lines' }).click()
  await expect(log.alert).toBeEmpty()
  await log.button('Map this building').click()
  await log.done()
})

test('what does not fit into memory is refused before it starts', async ({ page }) => {
  const log = await new LogFigure(page).open()
  // Twenty scans, 800 m apart: a kilometre would be refused as a jump.
  const far = Array.from({ length: 20 }, (_, k) => `FLASER 2 80 80 ${800 * k} ${70 * (k % 9)} 0 ${800 * k} ${70 * (k % 9)} 0 ${k} host ${k}\n`)
  await log.choose('far.clf', far.join(''))
  await log.set('max-range', '80')
  await log.set('cell', '0.02')
  await log.set('universes', '256')
  await log.element.locator('select[name=policy]').selectOption('never')
  await log.settled() // by another policy, another number would be the most
  await expect(log.alert).toContainText(/universes = 256: must be a whole number from 1 to \d+ here: .* the limit is 1000 MB/)
  await expect(log.button('Map this building')).toBeDisabled()
  const most = /from 1 to (\d+) here/.exec((await log.alert.textContent())!)![1]!
  await log.set('universes', most)
  await expect(log.alert).toBeEmpty()
  await log.set('universes', '1000')
  await expect(log.alert).toContainText('universes')
  await expect(log.element.locator('input[type=number][name=universes]')).toHaveValue(most)
})

test('the map is moved and magnified by keys, buttons, mouse and touchpad, and the wheel scrolls the page', async ({ page }) => {
  const log = await new LogFigure(page).open(QUICK)
  await log.choose('tiny.clf', readFileSync(TINY))
  await log.button('Map this building').click()
  await log.done()
  const whole = await log.picture()
  const box = (await log.element.locator('canvas').boundingBox())!
  const [x, y] = [box.x + 0.3 * box.width, box.y + 0.5 * box.height]
  const acts: [string, () => Promise<void>][] = [
    ['+', () => page.keyboard.press('+')],
    ['−', () => page.keyboard.press('-')],
    ['left', () => page.keyboard.press('ArrowLeft')],
    ['down', () => page.keyboard.press('ArrowDown')],
    ['button', () => log.button('Magnify').click()],
    [
      'mouse',
      async () => {
        await page.mouse.move(x, y)
        await page.mouse.down()
        await page.mouse.move(x + 50, y + 30, { steps: 4 })
        await page.mouse.up()
      },
    ],
    ['double click', () => page.mouse.dblclick(x, y)],
    [
      'touchpad',
      async () => {
        await page.keyboard.down('Control')
        await page.mouse.wheel(0, -100)
        await page.keyboard.up('Control')
      },
    ],
  ]
  for (const [name, act] of acts) {
    await log.stage.focus()
    await act()
    await expect.poll(() => log.picture(), name).not.toBe(whole)
    await log.stage.focus()
    await page.keyboard.press('0')
    await expect.poll(() => log.picture(), `${name}, and back`).toBe(whole)
  }
  // The page has something to scroll to.
  await page.evaluate(() => document.body.append(Object.assign(document.createElement('p'), { style: 'height: 2000px' })))
  const before = await page.evaluate(() => scrollY)
  await page.mouse.move(x, y)
  await page.mouse.wheel(0, 200)
  await expect.poll(() => page.evaluate(() => scrollY)).toBeGreaterThan(before)
  expect(await log.picture()).toBe(whole)
})

test('two fingers magnify the map, one scrolls the page', async ({ browser, baseURL }) => {
  const context = await browser.newContext({ baseURL: baseURL!, hasTouch: true, isMobile: true, viewport: { width: 380, height: 800 } })
  const page = await context.newPage()
  const log = await new LogFigure(page).open(QUICK)
  await log.choose('tiny.clf', readFileSync(TINY))
  await log.button('Map this building').tap()
  await log.done()
  await log.stage.scrollIntoViewIfNeeded()
  const whole = await log.picture()
  const box = (await log.element.locator('canvas').boundingBox())!
  const [x, y] = [box.x + box.width / 2, box.y + 200]
  const client = await context.newCDPSession(page)
  const touch = (type: 'touchStart' | 'touchMove' | 'touchEnd', ...points: [number, number][]) =>
    client.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) })

  const before = await page.evaluate(() => scrollY)
  await touch('touchStart', [x - 30, y], [x + 30, y])
  for (let k = 1; k <= 6; k++) await touch('touchMove', [x - 30 - 8 * k, y - 5 * k], [x + 30 + 8 * k, y - 5 * k])
  await touch('touchEnd')
  await expect.poll(() => log.picture()).not.toBe(whole)
  expect(await page.evaluate(() => scrollY)).toBe(before)
  const near = await log.picture()

  await touch('touchStart', [x, y])
  for (let k = 1; k <= 8; k++) await touch('touchMove', [x, y - 20 * k])
  await touch('touchEnd')
  await expect.poll(() => page.evaluate(() => scrollY)).toBeGreaterThan(before)
  expect(await log.picture()).toBe(near)
  await context.close()
})

test('a program that dies says so, and the example is still possible', async ({ page, complaints }) => {
  const log = await new LogFigure(page).open()
  await log.choose('tiny.clf', readFileSync(TINY))
  await expect(log.sentence).toContainText('91 scans')
  // What a panic would do to it.
  await page.evaluate(() => {
    const post = Worker.prototype.postMessage
    Worker.prototype.postMessage = function (this: Worker, message: { do?: string }) {
      if (message.do !== 'run') return post.call(this, message)
      this.dispatchEvent(new MessageEvent('message', { data: { told: 'failed', why: 'panicked at nothing', error: 'unreachable' } }))
      Worker.prototype.postMessage = post
    }
  })
  await log.button('Map this building').click()
  await expect(log.alert).toContainText('Something failed while this log was mapped (panicked at nothing), so mapping has stopped.')
  await log.alert.getByRole('button', { name: 'Run the example' }).click()
  await expect(log.status).toHaveText('the example')
  await expect(log.alert).toBeEmpty()
  expect(complaints.splice(0).every(complaint => complaint.includes('panicked at nothing'))).toBe(true)
})

test('a link holds the settings, and attributes set them', async ({ page }) => {
  await openAlone(page, 'fastslam-log', '#fastslam-log?universes=7&cell=0.2&policy=always&cell=9')
  const log = new LogFigure(page)
  await expect(log.element.locator('.stage.live')).toBeVisible()
  await expect(log.alert).toContainText('cell')
  await expect(log.element.locator('input[type=number][name=universes]')).toHaveValue('7')
  const link = await log.element.evaluate((element: HTMLElement & { link: string }) => element.link)
  expect(link.split('#')[1]).toBe('fastslam-log?v=3&universes=7&cell=0.2&policy=always&raw=off') // as links of its time had it
  await log.element.evaluate(element => element.setAttribute('universes', '9'))
  await expect(log.element.locator('input[type=number][name=universes]')).toHaveValue('9')
  await log.element.evaluate(element => element.setAttribute('universes', 'many'))
  await expect(log.alert).toContainText('universes = "many": must be a whole number from 1 to 256')
})

test('nothing leaves the machine, and the figure says so', async ({ page }) => {
  const log = await new LogFigure(page).open(QUICK)
  const asked: string[] = []
  page.on('request', request => asked.push(request.url()))
  await log.choose('secret.clf', readFileSync(TINY))
  await log.button('Map this building').click()
  await log.done()
  expect(asked.filter(url => !url.startsWith('blob:'))).toEqual([])
  await expect(log.element.locator('[part=source]')).toContainText('nothing leaves your machine')
})

test('the page answers while a log is mapped', async ({ page }) => {
  const log = await new LogFigure(page).open()
  await log.choose('tiny.clf', readFileSync(TINY))
  await log.set('universes', '256')
  await log.button('Map this building').click()
  await expect(log.button('Pause')).toBeVisible()
  // How soon is the machine's, and `npm run bench` tells it. That another thread does the work is ours.
  expect(page.workers()).toHaveLength(1)
  await log.stage.focus()
  for (let i = 0; i < 3; i++) {
    const before = await log.picture()
    await page.keyboard.press('ArrowLeft')
    await expect.poll(() => log.picture()).not.toBe(before)
    await expect(log.button('Pause')).toBeVisible()
  }
})

test('axe finds nothing: light, on a dark phone, in forced colours', async ({ page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' })
  const log = await new LogFigure(page).open(QUICK)
  await log.choose('none.clf', 'nonsense')
  await expect(log.alert).not.toBeEmpty()
  await log.choose('tiny.clf', readFileSync(TINY))
  await log.button('Map this building').click()
  await log.done()
  for (const [what, media, width] of [
    ['light', { colorScheme: 'light' }, 1280],
    ['a dark phone', { colorScheme: 'dark' }, 380],
    ['forced colours', { colorScheme: 'light', forcedColors: 'active' }, 1280],
  ] as const) {
    await page.emulateMedia(media)
    await page.setViewportSize({ width, height: 800 })
    await log.settled()
    expect(await brokenRules(page, { of: 'fastslam-log' }), what).toEqual([])
  }
})

// In `npm test`, a small log has the fingerprint of the native build (above).
test('the Intel log has the fingerprint that the command line tells', breadth, async ({ page }) => {
  test.skip(!existsSync(INTEL), 'intel.clf is not on this machine')
  test.setTimeout(600_000)
  const log = await new LogFigure(page).open()
  await log.choose('intel.clf', readFileSync(INTEL))
  await expect(log.sentence).toContainText('910 scans', { timeout: 30_000 })
  await log.set('universes', '4')
  await log.button('Map this building').click()
  // In the profile of tests, where most of the command line is built.
  const command = ['run', '--quiet', '--profile', 'test', '--bin', 'fastslam', '--', 'log', INTEL, '--particles', '4', '--json']
  const { digest } = JSON.parse(execFileSync('cargo', command, { cwd: root, encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] }))
  await log.done(300_000)
  await expect(log.readout('digest')).toHaveText(digest)
})

/** What the page sends the worker, by name, from now on. */
async function tapWorker(page: Page): Promise<() => Promise<string[]>> {
  await page.addInitScript(() => {
    const asked: string[] = []
    Object.assign(self, { asked })
    const post = Worker.prototype.postMessage
    Worker.prototype.postMessage = function (this: Worker, message: { do?: string }) {
      asked.push(message.do ?? '')
      return post.call(this, message)
    }
  })
  return () => page.evaluate(() => (self as unknown as { asked: string[] }).asked)
}

test('the first log that a script opens is read once, and a refusal names its file', async ({ page }) => {
  const asked = await tapWorker(page)
  await openCourse(page, '<fastslam-log></fastslam-log>')
  const log = new LogFigure(page)
  await expect(log.button('Map this building')).toBeVisible()
  await log.element.evaluate((element: HTMLElement & { open(file: Blob, name: string): Promise<void> }) => element.open(new Blob(['x,y\n1,2\n']), 'table.csv'))
  await expect(log.alert).toContainText('table.csv cannot be mapped: line 1: ')
  expect((await asked()).filter(ask => ask === 'open')).toHaveLength(1)
  // Each refusal names its own file, also where the next one is on its way.
  const text = readFileSync(TINY, 'utf8')
  await log.element.evaluate(async (element: HTMLElement & { open(file: Blob, name: string): Promise<void> }, text) => {
    await element.open(new Blob(['a,b\n']), 'other.csv')
    await element.open(new Blob([text]), 'tiny.clf')
  }, text)
  await expect(log.status).toHaveText('tiny.clf')
  await expect(log.alert).toContainText('other.csv cannot be mapped')
  // The one that is open is read again after a move.
  await log.element.evaluate(element => document.body.prepend(element))
  await expect(log.status).toHaveText('tiny.clf')
  await expect(log.sentence).toContainText('91 scans')
  await expect.poll(async () => (await asked()).filter(ask => ask === 'open').length).toBe(4)
})

/** The figure as the page has it, or a script of the page. */
const scripted = (set: string) => `<script type="module">
  import './fastslam.js'
  const log = document.createElement('fastslam-log')
  ${set}
  log.setAttribute('lock', 'LOCK')
  document.body.append(log)
</script>`
const MADE = {
  parsed: '<fastslam-log universes="8" lock="LOCK"></fastslam-log>',
  attribute: scripted("log.setAttribute('universes', '8')"),
  property: scripted('log.universes = 8'),
}
const LINKS = [
  ['#fastslam-log?universes=4&cell=0.1', '', 4],
  ['#fastslam-log?universes=4&cell=0.1', 'universes', 8],
  ['', '', 8],
] as const
for (const [which, cases, options] of [
  ['parsed or scripted', [[MADE.parsed, LINKS[0]], [MADE.attribute, LINKS[1]], [MADE.property, LINKS[0]], [MADE.property, LINKS[2]]], {}],
  ['in all ways', Object.values(MADE).flatMap(body => LINKS.map(link => [body, link] as const)), breadth],
] as const) {
  test(`settings obey one order, ${which}: locked, link, attribute, default; what is set is what is read`, options, async ({ page }) => {
    const universes = (log: LogFigure) => log.element.evaluate(element => (element as HTMLElement & { universes: number }).universes)
    for (const [body, [link, lock, expected]] of cases) {
      await page.unrouteAll()
      await page.goto('about:blank')
      await openCourse(page, body.replace('LOCK', lock), { link })
      const log = new LogFigure(page)
      await expect(log.element.locator('.stage.live')).toBeVisible()
      await expect(log.element.locator('input[type=number][name=universes]')).toHaveValue(String(expected))
      expect(await universes(log), `${body}, ${link}`).toBe(expected)
      const read = await log.element.evaluate(element => {
        const figure = element as HTMLElement & { universes: number }
        figure.setAttribute('universes', '5')
        const values = [figure.universes]
        figure.universes = 7
        return [...values, figure.universes]
      })
      expect(read).toEqual([5, 7])
      await expect(log.element.locator('input[type=number][name=universes]')).toHaveValue('7')
    }
  })
}

for (const type of ['fastslam-step', 'fastslam-change']) {
  test(`in ${type} of a log, to remove, move, reset or clone the figure is harmless`, async ({ page }) => {
    await openCourse(page, '<main></main><aside></aside>')
    for (const deed of ['remove', 'move', 'reset', 'clone'] as const) {
      await page.evaluate(() => {
        document.querySelectorAll('fastslam-log').forEach(figure => figure.remove())
        document.querySelector('main')!.innerHTML = '<fastslam-log></fastslam-log>'
      })
      const log = new LogFigure(page)
      await expect(log.button('Map this building')).toBeVisible()
      await log.choose('tiny.clf', readFileSync(TINY))
      await expect(log.sentence).toContainText('91 scans')
      await log.element.evaluate(
        (element, [type, deed]) =>
          new Promise<void>(done => {
            const figure = element as HTMLElement & { reset(): void }
            const deeds = {
              remove: () => figure.remove(),
              move: () => document.querySelector('aside')!.append(figure),
              reset: () => figure.reset(),
              clone: () => figure.after(Object.assign(figure.cloneNode(true), { id: 'copy' })),
            }
            figure.addEventListener(
              type,
              () => {
                deeds[deed]()
                requestAnimationFrame(() => {
                  if (!figure.isConnected) document.body.append(figure)
                  done()
                })
              },
              { once: true },
            )
            figure.setAttribute('universes', '3')
          }),
        [type, deed] as const,
      )
      const original = page.locator('fastslam-log:not(#copy)')
      await expect(original.getByRole('status'), deed).toHaveText('tiny.clf')
      await expect(original.locator('[part=sentence]'), deed).toContainText('91 scans')
      await expect(original.getByRole('alert'), deed).toBeEmpty()
    }
  })
}
