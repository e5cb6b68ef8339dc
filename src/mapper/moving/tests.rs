use super::*;
use core::f64::consts::PI;

/// A laser: where it sits, its first beam and from one to the next \[rad\], and how many.
type Laser = (Pose2, [f64; 2], usize);

const AHEAD: Laser = (Pose2 { x: 0.0, y: 0.0, theta: 0.0 }, [-0.5 * PI, PI / 180.0], 181);

/// One that looks ahead, one that looks all around and begins behind, one that looks all around, clockwise, beside the robot's middle and
/// turned, and one that looks three quarters around.
fn lasers() -> [Laser; 4] {
    [
        AHEAD,
        (Pose2::default(), [-PI, PI / 180.0], 360),
        (Pose2::new(0.2, -0.1, 2.0), [0.0, -PI / 180.0], 360),
        (Pose2::default(), [-0.75 * PI, PI / 180.0], 271),
    ]
}

/// What a laser of a robot at `pose` sees of a room of 12 m × 8 m round the origin, and of people in it, 0.4 m wide.
fn seen(pose: Pose2, (robot_from_laser, [first_angle, angle_step], count): Laser, people: &[[f64; 2]]) -> LaserScan {
    let laser = pose.compose(&robot_from_laser);
    let range = |k: usize| {
        let (sin, cos) = ops::sin_cos(laser.theta + first_angle + k as f64 * angle_step);
        let wall = ((6.0 - laser.x * cos.signum()) / cos.abs()).min((4.0 - laser.y * sin.signum()) / sin.abs());
        let person = |[x, y]: &[f64; 2]| {
            let (dx, dy) = (x - laser.x, y - laser.y);
            let (along, aside) = (cos * dx + sin * dy, cos * dy - sin * dx);
            if along > 0.0 && aside.abs() < 0.2 { along - (0.04 - aside * aside).sqrt() } else { f64::INFINITY }
        };
        people.iter().map(person).fold(wall, f64::min) as f32
    };
    let ranges = (0..count).map(range).collect();
    LaserScan { time: 0.0, odometry: pose, robot_from_laser, first_angle, angle_step, max_range: None, ranges }
}

/// A motion with an uncertainty of 2 cm and 2°, and some more for each metre and each radian.
fn told(moved: &Pose2, [way, turned]: [f64; 2]) -> Displacement {
    let [position, heading] = [0.02 + 0.02 * way, 0.035 + 0.02 * way + 0.05 * turned].map(|std: f64| std * std);
    Displacement { mean: *moved, covariance: Matrix3::from_diagonal(&[position, position, heading].into()) }
}

/// How many end points of each of these scans stand still, and how many do not.
fn sorted(scans: &[LaserScan]) -> Vec<[usize; 2]> {
    let mut views = LastViews::default();
    let sort = |scan: &LaserScan| {
        let Scan { hits, misses, .. } = views.standing(scan, scan.odometry, scan.beams(f64::INFINITY, 30.0, 0.0), told);
        [hits.len(), misses.len()]
    };
    scans.iter().map(sort).collect()
}

/// Ahead along the room's length, turning a little.
fn way() -> impl Iterator<Item = Pose2> {
    (0..20).map(|k| Pose2::new(-4.0 + 0.4 * f64::from(k), 0.3, 0.02 * f64::from(k)))
}

#[test]
fn what_stands_is_not_taken_to_move_though_odometry_be_off_by_nearly_as_much_as_is_searched() {
    for laser in lasers() {
        let (_, _, count) = laser;
        for error in [[0.0; 3], [2.5, 0.0, 0.0], [-2.5, 0.0, 0.0], [0.0, 2.5, 0.0], [0.0, 0.0, -2.5]] {
            let places = [[1.0, 2.0], [-1.0, -2.0], [4.5, 0.0], [-3.0, 1.2]];
            let mut scans: Vec<LaserScan> = way().map(|pose| seen(pose, laser, &places)).collect();
            // The error is there all at once, in one step of the way.
            let [x, y, theta] = error;
            for scan in &mut scans[9..] {
                let off = Pose2::new(0.028 * x, 0.028 * y, 0.043 * theta);
                scan.odometry =
                    way().nth(9).unwrap().compose(&off).compose(&way().nth(9).unwrap().between(&scan.odometry));
            }
            let sorted = sorted(&scans);
            assert!(sorted.iter().all(|sorted| *sorted == [count, 0]), "{laser:?}, {error:?}: {sorted:?}");
        }
    }
}

#[test]
fn what_stands_is_not_taken_to_move_though_turns_on_the_spot_add_up_to_none() {
    let turn = |k: u32| 10_f64.to_radians() * f64::from(k);
    let round: Vec<f64> = (0..=36).map(turn).collect();
    let there_and_back: Vec<f64> = (0..=9).chain((0..9).rev()).map(turn).collect();
    for laser in lasers() {
        let (_, _, count) = laser;
        // A full turn of which odometry tells 3 % too much, and a turn there and back of which it tells 5 % too much on the way there.
        for (headings, told) in [(&round, [1.03, 1.03]), (&there_and_back, [1.05, 1.0])] {
            let mut heading = 0.0;
            let scan = |(k, theta): (usize, &f64)| {
                let turned = theta - if k > 0 { headings[k - 1] } else { 0.0 };
                heading += turned * told[usize::from(turned < 0.0)];
                let scan = seen(Pose2::new(1.0, 0.5, *theta), laser, &[]);
                LaserScan { odometry: Pose2::new(1.0, 0.5, ops::wrap_angle(heading)), ..scan }
            };
            let scans: Vec<LaserScan> = headings.iter().enumerate().map(scan).collect();
            let sorted = sorted(&scans);
            assert!(sorted.iter().all(|sorted| *sorted == [count, 0]), "{laser:?}, {told:?}: {sorted:?}");
        }
    }
}

#[test]
fn who_comes_into_free_space_moves() {
    for laser in lasers() {
        // He crosses the way before the robot, which stands.
        let scans = [2.0, 1.0, 0.0].map(|y| seen(Pose2::default(), laser, &[[2.0, y]]));
        let sorted = sorted(&scans);
        assert_eq!(sorted[0][1], 0, "{laser:?}");
        assert!(sorted[1..].iter().all(|[_, moving]| (5..15).contains(moving)), "{laser:?}: {sorted:?}");
    }
}

#[test]
fn who_goes_along_with_the_robot_moves_also_where_he_hides_what_is_before_him() {
    for laser in lasers() {
        for place in [[1.2, 0.0], [0.0, 1.0], [0.3, -0.9]] {
            let scans: Vec<LaserScan> = way().map(|pose| seen(pose, laser, &[pose.transform(place)])).collect();
            let sorted = sorted(&scans);
            let found = sorted.iter().filter(|[_, moving]| *moving > 0).count();
            assert!(found > 14, "{laser:?}, {place:?}: {sorted:?}");
            // A metre from the laser he takes 23 beams; some more are taken for him, of the wall that he hid.
            assert!(sorted.iter().all(|[_, moving]| *moving < 46), "{laser:?}, {place:?}: {sorted:?}");
        }
    }
}

#[test]
fn what_has_not_moved_for_some_metres_stands() {
    // He comes between the first scan and the second, and stays.
    let mut scans: Vec<LaserScan> = way().map(|pose| seen(pose, AHEAD, &[[1.0, 1.5]])).collect();
    scans[0] = seen(way().next().unwrap(), AHEAD, &[]);
    let sorted = sorted(&scans);
    assert!(sorted[1][1] > 0, "{sorted:?}");
    let later = (MOVING.view_reach / 0.4).ceil() as usize + 1;
    assert!(sorted[later..].iter().all(|[_, moving]| *moving == 0), "{sorted:?}");
}

#[test]
fn a_wall_that_somebody_stood_right_before_stands_again_some_metres_on() {
    // He stands before the wall at the left, and is gone from the second scan on: beams now end on what he hid.
    let mut scans: Vec<LaserScan> = way().map(|pose| seen(pose, AHEAD, &[])).collect();
    scans[0] = seen(way().next().unwrap(), AHEAD, &[[-2.0, 3.3]]);
    let sorted = sorted(&scans);
    assert!(sorted.iter().any(|[_, moving]| *moving > 0), "{sorted:?}");
    let later = (MOVING.view_reach / 0.4).ceil() as usize + 1;
    assert!(sorted[later..].iter().all(|[_, moving]| *moving == 0), "{sorted:?}");
}

#[test]
fn scans_of_which_little_can_be_said_pass() {
    let mut scans = vec![seen(Pose2::default(), AHEAD, &[]); 6];
    scans[1].ranges.clear();
    scans[2].ranges.truncate(1);
    scans[3].angle_step = 0.0;
    scans[4].ranges.fill(f32::NAN);
    let sorted = sorted(&scans);
    assert_eq!(sorted, [[181, 0], [0, 0], [1, 0], [181, 0], [0, 0], [181, 0]]);
}
