//! Greedy hill climbing over poses.

use crate::geometry::Pose2;
use core::cmp::Ordering;

/// Step sizes of a climb.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct HillClimbSteps {
    /// First step along and across the robot \[m\].
    pub linear: f64,
    /// First turn \[rad\].
    pub angular: f64,
    /// How often the steps are halved before the climb ends.
    pub halvings: u32,
}

/// A pose with its value: where a climb starts, and where it ends.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ScoredPose {
    /// The pose; at the end of a climb the local optimum, to within the last steps.
    pub pose: Pose2,
    /// The objective there.
    pub value: f64,
}

impl ScoredPose {
    /// An order for sorting: what is worth most comes first.
    pub(crate) fn highest_first(a: &Self, b: &Self) -> Ordering {
        b.value.total_cmp(&a.value)
    }
}

/// Climbs `objective` greedily from `start`: tries a step ahead, back, left, right and a turn to each side, takes each that
/// improves, and halves the steps where none of the six does (after the matcher of gmapping).
///
/// `objective(pose, bar)` need not be exact where it does not exceed `bar`: −∞ will do.
pub fn hill_climb(
    start: ScoredPose,
    steps: HillClimbSteps,
    mut objective: impl FnMut(&Pose2, f64) -> f64,
) -> ScoredPose {
    // The pose that the last step led away from: it is worse, and the step back need not ask again.
    let (mut best, mut left_behind) = (start, None);
    let (mut linear, mut angular) = (steps.linear, steps.angular);
    for _ in 0..=steps.halvings {
        let (mut failed, mut moves) = (0, MOVES.iter().cycle());
        // The bound ends the climb of an objective that never stops improving.
        for _ in 0..MOST_TRIES {
            let (ahead, left, turn) = moves.next().copied().unwrap_or_default();
            let [x, y] = best.pose.transform([ahead * linear, left * linear]);
            let pose = Pose2::new(x, y, best.pose.theta + turn * angular);
            let value = if left_behind == Some(pose) { f64::NEG_INFINITY } else { objective(&pose, best.value) };
            if value > best.value {
                left_behind = Some(best.pose);
                best = ScoredPose { pose, value };
                failed = 0;
            } else {
                failed += 1;
            }
            if failed == MOVES.len() {
                break;
            }
        }
        linear *= 0.5;
        angular *= 0.5;
    }
    best
}

/// Steps (ahead, left, turn).
const MOVES: [(f64, f64, f64); 6] =
    [(1.0, 0.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)];

/// Most evaluations at one step size.
const MOST_TRIES: u32 = 100;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_climb_finds_the_top_of_a_smooth_hill() {
        let top = Pose2::new(0.31, -0.22, 0.17);
        let hill = |pose: &Pose2| -pose.minus(&top).norm_squared();
        let start = ScoredPose { pose: Pose2::default(), value: hill(&Pose2::default()) };
        let steps = HillClimbSteps { linear: 0.1, angular: 0.1, halvings: 6 };
        let end = hill_climb(start, steps, |pose, _| hill(pose));
        assert!(end.pose.minus(&top).norm() < 0.1 / 32.0, "{end:?}");
    }

    #[test]
    fn the_pose_that_a_step_led_away_from_is_not_asked_about_again() {
        let hill = |pose: &Pose2| -(pose.x - 1.0).abs() - pose.y.abs() - pose.theta.abs();
        let start = ScoredPose { pose: Pose2::default(), value: hill(&Pose2::default()) };
        let mut asked = Vec::new();
        // Steps that floating point adds and takes away again without an error.
        let steps = HillClimbSteps { linear: 0.5, angular: 0.5, halvings: 0 };
        let end = hill_climb(start, steps, |pose, _| {
            asked.push((pose.x, pose.y, pose.theta));
            hill(pose)
        });
        assert_eq!(end.pose, Pose2::new(1.0, 0.0, 0.0));
        // Each step back from a step ahead is missing; round the top only the last of them is.
        assert_eq!(asked.iter().filter(|at| **at == (0.0, 0.0, 0.0)).count(), 0, "{asked:?}");
        assert_eq!(asked.iter().filter(|at| **at == (0.5, 0.0, 0.0)).count(), 1, "{asked:?}");
    }

    #[test]
    fn a_flat_objective_leaves_the_start() {
        let start = ScoredPose { pose: Pose2::new(1.0, 2.0, 3.0), value: 0.0 };
        let steps = HillClimbSteps { linear: 0.1, angular: 0.1, halvings: 3 };
        assert_eq!(hill_climb(start, steps, |_, _| 0.0), start);
        assert_eq!(hill_climb(start, steps, |_, _| f64::NAN), start);
    }
}
