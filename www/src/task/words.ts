// What the page of an assignment says, in the languages of the figures.
const en = {
  task: 'Assignment',
  no_task: 'This address holds no assignment that can be read: it may have been cut off on its way.',
  predict_first: 'First your prediction: the figure can be used once you have given it.',
  your_prediction: 'Your prediction',
  keep_prediction: 'Keep my prediction',
  predicted: 'Your prediction was {given}. Now try it, and answer.',
  your_answer: 'Your answer',
  hand_in: 'Hand in',
  hand_in_state: 'Hand in this state',
  not_a_number: 'Please write a number.',
  no_answer: 'There is no answer yet.',
  not_by_hand: 'Change something first: this state was set for you.',
  right: 'Right.',
  wrong_once: 'Not right. You have one try left.',
  wrong: 'Not right. You have {left} tries left.',
  over: 'Not right. The answer is {answer}.',
  over_reach: 'Not reached. There are no tries left.',
  handed_in: 'Handed in.',
  after: 'This is after the answer was shown. It is recorded as that, and does not count.',
  goal_most: 'Wanted: {title} of at most {value}. Now: {now}.',
  goal_least: 'Wanted: {title} of at least {value}. Now: {now}.',
  goal_equal: 'Wanted: {title} = {value}. Now: {now}.',
  tries: 'Tries: {tries}',
  after_tries: 'After the answer was shown: {after}',
  score: 'Score: {score} of 100',
  print: 'Print my answer…',
  no_print: 'Printing is not allowed in this frame. Open the page by itself: {link}',
  name: 'Name',
  date: 'Date',
  state: 'The state of the figure',
}

export type TaskKey = keyof typeof en

const de: Record<TaskKey, string> = {
  task: 'Aufgabe',
  no_task: 'In dieser Adresse steht keine Aufgabe, die sich lesen lässt: Sie wurde vielleicht unterwegs abgeschnitten.',
  predict_first: 'Zuerst Ihre Vorhersage: Danach lässt sich die Abbildung bedienen.',
  your_prediction: 'Ihre Vorhersage',
  keep_prediction: 'Vorhersage festhalten',
  predicted: 'Ihre Vorhersage war {given}. Probieren Sie es nun aus, und antworten Sie.',
  your_answer: 'Ihre Antwort',
  hand_in: 'Abgeben',
  hand_in_state: 'Diesen Zustand abgeben',
  not_a_number: 'Bitte schreiben Sie eine Zahl.',
  no_answer: 'Es gibt noch keine Antwort.',
  not_by_hand: 'Ändern Sie zuerst etwas: Dieser Zustand wurde für Sie eingestellt.',
  right: 'Richtig.',
  wrong_once: 'Nicht richtig. Sie haben noch einen Versuch.',
  wrong: 'Nicht richtig. Sie haben noch {left} Versuche.',
  over: 'Nicht richtig. Die Antwort ist {answer}.',
  over_reach: 'Nicht erreicht. Es gibt keinen Versuch mehr.',
  handed_in: 'Abgegeben.',
  after: 'Das war, nachdem die Antwort gezeigt wurde. Es wird so vermerkt und zählt nicht.',
  goal_most: 'Gesucht: {title} höchstens {value}. Jetzt: {now}.',
  goal_least: 'Gesucht: {title} mindestens {value}. Jetzt: {now}.',
  goal_equal: 'Gesucht: {title} = {value}. Jetzt: {now}.',
  tries: 'Versuche: {tries}',
  after_tries: 'Nachdem die Antwort gezeigt wurde: {after}',
  score: 'Punkte: {score} von 100',
  print: 'Antwort drucken…',
  no_print: 'In diesem Rahmen darf nicht gedruckt werden. Öffnen Sie die Seite für sich: {link}',
  name: 'Name',
  date: 'Datum',
  state: 'Der Zustand der Abbildung',
}

/** Says it in a language that we have, else in English. */
export function say(language: string, key: TaskKey, values: Record<string, string | number> = {}): string {
  const words = language.toLowerCase().split('-')[0] === 'de' ? de : en
  return words[key].replace(/\{(\w+)\}/g, (_, name: string) => String(values[name] ?? ''))
}
