// Ties a figure, alone or with an assignment, to a learning system that speaks SCORM 1.2: what the learner did is kept in suspend_data and is
// there at the next visit, and answers are told as interactions. Without such a system around it, the page is what it is.
{
  const figure = document.querySelector('#figure > :not(p)')
  const assigned = document.querySelector('#given') !== null
  const key = 'cmi.suspend_data'
  const started = Date.now()

  /** The system's API is in a window above, or in that of the opener; other sites' windows are not ours to look into. */
  const find = from => {
    for (let [window, depth] = [from, 0]; window && depth < 10; depth++) {
      try {
        if (window.API) return window.API
      } catch {
        return undefined
      }
      if (window === window.parent) return undefined
      window = window.parent
    }
    return undefined
  }

  /**
   * Whether the learner's own hand has done what there is to do with a figure alone: placed a prediction and let it be judged, else gone to
   * the last step, else, where there is nothing to step through, changed something. What merely played, or was kept from an earlier visit, is
   * none of it. An assignment is done by its answer alone.
   */
  const isDone = ({ type, detail: { by, step, last, values, phase } }) => {
    if (assigned || by !== 'reader') return false
    if (phase) return phase === 'done' // of a log: every scan is mapped
    if (last === 0 && values.predict !== undefined) return values.run === 'on'
    return last > 0 ? type === 'fastslam-step' && step === last : type === 'fastslam-change'
  }

  const NEAR = 0.1 // a guess within a tenth of the result counts as correct
  const LONGEST = 255 // letters of a response
  const decimal = x => String(Number(Number(x).toPrecision(6)))

  /** HHHH:MM:SS.SS, as SCORM writes a length of time. */
  const length = milliseconds => {
    const [hours, minutes, seconds] = [3_600_000, 60_000, 1000].map((unit, i) => Math.floor(milliseconds / unit) % (i === 0 ? 10_000 : 60))
    return `${String(hours).padStart(4, '0')}:${String(minutes).padStart(2, '0')}:${String(seconds).padStart(2, '0')}`
  }

  /** An interaction: what was asked, what the learner said, what it is. A name tells which try it was, as SCORM 1.2 has no place for that. */
  const record = (api, { name, type, said, right, result }) => {
    const n = `cmi.interactions.${Number(api.LMSGetValue('cmi.interactions._count')) || 0}`
    const set = (what, value) => api.LMSSetValue(`${n}.${what}`, value)
    set('id', name)
    set('type', type)
    set('time', new Date().toTimeString().slice(0, 8))
    if (right !== undefined) set('correct_responses.0.pattern', right.slice(0, LONGEST))
    if (said !== undefined) set('student_response', said.slice(0, LONGEST))
    set('result', result)
  }

  /** A prediction of the figure's that was judged. From the second on, the learner has seen what comes out: that is said, and neither is right. */
  const guessed = ({ name, guess, result, waived }, before) => ({
    name: before > 0 ? `${name}.try_${before + 1}.after_the_answer` : name,
    type: 'numeric',
    ...(result !== null && { right: decimal(result) }),
    ...(!waived && { said: decimal(guess) }),
    result: before > 0 || waived || result === null ? 'neutral' : Math.abs(guess / result - 1) <= NEAR ? 'correct' : 'wrong',
  })

  const TYPES = { number: 'numeric', choice: 'choice', text: 'fill-in', reach: 'performance' }
  const letter = rank => String.fromCharCode('a'.charCodeAt(0) + Number(rank)) // of a choice

  /** An answer to an assignment. */
  const answered = ({ stage, kind, given, result, wanted, tries, after }) => {
    const written = text => (kind === 'choice' ? letter(text) : kind === 'number' && Number.isFinite(Number(text.replace(',', '.'))) ? decimal(text.replace(',', '.')) : text)
    return {
      name: stage === 'prediction' ? 'prediction' : after > 0 ? `answer.try_${tries + after}.after_the_answer` : `answer.try_${tries}`,
      type: TYPES[kind],
      said: written(given),
      ...(wanted !== undefined && { right: written(wanted) }),
      result: { right: 'correct', wrong: 'wrong' }[result] ?? 'neutral',
    }
  }

  /** What was kept, unless the learning system has cut it off. */
  const remembered = text => {
    try {
      return JSON.parse(text)
    } catch {
      return {}
    }
  }

  const api = find(window) ?? (window.opener && find(window.opener))
  if (api && String(api.LMSInitialize('')) === 'true') {
    const set = (name, value) => api.LMSSetValue(`cmi.${name}`, String(value))
    set('core.exit', 'suspend') // else a learning system may begin the next visit without what was kept
    if (['not attempted', ''].includes(api.LMSGetValue('cmi.core.lesson_status'))) set('core.lesson_status', 'incomplete')

    // The state, as a link has it; and in a second line how often was answered.
    const [state = '', more = ''] = api.LMSGetValue(key).split('\n')
    const memory = { guesses: {}, ...remembered(more) }
    if (memory.progress) figure.dataset.kept = JSON.stringify(memory.progress)
    // Before its class is known, what is set would hide the class's own.
    if (state) void customElements.whenDefined(figure.localName).then(() => (figure.state = state))

    let timer
    const keep = () => {
      clearTimeout(timer)
      api.LMSSetValue(key, `${figure.state ?? state}\n${JSON.stringify(memory)}`)
      set('core.session_time', length(Date.now() - started))
      api.LMSCommit('')
    }
    // What was kept from an earlier visit was recorded then.
    let known = new URLSearchParams(state)
    figure.addEventListener('fastslam-guess', ({ detail }) => {
      const again = known.get('run') === 'on' && (known.get('guess') === null ? detail.waived : Number(known.get('guess')) === detail.guess)
      known = new URLSearchParams()
      if (again) return
      const before = memory.guesses[detail.name] ?? 0
      memory.guesses[detail.name] = before + 1
      record(api, guessed(detail, before))
      keep()
    })
    figure.addEventListener('fastslam-answer', ({ detail }) => {
      memory.progress = detail.progress
      record(api, answered(detail))
      if (detail.kind === 'text') set('comments', detail.given) // where there is room for all of it
      if (detail.over && detail.after === 0 && detail.stage === 'answer') {
        if (detail.score !== undefined) for (const [what, value] of [['min', 0], ['max', 100], ['raw', detail.score]]) set(`core.score.${what}`, value)
        const mastery = Number.parseFloat(api.LMSGetValue('cmi.student_data.mastery_score'))
        set('core.lesson_status', Number.isNaN(mastery) || detail.score === undefined ? 'completed' : detail.score >= mastery ? 'passed' : 'failed')
      }
      keep()
    })
    for (const type of ['fastslam-change', 'fastslam-step']) {
      figure.addEventListener(type, event => {
        clearTimeout(timer)
        if (isDone(event)) set('core.lesson_status', 'completed')
        timer = setTimeout(keep, 1000)
      })
    }
    addEventListener('pagehide', () => {
      keep()
      api.LMSFinish('')
    }, { once: true })
  }
}
