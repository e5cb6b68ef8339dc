// The page of questions in German.
import './page'
import { follow } from './checks'

follow(document, undefined, {
  number: 'Schreiben Sie eine Zahl, zum Beispiel 0,25 oder 1/4.',
  right: 'Ja.',
  low: '{answer} ist zu klein.',
  high: '{answer} ist zu groß.',
  done: 'Geschafft.',
  forget: 'Meine Antwort vergessen',
})
