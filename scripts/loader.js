// fastslam.js: the one name that other pages know. It fetches the figures, whose files have hashes in their names. A browser may have kept
// it from before the site was renewed, and they are gone: then it asks for itself anew; and where they do not arrive at all, each figure of
// the page becomes its picture, which leads to it, and says so.
const home = new URL('.', import.meta.url)
const words = WORDS // in every language
import('SHARED').catch(() => {}) // what the figures share, which they would ask for later
const figures = await import('FIGURES').catch(async why => {
  try {
    if (!import.meta.url.includes('?')) return await import(`${home}fastslam.js?renewed`)
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
