//! How uncertain the pose of the robot is.

use super::models::MODELS;
use super::{Filter, Stamp, Wheels};
use crate::geometry::Pose2;
use crate::motion::{Displaced, Displacement, Motion};
use crate::ops;
use crate::proposal::ProposalTrace;
use crate::rbpf::Report;
#[cfg(feature = "serde")]
use crate::save::{self, RestoreError};
use nalgebra::Matrix3;

/// A pose and how uncertain it is, as in `geometry_msgs/PoseWithCovariance` of ROS, in the plane.
///
/// The covariance is that of the error of this pose, by the mixture of Gaussians that the particles' last poses were drawn from:
///
/// C = Σᵢ wᵢ (Σᵢ + dᵢ dᵢᵀ), dᵢ = μᵢ ⊖ x
///
/// with x the pose, N(μᵢ, Σᵢ) what particle i drew from (the fit to the scan where it was matched, else the motion of the odometry), the difference of headings
/// wrapped to (−π, π\], and wᵢ the scores by which particles are selected: their weights to the power of
/// the mapper's [selection temper](crate::rbpf::Builder::selection_temper), since scans that are held against one map repeat its errors. It is taken about x
/// and not about the mean of the particles, so that it holds for the pose that stands with it. The Σᵢ are part of it: without them it would be zero as soon
/// as all particles are copies of one. Where the robot has moved since the last scan that was taken, the motion by odometry moves the
/// errors along and adds its noise.
///
/// It is relative to the first scan, whose pose is exact by definition, and knows only what the particles differ in: an error that all paths share, because they
/// descend from one that had it, is missing. So it takes many particles to tell how far a map has drifted. In simulated drives of 24 m the mean of eᵀ C⁻¹ e over
/// ten seeds, with e the error of x, was 1.8 with 16 particles, 5 with four and 280 with one, where 3 is right: the covariance of a single particle says
/// how certain its place in its own map is.
///
/// Reference: law of total covariance for a mixture (Bar-Shalom, Li, Kirubarajan, *Estimation with applications to tracking and navigation*, 2001, §1.4.16);
/// N(μᵢ, Σᵢ) is that of Grisetti, Stachniss, Burgard (T-RO 2007), equations 15 and 16.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PoseWithCovariance {
    /// Where the best particle has the robot.
    pub pose: Pose2,
    /// Covariance of its error (3 × 3, \[m, m, rad\]), along the axes of the map.
    pub covariance: Matrix3<f64>,
}

impl PoseWithCovariance {
    /// Standard deviations of x, y and heading \[m, m, rad\].
    pub fn stds(&self) -> [f64; 3] {
        [0, 1, 2].map(|k| self.covariance[(k, k)].sqrt())
    }
}

/// By slot, what a particle's last pose was drawn from, as seen from that pose: where a path is bent, it comes along. Empty before the first step.
#[derive(Clone, Debug, Default)]
pub(super) struct Spreads(Vec<Displacement>);

impl Spreads {
    /// What one Gaussian leaves open, for each of so many particles that stand at its mean.
    pub(super) fn about(pose: &Pose2, covariance: &Matrix3<f64>, particles: usize) -> Self {
        Self(vec![seen_from(pose, pose, covariance); particles])
    }

    /// After a step that was led by this motion.
    pub(super) fn of(report: &Report<()>, control: &Displacement) -> Self {
        let spread = |slot: usize| {
            let path = &report.paths[slot];
            let (drawn, before) = (path.pose(), path.before().map_or_else(Pose2::default, |before| before.pose()));
            match &report.traces[slot] {
                ProposalTrace::Matched { mode, covariance, .. } => seen_from(&drawn, mode, covariance),
                ProposalTrace::Motion => {
                    let drive = Displaced.drive(control);
                    seen_from(&drawn, &drive.apply(&before), &drive.covariance(&before))
                }
            }
        };
        match &report.ancestors {
            Some(ancestors) => Self(ancestors.iter().map(|slot| spread(*slot as usize)).collect()),
            None => Self((0..report.paths.len()).map(spread).collect()),
        }
    }

    /// The pose of the best particle of a filter, where the robot has moved on from its last step as this stamp says.
    pub(super) fn now(&self, filter: &Filter, stamp: Option<&Stamp>, wheels: &Wheels) -> PoseWithCovariance {
        let best = filter.particles()[filter.best()].world_from_robot;
        let moved = stamp.map(|stamp| stamp.step_from_robot).filter(|moved| *moved != Pose2::default());
        let scores = filter.weights().tempered(MODELS.selection_temper);
        let of_particles = filter.particles().iter().zip(&self.0).zip(scores.as_slice());
        let covariance = of_particles
            .map(|((particle, spread), score)| {
                let from = &particle.world_from_robot;
                let d = Displaced.apply(from, spread).minus(&best);
                (Displaced.covariance(from, spread) + d * d.transpose()) * *score
            })
            .sum();
        let Some(moved) = moved else { return PoseWithCovariance { pose: best, covariance } };
        let moved = Displacement { mean: moved, ..wheels.displacement(&moved) };
        let jacobian = Displaced.jacobian(&best, &moved);
        PoseWithCovariance {
            pose: Displaced.apply(&best, &moved),
            covariance: jacobian * covariance * jacobian.transpose() + Displaced.covariance(&best, &moved),
        }
    }
}

/// A Gaussian of the world's frame, as seen from a pose.
fn seen_from(pose: &Pose2, mean: &Pose2, covariance: &Matrix3<f64>) -> Displacement {
    let (sin, cos) = ops::sin_cos(pose.theta);
    let back = Matrix3::new(cos, sin, 0.0, -sin, cos, 0.0, 0.0, 0.0, 1.0);
    Displacement { mean: pose.between(mean), covariance: back * covariance * back.transpose() }
}

#[cfg(feature = "serde")]
impl Spreads {
    /// Means, and covariances by columns.
    pub(super) fn save(&self) -> Vec<SavedSpread> {
        self.0.iter().map(|Displacement { mean, covariance }| (*mean, (*covariance).into())).collect()
    }

    /// Those of so many particles that were saved.
    pub(super) fn restore(saved: Vec<SavedSpread>, particles: usize) -> Result<Self, RestoreError> {
        save::holds(saved.is_empty() || saved.len() == particles, "spreads", "one for each particle")?;
        save::poses("spreads", saved.iter().map(|(mean, _)| *mean))?;
        save::finite("spreads", saved.iter().flat_map(|(_, columns)| columns.iter().flatten().copied()))?;
        let definite = saved.iter().all(|(_, columns)| (0..3).all(|k| columns[k][k] >= 0.0));
        save::holds(definite, "spreads", "covariances")?;
        let spread = |(mean, columns)| Displacement { mean, covariance: Matrix3::from(columns) };
        Ok(Self(saved.into_iter().map(spread).collect()))
    }
}

#[cfg(feature = "serde")]
pub(super) type SavedSpread = (Pose2, [[f64; 3]; 3]);
