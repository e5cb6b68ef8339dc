// Servers that tests start: found by their port, ended with the test.
import { spawn } from 'node:child_process'
import { createServer } from 'node:net'

/** @returns {Promise<number>} */
export const freePort = () =>
  new Promise((found, fail) => {
    const server = createServer()
    server.on('error', fail)
    server.listen(0, '127.0.0.1', () => {
      const { port } = /** @type {import('node:net').AddressInfo} */ (server.address())
      server.close(() => found(port))
    })
  })

/**
 * Starts a program and waits until its address answers. Returns what ends it.
 * @param {string} command
 * @param {string[]} args
 * @param {string} cwd
 * @param {string} url
 * @param {Record<string, string>} [env] besides the variables of this process
 * @returns {Promise<() => Promise<void>>}
 */
export async function serve(command, args, cwd, url, env = {}) {
  let said = ''
  // A group of its own, so that what it starts ends with it.
  const child = spawn(command, args, { cwd, env: { ...process.env, ...env }, detached: true, stdio: ['ignore', 'pipe', 'pipe'] })
  child.stdout.on('data', chunk => (said += chunk))
  child.stderr.on('data', chunk => (said += chunk))
  const ended = new Promise(done => child.on('close', done).on('error', done))
  const runs = () => child.pid !== undefined && child.exitCode === null && child.signalCode === null
  const kill = () => void (runs() && process.kill(-(/** @type {number} */ (child.pid)), 'SIGTERM'))
  process.once('exit', kill)
  const end = async () => {
    kill()
    process.off('exit', kill)
    await ended
  }
  for (let tries = 0; tries < 600; tries++) {
    if (!runs()) throw new Error(`${command} ended:\n${said}`)
    if (await fetch(url).then(answer => answer.status < 500, () => false)) return end
    await new Promise(later => setTimeout(later, 200))
  }
  await end()
  throw new Error(`${command} does not answer at ${url}:\n${said}`)
}
