//! The score of a scan against a grid, which stands for ln p(z | x, m).

use super::{Likelihood, Score, ScoreNear};
use crate::error::{Range, SettingError};
use crate::geometry::Pose2;
use crate::map::grid::{Grid, LANES, LocalMap, MAX_DISTANCE, NdtField, Nearest, UNIT};
use crate::ops;
use crate::sensor::Scan;
use core::cell::RefCell;
use wide::f64x4;

/// What an end point is compared with.
#[derive(
    Clone, Copy, PartialEq, Eq, Debug, strum::Display, strum::EnumString, strum::VariantNames, strum::VariantArray,
)]
#[strum(serialize_all = "lowercase", parse_err_ty = SettingError, parse_err_fn = unknown_matcher)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "lowercase"))]
pub enum Matcher {
    /// The occupancy of the cell it falls in. Every pose that moves no end point out of its cell scores the same, so the error
    /// has a floor of about half a cell.
    Cell,
    /// The nearest normal distribution of earlier end points (Biber and Straßer 2003) in the four cells nearest to it: the same
    /// grid, but a score that knows where in the cell the wall is.
    SubCell,
}

fn unknown_matcher(given: &str) -> SettingError {
    SettingError::unknown_word("matcher", given, <Matcher as strum::VariantNames>::VARIANTS)
}

/// What a distance from a wall costs, in standard deviations d of the nearest normal distribution.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Kernel {
    /// ℓ = −½ d²: what lies far from every distribution is judged by its cell.
    Gaussian,
    /// ℓ = −c d² / (d² + 2 c): Gaussian near the wall, and never below −c (Geman and McClure 1985). Its slope reaches far, so
    /// that a climb finds a wall from further away, and a chair that was moved pulls at nothing.
    Robust {
        /// c \[nats\].
        most: f64,
    },
}

/// How well a scan fits a map: a score \[nats\] that the filters use as ln p(z | x, m).
///
/// score = κ Σ_b max(ℓ_b, ln p_cell(b)), summed over the beams that met something: a maximum in place of the sum of a
/// mixture (Olson and Agarwal 2013), which costs no logarithm. p_cell = ε + (1 − ε) p(occupied) judges the cell an end point
/// falls in, where p(occupied) is p₀ ([`Self::with_unknown`]) in one of which nothing is known, and follows its log-odds from there; ℓ_b, of the squared Mahalanobis distance d² to the nearest distribution, is the term of [`Matcher::SubCell`], absent for
/// [`Matcher::Cell`]. With a robust kernel ℓ_b alone counts wherever there is a distribution near.
///
/// It is not a density over scans: the normaliser −½ ln |Σ′| of each distribution is left out, as Biber and Straßer (2003) leave it
/// out, and it differs from one to the next. So a scan may be compared between poses, and between maps of one place, but
/// its sum over all scans is not one.
///
/// κ < 1 tempers the product over beams: neighbouring beams meet the same wall and err together (GSB, *likelihood
/// smoothing*; PR §6.3.4).
#[derive(Clone, Debug)]
pub struct ScanModel {
    matcher: Matcher,
    kernel: Kernel,
    temper: f64,
    outlier: f64,
    unknown: f64,
    /// ln p_cell for each stored value of log-odds, from −128 units up.
    log_cell: [f64; 256],
}

impl ScanModel {
    /// A scan model with temper κ in (0, 1\] and probability ε in (0, 1) of a reading that has nothing to do with the map.
    pub fn new(matcher: Matcher, temper: f64, outlier: f64) -> Self {
        let unknown = 0.5;
        let log_cell = log_cells(matcher, outlier, unknown);
        Self { matcher, kernel: Kernel::Gaussian, temper, outlier, unknown, log_cell }
    }

    /// The same model with another probability p₀ in (0, 1) that a beam ends in a cell of which nothing is known; as given it is one half.
    /// The larger it is, the more a scan is drawn to where the map is empty.
    pub fn with_unknown(self, unknown: f64) -> Self {
        Self { unknown, log_cell: log_cells(self.matcher, self.outlier, unknown), ..self }
    }

    /// The same model with another kernel.
    pub fn with_kernel(self, kernel: Kernel) -> Self {
        Self { kernel, ..self }
    }

    /// The score \[nats\] of a scan taken at a pose; 0 at best.
    pub fn log_score<const CELLS_PER_NDT: usize>(
        &self,
        grid: &Grid<CELLS_PER_NDT>,
        world_from_robot: &Pose2,
        scan: &Scan,
    ) -> f64 {
        self.log_score_above(f64::NEG_INFINITY, &mut &*grid, world_from_robot, scan)
    }

    /// [`Self::log_score`] where it exceeds `floor`, else −∞.
    ///
    /// No beam adds anything positive, so the sum is given up as soon as it falls below the floor: a hill climb that only asks
    /// whether a step improves is spared the rest of the beams.
    pub(crate) fn log_score_above(
        &self,
        floor: f64,
        map: &mut impl NdtField,
        world_from_robot: &Pose2,
        scan: &Scan,
    ) -> f64 {
        let floor = floor / self.temper;
        let mut sum = 0.0;
        let ends = ends(world_from_robot);
        for beams in scan.hits.chunks(LANES) {
            for log_score in self.log_scores(map, beams, &ends).iter().take(beams.len()) {
                sum += log_score;
            }
            if sum <= floor {
                return f64::NEG_INFINITY;
            }
        }
        self.temper * sum
    }

    /// What each beam that met something adds to the sum of [`Self::log_score`], before it is tempered \[nats\].
    pub(crate) fn log_beams<const CELLS_PER_NDT: usize>(
        &self,
        mut grid: &Grid<CELLS_PER_NDT>,
        world_from_robot: &Pose2,
        scan: &Scan,
    ) -> Vec<f64> {
        let ends = ends(world_from_robot);
        let few = |beams: &[[f64; 2]]| self.log_scores(&mut grid, beams, &ends).into_iter().take(beams.len());
        scan.hits.chunks(LANES).flat_map(few).collect()
    }

    /// What each of these few beams adds to the sum; of lanes that they leave free nothing of any meaning is said.
    #[inline]
    fn log_scores(
        &self,
        map: &mut impl NdtField,
        beams: &[[f64; 2]],
        ends: impl Fn(&[[f64; 2]; LANES]) -> [f64x4; 2],
    ) -> [f64; LANES] {
        let filled;
        let lanes = match beams.first_chunk() {
            Some(lanes) => lanes,
            None => {
                filled = core::array::from_fn(|k| beams.get(k).copied().unwrap_or_default());
                &filled
            }
        };
        let ends = ends(lanes);
        if self.matcher == Matcher::Cell {
            let [x, y] = ends.map(f64x4::to_array);
            return core::array::from_fn(|k| self.log_cell(map.units_at([x[k], y[k]])));
        }
        let Nearest { d2, units } = map.nearest_ndt(ends);
        let cells = f64x4::new(units.map(|units| self.log_cell(units)));
        match self.kernel {
            Kernel::Gaussian => (f64x4::new(d2.to_array().map(f64::from)) * -0.5).fast_max(cells).to_array(),
            Kernel::Robust { most } => {
                // −c d² / (d² + 2 c), with one division in the precision in which distributions are kept.
                let most = most as f32;
                let ndt = 2.0 * most * most / (d2 + 2.0 * most) - most;
                let (d2, ndt, cells) = (d2.to_array(), ndt.to_array(), cells.to_array());
                core::array::from_fn(|k| if d2[k] < f32::INFINITY { f64::from(ndt[k]) } else { cells[k] })
            }
        }
    }

    /// ln p_cell of a cell's log-odds in units.
    #[inline]
    fn log_cell(&self, units: i8) -> f64 {
        self.log_cell[(i32::from(units) + UNKNOWN) as usize]
    }
}

/// Where beams end \[m\] of which this is given in the robot's frame.
#[inline]
fn ends(world_from_robot: &Pose2) -> impl Fn(&[[f64; 2]; LANES]) -> [f64x4; 2] {
    let (sin, cos) = ops::sin_cos(world_from_robot.theta);
    let (origin, ahead, left) = ([world_from_robot.x, world_from_robot.y], [cos, sin], [-sin, cos]);
    move |beams| {
        let [x, y] = [0, 1].map(|k: usize| f64x4::new(beams.map(|beam| beam[k])));
        [0, 1].map(|k: usize| origin[k] + ahead[k] * x + left[k] * y)
    }
}

/// ln p_cell for each stored value of log-odds, from −128 units up.
fn log_cells(matcher: Matcher, outlier: f64, unknown: f64) -> [f64; 256] {
    let prior = ops::ln(unknown / (1.0 - unknown));
    core::array::from_fn(|k| {
        let log_odds = (k as f64 - f64::from(UNKNOWN)) * UNIT;
        // Against the cell as it is: for sub-cell matching a wall is judged by its distribution, so a cell scores no better
        // than one that nothing is known of.
        let log_odds = if matcher == Matcher::SubCell { log_odds.min(0.0) } else { log_odds };
        ops::ln(outlier + (1.0 - outlier) / (1.0 + ops::exp(-(prior + log_odds))))
    })
}

impl<const CELLS_PER_NDT: usize> Likelihood<Grid<CELLS_PER_NDT>> for ScanModel {
    fn log_likelihood(&self, grid: &Grid<CELLS_PER_NDT>, world_from_robot: &Pose2, scan: &Scan) -> (f64, ()) {
        (self.log_score(grid, world_from_robot, scan), ())
    }

    fn validate(&self) -> Result<(), SettingError> {
        Range::number(1e-6, 1.0, "").check("score.temper", self.temper)?;
        Range::number(0.0, 1.0, "").check("score.outlier", self.outlier)?;
        Range::number(1e-6, 1.0 - 1e-6, "").check("score.unknown", self.unknown)?;
        match self.kernel {
            Kernel::Gaussian => Ok(()),
            Kernel::Robust { most } => Range::number(1e-6, 1e6, "nats").check("score.kernel", most).map(drop),
        }
    }
}

impl<const CELLS_PER_NDT: usize> Score<Grid<CELLS_PER_NDT>> for ScanModel {
    type Near<'a> = ScanNear<'a, CELLS_PER_NDT>;

    fn near<'a>(
        &'a self,
        grid: &'a Grid<CELLS_PER_NDT>,
        place: &Pose2,
        scan: &'a Scan,
        stride: usize,
    ) -> ScanNear<'a, CELLS_PER_NDT> {
        let map = around(grid.present(), place, scan).with_distances().into();
        ScanNear { model: self, map, scan, thinned: scan.thinned(stride), share: stride as f64 }
    }

    /// By [`Grid::past`].
    fn log_old(&self, grid: &Grid<CELLS_PER_NDT>, world_from_robot: &Pose2, scan: &Scan) -> f64 {
        self.log_score(&grid.past(), world_from_robot, scan)
    }

    fn near_old(&self, grid: &Grid<CELLS_PER_NDT>, place: &Pose2, scan: &Scan) -> impl Fn(&Pose2) -> f64 {
        let map = RefCell::new(around(grid.past(), place, scan));
        move |pose| self.log_score_above(f64::NEG_INFINITY, &mut *map.borrow_mut(), pose, scan)
    }
}

/// What a scan can reach that was taken near this place.
fn around<const CELLS_PER_NDT: usize>(
    grid: Grid<CELLS_PER_NDT>,
    place: &Pose2,
    scan: &Scan,
) -> LocalMap<CELLS_PER_NDT> {
    let reach = scan.hits.iter().map(|[x, y]| x * x + y * y).fold(0.0, f64::max).sqrt();
    LocalMap::new(grid, [place.x, place.y], reach + SLACK)
}

/// How far from the place a pose may lie \[m\] and be looked up fast.
const SLACK: f64 = 1.0;

/// A scan against the part of a grid that it can reach from one place.
pub struct ScanNear<'a, const CELLS_PER_NDT: usize> {
    model: &'a ScanModel,
    map: RefCell<LocalMap<CELLS_PER_NDT>>,
    scan: &'a Scan,
    /// A part of the scan, of which each beam counts for `share`.
    thinned: Scan,
    share: f64,
}

impl<const CELLS_PER_NDT: usize> ScoreNear for ScanNear<'_, CELLS_PER_NDT> {
    fn log_score(&self, world_from_robot: &Pose2) -> f64 {
        self.model.log_score_above(f64::NEG_INFINITY, &mut *self.map.borrow_mut(), world_from_robot, self.scan)
    }

    fn log_score_above(&self, world_from_robot: &Pose2, floor: f64) -> f64 {
        let map = &mut *self.map.borrow_mut();
        self.share * self.model.log_score_above(floor / self.share, map, world_from_robot, &self.thinned)
    }

    /// By the distance of each end point from the nearest hit. The scan is turned once for all positions.
    fn coarse(&self, theta: f64, stride: usize) -> impl Fn([f64; 2]) -> f64 {
        let (sin, cos) = ops::sin_cos(theta);
        let k = self.map.borrow().per_ndt();
        let turn = |[x, y]: &[f64; 2]| [k * (cos * x - sin * y), k * (sin * x + cos * y)];
        let turned: Vec<[f64; 2]> = self.scan.hits.iter().step_by(stride.max(1)).map(turn).collect();
        // Each of the few beams counts for those left out.
        let share = self.scan.hits.len() as f64 / turned.len().max(1) as f64;
        move |position: [f64; 2]| {
            let [u, v] = position.map(|c| c * k);
            let map = self.map.borrow();
            let mut counts = [0_u32; MAX_DISTANCE + 1];
            for end in &turned {
                counts[map.distance(end[0] + u, end[1] + v)] += 1;
            }
            let sum: f64 = counts.iter().zip(LOG_COARSE).map(|(count, log)| f64::from(*count) * log).sum();
            share * (self.model.temper * sum)
        }
    }
}

/// ln p of an end point by its distance from the nearest hit \[NDT cells\], up to a constant \[nats\].
const LOG_COARSE: [f64; MAX_DISTANCE + 1] = [0.0, -0.5, -1.0, -1.5];

/// Where log-odds 0 stand in the table.
const UNKNOWN: i32 = 128;
