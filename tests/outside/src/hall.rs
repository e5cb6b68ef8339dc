//! A hall with pillars, a drive through it, and what the robot makes of both. Simulated with the streams of the crate.

use crate::beacons::Receiver;
use crate::points::Echoes;
use crate::wheels::{Rolled, Wheels};
use fastslam::geometry::Pose2;
use fastslam::motion::Motion;
use fastslam::nalgebra::Vector2;
use fastslam::ops;
use fastslam::random::{Purpose, Stream};
use fastslam::sensor::{Feature, LandmarkSensor};

/// Streams of the world, apart from those of the filter.
const WORLD: Purpose = Purpose::new(100);

/// Boxes that the robot is in front of: the hall itself from within, and pillars: [x0, y0, x1, y1] \[m\].
const BOXES: [[f64; 4]; 4] = [[-2.0, -2.0, 7.0, 6.0], [1.5, 1.2, 2.4, 2.6], [3.6, 1.4, 4.2, 3.0], [0.2, 4.6, 1.2, 5.4]];

/// Beacons \[m\].
pub const BEACONS: [[f64; 2]; 5] = [[-1.5, 5.0], [6.5, -1.0], [2.0, 2.0], [6.0, 5.5], [-1.0, -1.5]];

/// Everything that happened.
pub struct Drive {
    /// Poses before each step, and after the last.
    pub truth: Vec<Pose2>,
    /// What the encoders counted.
    pub counted: Vec<Rolled>,
    /// What the ring of sonars heard after each step.
    pub echoes: Vec<Echoes>,
    /// What the receiver heard after each step.
    pub beacons: Vec<Vec<Feature>>,
}

/// Twice around the pillars.
pub fn drive(wheels: &Wheels, receiver: &Receiver, seed: u64) -> Drive {
    let (mut truth, mut counted, mut echoes, mut beacons) = (vec![Pose2::default()], vec![], vec![], vec![]);
    for step in 0..160_u32 {
        let mut stream = Stream::at(seed, WORLD, step, 0);
        // A rectangle with rounded corners, 6 m by 4 m.
        let turning = [14..20, 28..34, 48..54, 62..68].iter().any(|turn| turn.contains(&(step % 68)));
        let turn = if turning { core::f64::consts::FRAC_PI_2 / 6.0 } else { 0.0 };
        let [left, right] = [-0.5, 0.5].map(|side| 0.25 + side * turn * wheels.axle);
        let from = truth[truth.len() - 1];
        let pose = wheels.apply(&from, &Rolled { left, right });
        counted.push(wheels.perturb(&Rolled { left, right }, &mut stream));
        echoes.push(listen(&pose, &mut stream));
        beacons.push(receive(receiver, &pose, &mut stream));
        truth.push(pose);
    }
    Drive { truth, counted, echoes, beacons }
}

/// 36 sonars all around, up to 6 m, with 2 cm of noise.
pub fn listen(pose: &Pose2, stream: &mut Stream) -> Echoes {
    let sonar = |k: u32| {
        let angle = core::f64::consts::TAU * f64::from(k) / 36.0;
        let range = range(pose, angle) + 0.02 * stream.normal();
        let (sin, cos) = ops::sin_cos(angle);
        (range < 6.0).then_some([range * cos, range * sin])
    };
    (0..36).filter_map(sonar).collect()
}

fn receive(receiver: &Receiver, pose: &Pose2, stream: &mut Stream) -> Vec<Feature> {
    let mut heard = Vec::new();
    for (signature, beacon) in (0..).zip(BEACONS) {
        let beacon = Vector2::from(beacon);
        let [a, b] = stream.normals();
        if receiver.sees(pose, &beacon, 0.0) {
            let noise = Vector2::new(receiver.strength_std * a, receiver.direction_std * b);
            heard.push(Feature { z: receiver.predict(pose, &beacon).z + noise, signature: Some(signature) });
        }
    }
    heard
}

/// Distance \[m\] to the nearest side of any box in a direction \[rad\] of the robot's frame.
fn range(pose: &Pose2, angle: f64) -> f64 {
    let (sin, cos) = ops::sin_cos(pose.theta + angle);
    let mut nearest = f64::INFINITY;
    for [x0, y0, x1, y1] in BOXES {
        // Along x to the sides that stand upright, along y to those that lie.
        let sides = [(x0 - pose.x, cos, sin, pose.y, y0, y1), (x1 - pose.x, cos, sin, pose.y, y0, y1)];
        let lying = [(y0 - pose.y, sin, cos, pose.x, x0, x1), (y1 - pose.y, sin, cos, pose.x, x0, x1)];
        for (away, along, across, start, low, high) in sides.into_iter().chain(lying) {
            let range = away / along;
            if range > 0.0 && (low..=high).contains(&(start + range * across)) {
                nearest = nearest.min(range);
            }
        }
    }
    nearest
}
