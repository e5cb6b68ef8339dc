//! A world that is turned with all that is in it, and a filter that must not notice.

use fastslam::geometry::Pose2;
use fastslam::map::ConditionalMap;
use fastslam::map::grid::{Grid, GridModel};
use fastslam::mapper::{CELLS_PER_NDT, LaserMapperSettings};
use fastslam::matching::{Matcher, ScanModel};
use fastslam::motion::{Motion as _, Odometry, OdometryModel};
use fastslam::ops;
use fastslam::particle::Particle;
use fastslam::proposal::{Fit, FromScan, FromScanSettings, Proposal, ProposalTrace, Search};
use fastslam::random::{Purpose, Stream};
use fastslam::sensor::{BeamSensor, Scan};
use fastslam_lab::experiment::ErrorSummary as Errors;
use fastslam_lab::experiment::hill::Hill;
use fastslam_lab::experiment::lap::{self, BEAMS, Lap, LapSetup, LapWorld};
use fastslam_lab::world::{FloorPlan, Segment};
use nalgebra::Matrix3;
use std::sync::Arc;

/// 0, 15 … 90°.
const ANGLES: [f64; 7] = [0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0];

/// Along the raster, along its diagonals, where a Gaussian fitted along the axes is furthest off, and between the two.
const FEW_ANGLES: [f64; 3] = [0.0, 30.0, 45.0];

/// A particle before a step.
struct Scene<S, const CELLS_PER_NDT: usize> {
    from_scan: FromScan<OdometryModel, ScanModel, S>,
    particle: Particle<Grid<CELLS_PER_NDT>>,
    control: Odometry,
    scan: Scan,
}

/// A fit beside what it is a fit of.
struct Judged {
    /// ln η̂ less ln of the dense integral \[nats\].
    error: f64,
    fitted: Matrix3<f64>,
    dense: Matrix3<f64>,
}

impl<S: Search, const CELLS_PER_NDT: usize> Scene<S, CELLS_PER_NDT> {
    /// `None` where the matcher is not trusted.
    fn judged(&self, seed: u32) -> Option<Judged> {
        let Self { from_scan: FromScan { motion, score, settings }, particle, control, scan } = self;
        let prior = motion.gaussian(&particle.world_from_robot, control, settings.motion_floor).unwrap();
        let target = |pose: &Pose2| score.log_score(&particle.map, pose, scan) + prior.log_density(pose);
        let stream = || Stream::at(1, Purpose::TRIAL, seed, 0);
        let proposed = self.from_scan.propose(particle, control, scan, &mut stream());
        let ProposalTrace::Matched { mode, log_integral, .. } = proposed.trace else { return None };
        let fit = Fit::around(&mode, &settings.limits, target)?;
        // What is judged here is what was drawn from.
        assert!((fit.log_integral - log_integral).abs() < 1e-9);
        assert!(fit.gaussian.sample(&mut stream()).minus(&proposed.world_from_robot).norm() < 1e-9);
        let dense = Hill::summed(&fit.gaussian, 6, target)?;
        let error = log_integral - dense.log_integral;
        Some(Judged { error, fitted: fit.gaussian.covariance(), dense: dense.gaussian.covariance() })
    }
}

/// Half the width of the corridor \[m\].
const HALF: f64 = 0.9;

/// A motion of the plane about `center`, by so many degrees, and by up to a cell of the lap along each axis: where the raster lies is
/// chance, which the mean over `seed` averages.
fn turned_about(center: [f64; 2], angle: f64, seed: u32) -> Pose2 {
    let [x, y] = center;
    let mut stream = Stream::at(6, Purpose::TRIAL, seed, 0);
    let [dx, dy] = [0, 1].map(|_| lap::GRID.cell_size * stream.uniform());
    Pose2::new(x + dx, y + dy, angle.to_radians()).compose(&Pose2::new(-x, -y, 0.0))
}

/// Wheels for the corridor: 0.8 m on, 8 cm are unknown along it.
const WHEELS: OdometryModel = OdometryModel { alphas: [0.04, 0.01, 0.01, 0.01] };

/// A corridor with no end in sight, mapped on twelve steps of 0.3 m from known poses, and a scan `trans` \[m\] further: the `seed`-th
/// of places where raster and noise differ, the world turned.
fn corridor<S, const CELLS_PER_NDT: usize>(
    from_scan: FromScan<OdometryModel, ScanModel, S>,
    model: GridModel,
    trans: f64,
    seed: u32,
    angle: f64,
) -> Scene<S, CELLS_PER_NDT> {
    let wall = |y: f64| Segment { a: [-40.0, y], b: [40.0, y] };
    let motion = turned_about([0.0, 0.0], angle, seed);
    let plan = FloorPlan { size: [40.0, HALF], walls: vec![wall(-HALF), wall(HALF)], furniture: Vec::new() };
    let plan = plan.moved(&motion);
    let sensor = BeamSensor::panorama(BEAMS, lap::MAX_RANGE, 0.02);
    let look = |pose: &Pose2, k: u32| {
        sensor.scan(&plan.ranges(pose, &sensor, &mut Stream::at(4, fastslam_lab::WORLD_SENSOR, seed, k)))
    };
    let mut stream = Stream::at(4, Purpose::TRIAL, seed, 0);
    let mut within = |half: f64| half * (2.0 * stream.uniform() - 1.0);
    let y = within(0.3);
    let mut drive = (0..12).map(|k| Pose2::new(0.3 * f64::from(k), y + within(0.05), within(0.1)));
    let truth: [Pose2; 12] = core::array::from_fn(|_| motion.compose(&drive.next().unwrap()));
    let mut map = Grid::new(model);
    for (pose, k) in truth.iter().zip(0..) {
        map.assimilate(pose, &look(pose, k), &());
    }
    let (here, ahead) = (truth[11], truth[11].compose(&Pose2::new(trans, 0.0, 0.0)));
    let driven = Odometry::between(&here, &ahead);
    let control = WHEELS.perturb(&driven, &mut Stream::at(4, fastslam_lab::WORLD_ODOMETRY, seed, 0));
    let particle = Particle::start(here, map);
    Scene { from_scan, particle, control, scan: look(&ahead, 12) }
}

/// With the lap's map and settings.
fn corridor_of_the_lap(seed: u32, angle: f64) -> Option<Judged> {
    let likelihood = ScanModel::new(Matcher::SubCell, lap::TEMPER, lap::OUTLIER);
    let from_scan = FromScan { motion: WHEELS, score: likelihood, settings: lap::FROM_SCAN };
    corridor::<_, 1>(from_scan, lap::GRID, 0.8, seed, angle).judged(seed)
}

/// With the map and settings for logs, in which 4 to 5 cm are unknown along a step.
fn corridor_of_a_log(seed: u32, angle: f64) -> Option<Judged> {
    // With one hill the first numbers of the stream are those of the draw from its fit.
    let of_logs = LaserMapperSettings::default();
    let FromScan { score, settings, .. } = of_logs.proposal();
    let from_scan = FromScan { motion: WHEELS, score, settings: FromScanSettings { hills: 1, ..settings } };
    corridor::<_, CELLS_PER_NDT>(from_scan, of_logs.grid(), 0.4, seed, angle).judged(seed)
}

/// The first step of the lap, turned about its start.
fn start_of_the_lap(seed: u32, angle: f64) -> Option<Judged> {
    let setup = LapSetup { seed: u64::from(seed), ..LapSetup::default() };
    let world = world(&setup, angle);
    let mut map: Grid = Grid::new(lap::GRID);
    world.start_scans.iter().for_each(|(pose, scan)| map.assimilate(pose, scan, &()));
    let here = world.truth[0];
    let likelihood = ScanModel::new(setup.matcher, lap::TEMPER, lap::OUTLIER);
    let scene = Scene {
        from_scan: FromScan { motion: setup.motion(), score: likelihood, settings: lap::FROM_SCAN },
        particle: Particle::start(here, map),
        control: world.controls[0],
        scan: world.scans[0].clone(),
    };
    scene.judged(seed)
}

/// The lap of this setup, turned about its start.
fn world(setup: &LapSetup, angle: f64) -> LapWorld {
    let route = setup.course.route();
    let motion = turned_about(route.way_points[0], angle, setup.seed as u32);
    LapWorld::on(&route.moved(&motion), setup.seed, &setup.motion(), setup.range_std)
}

/// Means over the seeds at one angle.
#[derive(Clone, Copy, Debug)]
struct Mean {
    /// Of ln η̂ less ln of the dense integral \[nats\], and its standard error.
    error: [f64; 2],
    /// Root of the mean variance along and across the unturned world's x \[m\], and of the heading \[rad\]: of the fit.
    fitted: [f64; 3],
    /// The same of the dense sum.
    dense: [f64; 3],
}

fn mean(angle: f64, seeds: u32, scene: fn(u32, f64) -> Option<Judged>) -> Mean {
    let judged: Vec<Judged> = (0..seeds).filter_map(|seed| scene(seed + 1, angle)).collect();
    assert!(judged.len() as u32 >= seeds - seeds / 10, "the matcher is trusted: {} of {seeds}", judged.len());
    let n = judged.len() as f64;
    let error = judged.iter().map(|one| one.error).sum::<f64>() / n;
    let variance = judged.iter().map(|one| (one.error - error) * (one.error - error)).sum::<f64>() / (n - 1.0);
    let (sin, cos) = ops::sin_cos(-angle.to_radians());
    let turn = Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
    let stds = |of: fn(&Judged) -> &Matrix3<f64>| {
        let mean = judged.iter().map(of).sum::<Matrix3<f64>>() / n;
        let back = turn * mean * turn.transpose();
        [back.m11, back.m22, back.m33].map(f64::sqrt)
    };
    Mean { error: [error, (variance / n).sqrt()], fitted: stds(|one| &one.fitted), dense: stds(|one| &one.dense) }
}

/// Seeds a mean is taken of.
const SEEDS: u32 = 24;

/// The greatest of these over the least.
fn ratio(values: impl Iterator<Item = f64> + Clone) -> f64 {
    values.clone().fold(0.0, f64::max) / values.fold(f64::INFINITY, f64::min)
}

/// Standard deviations of the fit at all angles, turned back: along, across \[m\] and of the heading \[rad\] each within these ratios.
/// With the curvature along the world's axes alone, the corridor at 45° was fitted a third as wide along as at 0°.
fn holds_at_every_angle(
    name: &str,
    angles: &[f64],
    scene: fn(u32, f64) -> Option<Judged>,
    most: [f64; 3],
) -> Vec<Mean> {
    let means: Vec<Mean> = angles.iter().map(|angle| mean(*angle, SEEDS, scene)).collect();
    for (axis, most) in most.into_iter().enumerate() {
        let fitted = ratio(means.iter().map(|one| one.fitted[axis]));
        assert!(fitted < most, "{name}, axis {axis}: {fitted:.2}: {means:.4?}");
    }
    means
}

/// The target is no Gaussian: along the wall the raster's squares make it uneven, and the fit holds the width of one bump for that of the
/// corridor. It is as wrong at every angle: means of 24 places, with standard errors of 0.08 nats (log) and 0.2 (lap):
/// 0.15 and 0.45 are two of them.
fn a_corridor_is_fitted_alike(angles: &[f64]) {
    for (name, scene, slack) in
        [("log", corridor_of_a_log as fn(u32, f64) -> Option<Judged>, 0.15), ("lap", corridor_of_the_lap, 0.45)]
    {
        let means = holds_at_every_angle(name, angles, scene, [1.25, 1.15, 1.25]);
        let middle = means.iter().map(|one| one.error[0]).sum::<f64>() / means.len() as f64;
        for (angle, one) in angles.iter().zip(&means) {
            let off = one.error[0] - middle;
            assert!(off.abs() < slack, "{name} at {angle}°: {off:+.3} nats from the others: {one:.3?}");
        }
    }
}

#[test]
fn a_corridor_is_fitted_alike_whichever_way_it_runs() {
    a_corridor_is_fitted_alike(&FEW_ANGLES);
}

#[test]
#[ignore = "breadth: seven angles"]
fn a_corridor_is_fitted_alike_at_seven_angles() {
    a_corridor_is_fitted_alike(&ANGLES);
}

/// 0.1 nats of the dense integral: the mean over all angles, and each within two of its standard errors of some 0.05 more. The fit sees the bump at
/// the mode and not those beside it: it is 0.77 to 0.94 times as wide as the dense sum, and may not be narrower than 0.72 times.
fn the_laps_start_is_fitted_well(angles: &[f64]) {
    let means = holds_at_every_angle("start", angles, start_of_the_lap, [1.3, 1.3, 1.3]);
    for (angle, one) in angles.iter().zip(&means) {
        for (fitted, dense) in one.fitted.iter().zip(one.dense) {
            let ratio = fitted / dense;
            assert!((0.72..1.05).contains(&ratio), "{angle}°: {ratio:.3} times as wide: {means:.4?}");
        }
    }
    let middle = means.iter().map(|one| one.error[0]).sum::<f64>() / means.len() as f64;
    assert!(middle.abs() < 0.1, "{middle:+.3} nats: {means:.3?}");
    for (angle, one) in angles.iter().zip(&means) {
        let [error, std] = one.error;
        assert!(error.abs() < 0.1 + 2.0 * std, "{angle}°: {error:+.3} ± {std:.3} nats");
    }
}

#[test]
fn the_laps_start_is_fitted_well_whichever_way_it_is_turned() {
    the_laps_start_is_fitted_well(&FEW_ANGLES);
}

#[test]
#[ignore = "breadth: seven angles"]
fn the_laps_start_is_fitted_well_at_seven_angles() {
    the_laps_start_is_fitted_well(&ANGLES);
}

/// Seeds 1 to `seeds` at M = 8, each with its own place in the raster: medians of the error at three angles, the greatest less than `most` times the
/// least. What is found, then, is a direction in which laps are `most` times worse; noise makes the law stricter, not weaker.
fn a_lap_ends_as_well(seeds: u64, most: f64) {
    let errors = FEW_ANGLES.map(|angle| {
        let errors: Vec<f64> = (1..=seeds)
            .map(|seed| {
                let setup = LapSetup { particles: 8, seed, ..LapSetup::default() };
                let mut lap = Lap::in_world(&setup, Arc::new(world(&setup, angle))).unwrap();
                while lap.step().is_some() {}
                lap.report().rms_best
            })
            .collect();
        Errors::of(&errors)
    });
    let times = ratio(errors.iter().map(|one| one.median));
    assert!(times < most, "{times:.2}: {errors:.4?}");
}

#[test]
fn a_lap_ends_as_well_whichever_way_the_apartment_is_turned() {
    a_lap_ends_as_well(12, 1.5);
}

#[test]
#[ignore = "breadth: fifty seeds"]
fn fifty_laps_end_as_well_whichever_way_the_apartment_is_turned() {
    a_lap_ends_as_well(50, 1.25);
}
