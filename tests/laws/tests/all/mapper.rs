//! What a mapper of logs must hold to on its bad days: a crowd round the robot, people who go along with it, a laser that meets little, a robot that steps aside, and a
//! loop so long that particles must have stayed apart until it closes. Each is a simulated log of which the truth is known; what each bar is for stands with it.

use super::robots::poses;
use fastslam::geometry::Pose2;
use fastslam::mapper::{LaserMapper, LaserMapperSettings, LoopEnd, OdometryInnovations, Remark, Replay};
use fastslam::motion::OdometryModel;
use fastslam::ops;
use fastslam_lab::experiment::graph::PathError;
use fastslam_lab::experiment::log::{Example, Recipe};
use fastslam_lab::experiment::long_rings::{LongRingSetup, LoopErrors};
use fastslam_lab::world::{FloorPlan, Segment};
use fastslam_log::LaserLog;
use statrs::distribution::{ChiSquared, ContinuousCDF};
use std::sync::Arc;

/// A yard of 40 m × 30 m with four houses in it, and a robot that goes once round between them: a laser of 180 beams, wheels with half the noise
/// of the recorded logs (1.5° a metre), so that no step of 0.4 m is 5° off by itself.
pub fn yard(seed: u64) -> Recipe {
    let mut plan = FloorPlan { size: [40.0, 30.0], walls: Vec::new(), furniture: Vec::new() };
    let mut house = |[x0, y0]: [f64; 2], [x1, y1]: [f64; 2]| {
        let corners = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
        plan.walls.extend((0..4).map(|k| Segment { a: corners[k], b: corners[(k + 1) % 4] }));
    };
    house([0.0, 0.0], [40.0, 30.0]);
    house([12.0, 10.5], [17.0, 14.0]);
    house([22.0, 12.0], [28.5, 19.0]);
    house([2.0, 22.0], [5.5, 28.0]);
    house([33.0, 1.0], [38.0, 3.5]);
    Recipe {
        seed,
        plan,
        route: vec![[7.0, 6.0], [31.0, 7.0], [34.0, 24.0], [10.0, 24.5], [7.0, 6.0], [16.0, 6.4]],
        spacing: 0.4,
        wheels: OdometryModel { alphas: [0.0; 4] },
        scatter: 0.5,
        ..Recipe::building()
    }
}

/// How much of a drive is mapped, and by how many particles.
#[derive(Clone, Copy)]
struct Drive {
    particles: usize,
    /// Scans from the start on.
    scans: usize,
}

/// Once round the yard.
const ROUND: Drive = Drive { particles: 8, scans: usize::MAX };

/// The same by a single particle. People are told from walls before a pose is drawn, and by odometry alone: that takes no second particle.
const ALONE: Drive = Drive { particles: 1, ..ROUND };

/// The first half of the way.
const HALF: Drive = Drive { scans: 120, ..ALONE };

/// What a mapper made of a log.
#[derive(Debug)]
struct Mapped {
    /// RMS error of position after the best rigid alignment \[m\].
    error: f64,
    /// The same of raw odometry \[m\].
    odometry: f64,
    /// The most that a step turns the robot away from its true heading \[deg\].
    turn: f64,
}

fn mapped(recipe: &Recipe, Drive { particles, scans }: Drive) -> (Mapped, LaserLog) {
    let Example { log, truth, .. } = Example::of(recipe, scans);
    let log = Arc::new(log);
    let settings = LaserMapperSettings { particles, seed: recipe.seed, ..LaserMapperSettings::default() };
    let mut replay = Replay::new(settings, Arc::clone(&log)).unwrap();
    replay.by_ref().for_each(drop);
    let path = poses(replay.mapper());
    let raw: Vec<Pose2> = log.scans.iter().map(|scan| scan.odometry).collect();
    let found = Mapped {
        error: PathError::of(&path, &truth).aligned,
        odometry: PathError::of(&raw, &truth).aligned,
        turn: greatest_turn(&path, &truth).to_degrees(),
    };
    drop(replay);
    (found, Arc::unwrap_or_clone(log))
}

/// The most that a step adds to the error of the heading \[rad\]. What takes from it is no fault: where nothing was seen for a while, wheels have erred meanwhile.
fn greatest_turn(path: &[Pose2], truth: &[Pose2]) -> f64 {
    assert_eq!(path.len(), truth.len(), "a pose for each scan");
    let begun = path[0].theta - truth[0].theta;
    let error = |k: usize| ops::wrap_angle(path[k].theta - truth[k].theta - begun).abs();
    (1..path.len()).map(|k| error(k) - error(k - 1)).fold(0.0, f64::max)
}

/// Share of a log's readings for which this holds.
fn share(log: &LaserLog, holds: impl Fn(f32) -> bool) -> f64 {
    let readings = || log.scans.iter().flat_map(|scan| &scan.ranges);
    readings().filter(|range| holds(**range)).count() as f64 / readings().count() as f64
}

/// A run of M = 8, and how many times nearer to the truth than raw odometry it is. What share of its readings is `near` must be in `told`, or it is
/// no such log; and none of its steps turns the robot away from its true heading by 5°, where odometry does by 3.9° at the most: what a scan
/// happens to fit may not turn the map.
fn times_nearer(
    name: &str,
    drive: Drive,
    seed: u64,
    near: f32,
    told: [f64; 2],
    recipe: impl Fn(Recipe) -> Recipe,
) -> f64 {
    let (found, log) = mapped(&recipe(yard(seed)), drive);
    let share = share(&log, |range| range < near);
    println!("{name}, seed {seed}: {found:.3?}, {share:.3} of the beams below {near} m");
    assert!((told[0]..told[1]).contains(&share), "{name}, seed {seed}: {share}");
    assert!(found.turn < 5.0, "{name}, seed {seed}: {found:?}");
    found.odometry / found.error
}

/// How many times nearer to the truth than raw odometry drives must be: each of them, and half of them or more.
struct Bars {
    each: f64,
    half: f64,
}

impl Bars {
    fn hold(self, mut times: Vec<f64>) {
        times.sort_by(f64::total_cmp);
        assert!(times[0] > self.each && times[(times.len() - 1) / 2] > self.half, "{times:.1?}");
    }
}

/// Drives with twenty people beside the way: two thirds of the beams end on them within 2 m, and they stand for a while and go.
fn a_crowd_turns_no_map_of(drive: Drive, seeds: impl IntoIterator<Item = u64>, bars: Bars) {
    let crowd = |yard| Recipe { crowd: 20, ..yard };
    bars.hold(seeds.into_iter().map(|seed| times_nearer("crowd", drive, seed, 2.0, [0.62, 0.72], crowd)).collect());
}

/// Where nothing is taken to move, seed 2 is 2.4 times nearer. In seed 29 people cover the laser; where such a scan is believed against odometry, the path is
/// off by 9.4 m.
#[test]
fn a_crowd_round_the_robot_does_not_turn_the_map() {
    a_crowd_turns_no_map_of(ALONE, [2, 3, 29], Bars { each: 4.0, half: 4.0 });
}

#[test]
#[ignore = "breadth: sixteen seeds"]
#[should_panic(expected = "crowd, seed 16")] // open, in issue 31: a step of seed 16 turns by 5.2° from the truth, and the path is off by 6 cm all the same; red as soon as that is mended
fn a_crowd_round_the_robot_turns_the_map_of_none_of_sixteen_seeds() {
    a_crowd_turns_no_map_of(ROUND, 1..=16, Bars { each: 4.0, half: 15.0 });
}

/// Drives with people who keep their places round the robot, and so say that it stands still: two of them with a tenth of the beams, four with a
/// quarter, where walls are far and say little.
fn people_hold_no_robot_back_of(escort: u32, drive: Drive, seeds: impl IntoIterator<Item = u64>, bars: Bars) {
    let told = if escort == 2 { [0.05, 0.2] } else { [0.15, 0.3] };
    let along = |yard| Recipe { escort, ..yard };
    bars.hold(seeds.into_iter().map(|seed| times_nearer("escort", drive, seed, 2.0, told, along)).collect());
}

/// With two people no path is further off than raw odometry, with four none twice as far and half of them no further. Where nothing is taken to
/// move, the worst is 1.2 times as far off with two people, and with four ten times, half of them three times.
#[test]
fn people_who_go_along_do_not_hold_the_robot_back() {
    people_hold_no_robot_back_of(2, ALONE, [2], Bars { each: 1.0, half: 1.0 });
    people_hold_no_robot_back_of(4, HALF, 1..=4, Bars { each: 0.5, half: 1.0 });
}

#[test]
#[ignore = "breadth: eight seeds"]
#[should_panic(expected = "27.4]")] // open, in issue 31: since issue 30 three of eight seeds end further off than raw odometry; red as soon as that is mended
fn people_who_go_along_hold_the_robot_back_on_none_of_eight_seeds() {
    people_hold_no_robot_back_of(2, ROUND, 1..=8, Bars { each: 1.0, half: 10.0 });
    people_hold_no_robot_back_of(4, ROUND, 1..=8, Bars { each: 0.5, half: 2.0 });
}

/// Of 360 beams some 200 meet something, where the laser sees 12 m of a yard of forty. Of twelve seeds, when this was written: in the median
/// 9.7 times nearer than odometry, and 1.8 times on seed 2, whose wheels are off by 0.31 m and no more.
fn a_laser_that_meets_little_maps_well(seeds: impl IntoIterator<Item = u64>, bars: Bars) {
    let sparse = |yard| Recipe { beams: 360, max_range: 12.0, ..yard };
    bars.hold(seeds.into_iter().map(|seed| times_nearer("sparse", ROUND, seed, 11.6, [0.5, 0.6], sparse)).collect());
}

/// Where it sees 7 m, 75 of its beams meet something, and none for up to eleven steps: too little to be sure of being nearer than odometry. Of twelve seeds half
/// are off by 0.60 m or less, odometry by 0.83 m; where loops are not looked for as far as wheels err in the dark, by 1.47 m.
fn a_laser_that_meets_nothing_for_a_while_maps_well(bars: Bars, recipe: impl Fn(Recipe) -> Recipe) {
    let sparser = |yard| recipe(Recipe { max_range: 7.0, ..yard });
    bars.hold((1..=3).map(|seed| times_nearer("sparser", ROUND, seed, 6.7, [0.15, 0.25], sparser)).collect());
}

#[test]
#[ignore = "breadth: twelve seeds"]
fn a_laser_that_meets_little_maps_well_on_twelve_seeds() {
    a_laser_that_meets_little_maps_well(1..=12, Bars { each: 1.5, half: 7.0 });
}

#[test]
fn a_laser_that_meets_little_does_not_turn_the_map() {
    a_laser_that_meets_little_maps_well(1..=3, Bars { each: 1.5, half: 4.0 });
    let sparser = |yard| Recipe { beams: 360, ..yard };
    a_laser_that_meets_nothing_for_a_while_maps_well(Bars { each: 0.25, half: 0.35 }, sparser);
}

/// By two turns and a drive, a step straight to the left is a turn by 90° and one back, with the noise of both. The prior is so wide then that
/// scans of which one beam in five met something turned these maps by 9° to 14°, with all else as it is.
#[test]
fn a_robot_that_steps_aside_does_not_turn_its_map() {
    let aside = |yard| Recipe { aside: 0.4, ..yard };
    a_laser_that_meets_nothing_for_a_while_maps_well(Bars { each: 0.25, half: 1.5 }, aside);
}

/// Nothing in a ring of 60 m says which of two paths is right until it closes, so until then both must live: more than one of the particles that
/// began has descendants. Then the loop closes: every place that is seen again is where it was, to half a metre, which raw odometry
/// misses nearly everywhere.
#[test]
fn particles_stay_apart_until_a_long_loop_closes() {
    for seed in 1..=3 {
        let mut run = LongRingSetup { seed, ..LongRingSetup::default() }.start().unwrap();
        // Round the last corner, from where the start is in sight: 51 m of 75.
        let in_sight = (0.68 * run.log().scans.len() as f64) as u32;
        while run.step() {}
        let (errors, raw, one) = (run.errors(), run.odometry_errors(), run.mapper().single_lineage_since());
        println!("seed {seed}: {errors:.3?}, raw {raw:.3?}, one ancestor from {one:?}");
        assert!(one.is_none_or(|step| step > in_sight), "seed {seed}: one ancestor from {one:?} on");
        assert!(errors.revisits_off == 0.0 && raw.revisits_off > 0.9, "seed {seed}: {errors:?}, raw {raw:?}");
        assert!(2.0 * errors.rms < raw.rms, "seed {seed}: {errors:?}, raw {raw:?}");
    }
}

/// Where a scan is taken every metre, as in some recorded logs, a matched heading says little for the next one, and paths drift apart before a loop of 120 m
/// closes. Of its revisits, over 24 seeds, 17 % were off by more than half a metre with one particle, 13, 10, 7 and 3 % with 2, 4, 8 and 16; of the first twelve
/// 16 % with one and 1 % with eight. (With a scan every 0.4 m one particle does as well.) Should one hold the bar some day, a harder course must tell them apart.
#[test]
#[ignore = "breadth: twelve seeds"]
fn eight_particles_close_loops_of_sparse_scans_that_one_leaves_open() {
    const BAR: f64 = 0.06;
    let off = |particles: usize| {
        let off = |seed: u64| {
            let recipe =
                Recipe { spacing: 1.0, ..LongRingSetup { length: 120, seed, ..LongRingSetup::default() }.recipe() };
            let Example { log, truth, .. } = Example::of(&recipe, usize::MAX);
            let settings = LaserMapperSettings { particles, seed, ..LaserMapperSettings::default() };
            let mut replay = Replay::new(settings, Arc::new(log)).unwrap();
            replay.by_ref().for_each(drop);
            let path = poses(replay.mapper());
            LoopErrors::of(&path, &truth).revisits_off
        };
        let off: Vec<f64> = (1..=12).map(off).collect();
        println!("{particles} particles: {off:.2?}");
        off.iter().sum::<f64>() / off.len() as f64
    };
    let [one, eight] = [1, 8].map(off);
    assert!(eight <= BAR && one > BAR, "revisits off: {one} with one particle, {eight} with eight");
}

/// RMS error after the best rigid alignment \[m\] and share of the revisits that are off, of one path, before it was bent and after.
type Bend = [LoopErrors; 2];

/// A single particle round a ring of 120 m: its loop ends closed, and each time that its path is bent, it comes nearer to the truth and no place
/// that is seen again gets off. A path that was right before cannot come nearer, so none may be bent in vain. With its RMS error at the end \[m\].
fn bends(seed: u64) -> (Vec<Bend>, f64) {
    let mut run = LongRingSetup { length: 120, particles: 1, seed, ..LongRingSetup::default() }.start().unwrap();
    let (mut path, mut bends) = (Vec::new(), Vec::new());
    while run.step() {
        let now = run.path();
        if run.mapper().closings() as usize > bends.len() {
            // The scan that the bend came with has no place on the path of before.
            let of = |path: &[Pose2]| LoopErrors::of(path, &run.truth()[..path.len()]);
            bends.push([of(&path), of(&now[..path.len()])]);
        }
        path = now;
    }
    let errors = run.errors();
    println!("seed {seed}: {errors:.3?}, bent {bends:.3?}");
    // A twelfth of the revisits are those of the first metres after the corner.
    assert!(errors.revisits_off < 0.1, "seed {seed}: {errors:?}");
    for [before, after] in &bends {
        let better = after.rms < before.rms && after.revisits_off <= before.revisits_off;
        assert!(better, "seed {seed}: from {before:?} to {after:?}");
    }
    (bends, errors.rms)
}

/// The most that a path round a ring of 120 m may be off by at the end \[m\].
const OFF: f64 = 0.25;

/// A single particle has no other beside it that might have drifted less: without closings eight of twelve paths have revisits off by more than
/// half a metre, three of them all. Seeds are taken from the first on, until one needs to be bent.
#[test]
fn a_loop_that_no_particle_closes_is_closed_by_bending_its_path_and_no_bend_makes_it_worse() {
    let is_bent = |seed| {
        let (bends, rms) = bends(seed);
        assert!(rms < OFF, "seed {seed}: {rms} m");
        !bends.is_empty()
    };
    assert!((1..=6).any(is_bent), "none of six loops was left open");
}

/// Six of the scans so far are mapped again for each new one, so that five are gained on the robot. Seeds are taken from the first on, until a path is bent.
#[test]
fn a_path_that_is_corrected_a_few_scans_at_a_time_takes_over_once_all_are_mapped() {
    const EACH: usize = 6;
    let is_bent = |seed| {
        let log =
            Example::of(&LongRingSetup { length: 120, seed, ..LongRingSetup::default() }.recipe(), usize::MAX).log;
        let settings = LaserMapperSettings {
            particles: 1,
            seed,
            remapped_per_scan: EACH as u32,
            ..LaserMapperSettings::default()
        };
        let mut mapper = LaserMapper::new(settings.for_scans(&log.scans)).unwrap();
        for scan in &log.scans {
            _ = mapper.push(scan);
            if mapper.closings() > 0 {
                let found = mapper.loops().last().unwrap();
                assert!(matches!(found.end, LoopEnd::Bent { .. }) && mapper.open_loops().count() == 0, "{found:?}");
                let pushed = mapper.steps() as usize - found.to;
                assert_eq!(pushed, (found.to + 1 - EACH).div_ceil(EACH - 1), "seed {seed}: {found:?}");
                return true;
            }
        }
        false
    };
    assert!((1..=6).any(is_bent), "none of six loops was left open");
}

#[test]
#[ignore = "breadth: twelve seeds"]
fn loops_that_no_particle_closes_are_closed_by_bending_on_twelve_seeds() {
    let bent = (1..=12).filter(|seed| !bends(*seed).0.is_empty()).count();
    assert!(bent >= 3, "{bent} of 12: too few to tell");
}

#[test]
#[ignore = "breadth: twelve seeds"]
#[should_panic(expected = "[0.266")] // open, in issue 31: seed 7 ends closed, and 27 cm off: a single particle draws its poses along the corridor, and what it drifted so is spread over all of the way
fn loops_that_are_closed_by_bending_are_off_by_little_on_twelve_seeds() {
    let off: Vec<f64> = (1..=12).map(|seed| bends(seed).1).filter(|rms| *rms >= OFF).collect();
    assert!(off.is_empty(), "{off:.3?}");
}

/// 3 is expected of noises that are right, and one in a hundred beyond the bound. The mapper assumes no less of wheels than it knows, so that of wheels of half the noise of recorded
/// logs less is found; and more of wheels that slip in a third of the steps, by more than what is learnt of them can be.
#[test]
fn innovations_of_odometry_tell_wheels_that_slip_from_those_that_scatter() {
    let innovations = |slip: f64| {
        let log = Example::of(&Recipe { slip, scatter: 0.5, ..Recipe::building() }, 200).log;
        let settings = LaserMapperSettings { particles: 2, ..LaserMapperSettings::default() };
        let mut replay = Replay::new(settings, Arc::new(log)).unwrap();
        assert!(replay.mapper().predicted().is_none());
        let mut innovations = OdometryInnovations::default();
        while let Some(report) = replay.next() {
            innovations.add(replay.mapper().predicted().unwrap(), &report);
        }
        assert!(innovations.count() > 150, "{innovations:?}");
        println!("slip {slip}: {:.2?}, {:.3} beyond", innovations.mean(), innovations.share_beyond());
        innovations
    };
    let [scatter, slip] = [0.0, 0.3].map(innovations);
    let [mean, more] = [scatter, slip].map(|one| one.mean().unwrap());
    assert!(mean < 3.0 && scatter.share_beyond() < 0.02 && more > 1.5 * mean, "{scatter:?}, {slip:?}");
    assert_eq!(OdometryInnovations::default().mean(), None);
}

/// Rings of 240 m, along which doors look alike. A place that a loop is closed at, as the path is or by bending it, is the right one, to half a metre. Where
/// paths that seemed to meet counted as closed without a look at the next door, and a second-best place could have four fifths of the best one's gain, 8 of 18
/// bends on 24 seeds ended at a wrong door, and 36 % of all revisits were off; on the four seeds of the quick test all.
fn loops_are_closed_at_no_place_that_only_looks_alike(seeds: impl IntoIterator<Item = u64>) {
    let (mut bent, mut off) = (0, Vec::new());
    for seed in seeds {
        let mut run = LongRingSetup { length: 240, particles: 2, seed, ..LongRingSetup::default() }.start().unwrap();
        while run.step() {}
        let (path, errors) = (run.path(), run.errors());
        println!("seed {seed}: {errors:.3?}, {:?}", run.mapper().loops());
        for one in run.mapper().loops().iter().filter(|one| !one.is_open()) {
            let [is, should] = [&path[..], run.truth()].map(|poses| poses[one.from].between(&poses[one.to]));
            assert!(is.distance(&should) < 0.5, "seed {seed}: {one:?}, {is:?} and not {should:?}");
            bent += u32::from(matches!(one.end, LoopEnd::Bent { .. }));
        }
        off.push(errors.revisits_off);
    }
    let mean = off.iter().sum::<f64>() / off.len() as f64;
    assert!(bent > 0 && mean < 0.1, "{bent} bent, revisits off {mean}: {off:.2?}");
}

#[test]
fn loops_are_closed_at_no_door_that_only_looks_alike() {
    loops_are_closed_at_no_place_that_only_looks_alike([5, 6, 18, 19]);
}

#[test]
#[ignore = "breadth: twenty-four seeds"]
fn loops_are_closed_at_no_door_that_only_looks_alike_on_twenty_four_seeds() {
    loops_are_closed_at_no_place_that_only_looks_alike(1..=24);
}

/// A ring of 120 m that does not close, as its end is further from its beginning than a path's covariance says: the mapper says that its loop stays open. It says
/// nothing of rings that close, be it after a look at a corner where little was known yet.
#[test]
fn a_loop_that_stays_open_is_told_and_none_that_closes() {
    for (length, particles, seed) in [(120, 1, 73), (120, 1, 10), (120, 1, 30), (240, 2, 2), (240, 2, 15)] {
        let mut run = LongRingSetup { length, particles, seed, ..LongRingSetup::default() }.start().unwrap();
        while run.step() {}
        let (errors, loops) = (run.errors(), run.mapper().loops());
        let told = run.mapper().remarks().iter().any(|remark| matches!(remark, Remark::OpenLoops { loops: 1, .. }));
        println!("{length} m, seed {seed}: {errors:.3?}, {loops:?}");
        assert_eq!(errors.revisits_off == 1.0, seed == 73, "closed or not: {errors:?}");
        assert!(errors.revisits_off == 1.0 || errors.revisits_off < 0.1, "neither closed nor open: {errors:?}");
        assert_eq!(told, seed == 73, "seed {seed}: {errors:?}, {loops:?}");
    }
}

/// Squared error of the pose after 60 scans of our building, some 24 m, by the inverse of its covariance: of right covariances χ² with three degrees of freedom.
/// Ten seeds, two-sided α = 0.01. With the weights in full in place of the scores they add up to 597.
#[test]
fn the_covariance_of_the_pose_is_that_of_its_errors() {
    let squared = |seed: u64| {
        let Example { log, truth, .. } = Example::of(&Recipe { seed, ..Recipe::building() }, 60);
        let settings = LaserMapperSettings { particles: 16, seed, ..LaserMapperSettings::default() };
        let mut mapper = LaserMapper::new(settings.for_scans(&log.scans)).unwrap();
        log.scans.iter().for_each(|scan| drop(mapper.push(scan)));
        let now = mapper.pose_with_covariance();
        assert_eq!(now.pose, mapper.pose());
        let error = now.pose.minus(&truth[0].between(truth.last().unwrap()));
        error.dot(&(now.covariance.try_inverse().unwrap() * error))
    };
    let squares: Vec<f64> = (1..=10).map(squared).collect();
    let chi_squared = ChiSquared::new(30.0).unwrap();
    let bounds = [0.005, 0.995].map(|p| chi_squared.inverse_cdf(p));
    let sum = squares.iter().sum::<f64>();
    assert!((bounds[0]..bounds[1]).contains(&sum), "{sum} of {squares:.2?}, and not within {bounds:.1?}");
}

/// Round a ring of 120 m with as few scans kept as may be, a quarter of them: at any time no more are kept than the bound, and until a path is bent all is as with all of
/// them kept, to the bit. By those that are left a loop still closes. Seeds are taken from the first on, until a path is bent.
#[test]
fn scans_are_kept_within_their_bound_which_is_told_and_loops_still_close() {
    let bound = LaserMapperSettings::KEPT_SCANS.least as u32;
    let is_bent = |seed| {
        let Example { log, truth, .. } =
            Example::of(&LongRingSetup { length: 120, seed, ..LongRingSetup::default() }.recipe(), usize::MAX);
        assert!(log.scans.len() as u32 > 2 * bound);
        let settings =
            LaserMapperSettings { particles: 1, seed, ..LaserMapperSettings::default() }.for_scans(&log.scans);
        let mut all = LaserMapper::new(settings).unwrap();
        let mut few = LaserMapper::new(LaserMapperSettings { kept_scans: bound, ..settings }).unwrap();
        let thinned =
            |mapper: &LaserMapper| mapper.remarks().into_iter().find(|remark| matches!(remark, Remark::Thinned { .. }));
        for scan in &log.scans {
            _ = (all.push(scan), few.push(scan));
            let [kept, taken] = [few.memory().kept_scans, few.steps() + 1];
            assert!(kept <= bound && (kept == taken) == (taken <= bound), "{kept} of {taken}");
            assert_eq!(thinned(&few).is_some(), taken > bound);
            assert!(few.closings() > 0 || few.pose() == all.pose());
        }
        assert!(thinned(&all).is_none());
        assert!(few.memory().scan_bytes < all.memory().scan_bytes / 2);
        let path = poses(&few);
        let errors = LoopErrors::of(&path, &truth);
        assert!(errors.revisits_off < 0.1, "seed {seed}: {errors:?}");
        few.closings() > 0
    };
    assert!((1..=6).any(is_bent), "none of six loops was left open");
}

/// Each beam of a scan in a closed building is one point of single precision, and each step of a path that nobody shares a node.
#[test]
fn memory_that_is_told_grows_with_the_scans_as_what_is_kept_of_them() {
    let log = Example::of(&Recipe { beams: 180, ..Recipe::building() }, 60).log;
    let settings = LaserMapperSettings { particles: 2, ..LaserMapperSettings::default() };
    let mut mapper = LaserMapper::new(settings.for_scans(&log.scans)).unwrap();
    let mut points = 0;
    for (number, scan) in (1..).zip(&log.scans) {
        _ = mapper.push(scan);
        points += scan.ranges.len() as u64;
        let memory = mapper.memory();
        let (least, most) = (6 * points, 8 * points + 200 * number);
        assert!((least..=most).contains(&memory.scan_bytes), "{memory:?} of {number} scans, {points} points");
        assert!((64 * number..=400 * number).contains(&memory.path_bytes), "{memory:?}");
        let maps = mapper.footprint_with_kept().unique;
        assert_eq!(memory.bytes(), maps + memory.scan_bytes + memory.path_bytes);
    }
}
