//! The tree of frames, as far as it tells where the laser sits.

use super::messages::{Rigid, Transform};
use crate::LogProblem;
use fastslam::geometry::Pose2;
use fastslam::ops;
use std::collections::BTreeMap;

/// Frames that are kept: a robot has some dozens.
const MOST_FRAMES: usize = 1000;

/// Cosine of the tilt up to which a laser is taken to be level: 20°.
const LEVEL: f64 = 0.94;

/// Each frame's parent, and where it is in it: the first that was told, as a laser is bolted on.
#[derive(Default)]
pub struct Frames(BTreeMap<String, (String, Rigid)>);

/// Where a laser sits, and which way up.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Mounting {
    pub robot_from_laser: Pose2,
    /// Its beams turn the other way.
    pub upside_down: bool,
}

/// ROS 1 lets frames begin with a slash, ROS 2 does not.
pub fn frame(name: &str) -> &str {
    name.trim_start_matches('/')
}

impl Frames {
    /// Takes a transform; a fixed one counts for more than one that may change.
    pub fn take(&mut self, transform: &Transform, fixed: bool) {
        let child = frame(&transform.child_frame_id);
        if fixed || (!self.0.contains_key(child) && self.0.len() < MOST_FRAMES) {
            let parent = frame(&transform.header.frame_id).to_owned();
            self.0.insert(child.into(), (parent, transform.parent_from_child));
        }
    }

    /// The frames that a laser hangs from, each with that below it, from the laser up.
    pub fn above(&self, laser: &str) -> impl Iterator<Item = (&String, &String)> + use<'_> {
        let Self(frames) = self;
        let pair = |child: &str| frames.get_key_value(frame(child)).map(|(child, (parent, _))| (parent, child));
        // In a tree no chain is longer than there are frames.
        core::iter::successors(pair(laser), move |(parent, _)| pair(parent)).take(frames.len())
    }

    /// Where a laser sits on the robot; `None` where no chain of transforms tells.
    pub fn mounting(&self, robot: &str, laser: &str) -> Option<Result<Mounting, LogProblem>> {
        let [robot, laser] = [frame(robot), frame(laser)];
        let mut at = laser;
        let mut robot_from_laser = IDENTITY;
        for _ in 0..=self.0.len() {
            if at == robot {
                return Some(
                    mounted(&robot_from_laser)
                        .ok_or_else(|| LogProblem::Tilted { laser: laser.into(), robot: robot.into() }),
                );
            }
            let (parent, parent_from_child) = self.0.get(at)?;
            robot_from_laser = after(&matrix(parent_from_child)?, &robot_from_laser);
            at = parent;
        }
        None
    }
}

/// The upper three rows of a rigid motion's matrix.
type Matrix = [[f64; 4]; 3];

const IDENTITY: Matrix = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];

fn matrix(Rigid { position: [x, y, z], orientation }: &Rigid) -> Option<Matrix> {
    let length = orientation.iter().map(|part| part * part).sum::<f64>().sqrt();
    let [a, b, c, w] = orientation.map(|part| part / length);
    let rows = [
        [1.0 - 2.0 * (b * b + c * c), 2.0 * (a * b - c * w), 2.0 * (a * c + b * w), *x],
        [2.0 * (a * b + c * w), 1.0 - 2.0 * (a * a + c * c), 2.0 * (b * c - a * w), *y],
        [2.0 * (a * c - b * w), 2.0 * (b * c + a * w), 1.0 - 2.0 * (a * a + b * b), *z],
    ];
    rows.as_flattened().iter().all(|part| part.is_finite()).then_some(rows)
}

fn after(a: &Matrix, b: &Matrix) -> Matrix {
    core::array::from_fn(|i| {
        core::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum::<f64>() + if j == 3 { a[i][3] } else { 0.0 })
    })
}

fn mounted(robot_from_laser: &Matrix) -> Option<Mounting> {
    let [[r00, _, _, x], [r10, _, _, y], [_, _, up, _]] = *robot_from_laser;
    (up.abs() >= LEVEL)
        .then(|| Mounting { robot_from_laser: Pose2::new(x, y, ops::atan2(r10, r00)), upside_down: up < 0.0 })
}

/// The pose in the plane: the heading is the turn about the vertical, 2 atan2(q_z, q_w). `None` where that is none, as of a quaternion
/// of zeros.
pub fn flat(Rigid { position: [x, y, _], orientation: [_, _, z, w] }: &Rigid) -> Option<Pose2> {
    let pose = Pose2::new(*x, *y, 2.0 * ops::atan2(*z, *w));
    ([x, y, z, w].iter().all(|part| part.is_finite()) && (*z != 0.0 || *w != 0.0)).then_some(pose)
}
