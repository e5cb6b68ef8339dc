// The chapter is a plain page; its figures, and the table that can be run again, are all that needs script.
import '../../widgets/elements/index'
import './lap-table.css'
import '../../widgets/elements/lap-table'
