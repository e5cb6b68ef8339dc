// fastslam.js: the one name that other pages know. It fetches the figures, whose files have hashes in their names. A browser may have kept
// it from before the site was renewed, and they are gone: then it asks for itself anew; and where they do not arrive at all, each figure of
// the page becomes its picture, which leads to it, and says so.
const home = new URL('.', import.meta.url)
const words = WORDS // in every language
const sums = {} // of a version that is kept: what the scripts have to be that it loads (scripts/versions.mjs)
const kept = Object.entries(sums)
if (!kept.length) import('SHARED').catch(() => {}) // what the figures share, which they would ask for later
// A browser compares as it fetches: what has been fetched so is what is run.
const checked = kept.map(([file, integrity]) => new Promise((onload, onerror) => document.head.append(Object.assign(document.createElement('link'), { rel: 'modulepreload', crossOrigin: '', integrity, href: home + file, onload, onerror }))))
const figures = await Promise.all(checked).then(() => import('FIGURES')).catch(async why => {
  try {
    if (!kept.length && !import.meta.url.includes('?')) return await import(`${home}fastslam.js?renewed`)
  } catch {}
  for (const figure of document.querySelectorAll(':not(:defined)')) {
    if (!figure.localName.startsWith('fastslam-') || figure.childElementCount) continue
    const page = home + figure.localName.replace('fastslam', 'embed')
    const link = Object.assign(document.createElement('a'), { href: `${page}.html` })
    const picture = Object.assign(new Image(), { src: `${page}.png`, alt: '' })
    picture.setAttribute('width', '100%')
    const language = figure.closest('[lang]')?.lang.toLowerCase().split('-')[0]
    link.append(picture, document.createElement('br'), words[language] ?? words.en)
    figure.append(link)
  }
  throw why
})
export const { NAMES } = figures
