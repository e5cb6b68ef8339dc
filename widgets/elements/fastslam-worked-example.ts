// One update by hand: a picture to drag in, the numbers that decide, and each that they begin with in its matrix.
import { define } from './define'
import { MatrixInputs } from './matrix-inputs'

export const FastslamWorkedExample = define('fastslam-worked-example', MatrixInputs)
