// Serves dist/ for as long as the tests run.
import { dist } from '../../scripts/build.mjs'
import { startServer } from '../../scripts/serve.mjs'

export default async function serve(): Promise<() => Promise<void>> {
  const server = await startServer({ folder: dist })
  process.env.FASTSLAM_URL = server.url
  return server.close
}
