// The chapter: a page like any other, with figures and algorithms that run.
import '../../widgets/elements/index'
import './algorithm'
import './page'
