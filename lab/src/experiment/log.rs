//! A log, mapped: the filter of the lap, its matcher and its maps, on what a robot drove and saw.
//!
//! One setting for every log, robot and laser: nothing here is to be tuned to a building.

use super::lap::LAG;
use crate::digest::Digest;
use crate::world::{FloorPlan, corners_cut_short, drive};
use crate::{WORLD_ODOMETRY, WORLD_SENSOR};
use core::f64::consts::PI;
use fastslam::error::{Range, SettingError};
use fastslam::execute::Executor;
use fastslam::genealogy::Path;
use fastslam::geometry::Pose2;
use fastslam::log::{LaserLog, Relation};
use fastslam::map::grid::{Grid, GridModel};
use fastslam::map::{ConditionalMap, Footprint};
use fastslam::matching::{HillClimbSteps, Kernel, Matcher, ScanModel};
use fastslam::motion::{Odometry, OdometryModel};
use fastslam::particle::Particle;
use fastslam::proposal::{CorrelativeSearch, FitLimits, FromScan, FromScanSettings, ProposalTrace};
use fastslam::random::Stream;
use fastslam::rbpf::{Rbpf, Report};
use fastslam::resampling::ResamplePolicy;
use fastslam::sensor::BeamSensor;
use std::collections::BTreeSet;
use std::sync::Arc;

/// Cells along a side of a square that keeps one surface: squares of 0.2 m with the default cells. Much smaller ones hold too few
/// hits to tell which way a wall runs, much larger ones more than one wall.
pub const CELLS_PER_NDT: usize = 4;

/// A particle's map.
pub type LogMap = Grid<CELLS_PER_NDT>;

/// The filter of a log.
pub type Filter = Rbpf<LogMap, FromScan<OdometryModel, ScanModel, CorrelativeSearch>>;

/// Noise of the wheels: 0.2 rad a radian of turns, 0.1 rad and 0.1 m a metre. Wide on purpose: real wheels slip, and are off by
/// a bias that no noise describes (some 4° a metre in one log). Too wide a prior only costs time.
pub const ALPHAS: [f64; 4] = [0.04, 0.01, 0.01, 0.01];

/// κ: the share of each beam's log-likelihood that counts. A real log is mapped as well with 0.5; with 0.3 the odometry's bias
/// pulls at every pose, and its errors grow by half.
pub const TEMPER: f64 = 0.85;

/// ε: probability of a reading that has nothing to do with the map.
pub const OUTLIER: f64 = 0.05;

/// How many times further than its end points a surface reaches. End points spread evenly over a square have a standard deviation
/// of 0.29 of its side: with 3 a surface is felt into the next square, and a wall is one wall. With 1, scans of new
/// walls fitted a place half a metre off better than their own.
pub const NDT_STRETCH: f64 = 3.0;

/// What a distance from a surface costs. With c = 1 the pull is greatest at √⅔ σ, and at 2 σ half of that is left.
pub const KERNEL: Kernel = Kernel::Robust { most: 1.0 };

/// The proposal, for a laser of [`BEAMS`] beams.
pub const FROM_SCAN: FromScanSettings<CorrelativeSearch> = FromScanSettings {
    motion_floor: [0.02, 0.02, 0.01],
    // Half a square, and as much at 3 m. Three starts: of two, one is often the neighbour of the other's hill.
    search: CorrelativeSearch { linear: 0.1, angular: 0.035, stride: 4, climbs: 3 },
    // From half the lattice's step down to half a centimetre.
    climb: HillClimbSteps { linear: 0.05, angular: 0.02, halvings: 3 },
    climb_stride: 2,
    minimum_improvement: 0.5,
    full_weight: 0.5,
    limits: FitLimits { least: [0.005, 0.003], most: [0.05, 0.03] },
};

/// Beams for which [`FROM_SCAN`] is made. Of a denser laser the search takes fewer: neighbours tell it the same.
const BEAMS: usize = 180;

/// [`FROM_SCAN`] with strides for the beams of a log.
fn from_scan(log: &LaserLog) -> FromScanSettings<CorrelativeSearch> {
    let mut beams: Vec<usize> = log.scans.iter().map(|scan| scan.ranges.len()).collect();
    let middle = beams.len() / 2;
    let times = ((*beams.select_nth_unstable(middle).1 + BEAMS / 2) / BEAMS).max(1);
    let mut settings = FROM_SCAN;
    settings.climb_stride *= times;
    settings.search.stride *= times;
    settings
}

/// A robot that has moved by less than this \[m, or rad\] stands still: another look from there tells nothing new.
pub const STILL: f64 = 0.02;

/// Share of the longest range from which on a reading says *nothing met*: lasers write that range, or one a little different
/// (81.83, 80 and 81.91 m in one log).
pub const NOTHING_MET: f64 = 0.97;

/// What a reader can set.
#[derive(Clone, PartialEq, Debug)]
pub struct LogSetup {
    /// Number of particles M, 1 to 4096.
    pub particles: usize,
    /// Seed of the filter's draws.
    pub seed: u64,
    /// Side of a cell \[m\], 0.02 to 0.2.
    pub cell_size: f64,
    /// Ranges beyond this \[m\], 0.5 to 200, are not matched: up to it they say that the way is free.
    pub max_range: f64,
    /// Scans are passed over until the robot has driven this far \[m\], or turned by as many radians, 0 to 5.
    pub min_travel: f64,
    /// When the particles are resampled.
    pub policy: ResamplePolicy,
}

impl Default for LogSetup {
    fn default() -> Self {
        Self {
            particles: 16,
            seed: 1,
            cell_size: 0.05,
            max_range: 30.0,
            min_travel: 0.0,
            policy: ResamplePolicy::EssBelow(0.5),
        }
    }
}

impl LogSetup {
    fn validate(&self) -> Result<(), SettingError> {
        Range::whole(1, 4096).check("particles", self.particles as f64)?;
        Range::number(0.02, 0.2, "m").check("cell_size", self.cell_size)?;
        Range::number(0.5, 200.0, "m").check("max_range", self.max_range)?;
        Range::number(0.0, 5.0, "m").check("min_travel", self.min_travel)?;
        self.policy.validate()
    }
}

/// What one step did.
#[derive(Clone, Debug)]
pub struct LogStep {
    /// The step, from 1 on.
    pub step: u32,
    /// ln p̂(z_t | z₁..ₜ₋₁) by the filter \[nats\], in which the matcher's score stands for the density of a scan; −∞ where the step
    /// explained nothing.
    pub log_evidence: f64,
    /// N_eff before resampling.
    pub ess: f64,
    /// Whether the step resampled.
    pub resampled: bool,
    /// Particles whose matcher was trusted.
    pub matched: u32,
    /// Distinct ancestors at the start.
    pub lineage: u32,
    /// Paths of the particles that the step let die: the filter does not keep them.
    pub extinct: Vec<Path>,
}

/// A log under way.
#[derive(Clone, Debug)]
pub struct LogRun {
    log: Arc<LaserLog>,
    setup: LogSetup,
    /// Numbers of the scans that the filter takes, the first included.
    used: Arc<Vec<u32>>,
    /// Readings from this on \[m\] say that nothing was met.
    longest: f64,
    filter: Filter,
    step: u32,
    resampled: u32,
    lineage_one_scan: Option<u32>,
}

impl LogRun {
    /// At the log's start, which is the origin, with the first scan mapped.
    ///
    /// # Errors
    /// Where a setting is out of its range, or the log has no scan.
    pub fn new(setup: &LogSetup, log: Arc<LaserLog>) -> Result<Self, SettingError> {
        setup.validate()?;
        let Some(first) = log.scans.first() else {
            return Err(SettingError::Missing { field: "log", needed: "at least one scan" });
        };
        let longest = NOTHING_MET * log.longest_reading();
        let mut map = LogMap::new(GridModel {
            cell_size: setup.cell_size,
            log_odds_hit: 0.9,
            log_odds_pass: -0.4,
            ndt_std: 0.06,
            ndt_stretch: NDT_STRETCH,
            lag: LAG,
            distance_reach: 2,
        });
        map.assimilate(&Pose2::default(), &first.end_points(longest, setup.max_range), &());
        map.settle();
        let score = ScanModel::new(Matcher::SubCell, TEMPER, OUTLIER).with_kernel(KERNEL);
        let motion = OdometryModel { alphas: ALPHAS };
        let filter = Rbpf::builder(map, FromScan { motion, score, settings: from_scan(&log) })
            .particles(setup.particles)
            .seed(setup.seed)
            .policy(setup.policy)
            .build()?;
        let used = Arc::new(used(&log, setup.min_travel.max(STILL)));
        let lineage_one_scan = (setup.particles == 1).then_some(0);
        Ok(Self { log, setup: setup.clone(), used, longest, filter, step: 0, resampled: 0, lineage_one_scan })
    }

    /// The same run, computed by another executor: the results are the same.
    pub fn with_executor(self, executor: Executor) -> Self {
        Self { filter: self.filter.with_executor(executor), ..self }
    }

    /// The last step.
    pub fn step_count(&self) -> u32 {
        self.used.len() as u32 - 1
    }

    /// One scan of the log; `None` after the last.
    pub fn step(&mut self) -> Option<LogStep> {
        let to = &self.log.scans[*self.used.get(self.step as usize + 1)? as usize];
        let from = &self.log.scans[self.used[self.step as usize] as usize];
        let control = Odometry::recorded(&from.odometry, &to.odometry, STILL);
        let report = self.filter.step(&control, &to.end_points(self.longest, self.setup.max_range));
        self.step = report.step;
        let lineage = self.filter.lineage() as u32;
        if lineage == 1 {
            self.lineage_one_scan.get_or_insert(report.step);
        }
        let resampled = report.ancestors.is_some();
        self.resampled += u32::from(resampled);
        let matched = report.traces.iter().filter(|t| matches!(t, ProposalTrace::Matched { .. })).count() as u32;
        let extinct = report.extinct().cloned().collect();
        let Report { step, log_evidence, ess, .. } = report;
        Some(LogStep { step, log_evidence, ess, resampled, matched, lineage, extinct })
    }

    /// The filter, for those who watch it.
    pub fn filter(&self) -> &Filter {
        &self.filter
    }

    /// The particles, by slot.
    pub fn particles(&self) -> &[Particle<LogMap>] {
        self.filter.particles()
    }

    /// The best particle's map.
    pub fn map(&self) -> &LogMap {
        &self.particles()[self.filter.best()].map
    }

    /// The best particle's path, a pose for each scan so far with its time \[s\], in the frame of the first. A scan that was passed
    /// over has the pose of the scan before, moved by raw odometry.
    pub fn path(&self) -> Vec<(f64, Pose2)> {
        let poses = self.particles()[self.filter.best()].path.poses();
        let ends = self.used[1..].iter().map(|next| *next as usize).chain([self.log.scans.len()]);
        let mut path = Vec::new();
        for ((pose, first), end) in poses.iter().zip(self.used.iter()).zip(ends) {
            let scans = &self.log.scans[*first as usize..end];
            path.extend(scans.iter().map(|s| (s.time, pose.compose(&scans[0].odometry.between(&s.odometry)))));
        }
        path
    }

    /// Share of the steps so far that resampled.
    pub fn resampled_fraction(&self) -> f64 {
        f64::from(self.resampled) / f64::from(self.step.max(1))
    }

    /// First step at which all particles descend from one, if they do.
    pub fn lineage_one_scan(&self) -> Option<u32> {
        self.lineage_one_scan
    }

    /// Bytes of all maps.
    pub fn footprint(&self) -> Footprint {
        LogMap::footprint(self.particles().iter().map(|p| &p.map))
    }

    /// Fingerprint of the weights and of every particle's path and whole map, bit for bit.
    pub fn digest(&self) -> Digest {
        let mut digest = Digest::new();
        self.filter.weights().as_slice().iter().for_each(|w| digest.f64(*w));
        for particle in self.particles() {
            for pose in particle.path.poses() {
                [pose.x, pose.y, pose.theta].into_iter().for_each(|x| digest.f64(x));
            }
        }
        LogMap::hash_all(self.particles().iter().map(|particle| &particle.map), &mut digest);
        digest
    }
}

/// Numbers of the scans that are at least so far \[m, or rad\] from the one taken before them; the first always.
fn used(log: &LaserLog, travel: f64) -> Vec<u32> {
    let mut used = vec![0];
    let mut last = log.scans[0].odometry;
    for (k, scan) in (0..).zip(&log.scans).skip(1) {
        let moved = last.between(&scan.odometry);
        if moved.distance(&Pose2::default()).max(moved.theta.abs()) >= travel {
            used.push(k);
            last = scan.odometry;
        }
    }
    used
}

/// About how many bytes the maps of a run will take: the tiles that end points fall into by raw odometry once, and for
/// each particle those of two scans. Where odometry drifts it counts walls more than once; it is no bound.
pub fn memory_estimate(setup: &LogSetup, log: &LaserLog) -> u64 {
    /// NdtField in a tile, about.
    const SURFACES: usize = 12;
    let tile = f64::from(LogMap::TILE_CELLS) * setup.cell_size;
    let longest = NOTHING_MET * log.longest_reading();
    let mut all = BTreeSet::new();
    let mut most = 0;
    for scan in &log.scans {
        let pose = &scan.odometry;
        let mut tiles = BTreeSet::new();
        for end in scan.end_points(longest, setup.max_range).hits {
            // The tiles on the way are free space that is kept as well.
            let length = fastslam::ops::hypot(end[0], end[1]);
            let parts = (length / tile).ceil().max(1.0);
            for part in 0..=parts as u32 {
                let share = f64::from(part) / parts;
                let [x, y] = pose.transform([end[0] * share, end[1] * share]);
                tiles.insert(((x / tile).floor() as i64, (y / tile).floor() as i64));
            }
        }
        most = tiles.len().max(most);
        all.extend(tiles);
    }
    // A particle that lives on beside others differs from them by a few scans, which overlap.
    ((all.len() + 2 * setup.particles * most) * LogMap::tile_bytes(SURFACES)) as u64
}

/// How a log of our own comes about.
#[derive(Clone, PartialEq, Debug)]
pub struct Recipe {
    /// Seed of the noises.
    pub seed: u64,
    /// Where.
    pub plan: FloorPlan,
    /// Way points \[m\].
    pub route: Vec<[f64; 2]>,
    /// How far from its way the robot looks at first \[rad\]; it turns on the spot before it drives. A map begins with the
    /// first pose, so by this angle the building lies askew in its cells.
    pub askew: f64,
    /// From one scan to the next \[m\].
    pub spacing: f64,
    /// Beams of the laser, at least two, from right to left: 2 n of them from −90° on by π / n, or 2 n + 1 with +90° too.
    pub beams: u32,
    /// Longest range of the laser \[m\].
    pub max_range: f64,
    /// Standard deviation of a range \[m\].
    pub range_std: f64,
    /// Share of the beams, 0 to 1, that end before the wall, anywhere from a fifth of the way on: people who walk by.
    pub people: f64,
    /// Noise of the wheels.
    pub wheels: OdometryModel,
    /// What the wheels turn too far on every metre \[rad/m\].
    pub bias: f64,
    /// Share of the steps, 0 to 1, in which a wheel slips: the drive is reported 0.1 m too long, and a turn of up to 0.1 rad to
    /// either side that was none.
    pub slip: f64,
}

impl Recipe {
    /// A robot with a laser of 180 beams in [`FloorPlan::building`], twice round its corridors.
    pub fn building() -> Self {
        Self {
            seed: 17,
            plan: FloorPlan::building(),
            route: ROUTE.to_vec(),
            askew: 0.0,
            spacing: 0.35,
            beams: 180,
            max_range: 30.0,
            range_std: 0.015,
            people: 0.0,
            wheels: OdometryModel { alphas: [0.01, 0.0004, 0.002, 0.001] },
            bias: 0.0,
            slip: 0.0,
        }
    }

    /// Where the robot is, for each scan.
    fn truth(&self) -> Vec<Pose2> {
        /// From a corner, where the robot begins to cut it \[m\].
        const NEAR: f64 = 1.2;
        /// On the spot, from one scan to the next \[rad\].
        const TURN: f64 = PI / 12.0;
        let length: f64 =
            self.route.windows(2).map(|l| fastslam::ops::hypot(l[1][0] - l[0][0], l[1][1] - l[0][1])).sum();
        let way = drive(&corners_cut_short(&self.route, NEAR), (length / self.spacing) as usize);
        let turns = (self.askew.abs() / TURN).ceil() as u32;
        let left = |k: u32| self.askew * f64::from(turns - k) / f64::from(turns);
        let on_the_spot = (0..turns).map(|k| Pose2::new(way[0].x, way[0].y, way[0].theta + left(k)));
        on_the_spot.chain(way.iter().copied()).collect()
    }

    /// What the wheels report of a drive, the step-th.
    fn reported(&self, driven: &Odometry, step: u32) -> Odometry {
        let mut reported = self.wheels.perturb(driven, &mut Stream::at(self.seed, WORLD_ODOMETRY, step, 0));
        reported.rot2 += self.bias * driven.trans;
        let mut stream = Stream::at(self.seed, WORLD_ODOMETRY, step, 1);
        if stream.uniform() < self.slip {
            reported.trans += 0.1;
            reported.rot2 += 0.2 * (stream.uniform() - 0.5);
        }
        reported
    }

    /// Ranges \[m\] at a pose, of the step-th scan; the longest where nothing is met.
    fn ranges(&self, pose: &Pose2, sensor: &BeamSensor, step: u32) -> Vec<f64> {
        let mut ranges = self.plan.ranges(pose, sensor, &mut Stream::at(self.seed, WORLD_SENSOR, step, 0));
        let mut stream = Stream::at(self.seed, WORLD_SENSOR, step, 1);
        for range in &mut ranges {
            *range = range.min(sensor.max_range);
            if stream.uniform() < self.people {
                *range *= 0.2 + 0.8 * stream.uniform();
            }
        }
        ranges
    }
}

/// A log of our own, free to ship.
#[derive(Clone, Debug)]
pub struct Example {
    /// What the robot reported.
    pub log: LaserLog,
    /// Where it was, for each scan.
    pub truth: Vec<Pose2>,
    /// True relations between neighbouring scans, and between scans of one place at different times.
    pub relations: Vec<Relation>,
}

impl Example {
    /// By [`Recipe::building`]: always the same; of its key scans the first so many.
    pub fn new(scans: usize) -> Self {
        Self::of(&Recipe::building(), scans)
    }

    /// By a recipe; of its key scans the first so many.
    ///
    /// # Panics
    /// For fewer than two beams or way points, or a spacing longer than the route.
    pub fn of(recipe: &Recipe, scans: usize) -> Self {
        /// \[s\]
        const INTERVAL: f64 = 0.7;
        /// Scans between two that see a place at different times.
        const APART: usize = 60;
        let mut truth = recipe.truth();
        truth.truncate(scans);
        let half = recipe.beams / 2;
        assert!(half > 0, "a laser of ours needs two beams");
        let angle_step = PI / f64::from(2 * half);
        let angles = (0..recipe.beams).map(|k| (f64::from(k) - f64::from(half)) * angle_step).collect();
        let sensor = BeamSensor { angles, max_range: recipe.max_range, range_std: recipe.range_std };
        let mut log = LaserLog::default();
        let mut odometry = Pose2::default();
        for (step, pose) in (0..).zip(&truth) {
            if step > 0 {
                let driven = Odometry::between(&truth[step as usize - 1], pose);
                odometry = recipe.reported(&driven, step).apply(&odometry);
            }
            // With the digits that a file has: what is read from it is the same log.
            let odometry =
                Pose2 { x: rounded(odometry.x, 1e3), y: rounded(odometry.y, 1e3), theta: rounded(odometry.theta, 1e4) };
            let time = rounded(1_000_000_000.0 + INTERVAL * f64::from(step), 1e2);
            let ranges = recipe.ranges(pose, &sensor, step);
            let ranges = ranges.iter().map(|range| rounded(*range, 1e2) as f32).collect();
            log.odometry.push((time, odometry));
            log.scans.push(fastslam::log::LaserScan {
                time,
                odometry,
                robot_from_laser: Pose2::default(),
                first_angle: -0.5 * PI,
                angle_step,
                max_range: None,
                ranges,
            });
        }
        let relation = |a: usize, b: usize| Relation {
            times: [log.scans[a].time, log.scans[b].time],
            first_from_second: truth[a].between(&truth[b]),
        };
        let mut relations: Vec<Relation> = (1..truth.len()).map(|k| relation(k - 1, k)).collect();
        for k in APART..truth.len() {
            let near =
                (0..=k - APART).min_by(|a, b| truth[*a].distance(&truth[k]).total_cmp(&truth[*b].distance(&truth[k])));
            relations.extend(near.filter(|near| truth[*near].distance(&truth[k]) < 1.0).map(|near| relation(near, k)));
        }
        Self { log, truth, relations }
    }
}

/// To so many parts of one.
fn rounded(x: f64, parts: f64) -> f64 {
    (x * parts).round() / parts
}

/// Through the building \[m\]: round its west half, round its east half, then all round, and home.
const ROUTE: [[f64; 2]; 30] = [
    [6.0, 10.0],
    [6.0, 17.9],
    [19.8, 17.9],
    [20.0, 12.0],
    [20.1, 6.2],
    [12.5, 6.1],
    [12.0, 3.0],
    [13.8, 2.6],
    [13.6, 6.0],
    [6.1, 6.0],
    [5.9, 12.0],
    [6.2, 18.0],
    [20.0, 18.0],
    [33.0, 17.8],
    [33.9, 12.0],
    [37.0, 11.8],
    [37.4, 13.4],
    [34.0, 12.8],
    [33.8, 6.2],
    [20.2, 6.0],
    [19.9, 12.0],
    [20.0, 17.9],
    [26.0, 18.2],
    [26.4, 21.4],
    [28.0, 21.2],
    [27.8, 17.9],
    [33.8, 18.0],
    [34.0, 6.1],
    [6.0, 6.2],
    [6.1, 10.5],
];

/// Runs whose fingerprints are kept with the tests.
pub fn golden_runs() -> Vec<(&'static str, LogRun)> {
    let log = Arc::new(Example::new(40).log);
    let run = |setup: LogSetup| LogRun::new(&setup, Arc::clone(&log)).expect("a golden setup is valid");
    vec![
        ("log", run(LogSetup { particles: 5, ..LogSetup::default() })),
        (
            "log-sparse",
            run(LogSetup { particles: 3, min_travel: 0.8, cell_size: 0.1, max_range: 6.0, ..LogSetup::default() }),
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastslam::log::relation_errors;

    #[test]
    fn our_own_building_is_mapped_within_centimetres() {
        let Example { log, relations, .. } = Example::new(usize::MAX);
        let log = Arc::new(log);
        let raw = relation_errors(&log.odometry, &log.odometry, &relations).unwrap();
        let setup = LogSetup { particles: 8, ..LogSetup::default() };
        let mut run = LogRun::new(&setup, Arc::clone(&log)).unwrap();
        while run.step().is_some() {}
        assert_eq!(run.path().len(), log.scans.len());
        let errors = relation_errors(&run.path(), &log.odometry, &relations).unwrap();
        assert!(raw.translation_mean > 0.5, "odometry alone must fail: {raw:?}");
        assert!(errors.translation_mean < 0.06 && errors.rotation_mean_deg < 0.5, "{errors:?}");
        let (footprint, estimate) = (run.footprint(), memory_estimate(&setup, &log));
        assert!(
            footprint.unique < footprint.dense / 3 && footprint.unique < estimate && estimate < 10 * footprint.unique
        );
    }

    #[test]
    fn the_robot_of_the_example_drives_through_doors_and_not_through_walls() {
        let (plan, Example { truth, .. }) = (FloorPlan::building(), Example::new(usize::MAX));
        for (k, pair) in truth.windows(2).enumerate() {
            let [dx, dy] = [pair[1].x - pair[0].x, pair[1].y - pair[0].y];
            let free = plan.raycast([pair[0].x, pair[0].y], fastslam::ops::atan2(dy, dx));
            assert!(free > pair[0].distance(&pair[1]) + 0.1, "step {k} at {:?}: a wall after {free} m", pair[0]);
        }
    }

    #[test]
    fn settings_out_of_range_are_refused() {
        let log = Arc::new(Example::new(2).log);
        let refused = |setup: LogSetup| LogRun::new(&setup, Arc::clone(&log)).unwrap_err().field();
        let setup = LogSetup::default;
        assert_eq!(refused(LogSetup { particles: 0, ..setup() }), "particles");
        assert_eq!(refused(LogSetup { cell_size: f64::NAN, ..setup() }), "cell");
        assert_eq!(refused(LogSetup { max_range: 1e9, ..setup() }), "max-range");
        assert_eq!(refused(LogSetup { min_travel: -1.0, ..setup() }), "min-travel");
        assert_eq!(LogRun::new(&setup(), Arc::default()).unwrap_err().field(), "log");
    }

    #[test]
    fn the_search_takes_as_many_beams_of_a_dense_laser() {
        let mut log = Example::new(5).log;
        assert_eq!(from_scan(&log), FROM_SCAN);
        for (beams, times) in [(1, 1), (181, 1), (361, 2), (1081, 6)] {
            log.scans.iter_mut().skip(1).for_each(|scan| scan.ranges = vec![1.0; beams]);
            let settings = from_scan(&log);
            assert_eq!((settings.climb_stride, settings.search.stride), (2 * times, 4 * times));
        }
    }

    #[test]
    fn a_robot_that_stands_still_looks_once_and_its_path_goes_on() {
        let mut log = Example::new(3).log;
        let still = log.scans[1].clone();
        log.scans.splice(
            2..2,
            (1..=5).map(|k| fastslam::log::LaserScan { time: still.time + 0.01 * f64::from(k), ..still.clone() }),
        );
        let mut run = LogRun::new(&LogSetup { particles: 2, ..LogSetup::default() }, Arc::new(log)).unwrap();
        while run.step().is_some() {}
        assert_eq!((run.step_count(), run.path().len()), (2, 8));
        assert_eq!(run.path()[1].1, run.path()[6].1);
    }
}
