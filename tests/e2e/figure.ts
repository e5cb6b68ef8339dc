// A figure as a reader meets it: found by role and name, never by internals that a reader cannot see.
import type { Frame, Locator, Page } from '@playwright/test'
import { expect } from './fixtures'
import { openAlone } from './host'

/** Keeps the programs back that the page fetches, as a slow network does, until they are let through. */
export async function holdPrograms(page: Page): Promise<() => void> {
  let open = () => {}
  const gate = new Promise<void>(done => (open = done))
  await page.route('**/*.wasm', async route => {
    await gate
    await route.continue()
  })
  return open
}

/** Until what was asked of a figure is shown; also of one whose module is still on its way. */
export const settled = (element: Locator): Promise<void> =>
  element.evaluate(async figure => {
    await customElements.whenDefined(figure.localName)
    await (figure as HTMLElement & { settled(): Promise<void> }).settled()
  })

/** All that can be set is in sight, as after a press on *Lab*; of that, links and codes would tell (lab.spec.ts). */
export const openLab = (element: Locator): Promise<void> => element.evaluate(element => element.shadowRoot!.querySelector('.figure')!.classList.add('lab-open'))

/** The page has painted so many times: whatever was on its way has come, whatever the machine. */
export const frames = (page: Page | Frame, count: number): Promise<void> =>
  page.evaluate(async n => {
    for (let i = 0; i < n; i++) await new Promise(requestAnimationFrame)
  }, count)

/**
 * Opens the chapter's page with nothing but some of its figures in it, as its text has them: its policy, its styles and its pictures, in a
 * third of the time. `headers` may change what the host sends.
 */
export async function openChapterOf(page: Page, tags: string[], headers = (sent: Record<string, string>) => sent): Promise<void> {
  const address = new URL('./', process.env.FASTSLAM_URL).href
  await page.route(address, async route => {
    const response = await route.fetch()
    const html = await response.text()
    const figures = tags.map(tag => unfolded(new RegExp(`<figure[^>]*>\\s*<${tag}[ >][^]*?</figure>`).exec(html)![0]))
    const body = html.replace(/<figure[^>]*class="hero"[^]*?<\/figure>/, '').replace(/(?<=<main[^>]*>)[^]*(?=<\/main>)/, () => figures.join(''))
    await route.fulfill({ response, headers: headers(response.headers()), body })
  })
  await page.goto('./')
}

/** The figure that stands folded beside the title, as the others stand in the text. */
function unfolded(figure: string): string {
  const folds = / data-folds="([^"]*)"/.exec(figure)?.[1]?.split(' ') ?? []
  return folds.reduce((html, name) => html.replace(new RegExp(` ${name}="[^"]*"`), ''), figure.replace(' class="hero"', ' class="wide"'))
}

export class Figure {
  readonly element: Locator
  readonly play: Locator
  readonly pause: Locator
  readonly step: Locator
  readonly stepBack: Locator
  readonly rewind: Locator
  readonly reset: Locator
  readonly reroll: Locator
  readonly scrub: Locator
  readonly seed: Locator
  readonly alert: Locator
  /** The picture in words, for who does not see it. */
  readonly sentence: Locator
  /** The line over the picture. */
  readonly told: Locator
  readonly canvas: Locator

  constructor(
    readonly page: Page | Frame,
    private readonly tag: string,
  ) {
    this.element = page.locator(tag).and(page.locator(':not(.trial > *)')) // the exercises have copies of their own
    this.play = this.button('Play')
    this.pause = this.button('Pause')
    this.step = this.button('Step')
    this.stepBack = this.button('Step back')
    this.rewind = this.button('Rewind')
    this.reset = this.button('Reset')
    this.reroll = this.button('Re-roll the seed')
    this.scrub = this.element.getByRole('slider', { name: 'Step shown' })
    this.seed = this.element.getByRole('spinbutton', { name: 'Seed' })
    this.alert = this.element.getByRole('alert')
    this.sentence = this.element.locator('.described')
    this.told = this.element.locator('[part=sentence]')
    this.canvas = this.element.locator('[part=canvas]')
  }

  button(name: string): Locator {
    return this.element.getByRole('button', { name, exact: true })
  }

  /** The whole state, as a link has it. */
  state(): Promise<string> {
    return this.element.evaluate(element => (element as HTMLElement & { state: string }).state)
  }

  /** Goes to a state, as a link has it, in the page that is open: what a link does to a page is for other tests. */
  async goTo(state: string): Promise<void> {
    await this.element.evaluate((element, state) => ((element as HTMLElement & { state: string }).state = state), state)
    await this.settled()
  }

  /** Opens a page that has this figure and nothing else, with a link to its state if need be. */
  async alone(link = ''): Promise<this> {
    await openAlone(this.page as Page, this.tag, link)
    await this.live()
    return this
  }

  /** Opens the chapter, or what is at an address, and waits until the figure is live. */
  async open(address = './'): Promise<this> {
    await this.page.goto(address)
    await this.element.scrollIntoViewIfNeeded()
    await this.live()
    return this
  }

  /** All of it is there, also of the one that stands folded beside the title (hero.spec.ts). */
  async live(): Promise<void> {
    await expect(this.element.locator('.stage.live')).toBeVisible()
    const unfold = this.page.locator('.hero', { has: this.element }).getByRole('button', { name: 'Open this figure' })
    if ((await unfold.count()) > 0) await unfold.click()
    await openLab(this.element)
    await this.settled()
  }

  /** Until what was asked for is shown. */
  async settled(): Promise<void> {
    await settled(this.element)
  }

  async playing(): Promise<boolean> {
    return this.element.evaluate(figure => (figure as HTMLElement & { playing: boolean }).playing)
  }

  /** The step that is shown; where nothing plays, when it is the one asked for. */
  async position(): Promise<number> {
    await this.element.evaluate(async element => {
      const figure = element as HTMLElement & { playing: boolean; settled(): Promise<void> }
      if (!figure.playing) await figure.settled()
    })
    return Number((await this.element.locator('.timeline .position').textContent())!.split('/')[0])
  }

  async last(): Promise<number> {
    return Number(await this.scrub.getAttribute('max'))
  }

  /** Every readout as it is written, by name. */
  async readouts(): Promise<Record<string, string>> {
    const rows = await this.element.locator('[part=readout]').all()
    const entries = await Promise.all(
      rows.map(async row => [await row.getAttribute('data-name'), await row.locator('dd').textContent()]),
    )
    return Object.fromEntries(entries) as Record<string, string>
  }

  /** The number that a readout begins with. */
  async number(name: string): Promise<number> {
    return Number.parseFloat((await this.readouts())[name]!.replace('−', '-'))
  }

  /** A fingerprint of the pixels. */
  async picture(): Promise<number> {
    return this.canvas.evaluate((canvas: HTMLCanvasElement) => {
      // By way of a second canvas: reading the figure's own would move it off the fast path, and Chromium warns of that.
      const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d', { willReadFrequently: true })!
      copy.drawImage(canvas, 0, 0)
      const { data } = copy.getImageData(0, 0, canvas.width, canvas.height)
      let hash = 2166136261
      for (const byte of new Uint32Array(data.buffer)) hash = Math.imul(hash ^ byte, 16777619)
      return hash
    })
  }

  async scrubTo(step: number): Promise<void> {
    await this.scrub.fill(String(step))
    await this.settled()
  }

  /** Unfolds the settings that are not in sight. */
  openSettings(): Promise<void> {
    return this.#unfold('settings')
  }

  /** Unfolds the numbers. */
  openNumbers(): Promise<void> {
    return this.#unfold('numbers')
  }

  /** Unfolds the count over seeds. */
  openCount(): Promise<void> {
    return this.#unfold('count')
  }

  async #unfold(part: string): Promise<void> {
    const details = this.element.locator(`details[part=${part}]`)
    await details.waitFor({ state: 'attached' })
    await openLab(this.element)
    // Not every figure has settings that are folded away.
    const folded = await details.evaluate((details: HTMLDetailsElement) => !details.open && !details.hidden)
    if (folded) await details.locator('summary').click()
  }

  /** That a slider changes the readouts, and the value before, typed, brings them back. */
  async expectSliderAndBack(name: string): Promise<void> {
    await this.openSettings()
    const [before, value] = [await this.readouts(), await this.box(name).inputValue()]
    const slider = this.slider(name)
    await slider.scrollIntoViewIfNeeded()
    const box = (await slider.boundingBox())!
    await slider.click({ position: { x: box.width * 0.85, y: box.height / 2 } })
    await this.settled()
    expect(await this.box(name).inputValue()).not.toBe(value)
    expect(await this.readouts()).not.toEqual(before)
    await this.box(name).fill(value)
    await this.box(name).press('Enter')
    await this.settled()
    expect(await this.readouts()).toEqual(before)
  }

  async menu(item: string): Promise<void> {
    await this.element.locator('button[aria-label=Menu]').click()
    await this.element.getByRole('menuitem', { name: item }).click()
  }

  box(name: string): Locator {
    return this.element.locator(`input[type=number][name=${name}]`)
  }

  toggle(name: string): Locator {
    return this.element.locator(`button[name=${name}]`)
  }

  /** What of such a point takes the focus and is read out: its slider for the first direction. */
  grasp(name: string): Locator {
    return this.handle(name).locator('input').first()
  }

  /** What lies over a point of the picture that can be moved. */
  handle(name: string): Locator {
    return this.element.locator(`[part=handle][data-name=${name}]`)
  }

  slider(name: string): Locator {
    return this.element.locator(`input[type=range][name=${name}]`)
  }
}
