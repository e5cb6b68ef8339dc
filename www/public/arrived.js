// Why the script of a frame's figure did not arrive, where the browser says it in its console alone. It is no module: those are refused to a
// frame that has no origin, unless the server lets every origin have them, and that is what has to be said then.
const cause = async address => {
  const sandboxed = self.origin === 'null'
  const answer = await fetch(address).catch(() => undefined)
  if (answer && !answer.ok) return `the server answered ${answer.status} where its script should be`
  if (answer) return 'a file that its script needs did not arrive; the site may just have been renewed, so load this page again'
  if (sandboxed) return 'its frame is sandboxed and so has no origin, and the server does not send “Access-Control-Allow-Origin: *” with its files; else the frame needs “allow-same-origin” in its sandbox'
  return 'the network is down, or a rule blocks it'
}

addEventListener(
  'error',
  async ({ target }) => {
    if (!(target instanceof HTMLScriptElement)) return
    const why = await cause(target.src)
    const line = document.querySelector('.blocked')
    line.firstChild.data = `This figure is not live here: ${why}. `
    line.classList.add('known')
    // The page of one figure has its picture; the common one is told by its address which it is.
    const name = /^(?:fastslam-)?([a-z-]+)$/.exec(new URLSearchParams(location.search).get('figure') ?? '')?.[1]
    if (name && line.parentElement.children.length === 1) line.before(Object.assign(new Image(), { src: `./embed-${name}.png`, alt: '' }))
    // The style sheet may not have arrived either.
    for (const { style } of document.images) Object.assign(style, { width: '100%', height: 'auto' })
  },
  true,
)
