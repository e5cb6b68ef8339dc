use super::*;
use crate::experiment::Fraction;

fn log(seed: u64) -> Log {
    Log::new(&DoorsSetup { seed, ..DoorsSetup::default() })
}

/// The last report of a run.
fn end(setup: &DoorsSetup) -> DoorsReport {
    let mut doors = Doors::new(setup).unwrap();
    core::iter::from_fn(|| doors.step()).last().unwrap()
}

#[test]
fn who_is_off_by_a_door_foretells_every_sighting_before_the_sign() {
    for seed in 1..50 {
        let log = log(seed);
        assert!(log.first_door < log.sign);
        for k in log.first_door..log.sign {
            for feature in &log.sightings[k] {
                let place = log.truth[k + 1] + feature.z.x;
                let door = (place / SPACING).round();
                assert!((place - SPACING * door).abs() < 0.5 && (1.0..=6.0).contains(&door));
            }
        }
        for feature in &log.sightings[log.sign] {
            let nearest = ((log.truth[log.sign + 1] + feature.z.x) / SPACING + 0.5).fract() - 0.5;
            assert!((nearest * SPACING).abs() > 0.5, "the sign is where no door would be");
        }
    }
}

/// It decides at the first door, and all that follows only makes it surer: right or wrong, it ends a whole number of doors from the
/// truth, certain to centimetres.
#[test]
fn the_kalman_filter_is_certain_whether_it_is_right_or_wrong() {
    let mut wrong = 0;
    for seed in 1..30 {
        let last = end(&DoorsSetup { seed, particles: 1, ..DoorsSetup::default() });
        let off = (last.ekf_place - last.truth) / SPACING;
        assert!((off - off.round()).abs() * SPACING < 0.5, "seed {seed}: {off} doors off");
        assert!(last.ekf_std < 0.1, "seed {seed}");
        wrong += u32::from(off.round() != 0.0);
    }
    assert!(wrong > 0);
}

/// From the first door after the ride on, the explanation that EKF-SLAM has is the one that it ends with.
#[test]
fn the_kalman_filter_never_lets_go_of_the_door_that_it_decided_for() {
    for seed in 1..30 {
        let setup = DoorsSetup { seed, particles: 1, ..DoorsSetup::default() };
        let mut doors = Doors::new(&setup).unwrap();
        let [_, first_door, _] = doors.events();
        let reports = core::iter::from_fn(|| doors.step()).filter(|report| report.step >= first_door);
        let mut off: Vec<i32> = reports.map(|report| setup.off(report.ekf_place, report.truth)).collect();
        off.dedup();
        assert_eq!(off.len(), 1, "seed {seed}: {off:?}");
    }
}

#[test]
fn particles_hold_several_doors_at_once_and_are_right_where_the_kalman_filter_is_not() {
    for proposal in [ProposalKind::Motion, ProposalKind::Improved] {
        let setup = DoorsSetup { particles: 400, proposal, ..DoorsSetup::default() };
        let outcomes = outcomes(&setup, 1..41).unwrap();
        assert!(outcomes.iter().filter(|o| o.first >= 4).count() > 30, "{outcomes:?}");
        let fastslam = Fraction::of(outcomes.iter().map(|o| o.fastslam_right)).wilson();
        let ekf = Fraction::of(outcomes.iter().map(|o| o.ekf_right)).wilson();
        assert!(fastslam[0] > ekf[1], "{fastslam:?} against {ekf:?}");
    }
}

/// The chapter's counts, from before a run could be stepped through.
#[test]
fn what_the_first_seeds_come_to_stays_as_it_is() {
    let right = |particles: usize| {
        let setup = DoorsSetup { particles, ..DoorsSetup::default() };
        let outcomes = outcomes(&setup, 1..21).unwrap();
        let count = |right: fn(&DoorsOutcome) -> bool| outcomes.iter().filter(|outcome| right(outcome)).count();
        (count(|o| o.fastslam_right), count(|o| o.ekf_right), outcomes.iter().map(|o| o.first + o.last).sum::<u32>())
    };
    assert_eq!([25, 100, 400].map(right), [(9, 6, 89), (16, 6, 161), (20, 6, 191)]);
}

#[test]
fn a_door_believed_in_is_where_the_particle_is() {
    let setup = DoorsSetup { particles: 200, ..DoorsSetup::default() };
    let mut doors = Doors::new(&setup).unwrap();
    while let Some(report) = doors.step() {
        for (place, belief) in report.places.iter().zip(&report.beliefs) {
            if let (Belief::Landmark(rank), false) = (belief, report.seen.is_empty()) {
                let landmark = setup.doors.get(*rank as usize).copied().unwrap_or(SIGN);
                assert!((landmark - place).abs() < REACH + 1.0, "{place} sees {landmark}");
            }
            assert!(*belief != Belief::New || report.step > doors.events()[0], "while it maps it finds what is there");
        }
        if report.step == doors.events()[0] {
            assert!(report.beliefs.iter().all(|belief| *belief == Belief::Nothing), "its eyes were closed");
        }
    }
}

#[test]
fn a_ride_that_ends_elsewhere_and_doors_elsewhere_make_another_log() {
    let setup = DoorsSetup { end: Some(4.0), ..DoorsSetup::default() };
    let doors = Doors::new(&setup).unwrap();
    let [ride, ..] = doors.events();
    assert_eq!(doors.truth()[ride as usize], 4.0);
    assert_eq!(setup.spacing(), SPACING);
    let uneven = DoorsSetup { doors: vec![2.0, 4.0, 12.0], ..setup };
    assert_eq!((uneven.spacing(), uneven.off(7.0, 2.5)), (5.0, 1));
    assert!(Doors::new(&DoorsSetup { doors: vec![5.0], ..uneven }).unwrap().step().is_some());
}

#[test]
fn the_pencil_says_how_often_the_likeliest_door_is_right() {
    let of = |ride_std| DoorsSetup { ride_std, ..DoorsSetup::default() }.pencil();
    assert!((of(4.0) - 0.292_3).abs() < 1e-4, "{}", of(4.0));
    assert!(of(0.0) == 1.0 && of(0.5) > 0.99 && of(20.0) < 0.1);
}

#[test]
fn an_explanation_counts_by_its_weight() {
    let places = [9.0, 9.1, 12.0, 15.2, 100.0, -100.0];
    let shares = shares(&DoorsSetup::default(), &places, &[0.5, 0.3, 0.15, 0.005, 0.025, 0.02], 9.0);
    assert_eq!(shares.iter().filter(|share| **share >= HELD).count(), 2);
    assert_eq!((shares[FARTHEST as usize], shares[FARTHEST as usize + 1]), (0.8, 0.15));
}

#[test]
fn settings_out_of_range_are_named() {
    let refused = |setup: DoorsSetup| outcomes(&setup, 1..2).unwrap_err().field();
    let usual = DoorsSetup::default;
    assert_eq!(refused(DoorsSetup { particles: 0, ..usual() }), "particles");
    assert_eq!(refused(DoorsSetup { policy: ResamplePolicy::EssBelow(1.5), ..usual() }), "policy");
    assert_eq!(refused(DoorsSetup { ride_std: f64::NAN, ..usual() }), "ride_std");
    assert_eq!(refused(DoorsSetup { end: Some(18.0), ..usual() }), "end");
    assert_eq!(refused(DoorsSetup { sensor_std: 0.0, ..usual() }), "sensor_std");
    for doors in [vec![], vec![1.0; 8], vec![-1.0]] {
        assert_eq!(refused(DoorsSetup { doors, ..usual() }), "doors");
    }
}

/// Before the ride nothing knows of it: with another one the drive goes on as if it had been that from the start.
#[test]
fn another_ride_after_the_same_drive_is_as_if_it_were_the_first() {
    let setup = DoorsSetup { seed: 3, particles: 20, ..DoorsSetup::default() };
    let rest = |mut doors: Doors| -> Vec<DoorsReport> { core::iter::from_fn(|| doors.step()).collect() };
    let mut mapped = Doors::new(&setup).unwrap();
    let before = mapped.events()[0] - 1;
    (0..before).for_each(|_| drop(mapped.step()));
    let resumed = |other: &DoorsSetup, from: &Doors| Doors::new(other).unwrap().resumed(from);
    for other in [DoorsSetup { ride_std: 1.0, ..setup.clone() }, DoorsSetup { end: Some(9.0), ..setup.clone() }] {
        let ridden = rest(resumed(&other, &mapped));
        assert_eq!(ridden, rest(Doors::new(&other).unwrap())[before as usize..]);
        assert_ne!(ridden, rest(mapped.clone()));
    }
    let other = DoorsSetup { sensor_std: 0.2, ..setup.clone() };
    assert_eq!(resumed(&other, &mapped).step_number(), 0, "another drive");
    drop(mapped.step());
    assert_eq!(resumed(&setup, &mapped).step_number(), 0, "its ride is over");
}
