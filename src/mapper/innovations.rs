//! Whether scans agree with odometry as it is known by then.

use crate::motion::Displacement;
use crate::proposal::ProposalTrace;
use crate::rbpf::Report;
use nalgebra::Matrix3;

/// Normalised innovations squared of odometry, νᵀ P⁻¹ ν for each step in which a scan was matched.
///
/// ν is the motion to the mode that the scan calls for, less the mean of [`LaserMapper::predicted`](super::LaserMapper::predicted), whose covariance is P: that of
/// the drift and noise learnt so far. Of several particles it is the mean over those that were matched. Where noises are right and scans tell
/// all of the motion, 3 is expected; less where a scan tells little, as along a corridor, or where the wheels are better than the least that is
/// assumed of them.
///
/// Reference: Bar-Shalom, Li, Kirubarajan, *Estimation with applications to tracking and navigation* (2001), §5.4.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct OdometryInnovations {
    sum: f64,
    count: u32,
    beyond: u32,
}

/// χ²₃,₀.₉₉: one innovation in a hundred is larger.
const LARGE: f64 = 11.34;

impl OdometryInnovations {
    /// Adds a step of the filter, before which this motion was expected.
    pub fn add(&mut self, predicted: &Displacement, report: &Report<()>) {
        let Some(information) = predicted.covariance.try_inverse() else { return };
        let squared = |k: usize| squared(predicted, &information, k, report);
        let squares: Vec<f64> = (0..report.paths.len()).filter_map(squared).collect();
        if squares.is_empty() {
            return;
        }
        let mean = squares.iter().sum::<f64>() / squares.len() as f64;
        self.sum += mean;
        self.count += 1;
        self.beyond += u32::from(mean > LARGE);
    }

    /// How many steps there were.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// Their mean νᵀ P⁻¹ ν; `None` where there were none.
    pub fn mean(&self) -> Option<f64> {
        (self.count > 0).then(|| self.sum / f64::from(self.count))
    }

    /// Share of the steps, 0 to 1, whose νᵀ P⁻¹ ν is larger than 99 % should be.
    pub fn share_beyond(&self) -> f64 {
        f64::from(self.beyond) / f64::from(self.count.max(1))
    }
}

/// νᵀ P⁻¹ ν of the particle in a slot, if it was matched.
fn squared(predicted: &Displacement, information: &Matrix3<f64>, slot: usize, report: &Report<()>) -> Option<f64> {
    let ProposalTrace::Matched { mode, .. } = report.traces[slot] else { return None };
    let before = report.paths[slot].before()?.pose();
    let innovation = before.between(&mode).minus(&predicted.mean);
    Some(innovation.dot(&(information * innovation)))
}
