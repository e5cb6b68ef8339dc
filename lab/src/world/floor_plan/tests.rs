use super::*;
use core::f64::consts::{FRAC_PI_2, PI};

#[test]
fn beams_end_at_the_nearest_wall() {
    let room = FloorPlan {
        size: [4.0, 3.0],
        walls: vec![Segment { a: [4.0, 0.0], b: [4.0, 3.0] }, Segment { a: [0.0, 3.0], b: [4.0, 3.0] }],
        furniture: vec![Segment { a: [3.0, 0.0], b: [3.0, 3.0] }],
    };
    assert!((room.raycast([1.0, 1.0], 0.0) - 2.0).abs() < 1e-12);
    assert!((room.raycast([1.0, 1.0], FRAC_PI_2) - 2.0).abs() < 1e-12);
    assert_eq!(room.raycast([1.0, 1.0], PI), f64::INFINITY);
}

#[test]
fn no_beam_leaves_the_ring_or_enters_its_block() {
    for niches in 0..=2 {
        let plan = FloorPlan::ring(niches);
        for (origin, most) in [([1.6, 0.9], 9.5), ([10.1, 7.1], 10.2), ([0.9, 4.0], 4.4)] {
            for k in 0..720 {
                let range = plan.raycast(origin, PI * f64::from(k) / 360.0);
                assert!(range > 0.2 && range < most, "{niches} niches, {origin:?}, beam {k}: {range} m");
            }
        }
        // From the middle of the south, north, east and west corridors to the block: once in 2 cm a wall, or a niche's back.
        let deep = |upright: bool| {
            let [from, to, length] = if upright { [1.8, 6.2, 0.02] } else { [1.8, 9.2, 0.02] };
            let ahead = |along: f64| match upright {
                true => [([0.9, along], 0.0), ([10.1, along], PI)],
                false => [([along, 0.9], FRAC_PI_2), ([along, 7.1], -FRAC_PI_2)],
            };
            let count = ((to - from) / length) as u32;
            let places = (0..count).map(|k| from + length * (f64::from(k) + 0.5));
            let ranges = places.flat_map(ahead).map(|(origin, angle)| plan.raycast(origin, angle));
            length * ranges.filter(|range| (range - 1.4).abs() < 1e-9).count() as f64
        };
        // Two sides each way, niches of 0.9 m.
        for upright in [false, true] {
            assert!((deep(upright) - 2.0 * 0.9 * niches as f64).abs() < 0.1, "{niches}: {}", deep(upright));
        }
    }
}

#[test]
fn no_beam_leaves_the_long_corridors_or_enters_a_block() {
    let plan = FloorPlan::long_corridors();
    // In the corners and the middle corridor; from there the furthest end of a corridor is 60.7 m away.
    for origin in [[1.3, 1.3], [60.7, 40.7], [31.0, 40.7], [31.0, 20.0]] {
        for k in 0..720 {
            let range = plan.raycast(origin, PI * f64::from(k) / 360.0 + 1e-4);
            assert!(range > 1.0 && range < 61.0, "{origin:?}, beam {k}: {range} m");
        }
    }
    // A door's back in one of some nine beams across: 27 m of south wall of the west block have three doors of 1 m.
    let deep = (0..2700).filter(|k| plan.raycast([2.6 + 0.01 * f64::from(*k), 1.3], FRAC_PI_2) > 1.2).count();
    assert!((295..=305).contains(&deep), "{deep} cm");
}

#[test]
fn a_robot_that_is_moved_with_the_place_sees_the_same() {
    let (plan, pose, motion) = (FloorPlan::apartment(), Pose2::new(6.0, 4.7, 0.3), Pose2::new(3.0, -2.0, 0.8));
    let (moved, there) = (plan.moved(&motion), motion.compose(&pose));
    for k in 0..90 {
        let angle = PI * f64::from(k) / 45.0;
        let (here, moved) = ([pose.x, pose.y], moved.raycast([there.x, there.y], there.theta + angle));
        assert!((plan.raycast(here, pose.theta + angle) - moved).abs() < 1e-9, "beam {k}");
    }
    assert_eq!(plan.moved(&Pose2::default()), plan);
}

#[test]
fn no_beam_leaves_the_apartment() {
    let plan = FloorPlan::apartment();
    for k in 0..720 {
        let range = plan.raycast([6.0, 4.7], PI * f64::from(k) / 360.0);
        assert!(range > 0.2 && range < 15.0, "beam {k}: {range} m");
    }
}
