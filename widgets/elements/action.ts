// What can be asked of a program (widgets/src/action.rs, whose test holds these lines to it). Every action is flat, and of the same few fields,
// so that little has to be read. Points and lengths are in css px of the canvas.
import type { ThemeName } from './theme'

/** As a program reads it. */
interface Message {
  /** Of a parameter, a handle, or what it is about otherwise. */
  name: string
  value: string | null
  on: boolean
  /** A point, or other numbers. */
  at: number[]
}

type Needs<K extends keyof Message> = Pick<Message, K>

export type Action =
  /** As a code has it, with `v`, of which version that is: what is left out or taken away is at the default of that version. */
  | ({ do: 'author' } & Needs<'name'>)
  | Beginning
  /** A value for a parameter; null is the default. On by a reader's hand: what was set before is compared with it. */
  | ({ do: 'set' } & Needs<'name' | 'value'> & Partial<Needs<'on'>>)
  /** Names of parameters that readers may not change, apart by spaces, or `all`. */
  | ({ do: 'lock' } & Needs<'name'>)
  /** Parts of the picture. */
  | ({ do: 'show' } & Needs<'name'>)
  /** What is said in a language, which has the name. */
  | ({ do: 'words' } & Needs<'name' | 'value'>)
  | ({ do: 'comma' } & Needs<'on'>)
  /** A symbol that a reader of the chapter points at, in the picture too; an empty one puts it out. */
  | ({ do: 'light' } & Needs<'name'>)
  /** Whether the setting before is compared with that of now. */
  | ({ do: 'compare' } & Needs<'on'>)
  /** To a step. */
  | { do: 'seek'; at: [step: number] }
  /** To the step that tells most, if there is such a one. */
  | { do: 'tell' }
  | { do: 'trace' }
  | { do: 'leave' }
  | { do: 'pick'; at: [x: number, y: number] }
  | ({ do: 'drag'; at: [x: number, y: number] } & Needs<'name'>)
  /** A pointer over an area: the handle goes along, and when the pointer leaves, back to where it was. */
  | ({ do: 'follow'; at: [x: number, y: number] } & Needs<'name'>)
  | ({ do: 'nudge'; at: [right: number, up: number] } & Needs<'name'>)
  /** The name is that of a theme. Where the picture would be higher than its most height, it does not take all of the width of its room. */
  | { do: 'size'; name: ThemeName; at: Size }
  | ({ do: 'own' } & Own)

/**
 * A state: the value is that of a link, or null for the defaults, and in the name is what is set after that, as a link has it; a name without a value
 * is the default. On where that is told as a change. By a reader's link, locked parameters keep what the author gave.
 */
export type Beginning = { do: 'begin' | 'link' } & Needs<'name' | 'value' | 'on'>

/** All in css px but the canvas's own pixels, and how large letters are over normal ones. */
export type Size = [room: number, height: number, fontScale: number, css: number, width: number, height: number]

/** What only one kind of figure can do: at the wheel of the lap (widgets/src/lap/verb.rs), and over the map of a log (widgets/src/log/verb.rs). */
export type Own =
  | { name: 'take'; value: string }
  | { name: 'press'; value: string; at: [right: number, up: number] }
  | { name: 'stroke'; at: number[] }
  | { name: 'zoom'; at: [factor: number, ...about: [] | [x: number, y: number]] }
  | { name: 'pan'; at: [right: number, down: number] }
  | { name: 'fit' }
