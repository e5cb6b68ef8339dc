// Keys that a figure uses go no further: a book would turn its page at an arrow key, and a deck of slides at Space. Keys that it does
// not use are the page's. The page could not tell them apart: from outside, the target of every key is the figure.

const MOVES = /^(Arrow(Left|Right|Up|Down)|Home|End)$/
const SCROLLS = /^(Arrow(Up|Down)|Home|End|Page(Up|Down)| )$/
const EDITS = /^(Arrow(Left|Right|Up|Down)|Home|End|Backspace|Delete|Insert|Enter)$/
const COMMANDS = /^([acvxyz]|Arrow(Left|Right)|Home|End|Backspace|Delete|Insert)$/i

/** `act` does what a key asks of the figure, and says whether it asks anything. What a control has prevented, it has used. */
export function keepKeys(body: HTMLElement, act: (event: KeyboardEvent) => boolean): void {
  const used = new Set<string>() // keys held down
  body.addEventListener('keydown', event => {
    used.delete(event.code)
    if (!event.defaultPrevented && !act(event) && !servesControl(event)) return
    used.add(event.code)
    event.stopPropagation()
  })
  // A key that was used on its way down is nobody else's on its way up.
  body.addEventListener('keypress', event => used.has(event.code) && event.stopPropagation())
  body.addEventListener('keyup', event => used.delete(event.code) && event.stopPropagation())
}

/** Whether the browser does something at this key in the control that has the focus. */
function servesControl(event: KeyboardEvent): boolean {
  const { key, target } = event
  const control = target as Element
  const letter = key.length === 1
  const command = (event.ctrlKey || event.metaKey) && !event.getModifierState('AltGraph')
  if (control.matches('input[type=number], input[type=text]')) return command ? COMMANDS.test(key) : letter || EDITS.test(key)
  if (command) return false
  if (control.matches('select')) return letter || MOVES.test(key) || ['Enter', 'PageUp', 'PageDown'].includes(key)
  if (event.altKey) return false
  if (control.matches('input[type=range]')) return MOVES.test(key) || ['PageUp', 'PageDown'].includes(key)
  if (control.matches('[popover]')) return SCROLLS.test(key)
  if (control.matches('input[type=checkbox]')) return key === ' '
  return control.matches('button, summary') && [' ', 'Enter'].includes(key)
}
