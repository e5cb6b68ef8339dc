//! The Apartment lap: to the far end of the corridor, round the sun room, and home through what is mapped by then. And, as two more
//! [`Course`]s, the rooms of an apartment, one after the other round its core, and the ring, a corridor round a block: through ground never
//! seen before, until the start comes in sight again.
//!
//! The filter is told where the lap starts and with what noise wheels and sensor err. It is never told the truth: that stays
//! in [`LapWorld`], and only the errors of a [`StepReport`] are taken from it.

use crate::digest::Digest;
use crate::experiment::ProposalKind;
use crate::experiment::ring::closing;
use crate::world::{Edits, FloorPlan, Motion, Steering, corners_cut_short, drive};
use crate::{WORLD_ODOMETRY, WORLD_SENSOR};
use fastslam::error::{Range, SettingError};
use fastslam::execute::Executor;
use fastslam::geometry::{Pose2, align, rms};
use fastslam::map::grid::{Grid, GridModel};
use fastslam::map::{ConditionalMap, Footprint};
use fastslam::matching::{HillClimbSteps, Matcher, ScanModel};
use fastslam::motion::{Odometry, OdometryModel};
use fastslam::particle::Particle;
use fastslam::proposal::{
    Either, FitLimits, FromMotion, FromScan, FromScanSettings, HeadingSeeds, IncrementalWeight, ProposalTrace,
    ScanAtDraw,
};
use fastslam::random::Stream;
use fastslam::rbpf::{Rbpf, Report};
use fastslam::resampling::{ResamplePolicy, Scheme};
use fastslam::sensor::{BeamSensor, Scan};
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

/// What a particle pays for a scan.
#[derive(
    Clone,
    Copy,
    PartialEq,
    Eq,
    Debug,
    Default,
    strum::Display,
    strum::EnumString,
    strum::VariantNames,
    strum::VariantArray,
)]
#[strum(serialize_all = "kebab-case", parse_err_ty = SettingError, parse_err_fn = unknown_weight)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
pub enum ScanWeight {
    /// That of the filter by name: FastSLAM 1.0 moves first and pays [`Self::Marginal`], ours looks first and pays what [`FROM_SCAN`] says.
    #[default]
    Usual,
    /// [`IncrementalWeight::Marginal`], whatever poses are drawn from.
    Marginal,
    /// [`IncrementalWeight::NewGroundFree`], whatever poses are drawn from.
    NewGroundFree,
    /// [`IncrementalWeight::OldMapAtDraw`], whatever poses are drawn from.
    OldMapAtDraw,
}

impl ScanWeight {
    /// What is paid where poses are drawn so.
    pub const fn by(self, proposal: ProposalKind) -> IncrementalWeight {
        match (self, proposal) {
            (Self::Usual, ProposalKind::Motion) | (Self::Marginal, _) => IncrementalWeight::Marginal,
            (Self::Usual, ProposalKind::Improved) => FROM_SCAN.weight,
            (Self::NewGroundFree, _) => IncrementalWeight::NewGroundFree,
            (Self::OldMapAtDraw, _) => IncrementalWeight::OldMapAtDraw,
        }
    }
}

fn unknown_weight(given: &str) -> SettingError {
    SettingError::unknown_word("weight", given, <ScanWeight as strum::VariantNames>::VARIANTS)
}

/// Where a lap is driven.
#[derive(
    Clone,
    Copy,
    PartialEq,
    Eq,
    Debug,
    Default,
    strum::Display,
    strum::EnumString,
    strum::VariantNames,
    strum::VariantArray,
)]
#[strum(serialize_all = "lowercase", parse_err_ty = SettingError, parse_err_fn = unknown_course)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "lowercase"))]
pub enum Course {
    /// Out along the corridor of [`FloorPlan::apartment`] and back: nearly all is seen from afar, and seen again.
    #[default]
    Apartment,
    /// Once round [`FloorPlan::ring`] and a little further, with a laser that sees no further than 3 m and two niches on each side of the
    /// block: for most of the way nothing seen has been seen before.
    Ring,
    /// Once round [`FloorPlan::rooms`] and a little further, from door to door, with a laser that sees no further than 3 m.
    Rooms,
}

fn unknown_course(given: &str) -> SettingError {
    SettingError::unknown_word("course", given, <Course as strum::VariantNames>::VARIANTS)
}

impl Course {
    /// Steps, besides the start.
    pub const fn steps(self) -> usize {
        match self {
            Self::Apartment => STEPS,
            Self::Ring | Self::Rooms => RING_STEPS,
        }
    }

    /// The step at which the loop closes: the first that sees the start again after a way on which nothing is seen twice. None in
    /// the apartment, where what was seen once is in sight nearly all the way.
    pub fn closing(self) -> Option<u32> {
        match self {
            Self::Apartment => None,
            Self::Ring | Self::Rooms => closing(&self.route()),
        }
    }

    /// The place and the way through it.
    pub fn route(self) -> Route {
        match self {
            Self::Apartment => Route {
                plan: FloorPlan::apartment(),
                way_points: WAY_POINTS.to_vec(),
                steps: STEPS,
                max_range: MAX_RANGE,
            },
            Self::Ring => Route::ring(2, 3.0),
            Self::Rooms => Route::rooms(),
        }
    }
}

/// A place, a way through it, and how far the laser sees there.
#[derive(Clone, PartialEq, Debug)]
pub struct Route {
    /// The place.
    pub plan: FloorPlan,
    /// What [`drive`] goes through \[m\].
    pub way_points: Vec<[f64; 2]>,
    /// Steps, besides the start.
    pub steps: usize,
    /// Longest range of a beam \[m\].
    pub max_range: f64,
}

impl Route {
    /// The ring with so many niches on each side of the block, 0 to 2, and a laser of this range \[m\]: round it against the clock, and
    /// on along the first side. [`RING_STEPS`] steps of some 0.3 m.
    pub fn ring(niches: usize, max_range: f64) -> Self {
        const CORNERS: [[f64; 2]; 6] = [[1.6, 0.9], [10.1, 0.9], [10.1, 7.1], [0.9, 7.1], [0.9, 0.9], [6.6, 0.9]];
        // A drive leaves a leg half-way to the corner: of legs as long as these, it would cut the block's corners.
        let way_points = corners_cut_short(&CORNERS, 1.2);
        Self { plan: FloorPlan::ring(niches), way_points, steps: RING_STEPS, max_range }
    }

    /// Once round [`FloorPlan::rooms`] against the clock and a little further, with a laser that sees no further than 3 m: a loop that
    /// closes in an apartment. 110 steps of some 0.3 m.
    pub fn rooms() -> Self {
        const CORNERS: [[f64; 2]; 11] = [
            [1.6, 1.5],
            [4.0, 1.5],
            [8.0, 1.7],
            [10.4, 1.7],
            [10.6, 7.5],
            [4.0, 7.3],
            [1.6, 7.3],
            [1.5, 3.0],
            [1.6, 1.5],
            [4.0, 1.5],
            [7.0, 1.6],
        ];
        let way_points = corners_cut_short(&CORNERS, 0.9);
        Self { plan: FloorPlan::rooms(), way_points, steps: RING_STEPS, max_range: 3.0 }
    }

    /// The same place and way after a rigid motion of the plane.
    pub fn moved(&self, motion: &Pose2) -> Self {
        let way_points = self.way_points.iter().map(|point| motion.transform(*point)).collect();
        Self { plan: self.plan.moved(motion), way_points, ..*self }
    }
}

/// What a reader can set.
#[derive(Clone, PartialEq, Debug)]
pub struct LapSetup {
    /// Where the lap is driven.
    pub course: Course,
    /// Number of particles M, 1 to 4096.
    pub particles: usize,
    /// Seed of the world's noise and of the filter's.
    pub seed: u64,
    /// Where new poses are drawn from.
    pub proposal: ProposalKind,
    /// What a particle pays for a scan.
    pub weight: ScanWeight,
    /// What an end point is compared with.
    pub matcher: Matcher,
    /// When to resample.
    pub policy: ResamplePolicy,
    /// How to resample.
    pub scheme: Scheme,
    /// Factor on the standard deviations of the odometry's noise, 0 to 10: of the world's, and of what the filter expects.
    pub odometry_scale: f64,
    /// Standard deviation of a range \[m\], 0 to 1.
    pub range_std: f64,
    /// κ: the share of each beam's log-likelihood that counts, 0.01 to 1.
    pub temper: f64,
    /// Whether a match that is hardly better than the average pose is doubted, and the pose drawn from the motion instead.
    pub guard: bool,
    /// What a reader has changed about the course.
    pub edits: Edits,
}

impl Default for LapSetup {
    fn default() -> Self {
        Self {
            course: Course::Apartment,
            particles: 16,
            seed: 3,
            proposal: ProposalKind::Improved,
            weight: ScanWeight::Usual,
            matcher: Matcher::SubCell,
            policy: ResamplePolicy::EssBelow(0.5),
            scheme: Scheme::Systematic,
            odometry_scale: 1.0,
            range_std: 0.02,
            temper: TEMPER,
            guard: true,
            edits: Edits::default(),
        }
    }
}

impl LapSetup {
    /// What the lap's figure opens with: an apartment's rooms, in which the universes differ until the loop closes and most of them die.
    /// The wheels are worse than those of the lap table, with which positions differ by centimetres at the closing: too little for the eye.
    pub fn opening() -> Self {
        Self { course: Course::Rooms, seed: 17, odometry_scale: 1.5, ..Self::default() }
    }

    /// Noise of the wheels.
    pub fn motion(&self) -> OdometryModel {
        OdometryModel { alphas: ALPHAS }.scaled(self.odometry_scale)
    }

    /// The world of this seed and these noises.
    pub fn world(&self) -> LapWorld {
        LapWorld::edited(&self.course.route(), &self.edits, self.seed, &self.motion(), self.range_std)
    }

    /// [`Self::world`], where that of another setup is there: what is equal in both is not computed again.
    pub fn world_like(&self, other: &Self, world: &Arc<LapWorld>) -> Arc<LapWorld> {
        let drive = |setup: &Self| (setup.course, setup.seed, setup.range_std);
        if drive(self) != drive(other) || self.edits != other.edits {
            return Arc::new(self.world());
        }
        if self.odometry_scale == other.odometry_scale {
            Arc::clone(world)
        } else {
            world.with_motion(&self.motion()).into()
        }
    }

    /// What the filter draws poses from.
    pub fn proposals(&self) -> Proposals {
        let motion = self.motion();
        let score = ScanModel::new(self.matcher, self.temper, OUTLIER);
        // The best of the search is never below its mean.
        let minimum_improvement = if self.guard { FROM_SCAN.minimum_improvement } else { 0.0 };
        let weight = self.weight.by(self.proposal);
        let settings = FromScanSettings { minimum_improvement, weight, ..FROM_SCAN };
        match self.proposal {
            ProposalKind::Motion => Either::Left(FromMotion { motion, likelihood: ScanAtDraw { score, weight } }),
            ProposalKind::Improved => Either::Right(FromScan { motion, score, settings }),
        }
    }

    /// Whether another setup differs in nothing but what is driven.
    pub fn but_for_steering(&self, other: &Self) -> bool {
        let mut same = other.clone();
        same.edits.steering = self.edits.steering.clone();
        same == *self
    }

    /// # Errors
    /// Where a setting is out of its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        PARTICLES.check("particles", self.particles as f64)?;
        Range::number(0.0, 10.0, "").check("odometry_scale", self.odometry_scale)?;
        Range::number(0.0, 1.0, "m").check("range_std", self.range_std)?;
        Range::number(0.01, 1.0, "").check("temper", self.temper)?;
        let route = self.course.route();
        self.edits
            .fit(&route.plan, route.steps)
            .map_err(|(field, error)| SettingError::Unfit { field, allowed: error.allowed() })?;
        self.policy.validate()
    }
}

/// The truth of one lap, and what sensors reported of it.
#[derive(Clone, Debug)]
pub struct LapWorld {
    /// The place.
    pub plan: FloorPlan,
    /// The laser.
    pub sensor: BeamSensor,
    /// True poses of step 0 to the last.
    pub truth: Vec<Pose2>,
    /// Poses by raw odometry alone, from the same start.
    pub odometry: Vec<Pose2>,
    /// Reported controls; the k-th leads from step k to k + 1.
    pub controls: Vec<Odometry>,
    /// Scans of step 1 to the last.
    pub scans: Vec<Scan>,
    /// Scans taken at the start, with the poses they were taken from.
    pub start_scans: Vec<(Pose2, Scan)>,
    /// Steps at which a wall kept the robot where it was, in ascending order: its wheels stood.
    pub stopped: Vec<u32>,
    /// Steps at which the robot was lifted and set down elsewhere, in ascending order: its wheels did not notice.
    pub lifted: Vec<u32>,
    /// Controls without their noise.
    felt: Vec<Odometry>,
    noise: Noise,
}

/// What errs in a world, and by which seed.
#[derive(Clone, Copy, Debug)]
struct Noise {
    seed: u64,
    motion: OdometryModel,
}

impl LapWorld {
    /// The lap of the apartment that this seed and these noises give: the truth is always the same.
    pub fn new(seed: u64, motion: &OdometryModel, range_std: f64) -> Self {
        Self::on(&Course::Apartment.route(), seed, motion, range_std)
    }

    /// The same on another route.
    pub fn on(route: &Route, seed: u64, motion: &OdometryModel, range_std: f64) -> Self {
        Self::edited(route, &Edits::default(), seed, motion, range_std)
    }

    /// The same with walls and a drive of a reader's own, which fit to the route.
    pub fn edited(route: &Route, edits: &Edits, seed: u64, motion: &OdometryModel, range_std: f64) -> Self {
        let plan = edits.walls.apply(&route.plan);
        let sensor = BeamSensor::panorama(BEAMS, route.max_range, range_std);
        let way = drive(&route.way_points, route.steps);
        let mut world = Self {
            plan,
            sensor,
            truth: vec![way[0]],
            odometry: vec![way[0]],
            controls: Vec::with_capacity(STEPS),
            scans: Vec::with_capacity(STEPS),
            start_scans: Vec::new(),
            stopped: Vec::new(),
            lifted: Vec::new(),
            felt: Vec::with_capacity(STEPS),
            noise: Noise { seed, motion: *motion },
        };
        let turned = |k: u32| {
            let spacing = core::f64::consts::TAU / BEAMS as f64;
            way[0].compose(&Pose2::new(0.0, 0.0, spacing * f64::from(k) / f64::from(START_SCANS)))
        };
        world.start_scans = (0..START_SCANS).map(|k| (turned(k), world.look(&turned(k), 0, k))).collect();
        world.drive_on(&way, &edits.steering);
        world
    }

    /// The same place and noise with another drive on the same route: the steps that it has in common with the one `before` are
    /// those of this world, and only the others are computed.
    pub fn driven(&self, route: &Route, before: &Steering, steering: &Steering) -> Self {
        let mut world = self.clone();
        let kept = before.in_common(steering, route.steps).min(world.controls.len());
        world.truth.truncate(kept + 1);
        world.odometry.truncate(kept + 1);
        world.controls.truncate(kept);
        world.felt.truncate(kept);
        world.scans.truncate(kept);
        world.stopped.retain(|step| *step as usize <= kept);
        world.lifted.retain(|step| *step as usize <= kept);
        world.drive_on(&drive(&route.way_points, route.steps), steering);
        world
    }

    /// Drives the steps that are not driven yet: the course's `way` as far as that is asked for, and then motion by motion.
    fn drive_on(&mut self, way: &[Pose2], steering: &Steering) {
        let course = steering.of_course(way.len() - 1);
        while self.controls.len() < course {
            let step = self.controls.len();
            // Kept by a wall, the robot does not find the way again.
            let to = (self.truth[step] == way[step]).then(|| way[step + 1]);
            self.advance(to, Odometry::between);
        }
        while let Some(motion) = steering.motions().get(self.controls.len() - course) {
            let here = self.truth[self.controls.len()];
            let to = motion.from(&here);
            match motion {
                Motion::Lift(_) => {
                    self.lifted.push(self.controls.len() as u32 + 1);
                    self.step(to, Odometry::between(&here, &here));
                }
                // By the way round, it would be half a turn, and another.
                Motion::Back => self.advance(Some(to), |from, to| Odometry::recorded(from, to, f64::EPSILON)),
                Motion::Turn(_) | Motion::Go(_) => self.advance(Some(to), Odometry::between),
            }
        }
    }

    /// A step to a pose, if nothing is in the way.
    fn advance(&mut self, to: Option<Pose2>, wheels: impl Fn(&Pose2, &Pose2) -> Odometry) {
        let here = self.truth[self.controls.len()];
        let open = to.filter(|to| self.plan.is_open([here.x, here.y], [to.x, to.y]));
        if open.is_none() {
            self.stopped.push(self.controls.len() as u32 + 1);
        }
        let to = open.unwrap_or(here);
        self.step(to, wheels(&here, &to));
    }

    /// A step of the truth, of which the wheels feel `felt`.
    fn step(&mut self, to: Pose2, felt: Odometry) {
        let step = self.controls.len() + 1;
        self.felt.push(felt);
        self.report(&felt);
        self.truth.push(to);
        self.scans.push(self.look(&to, step, 0));
    }

    /// The next control with its noise.
    fn report(&mut self, felt: &Odometry) {
        let step = self.controls.len() + 1;
        let mut stream = Stream::at(self.noise.seed, WORLD_ODOMETRY, step as u32, 0);
        let control = self.noise.motion.perturb(felt, &mut stream);
        self.odometry.push(control.apply(&self.odometry[step - 1]));
        self.controls.push(control);
    }

    /// The same drive and scans with other odometry noise.
    fn with_motion(&self, motion: &OdometryModel) -> Self {
        let mut world = self.clone();
        world.noise.motion = *motion;
        world.odometry.truncate(1);
        world.controls.clear();
        self.felt.iter().for_each(|felt| world.report(felt));
        world
    }

    fn look(&self, pose: &Pose2, step: usize, look: u32) -> Scan {
        let mut stream = Stream::at(self.noise.seed, WORLD_SENSOR, step as u32, look);
        self.sensor.scan(&self.plan.ranges(pose, &self.sensor, &mut stream))
    }
}

/// Out from the west end of the corridor, round the sun room, and back \[m\].
const WAY_POINTS: [[f64; 2]; 9] =
    [[0.7, 4.6], [8.6, 4.6], [9.9, 4.9], [10.1, 6.2], [9.6, 7.6], [10.9, 7.3], [10.6, 5.6], [10.0, 4.8], [0.9, 4.75]];

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

    /// One step of the filter; `None` after the last.
    pub fn step(&mut self) -> Option<&StepReport> {
        let k = self.report.step as usize;
        let (control, scan) = (self.world.controls.get(k)?, self.world.scans.get(k)?);
        let report = self.filter.step(control, scan);
        self.report = self.judge(report);
        Some(&self.report)
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
