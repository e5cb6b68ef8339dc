//! What is this robot's own obeys the laws of the crate.

use fastslam::geometry::Pose2;
use fastslam::laws::proposal::Step;
use fastslam::laws::{QUARTER_TURNS, TURNS};
use fastslam::map::ConditionalMap;
use fastslam::map::landmarks::{Correspondence, Landmark, Landmarks};
use fastslam::nalgebra::{Matrix2, Vector2};
use fastslam::particle::Particle;
use fastslam::proposal::{FromMeasurement, FromMotion, FromScan, Marginal};
use fastslam::random::{Purpose, Stream};
use fastslam::sensor::{Feature, LandmarkSensor};
use outside::beacons::Receiver;
use outside::hall::listen;
use outside::points::{Echoes, Nearest, Points, Square};
use outside::search::SETTINGS;
use outside::wheels::{Rolled, Wheels};

const WHEELS: Wheels = Wheels { axle: 0.4, slip: 0.06, jitter: 0.0 };
const RECEIVER: Receiver = Receiver { strength_std: 0.1, direction_std: 0.05, reach: 9.0 };
const NEAREST: Nearest = Nearest { std: 0.15, most: 0.3 };

/// Ahead, an arc, a turn on the spot, backwards, standing still.
fn cases() -> [(Pose2, Rolled); 5] {
    let rolled = [(0.25, 0.25), (0.2, 0.3), (-0.1, 0.1), (-0.3, -0.25), (0.0, 0.0)];
    core::array::from_fn(|k| {
        let (k, (left, right)) = (k as f64, rolled[k]);
        (Pose2::new(k, 1.0 - k, 1.3 * k), Rolled { left, right })
    })
}

fastslam::motion_laws!(wheels, WHEELS, cases());

fn views() -> Vec<(Pose2, Vector2<f64>)> {
    let view = |k: u32| {
        let k = f64::from(k);
        (Pose2::new(0.2 * k, -0.1 * k, 0.7 * k), Vector2::new(3.0 - 0.5 * k, 2.0 + 0.2 * k))
    };
    (0..20).map(view).collect()
}

fastslam::sensor_laws!(receiver, RECEIVER, views());

/// What is heard on the way through the hall.
fn heard() -> Vec<(Pose2, Echoes)> {
    let at = |k: u32| {
        let pose = Pose2::new(0.25 * f64::from(k), 0.0, 0.05 * f64::from(k));
        (pose, listen(&pose, &mut Stream::at(1, Purpose::new(100), k, 0)))
    };
    (0..10).map(at).collect()
}

fn content(map: &Points) -> Vec<((i32, i32), Square)> {
    map.squares().iter().map(|(key, square)| (*key, *square)).collect()
}

fastslam::map_laws!(points, || Points::new(0.25), NEAREST, heard(), content);

/// A robot in the hall, which has been moved.
fn in_the_hall(world: &Pose2) -> Step<Points, Rolled> {
    let mut map = Points::new(0.25);
    let mut heard = heard();
    // Every third echo: a matcher that draws 20 000 times is slow enough.
    let (_, observation) = heard.pop().map(|(pose, echoes)| (pose, echoes.into_iter().step_by(3).collect())).unwrap();
    for (pose, echoes) in &heard {
        map.assimilate(&world.compose(pose), echoes, &());
    }
    let (before, _) = heard[heard.len() - 1];
    let particle = Particle::start(world.compose(&before), map);
    Step { particle, control: Rolled { left: 0.24, right: 0.26 }, observation }
}

fastslam::proposal_laws!(from_motion, FromMotion { motion: WHEELS, likelihood: NEAREST }, in_the_hall, QUARTER_TURNS);
fastslam::proposal_laws!(
    from_scan,
    FromScan { motion: WHEELS, score: NEAREST, settings: SETTINGS },
    in_the_hall,
    QUARTER_TURNS[..1]
);

/// Wheels so good that linearising does not show.
const GOOD_WHEELS: Wheels = Wheels { axle: 0.4, slip: 0.01, jitter: 0.0 };

/// A robot that knows two beacons, in a world that has been moved.
fn among_beacons(world: &Pose2) -> Step<Landmarks<Receiver>, Rolled> {
    let known = [[3.0, 1.0], [-1.0, 2.0]];
    let control = Rolled { left: 0.24, right: 0.26 };
    let to = Pose2::new(0.26, 0.01, 0.06);
    let hear = |(k, beacon): (u32, [f64; 2])| Feature {
        z: RECEIVER.predict(&to, &Vector2::from(beacon)).z,
        signature: Some(k),
    };
    let observation = (0..).zip(known).map(hear).collect();
    let landmark = |beacon: [f64; 2]| Landmark {
        mean: Vector2::from(world.transform(beacon)),
        covariance: Matrix2::identity() * 1e-4,
        existence_count: 1,
        apart: 0,
    };
    let map = Landmarks::new(RECEIVER, Correspondence::Known).with(known.map(landmark));
    Step { particle: Particle::start(*world, map), control, observation }
}

fastslam::proposal_laws!(
    from_measurement,
    FromMeasurement { motion: GOOD_WHEELS },
    among_beacons,
    TURNS,
    FromMotion { motion: GOOD_WHEELS, likelihood: Marginal }
);
