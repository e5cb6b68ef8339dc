// What runs beside the page, in an instance of its own of the program that the page has compiled: a job seed by seed, or the mapping of a log.
import init, { job } from '../pkg/fastslam_widgets.js'
import type { Job, Told } from './jobs'
import { answer, type Ask } from './log-work'

const tell = (told: Told) => postMessage(told)

addEventListener('message', async ({ data }: MessageEvent<(Job & { program: WebAssembly.Module }) | Ask>) => {
  if ('ask' in data) return answer(data)
  const { program, name, query, from, to } = data
  try {
    await init({ module_or_path: program })
    for (let seed = from; seed < to; seed++) tell({ rows: job(name, query, seed, seed + 1) as number[][] })
    tell({ done: true })
  } catch (error) {
    tell({ failed: error instanceof Error ? error.message : String(error) })
  }
})
