// The chapter is a plain page; its figures are all that needs script.
import '../../widgets/elements/index'
