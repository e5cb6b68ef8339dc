// The session of a figure that maps a log: it also reads the file, starts and pauses, goes back through what is mapped, and saves it.
import { createShell } from './generated/shell'
import type { Command, Errand, Frame, Phase, Run, Topics } from './host'
import type { Key } from './words'
import { Session } from './session'

const MOST_BYTES = 256e6 // of a log, unpacked
const LAST = Infinity // a step beyond every log's last

export class LogSession extends Session {
  #phase: Phase = 'empty'
  #log = ''
  #reading = 0 // files that are on their way
  #spent = 0 // [ms] of mapping
  #messages = '' // of the language that is spoken, for the program
  #mapped = false // anything, when it was looked at last

  protected override perform(command: Command): void | Promise<void> {
    switch (command.do) {
      case 'begin':
      case 'link':
        this.#atNewest(() => this.act(command))
        return this.#beginAnew()
      case 'set':
        // Nothing is compared: what is set is mapped only when the reader says so.
        if (this.#atNewest(() => this.act({ ...command, on: false }))) this.#beginAnew()
        return
      case 'seek':
        return this.#halted ? super.perform(command) : undefined
      case 'words':
        this.#messages = command.value ?? ''
        return super.perform(command)
      case 'open':
        return this.#open(command)
      case 'run':
        return this.#start()
      case 'pause':
        if (this.#phase === 'running') this.#phase = 'paused'
        return
      case 'save':
        return this.#save(command)
      default:
        return super.perform(command)
    }
  }

  /** Other settings begin the mapping anew. */
  #beginAnew(): void {
    if (!this.#mapped && this.#phase !== 'empty') this.#phase = 'ready'
  }

  /** Whether there is something to go back through, and nothing is added to it now. */
  get #halted(): boolean {
    return this.#phase === 'paused' || this.#phase === 'done'
  }

  /** Does something where the mapping stands, whichever scan is shown; then that one is shown again. */
  #atNewest<T>(act: () => T): T {
    const shown = this.state.step
    if (this.#halted) this.act({ do: 'seek', at: [LAST] })
    const result = act()
    this.#mapped = this.state.step > 0
    if (this.#halted && this.#mapped) this.act({ do: 'seek', at: [shown] })
    return result
  }

  override frame(ahead?: boolean): Frame {
    const frame = super.frame(ahead)
    return { ...frame, target: frame.step } // the next one of which something was kept
  }

  override get pending(): boolean {
    return this.#phase === 'running'
  }

  override work(): void {
    const from = performance.now()
    if (super.pending) super.work()
    this.#spent += performance.now() - from
    if (!super.pending) this.#phase = 'done'
  }

  protected override run(): Run {
    const { step, last, unfit } = this.state
    const left = step > 0 ? ((this.#spent / step) * (last - step)) / 1000 : NaN
    return { phase: this.#phase, log: this.#log, reading: this.#reading > 0, left, unfit: this.#phase === 'ready' && unfit ? [unfit.parameter, unfit.message] : undefined }
  }

  #start(): void {
    if (this.#phase !== 'ready' && this.#phase !== 'paused') return
    if (this.#phase === 'ready') {
      if (this.state.unfit) return // it says why
      this.#spent = 0
    }
    this.act({ do: 'seek', at: [LAST] })
    this.#phase = 'running'
  }

  async #open({ file, name, start, topics, format, decoder }: Extract<Errand, { do: 'open' }>): Promise<void> {
    if (this.#phase === 'running') this.#phase = 'paused' // the log before stays until this one is read
    this.#reading++
    const reading = (megabytes: number) => this.tell({ told: 'reading', megabytes })
    try {
      const log = format === 'bag' ? await this.#bag(file, decoder!, topics, reading) : await unpacked(file, reading)
      if (!log) return
      if (format === 'carmen' && hasJson(log)) return this.tell({ told: 'json', start })
      const read = format === 'json' ? (await createShell(decoder!)).read_text(log, this.#messages) : log
      this.ask(figure => (format === 'carmen' ? figure.open(log) : figure.take(read)))
    } catch (error) {
      return this.refuse(error, name)
    } finally {
      this.#reading--
    }
    this.#log = name
    this.#phase = 'ready'
    if (start) this.#start()
  }

  /** What is in a bag, as the figure takes it, by a program of its own, which goes when it is done; nothing where the reader has to choose a topic first. */
  async #bag(file: Blob, decoder: WebAssembly.Module, topics: Topics, reading: (megabytes: number) => void): Promise<Uint8Array | undefined> {
    const { Bag } = await createShell(decoder)
    const bag = new Bag(topics.scan, topics.odometry, this.#messages)
    for await (const piece of pieces(file, Infinity, reading)) bag.push(piece)
    const [what, ...choice] = bag.choice()
    if (what) {
      this.tell({ told: 'choose', what: what as 'scan' | 'odometry', topics: choice })
      return undefined
    }
    const bytes = bag.finish()
    if (bytes.length > MOST_BYTES) throw refusal('too_large_unpacked', { megabytes: MOST_BYTES / 1e6 })
    return bytes
  }

  async #save({ what, writer }: Extract<Errand, { do: 'save' }>): Promise<void> {
    const saved = (name: string, data: BlobPart, type = 'application/octet-stream') => this.tell({ told: 'saved', name, data: new Blob([data], { type }) })
    const file = (name: string) => this.figure.file(name) as Uint8Array<ArrayBuffer> | undefined
    if (what === 'report.json') return saved(what, this.#atNewest(() => this.#report()), 'application/json')
    if (what === 'map.png') {
      const png = await picture(file('map.pgm'))
      return png && saved(what, png, 'image/png')
    }
    const numbers = file(what === 'map.ros' ? 'map.f64' : 'path.f64')
    if (!numbers || !writer) return
    const [shell, of] = [await createShell(writer), new Float64Array(numbers.slice().buffer)]
    if (what === 'path.mcap') return saved(what, shell.path_mcap(of) as Uint8Array<ArrayBuffer>)
    if (what === 'path.tum') return saved(what, shell.path_tum(of))
    const [cell, x, y] = of as unknown as [number, number, number]
    saved('map.pgm', file('map.pgm')!)
    saved('map.yaml', shell.map_yaml('map.pgm', cell, x, y))
  }

  /** What was set and what came out, and every step. */
  #report(): string {
    const readouts = this.frame(true).readouts.map(({ name, value, text, unit }) => [name, { value, text, unit }])
    const { figure, query, columns, steps } = this.measured
    const results = Object.fromEntries(readouts) as Record<string, unknown>
    const seconds = Math.round(this.#spent) / 1000
    return JSON.stringify({ figure, log: this.#log, query, settings: this.state.values, seconds, results, columns, steps }, null, 1)
  }
}

async function unpacked(file: Blob, reading: (megabytes: number) => void): Promise<Uint8Array> {
  const parts: Uint8Array<ArrayBuffer>[] = []
  for await (const piece of pieces(file, MOST_BYTES, reading)) parts.push(piece)
  return new Uint8Array(await new Blob(parts).arrayBuffer())
}

/** What may stand before the first word of a line: blanks, and the byte-order mark in front of a text. */
const BLANKS = [0x20, 0x09, 0x0c, 0x0d, 0xef, 0xbb, 0xbf]

/** Whether any line of a text begins as an object of JSON does. */
function hasJson(text: Uint8Array): boolean {
  for (let at = text.indexOf(0x7b); at >= 0; at = text.indexOf(0x7b, at + 1)) {
    let before = at - 1
    while (BLANKS.includes(text[before]!)) before--
    if (before < 0 || text[before] === 0x0a) return true
  }
  return false
}

/** What is in a file, piece by piece. Compressed or not is told by the first two bytes, as servers may unpack what is called .gz. */
async function* pieces(file: Blob, most: number, reading: (megabytes: number) => void): AsyncGenerator<Uint8Array<ArrayBuffer>> {
  const [first, second] = new Uint8Array(await file.slice(0, 2).arrayBuffer())
  const packed = first === 0x1f && second === 0x8b
  const reader = (packed ? file.stream().pipeThrough(new DecompressionStream('gzip')) : file.stream()).getReader()
  let length = 0
  let toldAt = 0
  try {
    for (;;) {
      const { done, value } = await reader.read().catch(() => {
        throw refusal(packed ? 'bad_gzip' : 'unread')
      })
      if (done) return
      length += value.length
      if (length > most) throw refusal(packed ? 'too_large_unpacked' : 'too_large', { megabytes: most / 1e6 })
      if (length > toldAt + 8e6) {
        toldAt = length
        reading(Math.round(length / 1e6))
      }
      yield value
    }
  } finally {
    void reader.cancel().catch(() => undefined) // who has read enough, for whatever reason, lets the rest go
  }
}

function refusal(key: Key, values?: Record<string, number>): Error {
  return Object.assign(new Error(key), { parameter: 'file', told: { key, values } })
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
    throw refusal('map_too_large', { width, height })
  })
}
