//! The map-match likelihood p(z | x, m) of a scan against a grid.

use crate::error::ParameterError;
use crate::geometry::Pose2;
use crate::map::grid::{Grid, UNIT};
use crate::ops;
use crate::sensor::Scan;
use core::{fmt, str::FromStr};

/// What an end point is compared with: a reader's choice.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "lowercase"))]
pub enum Matcher {
    /// The occupancy of the cell it falls in. Every pose that moves no end point out of its cell scores the same, so the error
    /// has a floor of about half a cell.
    Cell,
    /// The nearest normal distribution of earlier end points (Biber and Straßer 2003) in the four cells nearest to it: the same
    /// grid, but a score that knows where in the cell the wall is.
    SubCell,
}

/// The likelihood of a scan.
///
/// ln p(z | x, m) = κ Σ_b max(ℓ_b, ln p_cell(b)), summed over the beams that met something: a maximum in place of the sum of a
/// mixture (Olson and Agarwal 2013), which costs no logarithm. p_cell = ε + (1 − ε) p(occupied) judges the cell an end point
/// falls in; ℓ_b = −½ d² is the surface term of [`Matcher::SubCell`], absent for [`Matcher::Cell`].
///
/// κ < 1 tempers the product over beams: neighbouring beams meet the same wall and err together (GSB, *likelihood
/// smoothing*; PR §6.3.4).
#[derive(Clone, Debug)]
pub struct ScanModel {
    matcher: Matcher,
    temper: f64,
    /// ln p_cell for each stored value of log-odds, from −128 units up.
    log_cell: [f64; 256],
}

impl ScanModel {
    /// A scan model with temper κ in (0, 1\] and probability ε in (0, 1) of a reading that has nothing to do with the map.
    pub fn new(matcher: Matcher, temper: f64, outlier: f64) -> Self {
        let log_cell = core::array::from_fn(|k| {
            let log_odds = (k as f64 - UNKNOWN as f64) * UNIT;
            // Against the cell as it is: for sub-cell matching a wall is judged by its surface, so a cell scores no better
            // than one that nothing is known of.
            let log_odds = if matcher == Matcher::SubCell { log_odds.min(0.0) } else { log_odds };
            ops::ln(outlier + (1.0 - outlier) / (1.0 + ops::exp(-log_odds)))
        });
        Self { matcher, temper, log_cell }
    }

    /// ln p(z | x, m) \[nats\], up to a constant that neither pose nor map changes; 0 at best.
    pub fn log_likelihood(&self, grid: &Grid, world_from_robot: &Pose2, scan: &Scan) -> f64 {
        let log_beam = |x, y| match self.matcher {
            Matcher::Cell => self.log_cell(grid, x, y),
            Matcher::SubCell => match grid.nearest_surface(x, y) {
                // Beyond what any cell offers: no need to look at the cell.
                Some(d2) if -0.5 * d2 >= self.log_cell[UNKNOWN] => -0.5 * d2,
                Some(d2) => (-0.5 * d2).max(self.log_cell(grid, x, y)),
                None => self.log_cell(grid, x, y),
            },
        };
        let (sin, cos) = ops::sin_cos(world_from_robot.theta);
        let to_world = |&[x, y]: &[f64; 2]| {
            (world_from_robot.x + cos * x - sin * y, world_from_robot.y + sin * x + cos * y)
        };
        self.temper * scan.hits.iter().map(to_world).map(|(x, y)| log_beam(x, y)).sum::<f64>()
    }

    /// ln p_cell of the cell that a point \[m\] falls in.
    #[inline]
    fn log_cell(&self, grid: &Grid, x: f64, y: f64) -> f64 {
        let (i, j) = grid.cell_of(x, y);
        self.log_cell[(i32::from(grid.units(i, j)) + UNKNOWN as i32) as usize]
    }
}

/// Where log-odds 0 stand in the table.
const UNKNOWN: usize = 128;

impl fmt::Display for Matcher {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Cell => "cell",
            Self::SubCell => "subcell",
        })
    }
}

impl FromStr for Matcher {
    type Err = ParameterError;

    fn from_str(text: &str) -> Result<Self, ParameterError> {
        match text {
            "cell" => Ok(Self::Cell),
            "subcell" => Ok(Self::SubCell),
            _ => Err(ParameterError::new("matcher", text, "cell or subcell")),
        }
    }
}
