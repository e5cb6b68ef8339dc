// Bags of ROS in the figure that maps logs: dropped or chosen, read by a program that is loaded then, mapped to the same bits as the CARMEN log
// that says the same, and refused in words. The same program reads lines of JSON.
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import { gzipSync } from 'node:zlib'
import { root } from '../../scripts/lib.mjs'
import { expect, test } from './fixtures'
import { LogFigure } from './log-figure'

const file = (name: string) => readFileSync(join(root, 'tests', 'bags', name))

/** The fingerprint of what is mapped of a file. */
async function fingerprint(log: LogFigure, name: string, content: Buffer): Promise<string> {
  await log.choose(name, content)
  await expect(log.status).toHaveText(name)
  await expect(log.sentence).toContainText('30 scans')
  await log.button('Map this building').click()
  await log.done()
  await expect(log.readout('digest')).toHaveText(/^[0-9a-f]{16}$/)
  return (await log.readout('digest').textContent())!
}

test('bags are mapped as the CARMEN log that says the same, by a program that is fetched for the first of them, and nothing leaves the machine', async ({ page }) => {
  const log = await new LogFigure(page).open()
  const asked: string[] = []
  page.on('request', request => request.url().startsWith('blob:') || asked.push(`${request.method()} ${request.url().replace(/.*\//, '')}`))
  await log.set('universes', '2')
  const expected = await fingerprint(log, 'lap.clf', file('lap.clf'))
  expect(asked).toEqual([])
  for (const name of ['odometry-zstd.mcap', 'tf-lz4.mcap', 'plain.bag', 'lz4.bag', 'bz2.bag']) {
    expect(await fingerprint(log, name, file(name)), name).toBe(expected)
  }
  expect(await fingerprint(log, 'packed.mcap.gz', gzipSync(file('tf-lz4.mcap')))).toBe(expected)
  expect(asked).toEqual([expect.stringMatching(/^GET fastslam-files.*\.wasm$/)])
})

test('the path is saved as MCAP, byte by byte as the command saves it, by a program that is fetched then', async ({ page, complaints }) => {
  const log = await new LogFigure(page).open()
  const asked: string[] = []
  await page.route(/fastslam-files.*\.wasm$/, async route => {
    asked.push(route.request().url())
    if (asked.length === 1) await route.abort()
    else await route.continue()
  })
  await log.set('universes', '3') // as the command's test has it, which keeps the file
  await fingerprint(log, 'lap.clf', file('lap.clf'))
  await log.unfold('saves')
  const save = log.button('Path for ROS 2 (MCAP)')
  await save.click()
  await expect(log.alert).toContainText('path.mcap cannot be saved: ')
  expect(complaints.splice(0)).toEqual([expect.stringContaining('ERR_FAILED')])
  const [download] = await Promise.all([page.waitForEvent('download'), log.alert.getByRole('button', { name: 'Try again' }).click()])
  expect(download.suggestedFilename()).toBe('path.mcap')
  expect(readFileSync(await download.path()).equals(file('lap-path.mcap'))).toBe(true)
  await expect(log.alert).toBeEmpty()
  // Once is enough, also for a path that is shorter.
  await log.set('min-travel', '1')
  await log.button('Map this building').click()
  await log.done()
  const [other] = await Promise.all([page.waitForEvent('download'), save.click()])
  expect(readFileSync(await other.path()).equals(file('lap-path.mcap'))).toBe(false)
  expect(asked).toHaveLength(2)
})

test('a bag is dropped on the figure', async ({ page }) => {
  const log = await new LogFigure(page).open()
  const bytes = [...file('lz4.bag')]
  await log.stage.evaluate((stage, bytes) => {
    const dataTransfer = new DataTransfer()
    dataTransfer.items.add(new File([new Uint8Array(bytes)], 'dropped.bag'))
    for (const type of ['dragenter', 'dragover', 'drop']) stage.dispatchEvent(new DragEvent(type, { bubbles: true, cancelable: true, composed: true, dataTransfer }))
  }, bytes)
  await expect(log.status).toHaveText('dropped.bag')
  await expect(log.sentence).toContainText('30 scans of up to 120 beams')
})

test('a bag that cannot be mapped is refused in words, and one that breaks off is mapped up to there if asked', async ({ page }) => {
  const log = await new LogFigure(page).open()
  const bag = file('odometry-zstd.mcap')
  const other = Buffer.from(file('tf-lz4.mcap'))
  other.write('xz9', other.indexOf('lz4'))
  await log.choose('other.mcap', other)
  await expect(log.alert).toContainText('its chunks are compressed by “xz9”')
  await log.choose('nothing.bag', '#ROSBAG V2.0\n')
  await expect(log.alert).toContainText('nothing.bag cannot be mapped: no sensor_msgs/LaserScan in it; there is no topic at all')
  await log.choose('half.mcap', bag.subarray(0, bag.length / 2))
  await expect(log.alert).toContainText('it ends in the middle of a record')
  await log.alert.getByRole('button', { name: 'Skip malformed lines' }).click()
  await log.button('Map this building').click()
  await log.done()
})

test('where several topics have scans, the reader chooses one', async ({ page }) => {
  const log = await new LogFigure(page).open()
  await log.choose('two.mcap', file('two-lasers.mcap'))
  await expect(log.alert).toContainText('two.mcap has several topics with scans. Which one is to be mapped?')
  await log.alert.getByRole('button', { name: '/rear/scan' }).click()
  await expect(log.sentence).toContainText('3 scans of up to 60 beams')
  await expect(log.sentence).toContainText('Note: there is no odometry')
  await expect(log.alert).toBeEmpty()
})

test('lines of JSON are read by the same program, wherever they stand and however the file is called', async ({ page }) => {
  const log = await new LogFigure(page).open()
  const asked: string[] = []
  page.on('request', request => request.url().endsWith('.wasm') && asked.push(request.url().replace(/.*\//, '')))
  const lines = [1, 2].map(time => JSON.stringify({ time, angle_min: -1, angle_increment: 0.5, ranges: [1, 2, null, 2, 1] }))
  await log.choose('log.jsonl', ['1 0 0 0 0 0 0 1', '2 0.5 0 0 0 0 0 1', ...lines].join('\n'))
  await expect(log.sentence).toContainText('2 scans of up to 5 beams')
  await log.choose('packed.gz', gzipSync(`# {no scan}\n  ${lines.join('\n')}\n\t${lines[1]!.replace('"time":2', '"time":3')}\n`))
  await expect(log.sentence).toContainText('3 scans of up to 5 beams')
  await log.choose('bad.jsonl', [lines[0]!.replace('0.5', 'NaN'), ...lines].join('\n'))
  await expect(log.alert).toContainText('bad.jsonl, line 1: ')
  expect(asked).toEqual([expect.stringMatching(/^fastslam-files.*\.wasm$/)])
})

test('a log of JSON lines that is to be mapped at once is, also by a program that comes at the second try', async ({ page, complaints }) => {
  const log = await new LogFigure(page).open()
  let refused = false
  await page.route(/fastslam-files.*\.wasm$/, async route => {
    if (refused) return route.continue()
    refused = true
    await route.abort()
  })
  const text = [0, 1, 2].map(time => JSON.stringify({ time, angle_min: -1, angle_increment: 0.5, ranges: [1, 2, 3, 2, 1], odometry: [0.3 * time, 0, 0] })).join('\n')
  await log.element.evaluate((element, text) => (element as HTMLElement & { open(file: Blob, name: string, start: boolean): Promise<void> }).open(new Blob([text]), 'three.txt', true), text)
  await expect(log.alert).toContainText('three.txt cannot be mapped: ')
  expect(complaints.splice(0)).toEqual([expect.stringContaining('ERR_FAILED')])
  await log.alert.getByRole('button', { name: 'Try again' }).click()
  await log.done()
  await expect(log.status).toHaveText('three.txt')
})
