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

  const api = find(window) ?? (window.opener && find(window.opener))
  if (api && String(api.LMSInitialize('')) === 'true') {
    const kept = api.LMSGetValue(key)
    if (kept) figure.state = kept
    if (['not attempted', ''].includes(api.LMSGetValue('cmi.core.lesson_status'))) api.LMSSetValue('cmi.core.lesson_status', 'incomplete')

    let timer
    const keep = () => {
      clearTimeout(timer)
      api.LMSSetValue(key, figure.state)
      // Who has moved something has worked with the figure; there is nothing here to be graded.
      if (figure.state) api.LMSSetValue('cmi.core.lesson_status', 'completed')
      api.LMSCommit('')
    }
    for (const type of ['fastslam-change', 'fastslam-step']) {
      figure.addEventListener(type, () => {
        clearTimeout(timer)
        timer = setTimeout(keep, 1000)
      })
    }
    addEventListener('pagehide', () => {
      keep()
      api.LMSFinish('')
    }, { once: true })
  }
}
