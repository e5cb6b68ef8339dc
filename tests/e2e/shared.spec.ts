// Two cores for one figure: a worker draws for half of the particles, and nobody sees a difference but in time.
import type { Page } from '@playwright/test'
import { expect, test } from './fixtures'
import { Figure } from './figure'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

/** As on a machine with so many processors. Counts what pages and workers give each other. */
async function withProcessors(page: Page, processors: number, posted?: 'lost' | 'broken'): Promise<void> {
  await page.addInitScript(
    ({ processors, posted }) => {
      Object.defineProperty(navigator, 'hardwareConcurrency', { get: () => processors })
      const given = { parts: 0 }
      Object.assign(self, { given })
      const { postMessage } = Worker.prototype
      Worker.prototype.postMessage = function (message: { do?: string }, ...rest: unknown[]) {
        if (message.do === 'part') {
          given.parts++
          if (posted === 'lost' && given.parts > 1) return
          if (posted === 'broken' && given.parts > 1) return void this.dispatchEvent(new ErrorEvent('error', { cancelable: true }))
        }
        Reflect.apply(postMessage, this, [message, ...rest])
      }
    },
    { processors, posted },
  )
}

const parts = (page: Page) => page.evaluate(() => (self as unknown as { given: { parts: number } }).given.parts)

/** What a figure shows of a setting that was dragged to. With a partner, dragging goes on until it takes part: it has to come first, and rests on a busy machine. */
async function dragged(page: Page, tag: string, attributes: string, partner: boolean): Promise<unknown> {
  const figure = await new Figure(page, tag).alone(`#${tag}?${attributes}`)
  const drag = async (value: number) => {
    await figure.element.evaluate((element, value) => element.setAttribute('odometry', value), value.toFixed(2))
    await figure.settled()
  }
  for (let value = 1.1; partner && (await parts(page)) === 0; value = value < 1.9 ? value + 0.01 : 1.1) await drag(value)
  await drag(1.05)
  return [await figure.readouts(), await figure.picture()]
}

for (const [tag, attributes] of [
  ['fastslam-lap', 'universes=16&step=90'],
  ['fastslam-resampling', 'particles=40&step=60'],
] as const) {
  test(`${tag} with a partner shows what it shows alone`, async ({ page, context }) => {
    await withProcessors(page, 2)
    const shared = await dragged(page, tag, attributes, true)
    const other = await context.newPage()
    await withProcessors(other, 1)
    expect(await dragged(other, tag, attributes, false)).toEqual(shared)
    expect([await parts(other), other.workers().length]).toEqual([0, 0])
  })
}

for (const [what, posted] of [
  ['falls silent', 'lost'],
  ['breaks down', 'broken'],
] as const) {
  test(`where the partner ${what} the page goes on alone`, async ({ page, context }) => {
    await withProcessors(page, 2, posted)
    const shared = await dragged(page, 'fastslam-lap', 'universes=64&step=60', true)
    const other = await context.newPage()
    await withProcessors(other, 1)
    expect(await dragged(other, 'fastslam-lap', 'universes=64&step=60', false)).toEqual(shared)
  })
}
