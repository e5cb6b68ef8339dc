//! What can be set about a mapper, and what a log tells of its laser.

use super::models::{self, CELL, MODELS, Map};
use crate::error::{Range, SettingError};
use crate::geometry::Pose2;
use crate::map::grid::GridModel;
use crate::matching::ScanModel;
use crate::motion::Displaced;
use crate::order::sorted;
use crate::proposal::{CorrelativeSearch, FromScan, IncrementalWeight};
use crate::resampling::ResamplePolicy;
use crate::sensor::{Beam, LaserScan, longest_reading};
use std::collections::BTreeSet;

/// Share of a log's longest range from which on a range says *nothing met*: lasers write their longest range then, or one a
/// little different (81.83, 80 and 81.91 m in one log).
pub(super) const NOTHING_MET: f64 = 0.97;

/// Settings of a [`LaserMapper`](super::LaserMapper). The defaults suit a building and a laser of 180°.
///
/// ```
/// use fastslam::mapper::{LaserMapper, LaserMapperSettings};
/// let settings = LaserMapperSettings { particles: 30, cell_size: 0.1, ..LaserMapperSettings::default() };
/// assert!(LaserMapper::new(settings).is_ok());
/// let error = LaserMapper::new(LaserMapperSettings { particles: 0, ..settings }).unwrap_err();
/// assert_eq!(error.to_string(), "particles = 0: must be a whole number from 1 to 4096");
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(default))]
pub struct LaserMapperSettings {
    /// Number of particles M, in [`Self::PARTICLES`]. Where a scan is taken every half metre, one does for a building: median errors over seeds, for M = 1, 2, 4, 8
    /// and 16, were 0.066, 0.066, 0.065, 0.066 and 0.065 m on the Intel log and 0.127, 0.109, 0.122, 0.132 and 0.140 m on that of ACES. The default is for the worst
    /// seed outdoors and where scans are a metre apart: of three of Freiburg's campus, 23, 8, 1, 7 and 3 % of the places seen again were off by more than half a
    /// metre, and of simulated loops of 120 m with a scan a metre eight particles close what one leaves open.
    pub particles: usize,
    /// Seed of the filter's draws: the same scans, settings and seed give the same map, bit for bit.
    pub seed: u64,
    /// Side of a cell \[m\], in [`Self::CELL_SIZE`].
    pub cell_size: f64,
    /// Readings beyond this \[m\], in [`Self::MAX_RANGE`], are not matched: up to it they say that the way is free.
    pub max_range: f64,
    /// Scans are passed over until the robot has driven this far \[m\], or turned by as many radians; in [`Self::MIN_TRAVEL`].
    /// One that has moved by less than [`Self::STILL`] is always taken to stand still.
    pub min_travel: f64,
    /// When the particles are resampled.
    pub policy: ResamplePolicy,
    /// What a particle pays for a scan.
    pub weight: IncrementalWeight,
    /// A reading of this length \[m\] or more, 0 or above, met nothing and says nothing: what it passed may be glass. `None` leaves
    /// it to what each scan declares, [`LaserScan::max_range`](crate::sensor::LaserScan::max_range); where it declares nothing,
    /// every finite reading met something.
    pub no_return: Option<f64>,
    /// How far the way is free \[m\] where nothing is in reach: of a reading of +∞, in [`Self::CLEAR_RANGE`]. 0: it says nothing.
    pub clear_range: f64,
    /// Beams of a scan: of a dense laser the search looks at fewer of them. `None` goes by the first scan.
    pub beams: Option<u32>,
    /// Whether drift and noise of the wheels are learnt along the way. `false` keeps to what is assumed of any wheels: for comparisons.
    pub learn_wheels: bool,
    /// About how many scans are mapped again when one is pushed, in [`Self::REMAPPED_PER_SCAN`], where a path is bent to close a loop: the corrected path takes over
    /// once it is mapped as far as the robot is. Work is counted and not time, so that results are the same on every machine. 0: all of them at once.
    /// A robot that maps as it drives wants some 100: of the 2,008 scans of the Freiburg campus, with 16 particles on two threads, the longest then took 0.11 s, and 1.6 s at 0.
    pub remapped_per_scan: u32,
    /// Most scans that are kept, in [`Self::KEPT_SCANS`]: where a path is bent, it is mapped again by them. Beyond that every second of them is let go, and again every
    /// second of what is left, but those of the last metres; [`Remark::Thinned`](super::Remark::Thinned) tells it, and [`LaserMapper::memory`](super::LaserMapper::memory)
    /// how many bytes they take. A bound of the default is reached by no recorded log that we know: scans of 180 beams take 150 MB there.
    pub kept_scans: u32,
}

impl Default for LaserMapperSettings {
    fn default() -> Self {
        Self {
            particles: 16,
            seed: 1,
            cell_size: CELL,
            max_range: 30.0,
            min_travel: 0.0,
            policy: ResamplePolicy::EssBelow(0.5),
            weight: MODELS.from_scan.weight,
            no_return: None,
            clear_range: 0.0,
            beams: None,
            learn_wheels: true,
            remapped_per_scan: 0,
            kept_scans: 100_000,
        }
    }
}

impl LaserMapperSettings {
    /// Range of [`Self::particles`].
    pub const PARTICLES: Range = Range::whole(1, 4096);
    /// Range of [`Self::cell_size`].
    pub const CELL_SIZE: Range = Range::number(0.02, 0.2, "m");
    /// Range of [`Self::max_range`].
    pub const MAX_RANGE: Range = Range::number(0.5, 200.0, "m");
    /// Range of [`Self::min_travel`].
    pub const MIN_TRAVEL: Range = Range::number(0.0, 5.0, "m");
    /// Way \[m\], or turn \[rad\], below which a robot stands still, whatever [`Self::min_travel`] says: another look from there tells nothing new.
    pub const STILL: f64 = 0.02;
    /// Range of [`Self::clear_range`].
    pub const CLEAR_RANGE: Range = Range::number(0.0, 200.0, "m");
    /// Range of [`Self::remapped_per_scan`]. Each path that is corrected gets two at the least, as the robot goes on by one.
    pub const REMAPPED_PER_SCAN: Range = Range::whole(0, 1_000_000);
    /// Range of [`Self::kept_scans`].
    pub const KEPT_SCANS: Range = Range::whole(100, 10_000_000);
    /// Range of [`Self::no_return`].
    const NO_RETURN: Range = Range::number(0.0, f64::INFINITY, "m");

    /// Whether every setting is in its range.
    ///
    /// # Errors
    /// [`SettingError::OutOfRange`] of the first that is not, by the name of its field.
    pub fn validate(&self) -> Result<(), SettingError> {
        Self::PARTICLES.check("particles", self.particles as f64)?;
        Self::CELL_SIZE.check("cell_size", self.cell_size)?;
        Self::MAX_RANGE.check("max_range", self.max_range)?;
        Self::MIN_TRAVEL.check("min_travel", self.min_travel)?;
        Self::CLEAR_RANGE.check("clear_range", self.clear_range)?;
        self.no_return.map_or(Ok(0.0), |length| Self::NO_RETURN.check("no_return", length))?;
        Self::REMAPPED_PER_SCAN.check("remapped_per_scan", f64::from(self.remapped_per_scan))?;
        Self::KEPT_SCANS.check("kept_scans", f64::from(self.kept_scans))?;
        self.policy.validate()
    }

    /// The same settings, with what is not said about the laser read off all scans of a log: [`Self::no_return`] is
    /// 0.97 times their [longest reading](longest_reading), as lasers write what they like for *nothing met*, and [`Self::beams`] their median.
    pub fn for_scans(self, scans: &[LaserScan]) -> Self {
        let beams = sorted(scans.iter().map(|scan| scan.ranges.len() as u32).collect(), Ord::cmp);
        Self {
            no_return: self.no_return.or_else(|| Some((NOTHING_MET * longest_reading(scans)).max(0.0))),
            beams: self.beams.or_else(|| beams.get(beams.len() / 2).copied()),
            ..self
        }
    }

    /// How the mapper's map learns from a scan.
    pub fn grid(&self) -> GridModel {
        models::grid(self.cell_size)
    }

    /// The proposal that the mapper's particles draw their poses from, and in it how well a scan fits a map: with a laser of [`Self::beams`], or of 180.
    pub fn proposal(&self) -> FromScan<Displaced, ScanModel, CorrelativeSearch> {
        models::proposal(self.beams.unwrap_or(MODELS.beams), self.weight)
    }

    /// Whether a scan is taken when the robot has moved by this since the one that was taken last.
    pub(super) fn takes(&self, moved: &Pose2) -> bool {
        moved.distance(&Pose2::default()).max(moved.theta.abs()) >= self.min_travel.max(Self::STILL)
    }

    /// A reading of this length \[m\] or more met nothing.
    pub(super) fn longest(&self) -> f64 {
        self.no_return.unwrap_or(f64::INFINITY)
    }

    /// How many scans are mapped again in a call.
    pub(super) fn remapped(&self) -> usize {
        if self.remapped_per_scan == 0 { usize::MAX } else { self.remapped_per_scan as usize }
    }

    /// What a scan says, beam by beam.
    pub(super) fn beams_of<'a>(&self, scan: &'a LaserScan) -> impl Iterator<Item = Option<Beam>> + use<'a> {
        scan.beams(self.longest(), self.max_range, self.clear_range)
    }

    /// About how many bytes the maps will take when these scans are mapped: for each particle all tiles that beams pass through by raw
    /// odometry, as particles that are selected seldom have long been apart. What they share makes it less; where odometry drifts it
    /// counts walls more than once. What is kept of maps from before to find loops by comes on top. It is no bound.
    pub fn memory_estimate(&self, scans: &[LaserScan]) -> u64 {
        /// NDT cells in a tile, about.
        const NDT_CELLS: usize = 12;
        let settings = self.for_scans(scans);
        let tile = f64::from(Map::TILE_CELLS) * settings.cell_size;
        let mut all = BTreeSet::new();
        for scan in scans {
            let origin = scan.origin();
            for Beam { end, length, .. } in settings.beams_of(scan).flatten().filter(|beam| beam.met) {
                // The tiles on the way are free space that is kept as well.
                let parts = (length / tile).ceil().max(1.0);
                for part in 0..=parts as u32 {
                    let share = f64::from(part) / parts;
                    let [x, y] =
                        scan.odometry.transform([0, 1].map(|k: usize| origin[k] + share * (end[k] - origin[k])));
                    all.insert(((x / tile).floor() as i64, (y / tile).floor() as i64));
                }
            }
        }
        (settings.particles * all.len() * Map::tile_bytes(NDT_CELLS)) as u64
    }
}
