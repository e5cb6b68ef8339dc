// When the next step is due, without a page: its clock is the test's.
import { expect, test } from '@playwright/test'

/** A page that asks for as much motion as there is. */
const quiet = () => ({ matches: false, addEventListener: () => undefined })

// Each test may be the first of its worker.
test.beforeAll(() => void Object.assign(globalThis, { matchMedia: quiet, addEventListener: () => undefined }))

/** Steps that are due within a second of frames, from a moment at which one was. */
async function stepsIn(change: (playback: { rate: number; pace: number }) => void): Promise<number> {
  const { Playback } = await import('../../widgets/elements/playback')
  const playback = new Playback()
  playback.start()
  let now = 1000
  expect(playback.isDue(now), 'the first one is due at once').toBe(true)
  change(playback)
  let steps = 0
  for (const end = now + 4000; now <= end; now += 1000 / 60) steps += Number(playback.isDue(now))
  return steps / 4
}

test('what a figure wants slow is played slowly', async () => {
  expect(await stepsIn(() => undefined)).toBeCloseTo(6, 0)
  expect(await stepsIn(playback => (playback.pace = 0.25))).toBeCloseTo(1.5, 0)
})

test('a rate that a reader has chosen holds for every step', async () => {
  expect(await stepsIn(playback => Object.assign(playback, { rate: 12, pace: 0.25 }))).toBeCloseTo(12, 0)
})

test('a step that becomes slow is slow at once, and the one after it quick again', async () => {
  const { Playback } = await import('../../widgets/elements/playback')
  const playback = new Playback()
  playback.start()
  expect(playback.isDue(1000)).toBe(true)
  playback.pace = 0.25
  // The first step came as soon as it could, half of a usual step late.
  expect([1200, 1570].map(now => playback.isDue(now))).toEqual([false, false])
  expect(playback.isDue(1590)).toBe(true)
  playback.pace = 1
  expect([1740, 1760].map(now => playback.isDue(now))).toEqual([false, true])
})
