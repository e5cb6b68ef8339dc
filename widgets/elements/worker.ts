// What runs beside the page, in an instance of its own of the program that the page has compiled: experiments, seed by seed, and the
// sessions of figures that would keep the page waiting.
import type { PartnerRequest, WorkerRequest, WorkerResponse } from './host'
import { createShell } from './generated/shell'
import { LogSession } from './log-session'
import { trapMessage, type Shell, type ShellFigure } from './shell'
import { Session } from './session'
import { yieldToMain } from './yield'

const SLICE = 12 // [ms] of work between two looks at what the page asks
const PICTURE = 100 // [ms] between two pictures of work under way …
const SHARE = 4 // … and at least so many times as long as it took to paint one

let shell: Shell | undefined
let session: Session | undefined
let partner: { figure: ShellFigure; run: number; part: Float64Array } | undefined
let dead = false
let working = false
let willShow: Promise<void> | undefined

const tell = (answer: WorkerResponse, transfer: Transferable[] = []) => postMessage(answer, { transfer })

/** One thing after the other: reading a file takes a while. */
let before = Promise.resolve()

addEventListener('message', ({ data }: MessageEvent<WorkerRequest>) => {
  before = before.then(() => attempt(() => carryOut(data)))
})

/** Anything that is thrown has killed the program. */
async function attempt(action: () => void | Promise<void>): Promise<void> {
  if (dead) return
  try {
    await action()
  } catch (error) {
    dead = true
    tell({ told: 'failed', why: trapMessage(error, shell), error: String(error) })
  }
}

async function carryOut(request: WorkerRequest): Promise<void> {
  if (request.do === 'job') return run(request)
  if (request.do === 'figure') {
    shell = await createShell(request.module)
    session = new (request.tag === 'fastslam-log' ? LogSession : Session)(shell, request.tag, tell)
    return
  }
  if (request.do === 'partner' || request.do === 'begin-part' || request.do === 'part') return takePart(request)
  await session!.do(request)
  void show()
  void work()
}

async function run({ module, job: { name, query, from, to }, every }: Extract<WorkerRequest, { do: 'job' }>): Promise<void> {
  shell = await createShell(module)
  for (let seed = from; seed < to; seed += every) tell({ told: 'rows', seed, rows: shell.job(name, query, seed, seed + 1) as number[][] })
  tell({ told: 'done' })
}

/** Works out the second part of each step of a figure on the page, and makes the step with the first. */
async function takePart(request: PartnerRequest): Promise<void> {
  if (request.do === 'partner') {
    shell = await createShell(request.module)
    partner = { figure: new shell.Figure(request.tag), run: 0, part: new Float64Array() }
    return tell({ told: 'ready' })
  }
  const { figure } = partner!
  if (request.do === 'begin-part') {
    partner!.run = request.run
    figure.act({ do: 'begin', value: request.query, name: '', on: false })
  } else if (request.run === partner!.run) figure.work_with(request.part, partner!.part)
  else return
  if (!figure.pending()) return
  partner!.part = figure.part(1)
  tell({ told: 'part', run: request.run, part: partner!.part })
}

/** Works, a slice at a time, as long as there is something to do. */
async function work(): Promise<void> {
  if (working || !session) return
  working = true
  let next = 0
  await attempt(async () => {
    while (session!.pending) {
      const from = performance.now()
      while (session!.pending && performance.now() < from + SLICE) session!.work()
      const now = performance.now()
      if (!session!.pending || now >= next) {
        await show()
        const painted = performance.now()
        next = painted + Math.max(PICTURE, SHARE * (painted - now))
      }
      await yieldToMain()
    }
  })
  working = false
}

/** A frame soon: one for all that was asked by then. */
function show(): Promise<void> {
  return (willShow ??= yieldToMain().then(() => {
    willShow = undefined
    return attempt(() => {
      if (!session!.state.answer) return
      const { picture, ...frame } = session!.frame()
      // A copy: the memory is the program's, and the next call may move it.
      const pixels = picture?.pixels().slice()
      tell({ told: 'frame', frame: { ...frame, picture: picture && { ...picture, pixels: pixels! } } }, pixels ? [pixels.buffer] : [])
    })
  }))
}
