//! A graph of streets: what pose graphs are tried on since Olson, Leonard and Teller (ICRA 2006).

use super::{Edge, EdgeKind, GraphError, PoseGraph};
use fastslam::geometry::Pose2;
use fastslam::nalgebra::{Matrix3, Vector3};
use fastslam::random::{Purpose, Stream};
use std::collections::BTreeMap;

/// Standard deviations of a measurement \[m, m, rad\].
const STDS: [f64; 3] = [0.05, 0.05, 0.02];

/// A drive of so many steps of 1 m along the streets of a grid, with turns by a quarter at one crossing in four; an edge for each step, and
/// one for each return to a crossing. Starts at the poses that the steps alone lead to. The true poses beside it.
///
/// # Errors
/// [`GraphError::TooManyPoses`].
pub fn manhattan(seed: u64, steps: usize) -> Result<(PoseGraph, Vec<Pose2>), GraphError> {
    /// Blocks along a side: so few that the drive comes back.
    const SIDE: i32 = 6;
    let information = Matrix3::from_diagonal(&Vector3::from(STDS.map(|std| 1.0 / (std * std))));
    let mut visited: BTreeMap<(i32, i32), usize> = BTreeMap::new();
    let (mut at, mut heading) = ((0_i32, 0_i32), 0_i32);
    let (mut truth, mut poses, mut edges): (Vec<Pose2>, Vec<Pose2>, Vec<Edge>) = Default::default();
    const AHEAD: [(i32, i32); 4] = [(1, 0), (0, 1), (-1, 0), (0, -1)];
    for step in 0..=steps {
        let pose = Pose2::new(f64::from(at.0), f64::from(at.1), f64::from(heading) * core::f64::consts::FRAC_PI_2);
        truth.push(pose);
        let mut stream = Stream::at(seed, Purpose::TRIAL, step as u32, 0);
        let mut measure = |i: usize, kind| {
            let [x, y, theta] = stream.normals();
            let noise = Pose2::new(STDS[0] * x, STDS[1] * y, STDS[2] * theta);
            Edge { i, j: step, i_from_j: truth[i].between(&pose).compose(&noise), information, kind }
        };
        if let Some(before) = step.checked_sub(1) {
            let edge = measure(before, EdgeKind::Odometry);
            poses.push(poses[before].compose(&edge.i_from_j));
            edges.push(edge);
        } else {
            poses.push(pose);
        }
        match visited.get(&at) {
            Some(&i) if step - i > 1 => edges.push(measure(i, EdgeKind::Loop)),
            _ => (),
        }
        visited.insert(at, step);
        let turn = Stream::at(seed, Purpose::TRIAL, step as u32, 1).uniform();
        heading = (heading
            + if turn < 0.125 {
                1
            } else if turn < 0.25 {
                3
            } else {
                0
            })
            % 4;
        let inside = |(dx, dy): (i32, i32)| (0..=SIDE).contains(&(at.0 + dx)) && (0..=SIDE).contains(&(at.1 + dy));
        while !inside(AHEAD[heading as usize]) {
            heading = (heading + 1) % 4;
        }
        let (dx, dy) = AHEAD[heading as usize];
        at = (at.0 + dx, at.1 + dy);
    }
    Ok((PoseGraph::new(poses, edges)?, truth))
}
