// Servers that the clients bring: started for a test, found by their port, ended with it.
import { spawn } from 'node:child_process'
import { createServer } from 'node:net'

export const freePort = (): Promise<number> =>
  new Promise((found, fail) => {
    const server = createServer()
    server.on('error', fail)
    server.listen(0, '127.0.0.1', () => {
      const { port } = server.address() as { port: number }
      server.close(() => found(port))
    })
  })

/** Starts a program and waits until its address answers. Returns what ends it. */
export async function serve(command: string, args: string[], cwd: string, url: string): Promise<() => Promise<void>> {
  let said = ''
  // A group of its own, so that what it starts ends with it.
  const child = spawn(command, args, { cwd, detached: true, stdio: ['ignore', 'pipe', 'pipe'] })
  child.stdout.on('data', chunk => (said += chunk))
  child.stderr.on('data', chunk => (said += chunk))
  const ended = new Promise<void>(done => child.on('close', () => done()))
  const end = async () => {
    if (child.exitCode === null) process.kill(-child.pid!, 'SIGTERM')
    await ended
  }
  for (let tries = 0; tries < 240; tries++) {
    if (child.exitCode !== null) throw new Error(`${command} ended:\n${said}`)
    if (await fetch(url).then(answer => answer.status < 500, () => false)) return end
    await new Promise(later => setTimeout(later, 500))
  }
  await end()
  throw new Error(`${command} does not answer at ${url}:\n${said}`)
}
