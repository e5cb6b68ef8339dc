// w17.1, the lap: every particle's own map, path and robot; and a reader who takes the wheel.
import { define } from './define'
import { Drive } from './drive'

export const FastslamLap = define('fastslam-lap', Drive)
