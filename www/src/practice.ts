// The page of questions and short exercises.
import './page'
import { follow } from './checks'

follow(document)
