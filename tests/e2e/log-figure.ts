// The figure that maps logs, as its specs handle it.
import type { Locator, Page } from '@playwright/test'
import { expect } from './fixtures'
import { openLab, settled } from './figure'
import { openAlone } from './host'

export class LogFigure {
  readonly element: Locator
  readonly alert: Locator
  readonly sentence: Locator
  readonly status: Locator
  readonly stage: Locator

  constructor(readonly page: Page) {
    this.element = page.locator('fastslam-log')
    this.alert = this.element.getByRole('alert')
    this.sentence = this.element.locator('[part=sentence]')
    this.status = this.element.getByRole('status')
    this.stage = this.element.locator('.stage')
  }

  /** Alone on a page, with a link to its settings if need be. */
  async open(link = ''): Promise<this> {
    await openAlone(this.page, 'fastslam-log', link && `#fastslam-log?${link}`)
    return this.begin(!link)
  }

  /** On a page that is open. Its program comes when something is asked of it. */
  async begin(asks = true): Promise<this> {
    if (asks) await this.stage.click()
    await expect(this.element.locator('.stage.live')).toBeVisible()
    await openLab(this.element)
    return this
  }

  button(name: string): Locator {
    return this.element.getByRole('button', { name, exact: true })
  }

  /** A reader's file. */
  async choose(name: string, content: string | Buffer): Promise<void> {
    await this.element.locator('input[type=file]').setInputFiles({ name, mimeType: '', buffer: Buffer.from(content) })
  }

  async done(timeout = 30_000): Promise<void> {
    await expect(this.sentence).toContainText('All scans are mapped', { timeout })
  }

  readout(name: string): Locator {
    return this.element.locator(`[part=readout][data-name=${name}] dd`)
  }

  async unfold(part: 'settings' | 'saves'): Promise<void> {
    const fold = this.element.locator(`details[part=${part}]`)
    if (!(await fold.evaluate((details: HTMLDetailsElement) => details.open))) await fold.locator('summary').click()
  }

  async set(name: string, value: string): Promise<void> {
    const box = this.element.locator(`input[type=number][name=${name}]`)
    if (!(await box.isVisible())) await this.unfold('settings')
    await box.fill(value)
    await box.press('Enter')
  }

  /** What the slider of scans does under a hand. */
  async scrubTo(scan: number): Promise<void> {
    await this.element.locator('[part=scrub]').evaluate((scrub: HTMLInputElement, scan) => {
      scrub.valueAsNumber = scan
      scrub.dispatchEvent(new InputEvent('input', { bubbles: true, composed: true }))
    }, scan)
  }

  /** Until what was asked for is shown. */
  async settled(): Promise<void> {
    await settled(this.element)
  }

  /** A fingerprint of the pixels. */
  async picture(): Promise<number> {
    await this.settled()
    return this.element.locator('canvas').evaluate((canvas: HTMLCanvasElement) => {
      const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d', { willReadFrequently: true })!
      copy.drawImage(canvas, 0, 0)
      const { data } = copy.getImageData(0, 0, canvas.width, canvas.height)
      let hash = 2166136261
      for (const pixel of new Uint32Array(data.buffer)) hash = Math.imul(hash ^ pixel, 16777619)
      return hash
    })
  }
}
