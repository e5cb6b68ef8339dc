// The static server of npm start, the end-to-end tests and npm run size: types, compression and headers as a good host would
// send them, the strict content security policy among them, so that what works here works on a course's server.
import { createHash } from 'node:crypto'
import { mkdir, readdir, readFile, realpath, rename, rm, stat, writeFile } from 'node:fs/promises'
import { createServer } from 'node:http'
import { dirname, extname, join, resolve, sep } from 'node:path'
import { promisify } from 'node:util'
import { brotliCompress, constants, gzip } from 'node:zlib'
import { cache, isMain, main, StepError } from './lib.mjs'
import { policy } from './policy.mjs'

/** Pages that are made for frames on other sites. */
const isFrame = (/** @type {string} */ path) => /(^|\/)(embed(-[a-z-]+)?|task)\.html$/.test(path)

/** A name with a hash of the content: all in assets/, and scripts and programs beside fastslam.js. Others only look so: custom-elements.json. @param {string} path */
export const isHashed = path => /(^|[/\\])(assets[/\\][^/\\]+|fastslam-([a-z]+-)*[\w-]{8}\.(js|wasm))$/.test(path)

/** Other sites may frame those, and no other. A course would name its learning system in place of the star. */
const frameAncestors = (/** @type {string} */ path) => `frame-ancestors ${isFrame(path) ? '*' : "'self'"}`

/** @type {Record<string, string>} */
const types = {
  '.html': 'text/html; charset=utf-8',
  '.css': 'text/css; charset=utf-8',
  '.js': 'text/javascript; charset=utf-8',
  '.mjs': 'text/javascript; charset=utf-8',
  '.json': 'application/json; charset=utf-8',
  '.map': 'application/json; charset=utf-8',
  '.txt': 'text/plain; charset=utf-8',
  '.md': 'text/markdown; charset=utf-8',
  '.svg': 'image/svg+xml; charset=utf-8',
  '.wasm': 'application/wasm',
  '.png': 'image/png',
  '.webp': 'image/webp',
  '.jpg': 'image/jpeg',
  '.ico': 'image/x-icon',
  '.woff2': 'font/woff2',
  '.ttf': 'font/ttf',
  '.otf': 'font/otf',
  '.csv': 'text/csv; charset=utf-8',
}
/** What shrinks when compressed; pictures and WOFF2 are compressed already. */
const compressible = /^text|json|svg|wasm|ttf|otf/

const encoders = {
  br: (/** @type {Buffer} */ body) =>
    promisify(brotliCompress)(body, { params: { [constants.BROTLI_PARAM_QUALITY]: 11, [constants.BROTLI_PARAM_SIZE_HINT]: body.length } }),
  gzip: (/** @type {Buffer} */ body) => promisify(gzip)(body, { level: 9 }),
}

/** Brotli takes seconds for a program: what was made of a content is kept, for the servers to come as well. */
const kept = cache('encoded')
const KEPT_FOR = 7 * 24 * 3600_000 // [ms]

/** @param {string} tag of the content @param {'br' | 'gzip'} encoding @param {Buffer} raw */
async function encode(tag, encoding, raw) {
  const path = join(kept, `${tag}.${encoding}`)
  const before = await readFile(path).catch(() => undefined)
  if (before) return before
  const body = await encoders[encoding](raw)
  // A disk that is full or may not be written only makes the next server slower.
  await keep(path, body).catch(() => {})
  return body
}

/** Under another name until it is whole: two servers may write the same. @param {string} path @param {Buffer} body */
async function keep(path, body) {
  const part = `${path}.${process.pid}.part`
  await mkdir(dirname(path), { recursive: true })
  await writeFile(part, body)
  await rename(part, path)
}

/**
 * A file as it is sent, made once by each server.
 * @param {Map<string, Promise<Buffer>>} encoded @param {Buffer} raw @param {'br' | 'gzip' | undefined} encoding
 */
function sent(encoded, raw, encoding) {
  const tag = createHash('sha256').update(raw).digest('base64url').slice(0, 22)
  const etag = `"${tag}${encoding ? `-${encoding}` : ''}"`
  const body = async () => {
    if (!encoding) return raw
    const promise = encoded.get(etag) ?? encode(tag, encoding, raw)
    encoded.set(etag, promise)
    return promise
  }
  return { etag, body }
}

async function forgetOld() {
  for (const file of await readdir(kept).catch(() => [])) {
    const path = join(kept, file)
    const found = await stat(path).catch(() => undefined)
    if (found && found.mtimeMs < Date.now() - KEPT_FOR) await rm(path, { force: true })
  }
}

/**
 * @typedef {{ path: string, status: number, raw: number, sent: number }} Served one answer: bytes of the file, bytes sent
 * @typedef {{ url: string, close: () => Promise<void>, prepare: (files: string[]) => Promise<void> }} Server `prepare` compresses files before
 *   anybody asks for them, and says of what cannot be read why: of a request that fails a client learns only that the other side closed
 */

/**
 * Serves a folder; if the port is taken, at the next free one.
 * @param {{ folder: string, port?: number, host?: string, onServed?: (served: Served) => void }} options
 * @returns {Promise<Server>}
 */
export async function startServer({ folder, port = 0, host = '127.0.0.1', onServed }) {
  const base = await realpath(folder).catch(() => {
    throw new StepError(`There is no folder ${folder} to serve.`, 'npm run build writes it.')
  })
  /** Files as sent, by content and encoding. @type {Map<string, Promise<Buffer>>} */
  const encoded = new Map()
  await forgetOld()

  const server = createServer((request, response) => {
    answer(base, encoded, request, response)
      .then(served => onServed?.(served))
      .catch(error => {
        console.error(error)
        response.destroy()
      })
  })
  for (let attempt = 0; ; attempt++) {
    const problem = await listen(server, port, host)
    if (!problem) break
    if (problem.code !== 'EADDRINUSE' || port === 0 || attempt === 50) {
      throw new StepError(`The server cannot listen at ${host}:${port}: ${problem.message}`, 'Another port: npm start -- --port 8080')
    }
    port++
  }
  const address = /** @type {import('node:net').AddressInfo} */ (server.address())
  return {
    prepare: async files => {
      await Promise.all(files.map(async file => sent(encoded, await readFile(join(base, file)), 'br').body()))
    },
    url: `http://${host === '127.0.0.1' ? 'localhost' : host}:${address.port}/`,
    close: () =>
      new Promise(done => {
        server.close(() => done())
        server.closeAllConnections()
      }),
  }
}

/** @param {import('node:http').Server} server @param {number} port @param {string} host */
function listen(server, port, host) {
  return new Promise((/** @type {(problem?: NodeJS.ErrnoException) => void} */ done) => {
    server.once('error', done)
    server.listen(port, host, () => {
      server.off('error', done)
      done()
    })
  })
}

/**
 * @param {string} base
 * @param {Map<string, Promise<Buffer>>} encoded
 * @param {import('node:http').IncomingMessage} request
 * @param {import('node:http').ServerResponse} response
 * @returns {Promise<Served>}
 */
async function answer(base, encoded, request, response) {
  const url = request.url ?? '/'
  const named = url.split('?')[0] ?? ''
  response.setHeader('Content-Security-Policy', `${policy}; ${frameAncestors(named)}`)
  response.setHeader('X-Content-Type-Options', 'nosniff')
  response.setHeader('Referrer-Policy', 'no-referrer')
  // A figure embedded in a sandboxed frame has an origin of its own and must still load its module.
  response.setHeader('Access-Control-Allow-Origin', '*')
  // A page that is isolated from other origins takes from them only what says that it may be taken, and frames that are isolated as well;
  // so are the scripts of their workers.
  response.setHeader('Cross-Origin-Resource-Policy', 'cross-origin')
  if (isFrame(named) || named.endsWith('.js')) response.setHeader('Cross-Origin-Embedder-Policy', 'require-corp')

  /** @param {number} status @param {string} text @param {Record<string, string>} [headers] @returns {Served} */
  const refuse = (status, text, headers = {}) => {
    response.writeHead(status, { 'Content-Type': types['.txt'], ...headers })
    response.end(request.method === 'HEAD' ? undefined : `${text}\n`)
    return { path: url, status, raw: 0, sent: 0 }
  }
  if (request.method !== 'GET' && request.method !== 'HEAD') return refuse(405, 'Only GET and HEAD.', { Allow: 'GET, HEAD' })

  const [path, ...query] = url.split('?')
  const file = await locate(base, path)
  if (file === undefined) return refuse(404, 'There is no such page.')
  if (file.folder) return refuse(308, 'See the page with a slash at its end.', { Location: [`./${path.split('/').at(-1)}/`, ...query].join('?') })

  const type = types[extname(file.path)] ?? 'application/octet-stream'
  const raw = await readFile(file.path)
  const accepted = String(request.headers['accept-encoding'] ?? '')
  const encoding = !compressible.test(type) ? undefined : /\bbr\b/.test(accepted) ? 'br' : /\bgzip\b/.test(accepted) ? 'gzip' : undefined
  const { etag, body: bodyOf } = sent(encoded, raw, encoding)
  response.setHeader('Content-Type', type)
  response.setHeader('ETag', etag)
  response.setHeader('Vary', 'Accept-Encoding')
  // Names with a hash of their content never change; the others are asked about each time.
  response.setHeader('Cache-Control', isHashed(file.path) ? 'public, max-age=31536000, immutable' : 'no-cache')
  if (request.headers['if-none-match'] === etag) {
    response.writeHead(304).end()
    return { path, status: 304, raw: raw.length, sent: 0 }
  }
  const body = await bodyOf()
  if (encoding) response.setHeader('Content-Encoding', encoding)
  response.writeHead(200, { 'Content-Length': body.length })
  response.end(request.method === 'HEAD' ? undefined : body)
  return { path, status: 200, raw: raw.length, sent: body.length }
}

/**
 * The file that a path of a URL names: never one outside of `base`, by .. or by a symbolic link, nor a hidden one.
 * @param {string} base @param {string} path
 * @returns {Promise<{ path: string, folder?: boolean } | undefined>}
 */
async function locate(base, path) {
  let decoded
  try {
    decoded = decodeURIComponent(path)
  } catch {
    return undefined
  }
  if (decoded.includes('\0') || decoded.split(/[/\\]/).some(part => part.startsWith('.'))) return undefined
  const wanted = resolve(base, `.${decoded.startsWith('/') ? '' : '/'}${decoded}`)
  try {
    const real = await realpath(wanted)
    if (real !== base && !real.startsWith(base + sep)) return undefined
    const found = await stat(real)
    if (!found.isDirectory()) return found.isFile() && !decoded.endsWith('/') ? { path: real } : undefined
    if (!decoded.endsWith('/')) return { path: real, folder: true }
    return await locate(base, `${path}index.html`)
  } catch {
    return undefined
  }
}

/** The port asked for by `--port N` or $PORT; 8017 is the chapter's own. @param {string[]} args */
export function portFrom(args) {
  const given = args.includes('--port') ? args[args.indexOf('--port') + 1] : (process.env.PORT ?? '8017')
  const port = Number(given)
  if (!Number.isInteger(port) || port < 0 || port > 65535) throw new StepError(`--port ${given}: a port is a whole number from 0 to 65535.`)
  return port
}

if (isMain(import.meta)) {
  await main(async () => {
    const named = process.argv[2]
    const folder = named && !named.startsWith('--') ? resolve(named) : join(import.meta.dirname, '..', 'dist')
    const server = await startServer({ folder, port: portFrom(process.argv) })
    console.log(`${folder}: ${server.url}`)
  })
}
