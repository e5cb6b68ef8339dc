// Typewriter quotes in the source, typographic ones on the page.

/** @param {string} text @param {string} before the character in front of it, "" at the beginning of a paragraph */
export function curly(text, before) {
  let last = before
  let result = ''
  for (const letter of text) {
    const opens = last === '' || /[\s([{—–“‘]/.test(last)
    last = letter === '"' ? (opens ? '“' : '”') : letter === "'" ? (opens ? '‘' : '’') : letter
    result += last
  }
  return result
}
