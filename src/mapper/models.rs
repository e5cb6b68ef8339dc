//! What the mapper's filter is made of: its map, how a scan is scored upon it, and where a particle's next pose is drawn from.
//!
//! One tuning for every building, robot and laser ([`MODELS`]), with the reason for each number. What follows from another number is computed
//! from it. Numbers from the literature say from where.

use crate::map::grid::{Grid, GridModel};
use crate::matching::{HillClimbSteps, Kernel, Matcher, ScanModel};
use crate::motion::Displaced;
use crate::proposal::{CorrelativeSearch, FitLimits, FromScan, FromScanSettings, IncrementalWeight};

/// Cells along a side of an NDT cell of a [`Map`]: NDT cells of 0.2 m with the default cells. Much smaller ones hold too few hits to tell which
/// way a wall runs, much larger ones more than one wall.
pub const CELLS_PER_NDT: usize = 4;

/// A particle's map.
pub type Map = Grid<CELLS_PER_NDT>;

/// Where a particle's next pose is drawn from.
pub(super) type Proposal = FromScan<Displaced, ScanModel, CorrelativeSearch>;

/// Side of a cell, as long as nobody sets another \[m\].
pub(super) const CELL: f64 = 0.05;

/// Side of an NDT cell then \[m\].
pub(super) const NDT_CELL: f64 = CELLS_PER_NDT as f64 * CELL;

/// Constants of the filter's models.
pub(super) struct ModelsConfig {
    /// How a map with cells of [`CELL`] learns from a scan.
    grid: GridModel,
    /// κ: the share of each beam's log-likelihood that counts. A real log is mapped as well with 0.5; with 0.3 the odometry's bias
    /// pulls at every pose, and its errors grow by half.
    temper: f64,
    /// ε: probability of a measurement that has nothing to do with the map.
    outlier: f64,
    /// p₀: probability that a beam ends in a cell of which nothing is known.
    unknown: f64,
    /// Cost of a distance from a wall. With c = 1 the pull is greatest at √⅔ σ, and at 2 σ half of that is left.
    kernel: Kernel,
    /// Beams for which [`Self::from_scan`] is made.
    pub beams: u32,
    /// The proposal, for a laser of [`Self::beams`].
    pub from_scan: FromScanSettings<CorrelativeSearch>,
    /// L: a scan is weighed against the map as it was so many metres of the way ago, or up to half as many more \[m\]. By then the robot is out of
    /// sight of most of what it saw for the first time.
    pub lag: f64,
    /// τ: particles are selected by so much of what a scan says ([`Builder::selection_temper`](crate::rbpf::Builder::selection_temper)), as all
    /// scans are held against one map with the same errors. Selected by all of it, half of all steps of a long corridor resampled, all
    /// particles had one ancestor 200 m before the first loop closed, and two loops in three did not close. gmapping takes 1 / (3 M), which
    /// is 0.011 with its 30 particles.
    pub selection_temper: f64,
}

/// Log-odds that a beam adds to the cell in which it ends, and to one that it passes \[nats\].
const LOG_ODDS: [f64; 2] = [0.9, -0.4];

/// Step of the search window for the pose of a scan \[m\].
const SCAN_STEP: f64 = 0.5 * NDT_CELL;

/// See [`ModelsConfig`].
pub(super) const MODELS: ModelsConfig = ModelsConfig {
    grid: GridModel {
        cell_size: CELL,
        log_odds_hit: LOG_ODDS[0],
        log_odds_pass: LOG_ODDS[1],
        // Those of OctoMap (Hornung et al. 2013). With ±4, somebody who comes to stand in free space counts as seen through for five
        // scans; errors in a crowd were larger by a third.
        log_odds_bounds: [-2.0, 3.5],
        ndt_std: 0.06,
        // How many times further than its end points an NDT cell reaches. End points spread evenly over a square have a standard deviation
        // of 0.29 of its side: with 3 a wall is felt into the next NDT cell, and is one wall. With 1, scans of new walls fitted a
        // place half a metre off better than their own.
        ndt_stretch: 3.0,
        lag: 0,
        distance_reach: 2,
        ndt_forgets: true,
    },
    temper: 0.85,
    outlier: 0.05,
    // A cell in which this share of the beams end stays where log-odds begin: 0.31. With one half, free space is so much worse than
    // unknown space that scans are drawn off the map.
    unknown: LOG_ODDS[1] / (LOG_ODDS[1] - LOG_ODDS[0]),
    kernel: Kernel::Robust { most: 1.0 },
    beams: 180,
    from_scan: FromScanSettings {
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
    },
    lag: 10.0,
    selection_temper: 0.01,
};

/// How a map with cells of this size \[m\] learns from a scan.
pub(super) const fn grid(cell_size: f64) -> GridModel {
    GridModel { cell_size, ..MODELS.grid }
}

/// How well a scan fits a map.
pub(super) fn score() -> ScanModel {
    let ModelsConfig { temper, outlier, unknown, kernel, .. } = MODELS;
    ScanModel::new(Matcher::SubCell, temper, outlier).with_unknown(unknown).with_kernel(kernel)
}

/// The proposal, for a laser of so many beams: of a denser one than [`ModelsConfig::beams`] the search takes fewer, since neighbours tell it the same.
pub(super) fn proposal(beams: u32, weight: IncrementalWeight) -> Proposal {
    let times = (beams.saturating_add(MODELS.beams / 2) / MODELS.beams).max(1) as usize;
    let mut settings = FromScanSettings { weight, ..MODELS.from_scan };
    settings.climb_stride *= times;
    settings.search.stride *= times;
    FromScan { motion: Displaced, score: score(), settings }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_search_takes_as_many_beams_of_a_dense_laser() {
        let of = |beams| proposal(beams, MODELS.from_scan.weight).settings;
        for (beams, times) in [(0, 1), (1, 1), (180, 1), (181, 1), (270, 2), (361, 2), (1081, 6)] {
            let settings = of(beams);
            assert_eq!((settings.climb_stride, settings.search.stride), (2 * times, 4 * times), "{beams}");
        }
        assert_eq!(of(180), MODELS.from_scan);
    }
}
