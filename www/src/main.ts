// The chapter: a page like any other, with figures, algorithms and a table that run.
import '../../widgets/elements/index'
import './lap-table'
import './algorithm'
import './challenges'
import './elsewhere'
import './guesses'
import './hero'
import './lap-table.css'
import './page'
import './place'
import './symbols'
import './vignette'
import { takePrintKey } from '../../widgets/elements/paper'

takePrintKey()
