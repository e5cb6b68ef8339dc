use super::*;
use crate::experiment::lap::ScanWeight;
use crate::experiment::lap::{Course, GRID};
use crate::world::ROBOT_RADIUS;
use fastslam::map::ConditionalMap;
use fastslam::sensor::Scan;

#[test]
fn the_deviation_is_that_of_weighted_positions() {
    let poses = [Pose2::new(0.0, 1.0, 2.0), Pose2::new(6.0, 9.0, -1.0)];
    assert_eq!(deviation(&poses, &[0.5, 0.5]), 5.0); // each 3 m and 4 m from the middle
    assert_eq!(deviation(&poses, &[1.0, 0.0]), 0.0);
    assert!((deviation(&poses, &[0.8, 0.2]) - 4.0).abs() < 1e-12); // √(0.8 · 0.2) of the 10 m between them
}

#[test]
fn walls_overlap_by_what_two_maps_have_in_common() {
    let map = |hits: [[f64; 2]; 2]| {
        let mut map: Grid = Grid::new(GRID);
        map.assimilate(&Pose2::default(), &Scan { hits: hits.to_vec(), ..Scan::default() }, &());
        map
    };
    let (one, other) = (map([[1.0, 0.1], [0.1, 1.0]]), map([[1.0, 0.1], [0.1, -1.0]]));
    assert_eq!(overlap(&[&one, &other]), 1.0 / 3.0);
    assert!((overlap(&[&one, &one, &other]) - (1.0 + 2.0 / 3.0) / 3.0).abs() < 1e-12);
    assert_eq!(overlap(&[&one]), 1.0);
}

#[test]
fn who_has_no_descendant_has_died() {
    assert_eq!(died(4, &[]), 0.0);
    assert_eq!(died(4, &[vec![0, 1, 1, 3]]), 0.25);
    // The copies of 3 are in slots 2 and 3, and slot 0 dies in the second resampling.
    assert_eq!(died(4, &[vec![0, 1, 3, 3], vec![1, 2, 2, 3]]), 0.5);
}

#[test]
fn the_loop_closes_where_the_start_comes_in_sight() {
    for (niches, max_range) in [(2, 3.0), (1, 2.5), (0, 3.0)] {
        let route = Route::ring(niches, max_range);
        let truth = drive(&route.way_points, route.steps);
        let closing = closing(&route).unwrap() as usize;
        assert!(closing + 2 * AFTER as usize <= route.steps);
        let nearest = |pose: &Pose2| truth[..20].iter().map(|early| early.distance(pose)).fold(f64::INFINITY, f64::min);
        // What is seen again may lie between here and there; before, the robot has been nowhere near.
        assert!(nearest(&truth[closing]) < 2.0 * max_range, "{}", nearest(&truth[closing]));
        for (step, pose) in truth.iter().enumerate().take(closing - 10).skip(40) {
            assert!(nearest(pose) > max_range, "step {step}: {:?}", pose);
        }
        // The corridor is 1.8 m wide, and the robot in its west side, on its way south.
        let Pose2 { x, y, theta } = truth[closing];
        assert!(x < 1.8 && y > 1.8 && (theta + core::f64::consts::FRAC_PI_2).abs() < 0.6, "{:?}", truth[closing]);
    }
    let there = Route { steps: 100, way_points: vec![[0.9, 0.9], [10.1, 0.9]], ..Route::ring(2, 3.0) };
    assert_eq!(closing(&there), None);
}

#[test]
fn a_run_is_a_lap_of_the_ring() {
    let lap = LapSetup { course: Course::Ring, particles: 3, seed: 5, ..LapSetup::default() };
    let run = RingRun::of(&RingSetup { lap: lap.clone(), ..RingSetup::default() }).unwrap();
    let (mut resampled, mut driven) = (0, Lap::new(&lap).unwrap());
    while driven.report().step + 1 < run.closing {
        resampled += u32::from(driven.step().unwrap().ancestors.is_some());
    }
    assert_eq!((run.resampled_before, run.lineage_before), (resampled, driven.report().lineage));
    assert_eq!(run.deviation_before, deviation_of(&driven));
    while driven.step().is_some() {}
    assert_eq!((run.rms_best, run.lineage), (driven.report().rms_best, driven.report().lineage));
    assert!(run.end_odometry > run.end_best, "{run:?}");
}

#[test]
fn the_rooms_are_driven_through_their_doors_and_the_loop_closes_before_the_end() {
    let route = Route::rooms();
    for pose in drive(&route.way_points, route.steps) {
        let free = (0..72).map(|k| route.plan.raycast([pose.x, pose.y], f64::from(k).to_radians() * 5.0));
        let nearest = free.fold(f64::INFINITY, f64::min);
        assert!(nearest > ROBOT_RADIUS, "{pose:?}: {nearest} m");
    }
    let closing = closing(&route).unwrap() as usize;
    assert!(closing > 60 && closing + 2 * AFTER as usize <= route.steps, "{closing}");
}

/// Before the first step all particles are one: where the drawn pose is paid for, those with the same draws pay the same, and all that a draw
/// of their own tells between them is noise. Where the integral is paid, a draw tells nothing.
#[test]
fn equal_particles_that_share_their_draws_pay_the_same() {
    let usual = LapSetup { particles: 3, ..LapSetup::default() };
    let at_draw = LapSetup { weight: ScanWeight::OldMapAtDraw, ..usual.clone() };
    let [usual, setup] = [usual, at_draw].map(|lap| RingSetup { lap, ..RingSetup::default() });
    let noise = noise_at(&usual.start().unwrap(), &usual.lap, NoiseProbe { draws: 20, ..NoiseProbe::default() }, 1);
    assert_eq!((noise.noise, noise.matched), (0.0, 1.0), "{noise:?}");
    let lap = setup.start().unwrap();
    let probe = NoiseProbe { draws: 20, ..NoiseProbe::default() };
    let shared = noise_at(&lap, &setup.lap, NoiseProbe { shared: true, ..probe }, 1);
    // The mean of three equal numbers is rounded.
    assert!(shared.noise_relative < 1e-12 && shared.spread < 1e-12 && shared.noise > 0.01, "{shared:?}");
    let own = noise_at(&lap, &setup.lap, probe, 1);
    assert!(own.noise_relative > 0.0 && own.spread > 0.0 && own.spread < own.noise, "{own:?}");
    // Half the steps are left out.
    let probe = NoiseProbe { every: 2, draws: 2, shared: false };
    let steps: Vec<u32> = price_noise(&setup, probe).unwrap().iter().map(|noise| noise.step).collect();
    assert_eq!(steps, (1..56).map(|half| 2 * half).collect::<Vec<_>>());
}

#[test]
fn settings_out_of_range_are_refused() {
    let refused = |setup: RingSetup| setup.start().unwrap_err().field();
    assert_eq!(refused(RingSetup { niches: 3, ..RingSetup::default() }), "niches");
    assert_eq!(refused(RingSetup { max_range: f64::NAN, ..RingSetup::default() }), "max_range");
    let lap = LapSetup { particles: 0, ..LapSetup::default() };
    assert_eq!(refused(RingSetup { lap, ..RingSetup::default() }), "particles");
}
