//! How a grid learns from a scan.

use super::tile::MAX_DISTANCE;
use crate::error::{Range, SettingError};

/// How a grid learns from a scan.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct GridModel {
    /// Side of a cell \[m\].
    pub cell_size: f64,
    /// Added to the log-odds of a cell that a beam ended in \[nats\].
    pub log_odds_hit: f64,
    /// Added to the log-odds of a cell that beams only passed through \[nats\], negative.
    pub log_odds_pass: f64,
    /// Where log-odds end \[nats\], free and occupied, to ±4: nearer to 0, a map changes its mind sooner (Hornung et al. 2013, OctoMap, clamp
    /// at −2 and 3.5).
    pub log_odds_bounds: [f64; 2],
    /// Standard deviation \[m\] of the two pseudo-hits that every NDT cell begins with: how far one hit alone is trusted.
    pub ndt_std: f64,
    /// How many times longer than its end points say a distribution is along the wall: 1 or more. A wall goes on from NDT cell to NDT cell,
    /// but a normal distribution in each is a string of beads: between two of them, even the right pose fits badly.
    pub ndt_stretch: f64,
    /// How many scans old [`Grid::past`](super::Grid::past) is, at the least; with 0 no past is kept but what is [marked](super::Grid::mark).
    pub lag: u32,
    /// How far from a hit the distance field is kept \[NDT cells\], 0 to 2: what a coarse search looks at. With 0 there is none.
    pub distance_reach: u32,
    /// Whether a distribution counts only until it is seen through: until beams have passed so often that the log-odds of all cells of its NDT
    /// cell are below 0 (after NDT-OM: Saarinen et al. 2013). Without, a place in which somebody stood once attracts scans for ever, and so
    /// does a wall that was drawn a little askew from afar.
    pub ndt_forgets: bool,
}

impl GridModel {
    /// Whether all settings are in range.
    ///
    /// # Errors
    /// Where one is not: with cells of no size there is no map, and what is felt further than two NDT cells away would be kept in no byte.
    pub fn validate(&self) -> Result<(), SettingError> {
        /// More than a byte of log-odds holds.
        const MOST: f64 = 4.0;
        /// Lengths for which single precision is no worry.
        const LENGTH: Range = Range::number(1e-6, 1e6, "m");
        let Self {
            cell_size,
            log_odds_hit,
            log_odds_pass,
            log_odds_bounds: [free, occupied],
            ndt_std,
            ndt_stretch,
            lag,
            distance_reach,
            ndt_forgets: _,
        } = *self;
        LENGTH.check("grid.cell_size", cell_size)?;
        Range::number(0.0, MOST, "nats").check("grid.log_odds_hit", log_odds_hit)?;
        Range::number(-MOST, 0.0, "nats").check("grid.log_odds_pass", log_odds_pass)?;
        Range::number(-MOST, 0.0, "nats").check("grid.log_odds_bounds", free)?;
        Range::number(0.0, MOST, "nats").check("grid.log_odds_bounds", occupied)?;
        LENGTH.check("grid.ndt_std", ndt_std)?;
        Range::number(1.0, 1e3, "").check("grid.ndt_stretch", ndt_stretch)?;
        Range::whole(0, 1_000_000).check("grid.lag", f64::from(lag))?;
        Range::whole(0, MAX_DISTANCE as u32 - 1).check("grid.distance_reach", f64::from(distance_reach)).map(drop)
    }
}
