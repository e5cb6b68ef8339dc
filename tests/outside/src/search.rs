//! Where the matcher of this robot begins.

use fastslam::matching::{HillClimbSteps, ScoreNear, ScoredPose};
use fastslam::ops;
use fastslam::proposal::{FitLimits, FromScanSettings, IncrementalWeight, Search, Starts, Target};

/// At the best of the prediction and the poses two standard deviations from it along the prior's axes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct AlongAxes;

/// The matcher of this robot.
pub const SETTINGS: FromScanSettings<AlongAxes> = FromScanSettings {
    motion_floor: [0.005, 0.005, 0.005],
    search: AlongAxes,
    climb: HillClimbSteps { linear: 0.02, angular: 0.02, halvings: 4 },
    hills: 1,
    climb_stride: 1,
    minimum_improvement: 0.1,
    full_weight: 0.0,
    limits: FitLimits { least: [0.002, 0.002], most: [0.1, 0.1] },
    weight: IncrementalWeight::NewGroundFree,
};

impl Search for AlongAxes {
    fn starts<N: ScoreNear>(&self, target: &Target<'_, N>) -> Starts {
        let prior = target.prior();
        let along = (0..3).flat_map(|axis| {
            [-2.0, -1.0, 1.0, 2.0].map(|reach| {
                let mut epsilon = [0.0; 3];
                epsilon[axis] = reach;
                prior.at(epsilon)
            })
        });
        let (mut best, mut log_scores): (Option<ScoredPose>, Vec<f64>) = (None, Vec::new());
        for pose in std::iter::once(*prior.mean()).chain(along) {
            let log_score = target.score().log_score(&pose);
            log_scores.push(log_score);
            let value = log_score + prior.log_density(&pose);
            if best.is_none_or(|best| value > best.value) {
                best = Some(ScoredPose { pose, value });
            }
        }
        let log_mean = ops::log_sum_exp(&log_scores) - ops::ln(log_scores.len() as f64);
        Starts { poses: best.into_iter().collect(), log_mean }
    }
}
