// The wasm that readers get, after wasm-opt, against the golden pictures: the program of the page's figures, that which maps logs, and those of
// single figures.
import { existsSync, readFileSync } from 'node:fs'
import { join } from 'node:path'
import type { Browser } from '@playwright/test'
import { programFile, programs, singlePrograms } from '../../scripts/registry.mjs'
import { root } from '../../scripts/lib.mjs'
import { startServer } from '../../scripts/serve.mjs'
import type { Action } from '../../widgets/elements/action'
import type { ProgramFrame } from '../../widgets/elements/shell'
import type { ThemeName } from '../../widgets/elements/theme'
import { expect, test } from './fixtures'
import { breadth, programsMade } from './host'

interface Picture {
  name: string
  tag: string
  query: string
  width: number
  dpr: number
  theme: ThemeName
  /** Size and value of the digest, as in the golden file. */
  digest: string
}

const golden = join(root, 'tests', 'figures', 'golden')
const pictures = readFileSync(join(golden, 'pixels.txt'), 'utf8')
  .trim()
  .split('\n')
  .map((line): Picture => {
    const [name, figure, width, dpr, theme, ...digest] = line.split(' ')
    const [tag, query] = figure!.split(/\?(.*)/)
    return { name: name!, tag: tag!, query: query!, width: Number(width), dpr: Number(dpr), theme: theme as ThemeName, digest: digest.join(' ') }
  })

/** Runs in the page: the digests of these pictures, by the calls that the page makes. */
async function digests({ program, wanted, log }: { program: string; wanted: Picture[]; log: string }): Promise<string[]> {
  // The glue holds one program: each gets its own.
  const module = `/fastslam_widgets.js?${program}`
  const { default: init, Figure } = (await import(module)) as typeof import('../../widgets/pkg/fastslam_widgets')
  const { memory } = await init({ module_or_path: `/${program}.wasm` })
  // Pictures of one state are of one figure, which was brought there once.
  const figures = new Map<string, InstanceType<typeof Figure>>()
  const act = (figure: InstanceType<typeof Figure>, action: Action) => void figure.act(action)
  const open = (tag: string, query: string) => {
    const figure = new Figure(tag)
    act(figure, { do: 'begin', value: query, name: '', on: false })
    if (tag === 'fastslam-log') {
      figure.open(new TextEncoder().encode(log))
      act(figure, { do: 'seek', at: [Infinity] })
    }
    while (figure.pending()) figure.work()
    figures.set(`${tag}?${query}`, figure)
    return figure
  }
  return wanted.map(({ tag, query, width, dpr, theme }) => {
    const figure = figures.get(`${tag}?${query}`) ?? open(tag, query)
    const look = (pixels: [number, number]) => {
      act(figure, { do: 'size', name: theme, at: [width, Infinity, 1, width, ...pixels] })
      return (figure.frame(true) as ProgramFrame).layout!.height
    }
    const [w, h] = [width, look([0, 0])].map(side => Math.round(side * dpr))
    look([w!, h!])
    // FNV-1a of 64 bits, in halves: × 0x100000001b3 is × 0x1b3, and a shift by 40.
    let [high, low] = [0xcbf29ce4, 0x84222325]
    for (const byte of new Uint8Array(memory.buffer, figure.pixels(), 4 * w! * h!)) {
      low = (low ^ byte) >>> 0
      const product = low * 0x1b3
      high = (Math.imul(high, 0x1b3) + Math.floor(product / 2 ** 32) + (low << 8)) >>> 0
      low = product >>> 0
    }
    const hex = (x: number) => x.toString(16).padStart(8, '0')
    return `${4 * w! * h!} ${hex(high)}${hex(low)}`
  })
}

/** That these pictures come out of a program as they are in the golden file. */
async function expectGolden(browser: Browser, program: string, wanted: Picture[]): Promise<void> {
  const server = await startServer({ folder: join(root, 'widgets', 'pkg') })
  // A context of its own: the fixture's may not leave the site.
  const page = await (await browser.newContext()).newPage()
  await page.route('**/blank', route => route.fulfill({ contentType: 'text/html', body: '<!doctype html><title>pixels</title>' }))
  await page.goto(`${server.url}blank`)
  const painted = await page.evaluate(digests, { program, wanted, log: readFileSync(join(golden, 'tiny.clf'), 'utf8') })
  expect(wanted.map(({ name }, i) => `${name} ${painted[i]}`)).toEqual(wanted.map(({ name, digest }) => `${name} ${digest}`))
  expect(wanted.length).toBeGreaterThan(0)
  await page.context().close()
  await server.close()
}

const of = (program: string) => pictures.filter(({ tag }) => programs.get(tag) === program)

// Three quarters of the time went into a quarter of the pictures, each of which has to be computed for itself; every figure has others.
const LONG = /^(joint-exercise|em-(fold|backward|phone)|graph-(folded|mended)|(joint|em|smoothing|graph)-(asked|judged)|resampling-judged)$|^fastslam-(joint|smoothing)-/

test('fastslam-page.wasm paints golden pictures of every figure to the last pixel', async ({ browser }) => {
  const wanted = of('page').filter(({ name }) => !LONG.test(name))
  for (const [tag, program] of programs) if (program === 'page') expect(wanted.filter(picture => picture.tag === tag).length, tag).toBeGreaterThan(1)
  await expectGolden(browser, 'fastslam-page', wanted)
})

test('fastslam-log.wasm paints its golden pictures to the last pixel', async ({ browser }) => {
  await expectGolden(browser, 'fastslam-log', of('log'))
})

test('fastslam-page.wasm paints all its golden pictures to the last pixel', breadth, async ({ browser }) => {
  test.slow()
  await expectGolden(browser, 'fastslam-page', of('page'))
})

test('the program of a single figure paints its golden pictures to the last pixel', async ({ browser }) => {
  await expectGolden(browser, 'fastslam-proposal', pictures.filter(({ tag }) => tag === 'fastslam-proposal'))
})

test('every program of a single figure paints its golden pictures to the last pixel', programsMade, async ({ browser }) => {
  test.slow()
  const built = singlePrograms.filter(name => existsSync(programFile(name)))
  expect(built.length, 'of these there are several, or this test shows nothing').toBeGreaterThan(1)
  for (const name of built) await expectGolden(browser, `fastslam-${name}`, pictures.filter(({ tag, name: picture }) => tag === `fastslam-${name}` && !LONG.test(picture)))
})
