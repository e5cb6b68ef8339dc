// Events are sent last: whoever listens may do anything to the figure.
import type { Page } from '@playwright/test'
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { openCourse } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

type FigureElement = HTMLElement & { step(): void; reset(): void; seek(step: number): void; play(): void; state: string }

const DEEDS = ['remove', 'reset', 'move', 'clone', 'go elsewhere', 'load another state'] as const

/** Does it in the first event of this type, which it calls forth. */
function doInside(page: Page, type: string, deed: (typeof DEEDS)[number]): Promise<unknown> {
  return page.locator('main > fastslam-lap').evaluate(
    (element, [type, deed]) => {
      const figure = element as FigureElement
      const deeds: Record<string, () => void> = {
        remove: () => figure.remove(),
        reset: () => figure.reset(),
        move: () => document.querySelector('aside')!.append(figure),
        clone: () => figure.after(figure.cloneNode(true)),
        'go elsewhere': () => figure.seek(4),
        'load another state': () => (figure.state = 'universes=3&step=1'),
      }
      const calls: Record<string, () => void> = {
        'fastslam-step': () => figure.seek(2),
        'fastslam-change': () => figure.setAttribute('universes', '3'),
        'fastslam-trace': () => figure.step(),
      }
      const done = new Promise<void>(resolve =>
        figure.addEventListener(
          type,
          () => {
            deeds[deed]!()
            // By then the frame that sent it has come to its end, and another has been.
            requestAnimationFrame(() => requestAnimationFrame(() => resolve()))
          },
          { once: true },
        ),
      )
      calls[type]!()
      return done
    },
    [type, deed] as const,
  )
}

for (const type of ['fastslam-step', 'fastslam-change', 'fastslam-trace']) {
  test(`in ${type}, it is harmless to ${DEEDS.join(', to ')}`, async ({ page }) => {
    await openCourse(page, '<main></main><aside></aside>')
    for (const deed of DEEDS) {
      await test.step(deed, async () => {
        await page.evaluate(() => {
          document.querySelector('aside')!.replaceChildren()
          document.querySelector('main')!.innerHTML = '<fastslam-lap id="lap" universes="2"></fastslam-lap>'
        })
        const lap = new Figure(page, '#lap >> nth=0')
        await lap.live()
        const held = await lap.element.elementHandle()
        await doInside(page, type, deed)
        if (deed === 'remove') {
          await expect(lap.element).toHaveCount(0)
          await held!.evaluate(figure => document.querySelector('main')!.append(figure))
        }
        await lap.live()
        await expect(lap.alert).toBeEmpty()
        // It goes on as any other.
        await lap.element.evaluate(figure => (figure as FigureElement).seek(3))
        await expect.poll(() => lap.position()).toBe(3)
        if (deed !== 'clone') return
        const clone = new Figure(page, '#lap >> nth=1')
        await clone.live()
        await expect(clone.alert).toBeEmpty()
      })
    }
  })
}

test('an event says whose doing it was: the reader’s, that of playing, or the page’s', async ({ page }) => {
  await openCourse(page, '<fastslam-lap universes="2"></fastslam-lap>')
  const lap = new Figure(page, 'fastslam-lap')
  await lap.live()
  const told = await lap.element.evaluateHandle(element => {
    const told: string[] = []
    for (const type of ['fastslam-step', 'fastslam-change']) {
      element.addEventListener(type, event => told.push(`${type.slice(9)} by ${(event as CustomEvent<{ by: string }>).detail.by}`))
    }
    return told
  })
  const expectTold = (what: string, act: Promise<unknown>) => act.then(() => expect.poll(() => told.evaluate(lines => lines.splice(0)[0])).toBe(what))
  const byPage = (act: (figure: FigureElement) => void) => lap.element.evaluate(act as never)
  await expectTold('step by reader', lap.step.click())
  await expectTold('step by page', byPage(figure => figure.step()))
  await expectTold('step by reader', lap.scrub.press('ArrowRight'))
  await expectTold('change by page', byPage(figure => figure.setAttribute('universes', '3')))
  await expectTold('change by reader', lap.reroll.click())
  await expectTold('change by page', page.evaluate(() => (location.hash = 'fastslam-lap?step=7')))
  await lap.settled()
  await told.evaluate(lines => lines.splice(0)) // and the step that the link led to
  await expectTold('step by playback', lap.play.click())
})
