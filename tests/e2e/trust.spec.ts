// What the statement on privacy says, looked at in the browser; and that the page with it can be read by everybody.
import { brokenRules } from './axe'
import { Figure } from './figure'
import { expect, test } from './fixtures'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

test('after use there is no cookie, and in storage nothing but what the statement on privacy names', async ({ page, context }) => {
  const kept = () => page.evaluate(() => [...Object.keys(localStorage), ...Object.keys(sessionStorage)])
  await page.goto('./')
  const doors = new Figure(page, 'fastslam-doors')
  await doors.element.scrollIntoViewIfNeeded()
  await doors.live()
  await doors.element.evaluate(element => (element as HTMLElement & { challenge(name: string): Promise<boolean> }).challenge('short'))
  await doors.box('ride').fill('0.5')
  await doors.box('ride').press('Enter')
  await doors.settled()
  const question = page.locator('.predict input').first()
  await question.fill('3')
  await question.press('Enter')
  await expect.poll(kept).toContainEqual(expect.stringMatching(/^fastslam-guess:/))
  await page.goto('./embed/?figure=doors#assign')
  expect((await kept()).filter(key => !/^fastslam-(challenges$|guess:|check:)/.test(key))).toEqual([])
  expect(await context.cookies()).toEqual([])
  expect(await page.evaluate(async () => [(await indexedDB.databases()).length, (await caches.keys()).length])).toEqual([0, 0])
})

test('the page on privacy, accessibility and licences is found from the chapter’s foot, and axe finds nothing on it', async ({ page }) => {
  await page.goto('./')
  await page.getByRole('contentinfo').getByRole('link', { name: 'Privacy and accessibility' }).click()
  await expect(page.getByRole('heading', { level: 1 })).toHaveText('Privacy, accessibility and licences')
  expect(await brokenRules(page)).toEqual([])
  for (const address of await page.getByRole('link', { name: /sbom|All licences/ }).evaluateAll(links => links.map(link => (link as HTMLAnchorElement).href))) expect((await page.request.get(address)).status()).toBe(200)
})
