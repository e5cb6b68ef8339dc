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
    /// The nearest normal distribution of earlier end points (Biber and Straßer 2003) in the 3 × 3 cells around: the same
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
            let log_odds = (k as f64 - 128.0) * UNIT;
            // Against the cell as it is: for sub-cell matching a wall is judged by its surface, so a cell scores no better
            // than one that nothing is known of.
            let log_odds = if matcher == Matcher::SubCell { log_odds.min(0.0) } else { log_odds };
            ops::ln(outlier + (1.0 - outlier) / (1.0 + ops::exp(-log_odds)))
        });
        Self { matcher, temper, log_cell }
    }

    /// ln p(z | x, m) \[nats\], up to a constant that neither pose nor map changes; 0 at best.
    pub fn log_likelihood(&self, grid: &Grid, world_from_robot: &Pose2, scan: &Scan) -> f64 {
        let (sin, cos) = ops::sin_cos(world_from_robot.theta);
        let per_cell = 1.0 / grid.cell_size();
        let mut sum = 0.0;
        for &[x, y] in &scan.hits {
            let wx = world_from_robot.x + cos * x - sin * y;
            let wy = world_from_robot.y + sin * x + cos * y;
            let (cx, cy) = (floor(wx * per_cell), floor(wy * per_cell));
            let cell = self.log_cell[(i32::from(grid.units(cx, cy)) + 128) as usize];
            sum += match self.matcher {
                Matcher::Cell => cell,
                Matcher::SubCell => cell.max(-0.5 * nearest_surface(grid, wx, wy, cx, cy)),
            };
        }
        self.temper * sum
    }
}

/// Smallest squared Mahalanobis distance of a point \[m\] to the surfaces in the 3 × 3 cells around its own.
#[inline]
fn nearest_surface(grid: &Grid, x: f64, y: f64, ci: i32, cj: i32) -> f64 {
    let size = grid.cell_size();
    let mut nearest = f64::INFINITY;
    for j in cj - 1..=cj + 1 {
        for i in ci - 1..=ci + 1 {
            if let Some(surface) = grid.surface(i, j) {
                let d2 = surface.mahalanobis2(x - (f64::from(i) + 0.5) * size, y - (f64::from(j) + 0.5) * size);
                nearest = nearest.min(d2);
            }
        }
    }
    nearest
}

/// ⌊x⌋ as an index; saturates, and NaN gives 0. Without the call that `f64::floor` is on a plain x86-64.
#[inline]
fn floor(x: f64) -> i32 {
    let truncated = x as i32;
    truncated - i32::from(f64::from(truncated) > x)
}

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floor_is_floor() {
        for k in -400..400 {
            let x = f64::from(k) * 0.01;
            assert_eq!(floor(x), x.floor() as i32, "{x}");
        }
        assert_eq!((floor(f64::NAN), floor(1e300)), (0, i32::MAX));
    }
}
