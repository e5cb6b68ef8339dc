// The state in which each figure is compared, and another that must be told apart from it.
import { programs } from '../../scripts/registry.mjs'

/**
 * @typedef {Record<string, string>} Attributes
 * @typedef {object} State
 * @property {Attributes} attributes of a figure with a timeline with a step on it, so that what steps compute is compared
 * @property {Attributes} changed what makes it another state: a seed, or a noise where nothing is drawn at random
 */

/** The figure of logs, which maps its example: it has nothing to show before it has a log. */
export const LOG = 'fastslam-log'

/** Of those that have more to compare than what they open with. @type {Record<string, State>} */
const SPECIAL = {
  'fastslam-lap': { attributes: { step: '60' }, changed: { seed: '5' } },
  'fastslam-conditioning': { attributes: { step: '4' }, changed: { odometry: '2' } },
  'fastslam-proposal': { attributes: { landmarks: 'pair' }, changed: { seed: '5' } },
  'fastslam-worked-example': { attributes: { 'all-steps': 'on' }, changed: { 'range-std': '0.3' } },
  'fastslam-resampling': { attributes: { step: '40' }, changed: { seed: '5' } },
  'fastslam-joint': { attributes: { landmarks: '6', particles: '500' }, changed: { seed: '5' } },
  'fastslam-universes': { attributes: { seeds: '50' }, changed: { threshold: '0.1' } },
  'fastslam-graph': { attributes: { step: '3' }, changed: { seed: '6' } },
  'fastslam-smoothing': { attributes: { step: '3' }, changed: { seed: '5' } },
  'fastslam-em': { attributes: { step: '40' }, changed: { seed: '5' } },
  'fastslam-doors': { attributes: { step: '46' }, changed: { seed: '5' } },
}

/** Of every figure, by tag. */
export const STATES = Object.fromEntries([...programs.keys()].map(tag => [tag, SPECIAL[tag] ?? { attributes: {}, changed: { seed: '5' } }]))

/** The figure that a pointer and keys are tried on. */
export const HANDLED = { tag: 'fastslam-lap', attributes: { step: '20' }, slider: 'input[type=range][name=odometry]' }
