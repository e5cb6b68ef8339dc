// The worker's half of the figure that maps a log: reads the file, runs the filter, paints. The page only shows what it is told.
import init, { Figure } from '../pkg/fastslam_widgets.js'
import { isRefusal, panicMessage, type ParamSpec, type Readout } from './engine'

/** What the page asks for. */
export type Ask =
  | { ask: 'begin'; program: WebAssembly.Module; tag: string; query: string }
  | { ask: 'load'; query: string }
  | { ask: 'set'; name: string; value: string }
  | { ask: 'open'; file: Blob; name: string; start: boolean }
  | { ask: 'run' | 'pause' | 'stop' | 'fit' }
  | { ask: 'size'; css: number; device: number; theme: string }
  | { ask: 'zoom'; factor: number; x: number; y: number }
  | { ask: 'pan'; right: number; down: number }
  | { ask: 'save'; what: Save }

export type Save = 'map.png' | 'map.ros' | 'path.tum' | 'report.json'

/** How far things are. */
export type Phase = 'empty' | 'ready' | 'running' | 'paused' | 'stopped' | 'done'

/** Everything there is to show. */
export interface Shown {
  phase: Phase
  log: string
  step: number
  last: number
  /** [s] until the end, at the pace so far. */
  left: number
  /** Messages of the page that had been answered. */
  asks: number
  specs: ParamSpec[]
  values: Record<string, string>
  query: string
  readouts: Readout[]
  sentence: string
  /** What keeps it from being started: the parameter, and a line. */
  unfit: [string, string] | undefined
  picture: { pixels: ArrayBuffer; width: number; height: number; cssHeight: number } | undefined
}

export type Told =
  | { told: 'shown'; shown: Shown }
  | { told: 'refused'; parameter: string; message: string; file?: string }
  | { told: 'reading'; megabytes: number }
  | { told: 'saved'; name: string; data: Blob }
  | { told: 'failed'; message: string }

const SLICE = 12 // [ms] of mapping between two looks at what the page asks
const PICTURE = 100 // [ms] between two pictures of a log under way …
const SHARE = 4 // … and at least so many times as long as it took to paint one
const MOST_BYTES = 256e6 // of a log, unpacked
const MAX_PIXELS = 6e6 // a canvas beyond this is painted coarser
const NEVER = 0xffffffff

let figure: Figure
let memory: WebAssembly.Memory
let phase: Phase = 'empty'
let log = ''
let size: { css: number; device: number; theme: string } | undefined
let spent = 0 // [ms] of mapping
let asks = 0
let mustShow = false
let looping = false
let dead = false

const tell = (told: Told, transfer: Transferable[] = []) => postMessage(told, { transfer })

/** One thing after the other: reading a file takes a while. */
let before = Promise.resolve()

export function answer(ask: Ask): void {
  before = before
    .then(() => attempt(() => answered(ask), ask.ask === 'open' ? ask.name : undefined))
    .then(() => {
      asks += 1
      show()
    })
}

/** Refusals are told, those of a file with its name; anything else has killed the program. */
async function attempt(action: () => void | Promise<void>, file?: string): Promise<void> {
  if (dead) return
  try {
    await action()
  } catch (error) {
    if (isRefusal(error)) return tell({ told: 'refused', parameter: error.parameter, message: error.message, ...(file !== undefined && { file }) })
    dead = true
    tell({ told: 'failed', message: panicMessage(error) })
  }
}

async function answered(ask: Ask): Promise<void> {
  switch (ask.ask) {
    case 'begin':
      memory = (await init({ module_or_path: ask.program })).memory
      figure = new Figure(ask.tag)
      return load(ask.query)
    case 'load':
      return load(ask.query)
    case 'set':
      figure.set(ask.name, ask.value)
      return settled()
    case 'open':
      await open(ask.file, ask.name)
      if (ask.start) run()
      return
    case 'run':
      return run()
    case 'pause':
      if (phase === 'running') phase = 'paused'
      return
    case 'stop':
      if (phase === 'running' || phase === 'paused') phase = 'stopped'
      return
    case 'fit':
      return figure.fit()
    case 'size':
      size = ask
      return
    case 'zoom':
      return figure.zoom(ask.factor, ask.x, ask.y, size?.css ?? 1)
    case 'pan':
      return figure.pan(ask.right, ask.down, size?.css ?? 1)
    case 'save':
      return save(ask.what)
  }
}

function load(query: string): void {
  const refused = figure.load(query).join('\n')
  settled()
  tell({ told: 'refused', parameter: 'link', message: refused })
}

/** Other settings begin anew. */
function settled(): void {
  if (phase !== 'empty' && figure.step() === 0) phase = 'ready'
}

function run(): void {
  if (phase === 'empty' || phase === 'running') return
  if (phase !== 'paused') {
    if (unfit()) return // it says why
    figure.seek(0)
    spent = 0
  }
  figure.seek(NEVER)
  phase = 'running'
  void loop()
}

function unfit(): [string, string] | undefined {
  try {
    figure.ready()
    return undefined
  } catch (error) {
    if (isRefusal(error)) return [error.parameter, error.message]
    throw error
  }
}

/** Maps, a slice at a time, as long as the page does not ask for anything else. */
async function loop(): Promise<void> {
  if (looping) return
  looping = true
  let next = 0
  await attempt(async () => {
    while (phase === 'running') {
      const from = performance.now()
      do figure.work()
      while (figure.pending() > 0 && performance.now() < from + SLICE)
      const now = performance.now()
      spent += now - from
      if (figure.pending() === 0) phase = 'done'
      if (phase === 'done' || now >= next) {
        show()
        await showing
        const painted = performance.now()
        next = painted + Math.max(PICTURE, SHARE * (painted - now))
      }
      await breath()
    }
  })
  looping = false
}

/** Lets messages come in. */
function breath(): Promise<void> {
  return new Promise(done => {
    const { port1, port2 } = new MessageChannel()
    port1.onmessage = () => {
      port1.close()
      done()
    }
    port2.postMessage(0)
  })
}

/** A picture soon: one for all that was asked by then. */
let showing = Promise.resolve()

function show(): void {
  if (mustShow || dead) return
  mustShow = true
  showing = breath().then(() =>
    attempt(() => {
      mustShow = false
      const step = figure.step()
      const last = figure.step_count()
      const picture = paint()
      const shown: Shown = {
        phase,
        log,
        step,
        last,
        asks,
        left: step > 0 ? ((spent / step) * (last - step)) / 1000 : NaN,
        specs: figure.params() as ParamSpec[],
        values: figure.values() as Record<string, string>,
        query: figure.query(),
        readouts: figure.readouts() as Readout[],
        sentence: figure.describe(),
        unfit: phase === 'ready' ? unfit() : undefined,
        picture,
      }
      tell({ told: 'shown', shown }, picture ? [picture.pixels] : [])
    }),
  )
}

function paint(): Shown['picture'] {
  if (!size || !(size.css > 0)) return undefined
  const cssHeight = Math.round(figure.height(size.css))
  const shrink = Math.min(1, Math.sqrt(MAX_PIXELS / (size.device * size.device * (cssHeight / size.css))))
  const width = Math.floor(size.device * shrink)
  const dpr = width / size.css
  const height = Math.round(cssHeight * dpr)
  figure.paint(width, height, dpr, size.theme)
  // A copy: the memory is the program's, and the next call may move it.
  return { pixels: memory.buffer.slice(figure.pixels(), figure.pixels() + 4 * width * height), width, height, cssHeight }
}

async function open(file: Blob, name: string): Promise<void> {
  phase = phase === 'running' ? 'paused' : phase // the log before stays until this one is read
  const bytes = await unpacked(file)
  figure.open(bytes)
  log = name
  phase = 'ready'
}

/** Compressed or not: told by the first two bytes, as servers may unpack what is called .gz. */
async function unpacked(file: Blob): Promise<Uint8Array> {
  const [first, second] = new Uint8Array(await file.slice(0, 2).arrayBuffer())
  const packed = first === 0x1f && second === 0x8b
  const stream = packed ? file.stream().pipeThrough(new DecompressionStream('gzip')) : file.stream()
  const parts: Uint8Array<ArrayBuffer>[] = []
  let length = 0
  let toldAt = 0
  try {
    for (const reader = stream.getReader(); ; ) {
      const { done, value } = await reader.read()
      if (done) break
      parts.push(value)
      length += value.length
      if (length > MOST_BYTES) {
        void reader.cancel()
        throw refusal(`it is too large: at most ${MOST_BYTES / 1e6} MB can be read${packed ? ', unpacked' : ''}`)
      }
      if (length > toldAt + 8e6) {
        toldAt = length
        tell({ told: 'reading', megabytes: Math.round(length / 1e6) })
      }
    }
  } catch (error) {
    if (isRefusal(error)) throw error
    throw refusal(packed ? 'it begins like a gzip file, but cannot be unpacked' : 'the browser could not read it')
  }
  return new Uint8Array(await new Blob(parts).arrayBuffer())
}

function refusal(message: string): Error {
  return Object.assign(new Error(message), { parameter: 'file' })
}

async function save(what: Save): Promise<void> {
  const saved = (name: string, data: BlobPart, type: string) => tell({ told: 'saved', name, data: new Blob([data], { type }) })
  const file = (name: string) => figure.file(name) as Uint8Array<ArrayBuffer> | undefined
  if (what === 'report.json') return saved(what, report(), 'application/json')
  if (what === 'map.png') {
    const png = await picture(file('map.pgm'))
    return png && saved(what, png, 'image/png')
  }
  for (const name of what === 'map.ros' ? ['map.pgm', 'map.yaml'] : [what]) {
    const bytes = file(name)
    if (bytes) saved(name, bytes, 'application/octet-stream')
  }
}

/** What was set and what came out, and every step. */
function report(): string {
  const readouts = (figure.readouts() as Readout[]).map(({ name, value, text, unit }) => [name, { value, text, unit }])
  const { figure: tag, query, columns, steps } = JSON.parse(figure.json()) as Record<string, unknown>
  const results = Object.fromEntries(readouts) as Record<string, unknown>
  const seconds = Math.round(spent) / 1000
  return JSON.stringify({ figure: tag, log, query, settings: figure.values() as unknown, seconds, results, columns, steps }, null, 1)
}

/** The same greys as the PGM file holds behind its three lines, a pixel for each cell. */
async function picture(pgm: Uint8Array | undefined): Promise<Blob | undefined> {
  if (!pgm) return undefined
  const [, width, height] = /^P5\n(\d+) (\d+)\n255\n/.exec(new TextDecoder().decode(pgm.subarray(0, 40)))!.map(Number) as [number, number, number]
  const grey = pgm.subarray(pgm.length - width * height)
  const image = new ImageData(width, height)
  new Uint32Array(image.data.buffer).set(Uint32Array.from(grey, shade => 0xff000000 | (shade * 0x010101)))
  const canvas = new OffscreenCanvas(width, height)
  canvas.getContext('2d')!.putImageData(image, 0, 0)
  return canvas.convertToBlob().catch(() => {
    throw refusal(`a map of ${width} × ${height} cells is too large for a picture`)
  })
}
