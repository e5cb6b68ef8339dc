use super::*;
use crate::experiment::ProposalKind;
use crate::world::{FloorPlan, drive};
use fastslam::ops;

const COURSES: [Course; 3] = [Course::Apartment, Course::Ring, Course::Rooms];

#[test]
fn courses_are_read_as_they_are_printed() {
    for course in COURSES {
        assert_eq!(course.to_string().parse(), Ok(course));
    }
    assert_eq!("moon".parse::<Course>().unwrap_err().to_string(), "course = moon: must be apartment, ring or rooms");
}

/// A robot is some 0.4 m wide.
#[test]
fn no_drive_goes_through_a_wall_or_scrapes_along_one() {
    let rings = [0, 1, 2].map(|niches| Route::ring(niches, 3.0));
    for Route { plan, way_points, steps, .. } in COURSES.map(Course::route).into_iter().chain(rings) {
        let truth = drive(&way_points, steps);
        for (k, pair) in truth.windows(2).enumerate() {
            let ahead = ops::atan2(pair[1].y - pair[0].y, pair[1].x - pair[0].x);
            let free = plan.raycast([pair[0].x, pair[0].y], ahead);
            assert!(free > pair[0].distance(&pair[1]) + 0.2, "step {k} at {:?}: a wall after {free} m", pair[0]);
            let around = (0..360).map(|degree| f64::from(degree).to_radians());
            let room = around.map(|angle| plan.raycast([pair[0].x, pair[0].y], angle)).fold(f64::INFINITY, f64::min);
            assert!(room > 0.2, "step {k} at {:?}: {room} m to a wall", pair[0]);
        }
    }
}

#[test]
fn a_course_is_driven_to_its_end_without_being_stopped() {
    for course in COURSES {
        let world = LapSetup { course, ..LapSetup::default() }.world();
        let route = course.route();
        assert_eq!(world.truth, drive(&route.way_points, route.steps));
        assert_eq!((world.stopped, world.lifted), (vec![], vec![]));
    }
}

/// To the bit, also with a reader's own walls and drive.
#[test]
fn a_world_made_from_another_one_is_that_of_its_setup() {
    let same = |a: &LapWorld, b: &LapWorld| {
        let of = |w: &LapWorld| {
            (
                w.truth.clone(),
                w.odometry.clone(),
                w.controls.clone(),
                w.scans.clone(),
                w.start_scans.clone(),
                w.stopped.clone(),
            )
        };
        of(a) == of(b) && (a.felt.len(), a.noise.motion) == (b.felt.len(), b.noise.motion)
    };
    let base = LapSetup { course: Course::Rooms, ..LapSetup::default() };
    let world = Arc::new(base.world());
    let others = [
        LapSetup { odometry_scale: 1.3, ..base.clone() },
        LapSetup { odometry_scale: 0.0, particles: 4, ..base.clone() },
        LapSetup { particles: 4, temper: 0.5, ..base.clone() },
        LapSetup { range_std: 0.1, odometry_scale: 1.3, ..base.clone() },
        LapSetup { seed: 8, ..base.clone() },
        LapSetup { course: Course::Ring, ..base.clone() },
    ];
    for other in &others {
        let made = other.world_like(&base, &world);
        assert!(same(&made, &other.world()), "{other:?}");
        assert_eq!(Arc::ptr_eq(&made, &world), other.particles == 4 && other.odometry_scale == 1.0);
        assert!(same(&base.world_like(other, &made), &world), "and back: {other:?}");
    }
}

#[test]
fn each_course_has_its_own_world() {
    let setup = |course| LapSetup { course, ..LapSetup::default() };
    let [apartment, ring, rooms] = COURSES.map(|course| Lap::new(&setup(course)).unwrap());
    let steps = [&apartment, &ring, &rooms].map(Lap::step_count);
    assert_eq!(steps, [STEPS, RING_STEPS, RING_STEPS].map(|steps| steps as u32));
    assert_eq!(COURSES.map(Course::steps), COURSES.map(|course| course.route().steps));
    let furthest = |lap: &Lap| {
        let ends = lap.world().scans.iter().flat_map(|scan| scan.hits.iter().chain(&scan.misses));
        ends.map(|[x, y]| ops::hypot(*x, *y)).fold(0.0, f64::max)
    };
    assert!(furthest(&apartment) > 4.0 && [&ring, &rooms].iter().all(|lap| furthest(lap) <= 3.0 + 1e-9));
    assert_eq!(apartment.world().plan, FloorPlan::apartment());
    assert_eq!(COURSES.map(Course::closing), [None, Some(84), Some(80)]);
}

/// The draws go through numbers, as between two programs; an odd population has parts of two sizes.
#[test]
fn a_step_of_which_two_draw_a_part_each_is_the_step_of_one() {
    for (proposal, particles) in [(ProposalKind::Improved, 7), (ProposalKind::Motion, 4), (ProposalKind::Improved, 1)] {
        let setup = LapSetup { proposal, particles, ..LapSetup::default() };
        let [mut alone, mut shared] = [(); 2].map(|()| Lap::new(&setup).unwrap());
        while alone.step().is_some() {
            let part = |part| shared::to_numbers(&shared.propose(shared::slots(part, particles)));
            let numbers = [part(0), part(1)].concat();
            assert_eq!(numbers.len(), particles * shared::NUMBERS);
            shared.step_by(Some(shared::from_numbers(&numbers)));
            assert_eq!(format!("{:?}", shared.report()), format!("{:?}", alone.report()), "{proposal}, {particles}");
        }
        assert!(shared.propose(0..particles).is_empty(), "after the last step");
        assert_eq!(shared.trace().value(), alone.trace().value());
    }
}
