// A building mapped from a log of its own, in a worker.
import { define } from './define'
import { Mapping } from './mapping'

export const FastslamLog = define('fastslam-log', Mapping)
