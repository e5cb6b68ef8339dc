// The reference (custom-elements.json, from which the types are made, too) against what running figures have and tell.
import { programs } from '../../scripts/registry.mjs'
import { expect, test } from './fixtures'
import { Figure } from './figure'
import { breadthOf, openCourse } from './host'

test.use({ contextOptions: { reducedMotion: 'reduce' } })

type Named = { name: string; description: string }[]
type Declaration = { tagName: string } & Record<'members' | 'cssParts' | 'readouts' | 'challenges' | 'events', Named> & { predictions?: Named }
type Details = Record<string, Record<string, unknown>>

const namesOf = (all: Named) => all.map(({ name }) => name)

/** The fields of an event's detail, and those that are always there. */
function fieldsOf(description: string): [all: string[], always: string[]] {
  const fields = /Its detail: \{ (.*) \}\.$/.exec(description)![1]!.split(', ')
  return [fields.map(field => field.replace('?', '')), fields.filter(field => !field.endsWith('?'))]
}

for (const tag of programs.keys()) {
  test(`${tag} has and tells what the reference says: parts, readouts, challenges, what is predicted, and the details of events`, breadthOf(tag), async ({ page, request }) => {
    const { modules } = (await (await request.get('./custom-elements.json')).json()) as { modules: { declarations: Declaration[] }[] }
    const { members, cssParts, readouts, challenges, events, predictions = [] } = modules[0]!.declarations.find(({ tagName }) => tagName === tag)!
    const logs = tag === 'fastslam-log'
    await openCourse(page, `<${tag} v="latest"${logs ? ' universes="2"' : ''}></${tag}>`)
    const figure = new Figure(page, tag)
    await figure.element.evaluate(
      (element, names) => {
        const heard: Details = ((window as unknown as { heard: Details }).heard = {})
        for (const name of names) element.addEventListener(name, event => (heard[name] = (event as CustomEvent).detail))
      },
      namesOf(events),
    )
    if (logs) {
      await figure.settled()
      await figure.element.evaluate(element => (element as unknown as { example(): Promise<void> }).example())
      await expect(figure.sentence).toContainText('All scans are mapped', { timeout: 120_000 })
    } else await figure.live()
    await figure.element.evaluate(
      async (element, [challenge, predicts, runs, logs]) => {
        const figure = element as unknown as HTMLElement & { challenge(name: string): Promise<boolean>; settled(): Promise<void>; runSeeds(wish: object): Promise<unknown>; step(): void }
        const set = async (name: string, value: string) => {
          figure.setAttribute(name, value)
          await figure.settled()
        }
        if (runs) await figure.runSeeds({ seeds: [1], step: 1 })
        if (predicts) {
          await set('predict', 'on')
          await set('run', 'on')
        }
        // It presses buttons: a figure shows then what it can.
        for (const toggle of figure.shadowRoot!.querySelectorAll<HTMLElement>('.toggle[aria-pressed=false]')) toggle.click()
        await figure.settled()
        if (challenge && !logs) await figure.challenge(challenge)
        await figure.settled()
      },
      [challenges[0]?.name ?? '', predictions.length > 0, namesOf(members).includes('runSeeds'), logs] as const,
    )
    const { heard, parts, handles } = await figure.element.evaluate(element => {
      const root = element.shadowRoot!
      const parts = [...new Set([...root.querySelectorAll('[part]')].flatMap(inner => [...inner.part]))]
      return { heard: (window as unknown as { heard: Details }).heard, parts, handles: root.querySelectorAll('.handle').length > 0 }
    })
    const sometimes = ['notice', ...(handles ? [] : ['handle'])]
    expect(new Set(parts)).toEqual(new Set(namesOf(cssParts).filter(part => parts.includes(part) || !sometimes.includes(part))))

    for (const [name, detail] of Object.entries(heard)) {
      const [all, always] = fieldsOf(events.find(event => event.name === name)!.description)
      expect(all, name).toEqual(expect.arrayContaining(Object.keys(detail)))
      expect(Object.keys(detail), name).toEqual(expect.arrayContaining(always))
    }
    const told = (heard['fastslam-step']?.['readouts'] ?? heard['fastslam-change']!['readouts']) as Named
    expect(namesOf(readouts)).toEqual(expect.arrayContaining(namesOf(told)))
    if (!logs) {
      expect(heard['fastslam-challenge'], 'by its name').toMatchObject({ name: challenges[0]!.name })
      const chips = await figure.element.evaluate(element => element.shadowRoot!.querySelectorAll('.chip').length)
      expect(chips).toBe(challenges.length)
    }
    if (predictions.length > 0) expect(heard['fastslam-guess']).toMatchObject({ name: predictions[0]!.name })
    if (namesOf(members).includes('runSeeds')) expect(namesOf(readouts)).toContain(heard['fastslam-seeds']!['readout'])
  })
}
