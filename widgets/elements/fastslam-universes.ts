// How many universes are enough: laps that end well over M, what a rule makes of them, and the depletion; every point can be run again.
import { define } from './define'
import { UniversesAgain } from './universes-again'

export const FastslamUniverses = define('fastslam-universes', UniversesAgain)
