// What figures tell the page. The types of the packages (scripts/elements.mjs) have these lines as they are: nothing is imported here.

/** A number that a figure shows. */
export interface FigureReadout {
  name: string
  title: string
  value: number | null
  text: string
  unit: string
  help: string
  /** Whether the picture says it. */
  drawn: boolean
}

/** Whose doing it was: the reader's own hand, playing, or the page (an attribute, a property, a link, a script). */
export type Cause = 'reader' | 'playback' | 'page'

/** How far the mapping of a file is. */
export type Phase = 'empty' | 'ready' | 'running' | 'paused' | 'done'

export interface FigureDetail {
  step: number
  /** The last step there is; 0 where there is nothing to play. */
  last: number
  by: Cause
  values: Record<string, string>
  readouts: FigureReadout[]
  /** Of a figure that maps a file. */
  phase?: Phase
}

/** A line of the algorithm that led to what is shown. */
export interface TraceLine {
  key: string
  text: string
}

export interface TraceDetail {
  step: number
  lines: TraceLine[]
}

export interface ChallengeDetail {
  /** Of the challenge, the same in every language. */
  name: string
  /** Whether it was reached, or taken up. */
  done: boolean
}

export interface GuessDetail {
  /** What was predicted. */
  name: string
  guess: number | null
  /** Null where what was to be predicted never came. */
  result: number | null
  /** Whether the reader has seen the result without a guess. */
  waived: boolean
}

export interface NoticeDetail {
  /** Of the attribute. */
  name: string
  /** What is wrong with it, in the figure's language. */
  text: string
}

/** What came out at one seed. */
export interface SeedRun {
  seed: number
  step: number
  /** The state that shows it, as a link has it. */
  state: string
  readouts: FigureReadout[]
}

export interface SeedsDetail {
  /** The readout that matters, by its name. */
  readout: string
  /** Its median over the seeds; null where some have none. */
  median: number | null
  runs: SeedRun[]
}

/** What a script may say of the seeds that it wants to be run. */
export interface SeedsWish {
  /** Where they are not given, the one shown and the next four. */
  seeds?: number[]
  /** Where it is not given, the step shown. */
  step?: number
  /** The setting, as a link has it; where it is not given, that of now. */
  state?: string
  /** Ends it. */
  signal?: AbortSignal
}

/** Each bubbles, through the borders of shadow roots too. */
export interface FigureEvents {
  /** Another step is shown; also once when the figure comes to life. */
  'fastslam-step': CustomEvent<FigureDetail>
  /** A parameter has changed, whoever did it. */
  'fastslam-change': CustomEvent<FigureDetail>
  /** A reader has taken up a challenge or, where it is done, reached it. */
  'fastslam-challenge': CustomEvent<ChallengeDetail>
  /** The lines of the algorithm that led to the step shown. */
  'fastslam-trace': CustomEvent<TraceDetail>
  /** The page’s author has given what a figure cannot take: an attribute that it does not know, or a value out of its range. Readers see nothing of it, but on localhost. */
  'fastslam-notice': CustomEvent<NoticeDetail>
  /** A prediction was judged: guess and result stand side by side; or the reader has waived it. */
  'fastslam-guess': CustomEvent<GuessDetail>
  /** A script’s seeds have been run: what came out at each, and the median. */
  'fastslam-seeds': CustomEvent<SeedsDetail>
}
