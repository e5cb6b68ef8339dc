// The bank as QTI 2.1: well-formed, of elements that its schema has and in their order, all references resolved, and scored by its own rules as the
// other files of the bank are. Read by the browser's parser of XML.
import { parse } from 'gift-pegjs'
import { unzipSync, strFromU8 } from 'fflate'
import { expect, test } from './fixtures'

/** What an element may have in it, in this order, as far as the bank goes; a star: any of these, in any order. */
const flow = ['p', 'em', 'strong', 'code', 'a', 'span', 'sub', 'sup', 'br']
const children: Record<string, string[]> = {
  assessmentItem: ['responseDeclaration', 'outcomeDeclaration', 'itemBody', 'responseProcessing', 'modalFeedback'],
  responseDeclaration: ['correctResponse'],
  correctResponse: ['value'],
  outcomeDeclaration: ['defaultValue'],
  defaultValue: ['value'],
  itemBody: ['*', 'p', 'choiceInteraction', 'rubricBlock', 'extendedTextInteraction'],
  choiceInteraction: ['prompt', 'simpleChoice'],
  prompt: ['*', ...flow.slice(1)],
  simpleChoice: ['*', ...flow],
  modalFeedback: ['*', ...flow],
  rubricBlock: ['p'],
  responseProcessing: ['*', 'responseCondition', 'setOutcomeValue'],
  responseCondition: ['responseIf', 'responseElse'],
  responseIf: ['match', 'equal', 'setOutcomeValue'],
  responseElse: ['setOutcomeValue'],
  setOutcomeValue: ['*', 'baseValue', 'variable'],
  match: ['variable', 'correct'],
  equal: ['variable', 'correct'],
  ...Object.fromEntries(flow.map(name => [name, ['*', ...flow.slice(1), ...(name === 'p' ? ['textEntryInteraction'] : [])]])),
}
const needed: Record<string, string[]> = {
  assessmentItem: ['identifier', 'title', 'adaptive', 'timeDependent'],
  responseDeclaration: ['identifier', 'cardinality', 'baseType'],
  outcomeDeclaration: ['identifier', 'cardinality', 'baseType'],
  choiceInteraction: ['responseIdentifier', 'shuffle', 'maxChoices'],
  simpleChoice: ['identifier'],
  textEntryInteraction: ['responseIdentifier'],
  extendedTextInteraction: ['responseIdentifier'],
  modalFeedback: ['outcomeIdentifier', 'showHide', 'identifier'],
  rubricBlock: ['view'],
  equal: ['toleranceMode', 'tolerance'],
  baseValue: ['baseType'],
  setOutcomeValue: ['identifier'],
  variable: ['identifier'],
  correct: ['identifier'],
  a: ['href'],
}

for (const [name, category] of [['bank', 'FastSLAM/'], ['bank-de', 'FastSLAM (deutsch)/']] as const) {
  test(`${name}.qti.zip is a package of forty items that keep to the schema, and scores what the bank holds for right`, async ({ page, request }) => {
    const gift = parse(await (await request.get(`./${name}.gift.txt`)).text())
    expect(gift.some(one => one.type === 'Category' && one.title.includes(category))).toBe(true)
    const questions = gift.filter(one => one.type !== 'Category')
    const files = Object.entries(unzipSync(await (await request.get(`./${name}.qti.zip`)).body())).map(([file, bytes]) => [file, strFromU8(bytes)] as const)
    expect(files.map(([file]) => file).sort()).toEqual(['imsmanifest.xml', ...questions.map(({ id }) => `${id}.xml`)].sort())
    await page.goto('./trust.html')
    const read = await page.evaluate(
      ({ files, children, needed }) => {
        const wrong: string[] = []
        const scores: Record<string, { right: number | undefined; other: number | undefined; edge: number | undefined; value: string | undefined }> = {}
        for (const [file, text] of files) {
          const root = new DOMParser().parseFromString(text, 'application/xml').documentElement
          const complain = (what: string) => wrong.push(`${file}: ${what}`)
          if (root.ownerDocument.querySelector('parsererror')) complain(root.textContent!.slice(0, 200))
          if (file === 'imsmanifest.xml') {
            if (root.namespaceURI !== 'http://www.imsglobal.org/xsd/imscp_v1p1') complain(`namespace ${root.namespaceURI}`)
            if ([...root.children].map(({ localName }) => localName).join() !== 'metadata,organizations,resources') complain('its parts')
            const resources = [...root.querySelectorAll('resource')]
            const named = resources.map(one => one.getAttribute('href')!)
            if (named.slice().sort().join() !== files.map(([other]) => other).filter(other => other !== file).sort().join()) complain(`resources ${named.join()}`)
            for (const one of resources) if (one.getAttribute('type') !== 'imsqti_item_xmlv2p1' || one.querySelector('file')?.getAttribute('href') !== one.getAttribute('href')) complain(one.outerHTML)
            continue
          }
          if (root.namespaceURI !== 'http://www.imsglobal.org/xsd/imsqti_v2p1' || root.localName !== 'assessmentItem') complain(`root ${root.namespaceURI} ${root.localName}`)
          const identifiers = (selector: string) => [...root.querySelectorAll(selector)].map(one => one.getAttribute('identifier')!)
          const [responses, outcomes] = [identifiers('responseDeclaration'), identifiers('outcomeDeclaration')]
          for (const element of [root, ...root.querySelectorAll('*')]) {
            const [first, ...rest] = children[element.localName] ?? []
            const allowed = first === undefined ? [] : first === '*' ? rest : [first, ...rest]
            const places = [...element.children].map(child => allowed.indexOf(child.localName))
            if (places.includes(-1)) complain(`${element.localName} has ${[...element.children].map(({ localName }) => localName).join()}`)
            if (first !== '*' && places.some((place, i) => place < (places[i - 1] ?? 0))) complain(`order in ${element.localName}`)
            for (const attribute of needed[element.localName] ?? []) if (!element.getAttribute(attribute)) complain(`${element.localName} without ${attribute}`)
            for (const attribute of ['identifier', 'responseIdentifier', 'outcomeIdentifier']) {
              const value = element.getAttribute(attribute)
              if (value !== null && !/^[A-Za-z_][\w.-]*$/.test(value)) complain(`${attribute} ${value}`)
            }
            const response = element.getAttribute('responseIdentifier') ?? (['variable', 'correct'].includes(element.localName) ? element.getAttribute('identifier') : undefined)
            if (response && !responses.includes(response)) complain(`no response ${response}`)
            const outcome = element.getAttribute('outcomeIdentifier') ?? (element.localName === 'setOutcomeValue' ? element.getAttribute('identifier') : undefined)
            if (outcome && !outcomes.includes(outcome)) complain(`no outcome ${outcome}`)
          }
          const choices = identifiers('simpleChoice')
          if (new Set(choices).size !== choices.length) complain(`choices ${choices.join()}`)
          // Scored as its rules say.
          const value = root.querySelector('correctResponse > value')?.textContent ?? undefined
          const condition = root.querySelector('responseIf > :is(match, equal)')
          const [within] = (condition?.getAttribute('tolerance') ?? '').split(' ').map(Number)
          const score = (given: string) => {
            if (!condition) return undefined
            const holds = condition.localName === 'match' ? given === value : Math.abs(Number(given) - Number(value)) <= within! + 1e-12
            return Number(root.querySelector(`${holds ? 'responseIf' : 'responseElse'} > setOutcomeValue[identifier="SCORE"] > baseValue`)!.textContent)
          }
          if (choices.length > 0) {
            const told = identifiers('modalFeedback')
            if (told.join() !== choices.join()) complain(`feedback ${told.join()}`)
          }
          const other = choices.find(choice => choice !== value)
          scores[file.replace('.xml', '')] = { right: score(value!), other: score(other ?? String(Number(value) + 2 * within!)), edge: choices.length > 0 ? undefined : score(String(Number(value) + 0.99 * within!)), value: choices.length > 0 ? String(choices.indexOf(value!)) : value }
        }
        return { wrong, scores }
      },
      { files, children, needed },
    )
    expect(read.wrong).toEqual([])
    for (const question of questions) {
      const { right, other, edge, value } = read.scores[question.id!]!
      if (question.type === 'Essay') expect([question.id, right, value]).toEqual([question.id, undefined, undefined])
      else expect([question.id, right, other]).toEqual([question.id, 1, 0])
      if (question.type === 'MC') expect(Number(value)).toBe(question.choices.findIndex(({ isCorrect }) => isCorrect))
      if (question.type === 'Numerical') {
        expect(edge, question.id!).toBe(1)
        expect(Number(value), question.id!).toBe((question.choices as { number?: number }).number)
      }
    }
  })
}
