// No text around a picture is cut: in the state of any chip, in any language, as wide as any page has it, on a projector. The texts of the
// pictures themselves are held to it natively (widgets/tests/all/whole.rs).
import type { Locator } from '@playwright/test'
import { programs } from '../../scripts/registry.mjs'
import { expect, test } from './fixtures'
import { breadth, openCourse } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

/** Of phones, a column, a laptop and a large screen [px]. */
const WIDTHS = [352, 832, 1318, 1872]
const PROJECTOR = { width: 900, height: 560 }

/** Texts that do not fit into what they stand in, and those that run out of the figure. */
const cut = (figure: Locator): Promise<string[]> =>
  figure.evaluate(element => {
    const root = element.shadowRoot!
    const { left, right } = root.querySelector('.figure')!.getBoundingClientRect()
    const shown = (one: Element) => one.checkVisibility({ visibilityProperty: true }) && !one.closest('.hidden') && getComputedStyle(one).clipPath === 'none' && one.getBoundingClientRect().width > 0
    const texts = [...root.querySelectorAll<HTMLElement>('.title, .status, .chip, .verdict span, .sentence, .name, .flag, .toggle, .lab, .to-wheel, .work button, summary, dt, dd, .unit, .said, .position, .source *')]
    const wrong: string[] = []
    for (const text of texts.filter(shown)) {
      const words = text.textContent!.trim()
      if (!words) continue
      const clips = getComputedStyle(text).overflow !== 'visible'
      const [over, below] = [text.scrollWidth - text.clientWidth, text.scrollHeight - text.clientHeight]
      if (text.clientWidth > 0 && (over > 1 || (clips && below > 1))) wrong.push(`“${words}” takes ${over} px too much, and ${below} px below`)
      const range = document.createRange()
      range.selectNodeContents(text)
      const { left: from, right: to } = range.getBoundingClientRect()
      // The row of chips scrolls.
      if (!text.closest('.chips') && (from < left - 1 || to > right + 1)) wrong.push(`“${words}” runs out of the figure`)
    }
    // What is picked in a list is whole.
    const pen = document.createElement('canvas').getContext('2d')!
    for (const list of [...root.querySelectorAll('select')].filter(shown)) {
      const { font, paddingLeft, paddingRight } = getComputedStyle(list)
      pen.font = font
      const words = list.selectedOptions[0]?.text ?? ''
      const over = pen.measureText(words).width - (list.clientWidth - parseFloat(paddingLeft) - parseFloat(paddingRight))
      if (over > 1) wrong.push(`“${words}” in a list takes ${Math.ceil(over)} px too much`)
    }
    return wrong
  })

for (const tag of programs.keys()) {
  test(`no text of ${tag} is cut in any state, language and width`, tag === 'fastslam-proposal' ? {} : breadth, async ({ page }) => {
    test.slow()
    const wrong = new Set<string>()
    await openCourse(page, `<${tag} lab="open"></${tag}>`)
    const figure = page.locator(tag)
    await expect(figure.locator(tag === 'fastslam-log' ? '.idle' : '.stage.live')).toBeVisible()
    const chips = tag === 'fastslam-log' ? [] : await figure.locator('.chip').evaluateAll(chips => chips.map(chip => (chip as HTMLElement).dataset['challenge']!))
    for (const lang of ['en', 'de']) {
      await page.setViewportSize({ width: 1366, height: 650 })
      await figure.evaluate((element, lang) => element.setAttribute('lang', lang), lang)
      for (const chip of ['', ...chips]) {
        await figure.evaluate(async (element, chip) => {
          const figure = element as HTMLElement & { challenge(name: string): Promise<boolean>; settled(): Promise<void> }
          if (chip) await figure.challenge(chip)
          if (figure.localName !== 'fastslam-log') await figure.settled()
        }, chip)
        const look = async (where: string) => {
          await figure.evaluate(async () => {
            for (let i = 0; i < 3; i++) await new Promise(requestAnimationFrame)
          })
          for (const one of await cut(figure)) wrong.add(`${lang} ${chip || 'opening'} ${where}: ${one}`)
        }
        for (const width of WIDTHS) {
          await page.setViewportSize({ width: width + 16, height: 800 })
          await look(`${width} px`)
        }
        await page.setViewportSize(PROJECTOR)
        await figure.evaluate(element => element.setAttribute('size', 'presentation'))
        await look('projector')
        await figure.evaluate(element => element.removeAttribute('size'))
      }
    }
    expect([...wrong].join('\n')).toBe('')
  })
}
