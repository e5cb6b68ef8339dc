//! Constants of the closing of loops.

use crate::mapper::models::NDT_CELL;
use crate::matching::HillClimbSteps;
use crate::proposal::CorrelativeSearch;

/// When a loop counts as missed, and where it is looked for.
#[derive(Clone, Copy, Debug)]
pub(in crate::mapper) struct ClosingConfig {
    /// Metres between two looks.
    pub every: f64,
    /// Length of the way \[m\] of which the scans make the picture that is looked for.
    pub window: f64,
    /// About how many of its end points are looked at.
    pub picture: usize,
    /// The map that it is held against ended before what is in the picture was in sight: as many metres earlier as the laser reaches, up to these.
    pub farthest: f64,
    /// Metres between two maps that are kept for it.
    pub spacing: f64,
    /// How near the robot must be to a place where that map was drawn \[m\].
    pub reach: f64,
    /// A loop is at least so long \[m\], and so many times as long as what lies between its ends: on a straight way nothing is come back to.
    pub loop_way: f64,
    /// See [`Self::loop_way`].
    pub loop_times: f64,
    /// Share of all end points that must lie on walls where the picture is found: about a third, as the robot may just have come back.
    pub fits: f64,
    /// Share from which on a loop counts as closed for good.
    pub sure: f64,
    /// How much better than anywhere else the picture must fit where the robot is taken to be \[nats an end point, tempered\]: a sixth of what lies between a
    /// wall and unknown space.
    pub gain: f64,
    /// How far from here a place counts as another one \[m, rad\]: what is nearer the matcher has looked at.
    pub elsewhere: [f64; 2],
    /// How many of the particles are searched for, the heaviest first: from those that fit, selection makes the others.
    pub searched: usize,
    /// Metres between two loops that are remembered as closed.
    pub apart: f64,
    /// Standard deviations \[m, rad\] of position and heading that matching leaves after a metre; both grow with the root of the way.
    pub drift: [f64; 2],
    /// Standard deviations of a place that was found again \[m, m, rad\].
    pub relation: [f64; 3],
    /// The lattice. It reaches as far as the path may have drifted by its own covariance, and 12 m at the most. Half of the climbs begin on one hill: the others find
    /// the next best.
    pub search: CorrelativeSearch,
    /// From half the lattice's step down to half a centimetre.
    pub climb: HillClimbSteps,
}

/// Step of the lattice that loops are searched for on \[m\]: as far as the distance field reaches.
const CLOSING_STEP: f64 = 2.0 * NDT_CELL;

/// See [`ClosingConfig`].
pub(in crate::mapper) const CLOSING: ClosingConfig = ClosingConfig {
    every: 5.0,
    window: 10.0,
    picture: 400,
    farthest: 50.0,
    spacing: 10.0,
    reach: 10.0,
    loop_way: 30.0,
    loop_times: 4.0,
    fits: 0.35,
    sure: 0.5,
    gain: 0.15,
    elsewhere: [0.15, 0.02],
    searched: 4,
    apart: 20.0,
    drift: [0.03, 0.0026],
    relation: [0.03, 0.03, 0.005],
    search: CorrelativeSearch { linear: CLOSING_STEP, angular: 0.02, most_steps: 30, stride: 3, climbs: 12 },
    climb: HillClimbSteps { linear: 0.5 * CLOSING_STEP, angular: 0.02, halvings: 5 },
};
