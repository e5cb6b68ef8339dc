// The chapter: a page like any other, with figures and algorithms that run.
import '../../widgets/elements/index'
import './addresses'
import './algorithm'
import './page'
