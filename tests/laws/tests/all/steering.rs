//! A reader at the wheel: what was driven stays as it was, walls stop the robot, no universe finds a robot that was lifted, and a text
//! from outside is read or refused.

use fastslam::geometry::Pose2;
use fastslam_lab::experiment::lap::{Course, Lap, LapSetup, LapWorld, STEPS};
use fastslam_lab::experiment::ring::median;
use fastslam_lab::world::{
    EditError, Edits, GridWall, MOST_STEPS, Motion, Place, ROBOT_RADIUS, Steering, Turn, WallEdits, WallId,
};
use proptest::prelude::*;
use std::sync::Arc;

fn setup(edits: Edits) -> LapSetup {
    LapSetup { edits, ..LapSetup::default() }
}

fn steered(from: usize, motions: impl IntoIterator<Item = Motion>) -> Steering {
    let mut steering = Steering::default();
    for (k, motion) in motions.into_iter().enumerate() {
        steering.drive_on(from + k, STEPS, motion).unwrap();
    }
    steering
}

fn motion() -> impl Strategy<Value = Motion> {
    let pose = (0.2..11.8, 0.2..8.8, -3.1..3.1).prop_map(|(x, y, theta)| Pose2::new(x, y, theta));
    prop_oneof![
        10 => (-3..=3).prop_map(|k| Motion::Turn(Turn::by(k))),
        30 => (-12..=12).prop_map(|k| Motion::Go(Turn::by(k))),
        5 => Just(Motion::Back),
        1 => pose.prop_map(|pose| Motion::Lift(Place::near(&pose))),
    ]
}

/// What a drive left behind up to a step, bit for bit: poses have no equality of bits, but their text has.
fn history(world: &LapWorld, steps: usize) -> String {
    let LapWorld { truth, odometry, controls, scans, .. } = world;
    format!("{:?}", (&truth[..=steps], &odometry[..=steps], &controls[..steps], &scans[..steps]))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_drive_is_read_as_it_is_written(from in 0..=STEPS, motions in prop::collection::vec(motion(), 1..60)) {
        let mut steering = Steering::default();
        for (k, motion) in motions.iter().enumerate() {
            let full = steering.drive_on(from + k, STEPS, *motion) == Err(EditError::Many);
            prop_assert!(!full || motions.iter().filter(|m| matches!(m, Motion::Lift(_))).count() > 8);
            if full {
                break;
            }
        }
        prop_assert_eq!(steering.to_string().parse(), Ok(steering));
    }

    #[test]
    fn walls_are_read_as_they_are_written(
        walls in prop::collection::vec(((0.0..12.0, 0.0..9.0), (0.0..12.0, 0.0..9.0)), 0..60),
        erased in prop::collection::vec(4_u16..60, 0..50),
    ) {
        let mut edits = WallEdits::default();
        for ((ax, ay), (bx, by)) in walls {
            if let Some(wall) = GridWall::near([ax, ay], [bx, by]) {
                edits.add(wall).unwrap();
            }
        }
        erased.into_iter().for_each(|rank| edits.erase(WallId::Course(rank)).unwrap());
        prop_assert_eq!(edits.to_string().parse(), Ok(edits));
    }

    #[test]
    fn any_text_is_read_or_refused(text in "\\PC*", letters in "1\\.[0-9]{0,3}\\.[a-zA-Z0-9~_.]{0,600}") {
        for text in [&text, &letters] {
            if let Ok(steering) = text.parse::<Steering>() {
                prop_assert!(steering.steps(STEPS) <= MOST_STEPS);
                prop_assert_eq!(steering.to_string().parse(), Ok(steering));
            }
            if let Ok(walls) = text.parse::<WallEdits>() {
                prop_assert_eq!(&walls.to_string(), text);
            }
        }
    }

    #[test]
    fn what_was_driven_stays_when_more_is_driven(
        from in 0..=STEPS,
        motions in prop::collection::vec(motion(), 2..12),
        cut in 0_usize..12,
    ) {
        let whole = steered(from, motions.iter().copied());
        let route = Course::Apartment.route();
        let part = if cut == 0 { Steering::default() } else { steered(from, motions.iter().copied().take(cut)) };
        let world = |steering: &Steering| setup(Edits { steering: steering.clone(), ..Edits::default() }).world();
        let (all, short) = (world(&whole), world(&part));
        let kept = whole.in_common(&part, STEPS);
        prop_assert_eq!(history(&all, kept), history(&short, kept));
        // And what is computed from one drive on is the other, whole.
        let steps = whole.steps(STEPS);
        let went_on = short.driven(&route, &part, &whole);
        prop_assert_eq!(history(&went_on, steps), history(&all, steps));
        prop_assert_eq!((&went_on.stopped, &went_on.lifted), (&all.stopped, &all.lifted));
    }

    #[test]
    fn no_robot_drives_through_a_wall(motions in prop::collection::vec(motion(), 1..80)) {
        let lifts = motions.iter().filter(|motion| matches!(motion, Motion::Lift(_))).count();
        prop_assume!(lifts <= 8);
        let world = setup(Edits { steering: steered(40, motions), ..Edits::default() }).world();
        for (step, pair) in world.truth.windows(2).enumerate().skip(40) {
            let ends = [[pair[0].x, pair[0].y], [pair[1].x, pair[1].y]];
            let lifted = world.lifted.contains(&(step as u32 + 1));
            prop_assert!(lifted || world.plan.is_open(ends[0], ends[1]), "step {}", step + 1);
            if world.stopped.contains(&(step as u32 + 1)) {
                prop_assert_eq!(pair[0], pair[1]);
                let control = world.controls[step];
                prop_assert_eq!((control.rot1, control.trans, control.rot2), (0.0, 0.0, 0.0));
            }
        }
        // Whoever was not set down too near a wall never comes too near one.
        if lifts == 0 {
            let room = world.truth.iter().map(|at| world.plan.clearance([at.x, at.y], [at.x, at.y]));
            prop_assert!(room.fold(f64::INFINITY, f64::min) >= ROBOT_RADIUS - 1e-9);
        }
    }
}

#[test]
fn the_robot_stands_before_a_wall_that_was_put_up_in_its_way() {
    let mut edits = Edits::default();
    edits.walls.add(GridWall::near([6.0, 3.9], [6.0, 5.4]).unwrap()).unwrap();
    let world = setup(edits).world();
    let first = world.stopped[0] as usize;
    assert_eq!(world.stopped, (first as u32..=STEPS as u32).collect::<Vec<_>>(), "it does not find its way again");
    let end = world.truth[STEPS];
    assert!((5.4..=5.8).contains(&end.x) && world.truth[first..].iter().all(|pose| *pose == end), "{end:?}");
}

#[test]
fn an_erased_wall_is_neither_seen_nor_in_the_way() {
    // Between kitchen and bath, at x = 4.2.
    let mut edits = Edits::default();
    edits.walls.erase(WallId::Course(12)).unwrap();
    let lift = Motion::Lift(Place::near(&Pose2::new(3.6, 2.0, 0.0)));
    edits.steering = steered(0, [lift].into_iter().chain([Motion::straight(); 4]));
    let with = |edits: &Edits| setup(edits.clone()).world();
    let (open, closed) = (with(&edits), with(&Edits { walls: WallEdits::default(), ..edits.clone() }));
    assert!(open.truth[5].x > 4.7 && open.stopped.is_empty());
    assert!(closed.truth[5].x < 4.0 && !closed.stopped.is_empty());
    assert_ne!(format!("{:?}", open.scans[0]), format!("{:?}", closed.scans[0]));
}

#[test]
fn a_filter_goes_on_in_a_world_that_is_driven_on() {
    let (before, after) = (steered(10, [Motion::straight(); 3]), steered(10, [Motion::straight(); 6]));
    let of = |steering: &Steering| setup(Edits { steering: steering.clone(), ..Edits::default() });
    let mut whole = Lap::new(&of(&after)).unwrap();
    let mut lap = Lap::new(&of(&before)).unwrap();
    while lap.step().is_some() {}
    let world = lap.world().driven(&Course::Apartment.route(), &before, &after);
    let mut lap = lap.with_world(Arc::new(world));
    while lap.step().is_some() {}
    while whole.step().is_some() {}
    assert_eq!(format!("{:?}", lap.report()), format!("{:?}", whole.report()));
}

#[test]
fn edits_that_do_not_fit_the_course_are_refused() {
    let lift = |x: f64| steered(0, [Motion::Lift(Place::near(&Pose2::new(x, 4.6, 0.0)))]);
    let edits = |steering| Edits { steering, ..Edits::default() };
    let refused = |edits: Edits| Lap::new(&setup(edits)).err().map(|error| error.to_string());
    assert_eq!(refused(edits(lift(4.0))), None);
    assert_eq!(refused(edits(lift(13.0))).unwrap(), "drive: must be inside the outer walls of the course");
    assert_eq!(
        refused(Edits { walls: "1.00.".parse().unwrap(), ..Edits::default() }).unwrap(),
        "plan: must be inside the outer walls of the course"
    );
}

/// The law behind what the figure says of a kidnapping. Sixteen universes, lifted from the corridor into the sun room, then driven on
/// for 20 steps; the distance is that of the nearest universe.
#[test]
fn no_universe_finds_a_robot_that_was_lifted() {
    let lift = Motion::Lift(Place::near(&Pose2::new(9.6, 7.6, 0.0)));
    let circle = (0..19).map(|_| Motion::Turn(Turn::by(2)));
    let steering = steered(25, [lift].into_iter().chain(circle));
    let distances = (0..20).map(|seed| {
        let edits = Edits { steering: steering.clone(), ..Edits::default() };
        let mut lap = Lap::new(&LapSetup { seed, ..setup(edits) }).unwrap();
        let mut of_steps = Vec::new();
        while lap.step().is_some() {
            if lap.report().step > 25 {
                of_steps.push(lap.nearest_universe());
            }
        }
        assert_eq!(of_steps.len(), 20);
        of_steps.into_iter().fold(f64::INFINITY, f64::min)
    });
    let nearest: Vec<f64> = distances.collect();
    let middle = median(nearest.clone());
    assert!(middle > 1.0, "{nearest:?}");
}
