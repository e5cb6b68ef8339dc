// A worksheet: figures that run, on a page that is made for paper.
import '../../widgets/elements/index'
import { takePrintKey } from '../../widgets/elements/paper'
import './page'
import './sheet.css'

takePrintKey()
// On paper an address is all that there is of a link.
for (const link of document.querySelectorAll<HTMLAnchorElement>('main a[href*="?"]')) link.href = link.href
