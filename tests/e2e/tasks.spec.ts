// The page answers while it computes: no task of it keeps a reader waiting. A busy or slow machine must not decide what these tests say, so
// that tasks are measured in CPU time, and held to what a known piece of work takes there at the same time.
// cspell:ignore tdur
import type { Browser, Page } from '@playwright/test'
import { DRAGS } from '../../scripts/latency.mjs'
import { Figure } from './figure'
import { expect, test } from './fixtures'
import { breadth, openCourse } from './host'

const LONG = 50 // [ms], from which on browsers call a task long
const KNOWN = 0.58 // [ms] that the known piece of work takes on the machine that is meant by that, two good cores
const EVENTS = 2 // of a slider, after one that warms up the compiler

interface TraceEvent {
  name: string
  ph: string
  pid: number
  tid: number
  ts: number
  tdur?: number // [µs] of CPU time
}

/** CPU times of the page's tasks [ms], between each mark and the next. */
async function tasksOf(browser: Browser, page: Page, act: () => Promise<void>): Promise<Map<string, number[]>> {
  await browser.startTracing(page, { categories: ['-*', 'blink.user_timing', 'disabled-by-default-devtools.timeline'] })
  await act()
  const trace: TraceEvent[] = JSON.parse((await browser.stopTracing()).toString()).traceEvents
  const marks = trace.filter(({ name, ph }) => name.startsWith('tasks: ') && 'IR'.includes(ph)).sort((a, b) => a.ts - b.ts)
  const found = new Map(marks.map(({ name }) => [name.slice(7), [] as number[]]))
  for (const { name, pid, tid, ts, tdur } of trace) {
    if (name !== 'RunTask' || pid !== marks[0]!.pid || tid !== marks[0]!.tid) continue
    const mark = marks.findLast(mark => mark.ts <= ts)
    if (mark && tdur !== undefined) found.get(mark.name.slice(7))!.push(tdur / 1000)
  }
  return found
}

/** Runs in the page: before each event some tasks of the known piece of work. */
async function drag(figure: Element, { slider, from, by, events }: { slider: string; from: number; by: number; events: number }): Promise<void> {
  const { settled } = figure as HTMLElement & { settled(): Promise<void> }
  // A parameter without a slider has a box alone.
  const find = (type: string) => figure.shadowRoot!.querySelector<HTMLInputElement>(`input${type}[name=${slider}]`)
  const input = (find('[type=range]') ?? find(''))!
  const moves = input.type === 'range' ? 'input' : 'change'
  const numbers = new Float64Array(4096)
  const known = () => {
    for (let round = 0; round < 100; round++) for (let k = 0; k < 4096; k++) numbers[k] = Math.sqrt(numbers[(5 * k + round) & 4095]! + k) * 0.5
  }
  const task = (act: () => void) => new Promise<void>(done => setTimeout(() => (act(), done())))
  for (let event = -1; event < events; event++) {
    performance.mark('tasks: known')
    for (let k = 0; k < 4; k++) await task(known)
    performance.mark(event < 0 ? 'tasks: warming up' : `tasks: event ${event}`)
    input.value = String(from + (event + 2) * by)
    await task(() => input.dispatchEvent(new Event(moves, { bubbles: true, composed: true })))
    await settled.call(figure)
  }
}

for (const { what, tag, attributes, slider, from, by, file } of DRAGS) {
  test(`no task of the page is long while a slider is dragged: ${what}`, breadth, async ({ browser, page }) => {
    const written = Object.entries(attributes).map(([name, value]) => ` ${name}="${value}"`)
    await openCourse(page, `<${tag}${written.join('')}></${tag}>`)
    const figure = new Figure(page, tag)
    if (file) await figure.element.locator('input[type=file]').setInputFiles(file)
    await figure.live()
    const tasks = await tasksOf(browser, page, () => figure.element.evaluate(drag, { slider, from, by, events: EVENTS }))
    // Among them are empty ones, of the browser's own.
    const known = tasks.get('known')!.filter(time => time > 0.5 * KNOWN).sort((a, b) => a - b)
    const slowness = Math.max(1, known[known.length >> 1]! / KNOWN)
    const longest = [...tasks].filter(([mark]) => mark.startsWith('event')).map(([, times]) => Math.max(...times))
    expect(longest).toHaveLength(EVENTS)
    const told = `longest tasks of ${longest.map(time => time.toFixed(0)).join(', ')} ms of CPU time, on a machine ${slowness.toFixed(2)} times as slow`
    test.info().annotations.push({ type: 'tasks', description: told })
    expect(Math.max(...longest) / slowness, told).toBeLessThan(LONG)
  })
}

test('a slice of work ends when its time is over, however long each step of it takes', breadth, async ({ page }) => {
  await openCourse(page, '<fastslam-em></fastslam-em>')
  const figure = new Figure(page, 'fastslam-em')
  await figure.live()
  const most = await figure.element.evaluate(async figure => {
    // A clock by which each step of the work takes 3 ms: it goes on by so much whenever somebody looks.
    let [now, looks, most] = [performance.now(), 0, 0]
    performance.now = () => ((looks += 1), (now += 3))
    // What a figure yields by, before each slice: in between lies one, and at the most that of a frame.
    const { MessageChannel } = window
    window.MessageChannel = class extends MessageChannel {
      constructor() {
        super()
        ;[most, looks] = [Math.max(most, looks), 0]
      }
    }
    const slider = figure.shadowRoot!.querySelector<HTMLInputElement>('input[type=range][name=odometry]')!
    slider.value = '0.1'
    slider.dispatchEvent(new Event('input', { bubbles: true, composed: true }))
    await (figure as HTMLElement & { settled(): Promise<void> }).settled()
    return most
  })
  expect(most, 'looks at the clock').toBeGreaterThan(3)
  expect(most, 'looks at the clock').toBeLessThan(18)
})

test('the chapter asks for no style while a figure is made, and for the sizes of all figures before it changes one', breadth, async ({ page }) => {
  await page.addInitScript(() => {
    const seen = Object.assign(window, { seen: { made: 0, styles: 0, changes: 0, sizes: 0 } }).seen
    let makes = false
    const { define } = customElements
    customElements.define = (...given) => {
      makes = true
      define.apply(customElements, given)
      makes = false
      seen.made += document.querySelectorAll(given[0]).length
    }
    const { getComputedStyle } = window
    window.getComputedStyle = (...given) => {
      if (makes) seen.styles += 1
      return getComputedStyle(...given)
    }
    // Each size that is asked for after a change lays the page out.
    let changed = false
    const { add } = DOMTokenList.prototype
    DOMTokenList.prototype.add = function (...names) {
      if (names.includes('reserved')) changed = Boolean((seen.changes += 1))
      add.apply(this, names)
    }
    const { get } = Object.getOwnPropertyDescriptor(Element.prototype, 'clientWidth')!
    Object.defineProperty(Element.prototype, 'clientWidth', {
      configurable: true,
      get(this: Element) {
        if (changed && this.localName.startsWith('fastslam-')) changed = !(seen.sizes += 1)
        return get!.call(this)
      },
    })
  })
  await new Figure(page, 'fastslam-lap').open()
  const { made, styles, changes, sizes } = await page.evaluate(() => (window as unknown as { seen: Record<string, number> }).seen)
  expect([made! >= 12, changes! >= 12], `${made} figures, ${changes} changes`).toEqual([true, true])
  expect([styles, sizes! <= 2], `${sizes} sizes asked for after a change`).toEqual([0, true])
})
