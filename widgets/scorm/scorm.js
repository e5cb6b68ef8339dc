// Ties the figure to a learning system that speaks SCORM 1.2: what the learner set is kept in suspend_data and is there at the next visit.
// Without such a system around it, the page is the figure alone.
{
  const figure = document.querySelector('#figure > :not(p)')
  const key = 'cmi.suspend_data'

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
   * Whether the learner's own hand has done what there is to do: placed a prediction and let it be judged, else gone to the last step,
   * else, where there is nothing to step through, changed something. What merely played, or was kept from an earlier visit, is none of it.
   */
  const isDone = ({ type, detail: { by, step, last, values, phase } }) => {
    if (by !== 'reader') return false
    if (phase) return phase === 'done' // of a log: every scan is mapped
    if (last === 0 && values.predict !== undefined) return values.run === 'on'
    return last > 0 ? type === 'fastslam-step' && step === last : type === 'fastslam-change'
  }

  const NEAR = 0.1 // a guess within a tenth of the result counts as correct
  const decimal = x => String(Number(x.toPrecision(6)))

  /** A prediction that was judged, as an interaction: what was asked, what the learner said, what it is. */
  const record = (api, { name, guess, result, waived }) => {
    const n = `cmi.interactions.${Number(api.LMSGetValue('cmi.interactions._count')) || 0}`
    const set = (what, value) => api.LMSSetValue(`${n}.${what}`, value)
    set('id', name)
    set('type', 'numeric')
    set('time', new Date().toTimeString().slice(0, 8))
    if (result !== null) set('correct_responses.0.pattern', decimal(result))
    if (!waived) set('student_response', decimal(guess))
    set('result', waived || result === null ? 'neutral' : Math.abs(guess / result - 1) <= NEAR ? 'correct' : 'wrong')
    api.LMSCommit('')
  }

  const api = find(window) ?? (window.opener && find(window.opener))
  if (api && String(api.LMSInitialize('')) === 'true') {
    api.LMSSetValue('cmi.core.exit', 'suspend') // else a learning system may begin the next visit without what was kept
    const kept = api.LMSGetValue(key)
    if (kept) figure.state = kept
    if (['not attempted', ''].includes(api.LMSGetValue('cmi.core.lesson_status'))) api.LMSSetValue('cmi.core.lesson_status', 'incomplete')

    let timer
    const keep = () => {
      clearTimeout(timer)
      api.LMSSetValue(key, figure.state)
      api.LMSCommit('')
    }
    // What was kept from an earlier visit was recorded then.
    let known = new URLSearchParams(kept)
    figure.addEventListener('fastslam-guess', ({ detail }) => {
      const again = known.get('run') === 'on' && (known.get('guess') === null ? detail.waived : Number(known.get('guess')) === detail.guess)
      known = new URLSearchParams()
      if (!again) record(api, detail)
    })
    for (const type of ['fastslam-change', 'fastslam-step']) {
      figure.addEventListener(type, event => {
        clearTimeout(timer)
        if (isDone(event)) api.LMSSetValue('cmi.core.lesson_status', 'completed')
        timer = setTimeout(keep, 1000)
      })
    }
    addEventListener('pagehide', () => {
      keep()
      api.LMSFinish('')
    }, { once: true })
  }
}
