//! Steps that two programs work out together. Each holds the same lap and draws for a part of the slots; the draws go from one to the other as
//! numbers, with every bit.

use fastslam::geometry::Pose2;
use fastslam::nalgebra::Matrix3;
use fastslam::proposal::{ProposalTrace, Proposed};
use std::ops::Range;

/// Numbers of a draw: pose, log weight increment, whether it was matched, and if so its mode, covariance and log integral; else zeros.
pub const NUMBERS: usize = 18;

/// The slots of a part of two, 0 or 1, of so many.
pub fn slots(part: usize, count: usize) -> Range<usize> {
    if part == 0 { 0..count / 2 } else { count / 2..count }
}

/// Draws as numbers, [`NUMBERS`] of each.
pub fn to_numbers(proposed: &[Proposed<()>]) -> Vec<f64> {
    let pose = |pose: Pose2| [pose.x, pose.y, pose.theta];
    let mut numbers = Vec::with_capacity(proposed.len() * NUMBERS);
    for Proposed { world_from_robot, log_increment, trace, .. } in proposed {
        numbers.extend(pose(*world_from_robot));
        numbers.push(*log_increment);
        match trace {
            ProposalTrace::Motion => numbers.extend([0.0; NUMBERS - 4]),
            ProposalTrace::Matched { mode, covariance, log_integral } => {
                numbers.push(1.0);
                numbers.extend(pose(*mode));
                numbers.extend(covariance.iter());
                numbers.push(*log_integral);
            }
        }
    }
    numbers
}

/// The draws that these are the numbers of; what is left of less than one is none.
pub fn from_numbers(numbers: &[f64]) -> Vec<Proposed<()>> {
    let pose = |numbers: &[f64]| Pose2 { x: numbers[0], y: numbers[1], theta: numbers[2] };
    let draw = |numbers: &[f64; NUMBERS]| Proposed {
        world_from_robot: pose(numbers),
        association: (),
        log_increment: numbers[3],
        trace: if numbers[4] == 0.0 {
            ProposalTrace::Motion
        } else {
            let covariance = Matrix3::from_column_slice(&numbers[8..17]);
            ProposalTrace::Matched { mode: pose(&numbers[5..]), covariance, log_integral: numbers[17] }
        },
    };
    numbers.as_chunks().0.iter().map(draw).collect()
}
