// npm start: sets up, builds, and serves the chapter until Ctrl-C. `-- --no-serve` stops after the build; `-- --port N` asks for a port.
import { build, dist } from './build.mjs'
import { bold, main } from './lib.mjs'
import { portFrom, startServer } from './serve.mjs'

await main(async () => {
  await build()
  if (process.argv.includes('--no-serve')) return
  const server = await startServer({ folder: dist, port: portFrom(process.argv) })
  console.log(`\n  The chapter: ${bold(server.url)}\n  Ctrl-C ends it.\n`)
})
