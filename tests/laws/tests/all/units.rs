//! Ranges whose unit changes while a log is recorded.

use fastslam::geometry::Pose2;
use fastslam::sensor::LaserScan;
use fastslam_log::{LaserLog, UnitChange};

/// Forty scans on the way along a corridor that is 2 m wide and ends ahead, some beams of which meet nothing, with the k-th scan's ranges multiplied.
fn log(times: impl Fn(usize) -> f64) -> LaserLog {
    let scan = |k: usize| {
        let range = |beam: usize| match (beam, beam % 10) {
            (_, 3) => 81.83,
            (80..100, _) => 14.0 - 0.3 * k as f64,
            _ => 1.0 / fastslam::ops::sin(beam as f64 / 60.0).abs().max(0.1),
        };
        LaserScan {
            time: k as f64,
            odometry: Pose2::new(0.3 * k as f64, 0.0, 0.0),
            robot_from_laser: Pose2::default(),
            first_angle: 0.0,
            angle_step: 0.02,
            max_range: None,
            ranges: (0..180).map(|beam| (times(k) * range(beam)) as f32).collect(),
        }
    };
    LaserLog { scans: (0..40).map(scan).collect(), ..LaserLog::default() }
}

#[test]
fn ranges_are_brought_to_the_longest_of_their_units() {
    type Unit = fn(usize) -> f64;
    let kinds: [(Unit, &[UnitChange]); 5] = [
        (|_| 1.0, &[]),
        (|k| if k < 20 { 1.0 } else { 1000.0 }, &[UnitChange { time: 20.0, times: 1000.0 }]),
        (|k| if k < 20 { 100.0 } else { 1.0 }, &[UnitChange { time: 20.0, times: 0.01 }]),
        (
            |k| if (10..30).contains(&k) { 100.0 } else { 1.0 },
            &[UnitChange { time: 10.0, times: 100.0 }, UnitChange { time: 30.0, times: 0.01 }],
        ),
        // What is in one unit throughout, and what is a little off, changes none.
        (|k| if k < 20 { 100.0 } else { 300.0 }, &[]),
    ];
    for (times, changes) in kinds {
        let mut told = log(times);
        assert_eq!(told.bring_to_one_unit(), changes);
        let meant = if changes.is_empty() { log(times) } else { log(|_| 1.0) };
        for (told, meant) in told.scans.iter().zip(&meant.scans) {
            let off = told.ranges.iter().zip(&meant.ranges).map(|(told, meant)| (told / meant - 1.0).abs());
            assert!(off.fold(0.0, f32::max) < 1e-6);
        }
    }
}

#[test]
fn scans_that_meet_nothing_or_hardly_anything_are_in_no_unit() {
    let mut told = log(|_| 1.0);
    for (k, scan) in told.scans.iter_mut().enumerate() {
        match k {
            10..15 => scan.ranges.fill(81.83),
            20..25 => scan.ranges.fill(0.02),
            30..35 => scan.ranges[5..].fill(f32::NAN),
            35 => scan.ranges.clear(),
            _ => {}
        }
    }
    assert_eq!(told.bring_to_one_unit(), []);
}
