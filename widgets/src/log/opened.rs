//! A log that was read, and the memory that it takes to map it.

use fastslam::{mapper::LaserMapperSettings, resampling::ResamplePolicy};
use fastslam_log::{LaserLog, swept_area};
use std::sync::Arc;

/// Most memory that maps and paths may take \[bytes\]: a quarter of what WebAssembly can address.
pub const LIMIT: f64 = 1e9;

/// What a map takes at the most: for each cell of the swept area, and for the walls in it, of which a square metre has about two
/// metres, a cell thick \[bytes\]. The tests hold mapped logs against it.
const CELL_BYTES: f64 = 4.0;
const WALL_BYTES: f64 = 2.0 * 45.0;

/// A population that resamples shares its past. What it does not share has some M log₂ M nodes (Jacob, Murray and Rubenthaler 2015), and
/// each node has written one scan: this many times as many are reckoned with.
const BUSH: f64 = 2.0;

/// Scans of which one's own area is taken.
const SAMPLES: usize = 32;

/// What a pose in the tree of all paths takes \[bytes\].
const NODE_BYTES: f64 = 56.0;

/// A log that was read.
pub struct Opened {
    /// Its scans.
    pub log: Arc<LaserLog>,
    /// Area \[m²\] that its beams sweep up to the longest range that is set, and a single scan's.
    pub swept: [f64; 2],
    /// Length of the way by raw odometry \[m\].
    pub way: f64,
}

impl Opened {
    /// A log, to be mapped as was set.
    pub fn new(log: LaserLog, setup: &LaserMapperSettings) -> Self {
        let way = log.scans.windows(2).map(|pair| pair[0].odometry.distance(&pair[1].odometry)).sum();
        Self { swept: swept(&log, setup.max_range), log: Arc::new(log), way }
    }

    /// Memory \[bytes\] that so many universes with cells of this size take at the most.
    pub fn bytes(&self, setup: &LaserMapperSettings, universes: usize) -> f64 {
        let m = universes as f64;
        let map = |area: f64| area / setup.cell_size * (CELL_BYTES / setup.cell_size + WALL_BYTES);
        let [all, one] = self.swept.map(map);
        let shares = match setup.policy {
            ResamplePolicy::Never => false,
            ResamplePolicy::Always => true,
            ResamplePolicy::EssBelow(fraction) => fraction > 0.0,
        };
        // Whole numbers: the bits of M.
        let bush = BUSH * m * f64::from(usize::BITS - universes.leading_zeros());
        // Of maps and of paths: what all have, and for each node of the bush what one step adds.
        let of = |all: f64, one: f64| if shares { (m * all).min(all + bush * one) } else { m * all };
        of(all, one) + of(NODE_BYTES * self.log.scans.len() as f64, NODE_BYTES)
    }
}

/// Areas \[m²\] that all scans sweep together, and one alone, the largest of some.
pub fn swept(log: &LaserLog, max_range: f64) -> [f64; 2] {
    let samples = log.scans.iter().step_by(log.scans.len().div_ceil(SAMPLES));
    let one = samples.map(|scan| swept_area(core::slice::from_ref(scan), max_range)).fold(0.0, f64::max);
    [swept_area(&log.scans, max_range), one]
}
