// The chapter is to be finished: what is read without unfolding anything is as long as a chapter of a textbook, and whole by itself.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import { chapterWords, total } from '../../scripts/words.mjs'

test('the chapter has 14 000 words at most without unfolding anything, and no section of it is empty until something is unfolded', async () => {
  const counts = await chapterWords()
  assert.ok(counts.length > 30)
  const { open, whole } = total(counts)
  assert.ok(open <= 14_000, `${open} words are open`)
  assert.ok(whole <= 24_000, `${whole} words in all`)
  // A heading, and at least a sentence under it; terms are a list by themselves.
  for (const { id, open } of counts) assert.ok(open >= 15 || id === 'glossary', `#${id} has ${open} words that are open`)
})
