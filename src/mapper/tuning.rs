//! What the mapper does not let anybody set: one tuning for every building, robot and laser, with the reason for each number.
//!
//! The numbers were chosen by the errors of paths on three recorded logs (Intel Research Lab; ACES building; Freiburg's campus) and on simulated ones:
//! our own building, rings of 60, 120 and 240 m with people, a crowd, a yard in which few beams return. Errors on these logs are therefore
//! no test of them; no other recorded log was looked at. What follows from another number is computed from it. Numbers from the
//! literature say from where.

use super::wheels::WheelNoise;
use crate::map::grid::{Grid, GridModel};
use crate::matching::{HillClimbSteps, Kernel, Matcher, ScanModel};
use crate::motion::Displaced;
use crate::proposal::{
    CorrelativeSearch, DRIFT_STDS, FitLimits, FromScan, FromScanSettings, IncrementalWeight, SEARCH_STDS,
};

/// Cells along a side of an NDT cell: NDT cells of 0.2 m with the default cells. Much smaller ones hold too few hits to tell which
/// way a wall runs, much larger ones more than one wall.
pub const CELLS_PER_NDT: usize = 4;

/// Side of a cell, as long as nobody sets another \[m\].
pub const CELL: f64 = 0.05;

/// Side of an NDT cell then \[m\].
const NDT_CELL: f64 = CELLS_PER_NDT as f64 * CELL;

/// A particle's map.
pub type Map = Grid<CELLS_PER_NDT>;

/// Where a particle's next pose is drawn from.
pub type Proposal = FromScan<Displaced, ScanModel, CorrelativeSearch>;

/// What wheels are taken for before any scan was matched. Wide on purpose: real wheels slip, and are off by a bias that no noise
/// describes. What is too wide is narrowed on the way (`wheels.rs`). After half a metre a heading is uncertain by 4° and a position by 5 cm.
pub const WHEELS: WheelNoise = WheelNoise { heading: [0.14, 0.1], position: [0.07, 0.07] };

/// What stays uncertain of a motion, however good the wheels are known to be: their own noise is not all that scans of one place differ by.
pub const FLOOR: WheelNoise = WheelNoise { heading: [0.014, 0.014], position: [0.028, 0.028] };

/// Standard deviation of the wheels' drift \[rad/m\], before anything is known: some 3° a metre, as one log has.
pub const DRIFT_STD: f64 = DRIFT_STDS[0];

/// What is assumed of the wheels counts as much as so many metres of the way \[m\].
pub const TRUST: f64 = 5.0;

/// Way after which what was learnt of the wheels is forgotten to 1/e \[m\]: carpets change, and tyres warm up.
pub const MEMORY: f64 = 50.0;

/// Length of a stretch \[m\]: over less, a matched heading says little of the wheels.
pub const STRETCH: f64 = 0.5;

/// An error of more standard deviations is no noise of the wheels, and is learnt from as if it were of so many.
pub const OUTLYING: f64 = 3.0;

/// κ: the share of each beam's log-likelihood that counts. A real log is mapped as well with 0.5; with 0.3 the odometry's bias
/// pulls at every pose, and its errors grow by half.
pub const TEMPER: f64 = 0.85;

/// ε: probability of a reading that has nothing to do with the map.
pub const OUTLIER: f64 = 0.05;

/// What a beam that ends in a cell adds to its log-odds, and one that passes \[nats\].
const LOG_ODDS: [f64; 2] = [0.9, -0.4];

/// Where log-odds end \[nats\]: those of OctoMap (Hornung et al. 2013). With ±4, somebody who comes to stand in free space counts as seen
/// through for five scans; errors in a crowd were larger by a third.
const LOG_ODDS_BOUNDS: [f64; 2] = [-2.0, 3.5];

/// p₀: probability that a beam ends in a cell of which nothing is known. By [`LOG_ODDS`], a cell in which this share of the beams end stays
/// where log-odds begin: 0.31. With one half, free space is so much worse than unknown space that scans are drawn off the map.
const UNKNOWN: f64 = LOG_ODDS[1] / (LOG_ODDS[1] - LOG_ODDS[0]);

/// What a distance from a wall costs. With c = 1 the pull is greatest at √⅔ σ, and at 2 σ half of that is left.
pub const KERNEL: Kernel = Kernel::Robust { most: 1.0 };

/// How many times further than its end points an NDT cell reaches. End points spread evenly over a square have a standard deviation
/// of 0.29 of its side: with 3 a wall is felt into the next NDT cell, and is one wall. With 1, scans of new walls fitted a
/// place half a metre off better than their own.
pub const NDT_STRETCH: f64 = 3.0;

/// L: a scan is weighed against the map as it was so many metres of the way ago, or up to half as many more \[m\]. By then the robot is out of
/// sight of most of what it saw for the first time.
pub const LAG: f64 = 10.0;

/// τ: particles are selected by so much of what a scan says ([`Builder::selection_temper`](crate::rbpf::Builder::selection_temper)), as all
/// scans are held against one map with the same errors. Selected by all of it, half of all steps of a long corridor resampled, all
/// particles had one ancestor 200 m before the first loop closed, and two loops in three did not close. gmapping takes 1 / (3 M), which
/// is 0.011 with its 30 particles.
pub const SELECTION_TEMPER: f64 = 0.01;

/// Radius of the circle in which an end point may lie, in standard deviations of odometry: it is taken to move where all of the circle was
/// seen to be free. As many as the search for the pose reaches.
pub const SEEN_THROUGH_STDS: f64 = SEARCH_STDS;

/// Added to that radius \[m\]: three standard deviations of a range that is off by 3 cm.
pub const RANGE_ERROR: f64 = 0.1;

/// Least distance on the way between two scans that are remembered to find what moves \[m\]; the last one always is.
pub const VIEW_SPACING: f64 = 0.5;

/// Scans from further back on the way \[m\] are forgotten: odometry is then less certain than most free space is wide.
pub const VIEW_REACH: f64 = 3.0;

/// How much further than the robot a person may have walked since a view \[m\].
pub const WALKED_ON: f64 = 0.5;

/// A robot that has moved by less than this \[m, or rad\] stands still: another look from there tells nothing new.
pub const STILL: f64 = 0.02;

/// Share of a log's longest reading from which on a reading says *nothing met*: lasers write their longest range then, or one a
/// little different (81.83, 80 and 81.91 m in one log).
pub const NOTHING_MET: f64 = 0.97;

/// When a loop counts as missed, and where it is looked for (`closing.rs`).
#[derive(Clone, Copy, Debug)]
pub(super) struct Closing {
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
    /// A loop was missed if so large a share of the end points of which the map knows anything lies in free space. Less than half of it is
    /// hardly anything: people and doors.
    pub disputed: f64,
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

/// Step of the lattice that a scan is searched for on \[m\].
const SCAN_STEP: f64 = 0.5 * NDT_CELL;

/// See [`Closing`].
pub(super) const CLOSING: Closing = Closing {
    every: 5.0,
    window: 10.0,
    picture: 400,
    farthest: 50.0,
    spacing: 10.0,
    reach: 10.0,
    loop_way: 30.0,
    loop_times: 4.0,
    disputed: 0.25,
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

/// What an end point adds to a score where it lies on a wall, at the least \[nats, before tempering\]: three
/// quarters of what an end point far from any wall loses.
pub(super) const ON_A_WALL: f64 = -0.75;

/// What it adds where it lies in space that was seen to be free, at the most \[nats, before tempering\]: by one beam
/// that passed. In unknown space it is −1.07.
pub(super) const IN_FREE_SPACE: f64 = -1.3;

/// Beams for which [`FROM_SCAN`] is made.
pub const BEAMS: u32 = 180;

/// The proposal, for a laser of [`BEAMS`] beams.
pub const FROM_SCAN: FromScanSettings<CorrelativeSearch> = FromScanSettings {
    // Enough to make a covariance definite: the floor that counts is that of the way.
    motion_floor: [1e-3, 1e-3, 5e-4],
    // Half an NDT cell, and as much at 3 m. Three starts: of two, one is often the neighbour of the other's hill.
    search: CorrelativeSearch { linear: SCAN_STEP, angular: 0.035, most_steps: 8, stride: 4, climbs: 3 },
    // From half the lattice's step down to half a centimetre.
    climb: HillClimbSteps { linear: 0.5 * SCAN_STEP, angular: 0.02, halvings: 3 },
    hills: 3,
    climb_stride: 2,
    minimum_improvement: 0.5,
    full_weight: 0.5,
    // From what cannot be seen to what wheels are off by after a metre or two: along a corridor a scan knows no better.
    limits: FitLimits { least: [0.005, 0.003], most: [0.15, 0.05] },
    weight: IncrementalWeight::NewGroundFree,
};

/// [`FROM_SCAN`] for a laser of so many beams: of a denser one the search takes fewer, since neighbours tell it the same.
pub fn from_scan(beams: u32) -> FromScanSettings<CorrelativeSearch> {
    let times = (beams.saturating_add(BEAMS / 2) / BEAMS).max(1) as usize;
    let mut settings = FROM_SCAN;
    settings.climb_stride *= times;
    settings.search.stride *= times;
    settings
}

/// How a map with cells of this size \[m\] learns from a scan.
pub const fn grid(cell_size: f64) -> GridModel {
    GridModel {
        cell_size,
        log_odds_hit: LOG_ODDS[0],
        log_odds_pass: LOG_ODDS[1],
        log_odds_bounds: LOG_ODDS_BOUNDS,
        ndt_std: 0.06,
        ndt_stretch: NDT_STRETCH,
        lag: 0,
        distance_reach: 2,
        ndt_forgets: true,
    }
}

/// How well a scan fits a map.
pub fn score() -> ScanModel {
    ScanModel::new(Matcher::SubCell, TEMPER, OUTLIER).with_unknown(UNKNOWN).with_kernel(KERNEL)
}

/// The whole proposal, for a laser of so many beams.
pub fn proposal(beams: u32) -> Proposal {
    FromScan { motion: Displaced, score: score(), settings: from_scan(beams) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_search_takes_as_many_beams_of_a_dense_laser() {
        for (beams, times) in [(0, 1), (1, 1), (180, 1), (181, 1), (270, 2), (361, 2), (1081, 6)] {
            let settings = from_scan(beams);
            assert_eq!((settings.climb_stride, settings.search.stride), (2 * times, 4 * times), "{beams}");
        }
        assert_eq!(from_scan(180), FROM_SCAN);
    }
}
