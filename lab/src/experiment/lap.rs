//! The Apartment lap: to the far end of the corridor, round the sun room, and home through what is mapped by then. And, as two more
//! [`Course`]s, the rooms of an apartment, one after the other round its core, and the ring, a corridor round a block: through ground never
//! seen before, until the start comes in sight again.
//!
//! The filter is told where the lap starts and with what noise wheels and sensor err. It is never told the truth: that stays
//! in [`LapWorld`], and only the errors of a [`StepReport`] are taken from it.

mod course;
mod setup;
pub mod shared;
mod world;

pub use course::{Course, Route};
pub use setup::{LapSetup, ScanWeight};
pub use world::LapWorld;

use crate::digest::Digest;
use fastslam::error::{Range, SettingError};
use fastslam::execute::Executor;
use fastslam::geometry::{Pose2, align, rms};
use fastslam::map::grid::{Grid, GridModel};
use fastslam::map::{ConditionalMap, Footprint};
use fastslam::matching::{HillClimbSteps, ScanModel};
use fastslam::motion::OdometryModel;
use fastslam::particle::Particle;
use fastslam::proposal::{
    Either, FitLimits, FromMotion, FromScan, FromScanSettings, HeadingSeeds, IncrementalWeight, ProposalTrace,
    Proposed, ScanAtDraw,
};
use fastslam::rbpf::{Rbpf, Report};
use fastslam::resampling::ResamplePolicy;
use std::sync::Arc;

/// Steps of the apartment's lap, besides the start.
pub const STEPS: usize = 90;

/// How many particles a lap may have.
pub const PARTICLES: Range = Range::whole(1, 4096);

/// Steps of the ring and of the rooms, besides the start: round, and on along the first side.
pub const RING_STEPS: usize = 110;

/// Noise of the wheels at scale 1: α₁ \[–\], α₂ \[rad²/m²\], α₃ \[–\], α₄ \[m²/rad²\].
///
/// Chosen so that raw odometry drifts by metres: the median RMS of its position over a lap is 3.0 to 3.7 m.
pub const ALPHAS: [f64; 4] = [0.1, 0.12, 0.01, 0.01];

/// Beams of a scan, all around.
pub const BEAMS: usize = 72;

/// Longest range of a beam in the apartment \[m\].
pub const MAX_RANGE: f64 = 8.0;

/// Scans taken at the known start, before the first motion, while the robot turns by one beam's spacing.
///
/// They anchor the gauge. With one scan only, every particle's map is turned as a whole by the first errors of heading:
/// consistent with itself, and metres wrong at the far end. Looking between the beams matters as much as looking often:
/// repeated from one heading, the scans leave walls of separate dots, between which the next scan falls.
pub const START_SCANS: u32 = 30;

/// L: a scan is weighed against the map of so many scans ago, as in the mapper for lasers.
pub const LAG: u32 = 20;

/// How the map learns.
///
/// A pass weighs a ninth of a hit: in cells this wide most beams that pass a wall's cell pass beside the wall. With
/// −0.4, walls seen at a grazing angle wear away, and with the cell matcher one lap in ten drifts.
pub const GRID: GridModel = GridModel {
    cell_size: 0.3,
    log_odds_hit: 0.9,
    log_odds_pass: -0.1,
    log_odds_bounds: [-4.0, 4.0],
    ndt_std: 0.1,
    ndt_stretch: 1.0,
    lag: LAG,
    distance_reach: 0,
    ndt_forgets: false,
};

/// κ, where nothing else is set: the share of each beam's log-likelihood that counts. One for both proposals, both matchers and every M.
///
/// Near one, since surfaces are kept five times as wide as the sensor's noise and are a tempering of their own. At 0.15 the
/// matcher follows the odometry too long, and laps end metres off.
pub const TEMPER: f64 = 0.85;

/// ε: probability of a reading that has nothing to do with the map. Anything from 0.02 to 0.1 serves.
pub const OUTLIER: f64 = 0.05;

/// The measurement-aware proposal: one setting for every M and both matchers.
pub const FROM_SCAN: FromScanSettings<HeadingSeeds> = FromScanSettings {
    // Keeps R_t invertible at a stand, and lets a centimetre of slip be.
    motion_floor: [0.02, 0.02, 0.01],
    // With the spread of 3 σ one every 0.75 σ, some five degrees here: about the slope's width.
    search: HeadingSeeds { seeds: 8, climbs: 2 },
    // From a third of a cell down to two centimetres; the fit's first step takes over from there.
    climb: HillClimbSteps { linear: 0.08, angular: 0.04, halvings: 2 },
    hills: 1,
    climb_stride: 2,
    // e^½: an optimum less than two thirds better than the average pose is no optimum.
    minimum_improvement: 0.5,
    full_weight: 0.0,
    // From half a centimetre, below which there is nothing to see, to a third of a cell, the plateau of the cell matcher.
    limits: FitLimits { least: [0.005, 0.003], most: [0.1, 0.05] },
    weight: IncrementalWeight::NewGroundFree,
};

/// What one step did, and how far from the truth it led.
#[derive(Clone, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct StepReport {
    /// The step; 0 is the start.
    pub step: u32,
    /// ln p̂(z_t | z₁..ₜ₋₁) by the filter \[nats\], in which the matcher's score stands for the density of a scan; −∞ where the step
    /// explained nothing (`null` in JSON), 0 at the start.
    pub log_evidence: f64,
    /// N_eff before resampling.
    pub ess: f64,
    /// Normalised weights before resampling, by slot.
    pub weights: Vec<f64>,
    /// Slot that each particle was copied from, where the step resampled.
    pub ancestors: Option<Vec<u32>>,
    /// Slot of the best particle after the step.
    pub best: u32,
    /// RMS error of position over the best particle's path so far \[m\].
    pub rms_best: f64,
    /// The same after the best rigid motion of that path onto the truth \[m\]: what is left when map and path may be moved as a
    /// whole.
    pub rms_best_aligned: f64,
    /// RMS error of position of raw odometry so far \[m\].
    pub rms_odometry: f64,
    /// Distinct ancestors at step 0.
    pub lineage: u32,
    /// Particles whose matcher was trusted.
    pub matched: u32,
    /// Log weight increment of each slot before resampling \[nats\]; empty at the start.
    pub log_increments: Vec<f64>,
    /// How each slot came by its pose before resampling; empty at the start.
    pub traces: Vec<ProposalTrace>,
    /// Bytes of all maps, shared parts counted once.
    pub map_bytes_unique: u64,
    /// Bytes that dense maps, one for each particle, would take.
    pub map_bytes_dense: u64,
}

/// What a lap's filter draws poses from.
pub type Proposals =
    Either<FromMotion<OdometryModel, ScanAtDraw<ScanModel>>, FromScan<OdometryModel, ScanModel, HeadingSeeds>>;

/// The filter of a lap.
pub type Filter = Rbpf<Grid, Proposals>;

/// A lap under way. Cloning one is cheap: the world and the maps are shared.
#[derive(Clone, Debug)]
pub struct Lap {
    world: Arc<LapWorld>,
    filter: Filter,
    report: StepReport,
}

impl Lap {
    /// At the start, the first scans mapped.
    ///
    /// # Errors
    /// Where a setting is out of its range.
    pub fn new(setup: &LapSetup) -> Result<Self, SettingError> {
        setup.validate()?;
        Self::in_world(setup, Arc::new(setup.world()))
    }

    /// The same in a world that is there, whatever the course of the setup: one for several filters.
    ///
    /// # Errors
    /// Where a setting is out of its range.
    pub fn in_world(setup: &LapSetup, world: Arc<LapWorld>) -> Result<Self, SettingError> {
        setup.validate()?;
        let start = world.truth[0];
        let mut map = Grid::new(GRID);
        for (pose, scan) in &world.start_scans {
            map.assimilate(pose, scan, &());
        }
        map.settle();
        let filter = Rbpf::builder(map, setup.proposals())
            .particles(setup.particles)
            .seed(setup.seed)
            .start(start)
            .policy(setup.policy)
            .scheme(setup.scheme)
            .build()?;
        let uniform = Report {
            selection_ess: 0.0,
            step: 0,
            log_increments: Vec::new(),
            weights: filter.weights().as_slice().to_vec(),
            log_evidence: 0.0,
            ess: filter.weights().ess(),
            paths: Vec::new(),
            ancestors: None,
            ignored: 0,
            refused_control: false,
            traces: Vec::new(),
            associations: Vec::new(),
        };
        let mut lap = Self { world, filter, report: StepReport::default() };
        lap.report = lap.judge(uniform);
        Ok(lap)
    }

    /// The same lap, resampled by another policy from here on.
    pub fn with_policy(self, policy: ResamplePolicy) -> Self {
        Self { filter: self.filter.with_policy(policy), ..self }
    }

    /// The same lap, computed by another executor: the results are the same.
    pub fn with_executor(self, executor: Executor) -> Self {
        Self { filter: self.filter.with_executor(executor), ..self }
    }

    /// The same lap, where the drive goes on differently after the step that it is at: up to there the world is the same.
    pub fn with_world(self, world: Arc<LapWorld>) -> Self {
        Self { world, ..self }
    }

    /// The last step.
    pub fn step_count(&self) -> u32 {
        self.world.controls.len() as u32
    }

    /// Steps made so far.
    pub fn step_now(&self) -> u32 {
        self.particles()[0].path.step()
    }

    /// One step of the filter; `None` after the last.
    pub fn step(&mut self) -> Option<&StepReport> {
        self.step_by(None)
    }

    /// The same, where the draws of all slots are there: those of [`Self::propose`].
    pub fn step_by(&mut self, proposed: Option<Vec<Proposed<()>>>) -> Option<&StepReport> {
        let report = self.advance_by(proposed)?;
        self.report = self.judge(report);
        Some(&self.report)
    }

    /// One step of the filter, without a comparison with the truth: [`Self::report`] stays that of an earlier step.
    pub fn advance(&mut self) -> Option<Report<()>> {
        self.advance_by(None)
    }

    /// The same, where the draws of all slots are there.
    pub fn advance_by(&mut self, proposed: Option<Vec<Proposed<()>>>) -> Option<Report<()>> {
        let (control, scan) = self.world.told(self.step_now())?;
        let proposed = proposed.unwrap_or_else(|| self.filter.propose(control, scan, 0..self.particles().len()));
        Some(self.filter.step_proposed(control, scan, proposed))
    }

    /// What the particles in these slots draw in the next step; nothing after the last.
    pub fn propose(&self, slots: core::ops::Range<usize>) -> Vec<Proposed<()>> {
        let step = self.world.told(self.step_now());
        step.map_or_else(Vec::new, |(control, scan)| self.filter.propose(control, scan, slots))
    }

    /// One step of the filter, while there is one. Only the last is compared with the truth.
    pub fn follow(&mut self) {
        let report = self.advance().filter(|_| self.step_now() == self.step_count());
        if let Some(report) = report {
            self.report = self.judge(report);
        }
    }

    /// Compares the filter's newest state with the truth.
    fn judge(&self, report: Report<()>) -> StepReport {
        let best = self.best();
        let path = self.path(best);
        let truth = &self.world.truth[..path.len()];
        let gauge = align(&path, truth);
        let aligned: Vec<Pose2> = path.iter().map(|pose| gauge.compose(pose)).collect();
        let Footprint { unique, dense } = Grid::footprint(self.particles().iter().map(|p| &p.map));
        StepReport {
            step: report.step,
            log_evidence: report.log_evidence,
            ess: report.ess,
            weights: report.weights,
            ancestors: report.ancestors,
            best: best as u32,
            rms_best: rms(&path, truth),
            rms_best_aligned: rms(&aligned, truth),
            rms_odometry: rms(&self.world.odometry[..path.len()], truth),
            lineage: self.filter.lineage() as u32,
            matched: report.traces.iter().filter(|t| matches!(t, ProposalTrace::Matched { .. })).count() as u32,
            log_increments: report.log_increments,
            traces: report.traces,
            map_bytes_unique: unique,
            map_bytes_dense: dense,
        }
    }

    /// Report of the newest step.
    pub fn report(&self) -> &StepReport {
        &self.report
    }

    /// The truth, for drawing and judging.
    pub fn world(&self) -> &Arc<LapWorld> {
        &self.world
    }

    /// The filter, for those who watch it.
    pub fn filter(&self) -> &Filter {
        &self.filter
    }

    /// The particles, by slot.
    pub fn particles(&self) -> &[Particle<Grid>] {
        self.filter.particles()
    }

    /// Normalised weights as they are now, by slot: uniform after a resampling.
    pub fn weights(&self) -> &[f64] {
        self.filter.weights().as_slice()
    }

    /// Poses of one particle, step 0 to now.
    pub fn path(&self, slot: usize) -> Vec<Pose2> {
        self.particles()[slot].path.poses()
    }

    /// How far the robot truly is from the nearest particle \[m\].
    pub fn nearest_universe(&self) -> f64 {
        let truth = &self.world.truth[self.report.step as usize];
        self.particles().iter().map(|p| p.world_from_robot.distance(truth)).fold(f64::INFINITY, f64::min)
    }

    /// Slot of the best particle: of the largest weight along its path.
    pub fn best(&self) -> usize {
        self.filter.best()
    }

    /// Runs the lap to its end and shows every report, the present one first. Returns the end, and a fingerprint of every
    /// report, weight and pose on the way and of every particle's whole map at the end, bit for bit.
    pub fn run(mut self, mut show: impl FnMut(&StepReport)) -> (Self, Digest) {
        let mut digest = Digest::new();
        loop {
            show(&self.report);
            self.put(&mut digest);
            if self.step().is_none() {
                break;
            }
        }
        Grid::hash_all(self.particles().iter().map(|particle| &particle.map), &mut digest);
        (self, digest)
    }

    /// The fingerprint of [`Self::run`].
    pub fn trace(self) -> Digest {
        self.run(|_| ()).1
    }

    fn put(&self, digest: &mut Digest) {
        let r = &self.report;
        [r.step, r.best, r.lineage, r.matched].into_iter().for_each(|x| digest.u32(x));
        [r.ess, r.rms_best, r.rms_best_aligned, r.rms_odometry].into_iter().for_each(|x| digest.f64(x));
        r.weights.iter().for_each(|x| digest.f64(*x));
        r.ancestors.iter().flatten().for_each(|x| digest.u32(*x));
        for particle in self.particles() {
            let Pose2 { x, y, theta } = particle.world_from_robot;
            [x, y, theta].into_iter().for_each(|x| digest.f64(x));
        }
    }
}

#[cfg(test)]
mod tests;
