//! The measurement-aware proposal for landmarks: FastSLAM 2.0.
//!
//! References: Montemerlo, Thrun, Koller, Wegbreit (IJCAI 2003); PR table 13.3. There Σ_x = (H_xᵀ Q_j⁻¹ H_x + R_t⁻¹)⁻¹; here the
//! same in the form of the Kalman gain, which never inverts R_t: a robot that stands still has none.

use super::{Proposal, ProposalTrace, Proposed};
use crate::error::SettingError;
use crate::geometry::{Pose2, sample_semidefinite};
use crate::map::landmarks::{Associated, Association, Belief, Innovation, Landmarks, Store};
use crate::motion::Motion;
use crate::particle::Particle;
use crate::random::Stream;
use crate::sensor::{Feature, LandmarkSensor};
use nalgebra::{Matrix3, Vector2};

/// x_t ~ N(μ_x, Σ_x), the motion's Gaussian with the step's features folded in one after another.
#[derive(Clone, Debug)]
pub struct FromMeasurement<D> {
    /// Noise of the odometry.
    pub motion: D,
}

/// The Gaussian that a step's features make of the motion's.
#[derive(Clone, PartialEq, Debug)]
pub struct Measured {
    /// μ_x.
    pub mean: Pose2,
    /// Σ_x (3 × 3, \[m, m, rad\]).
    pub covariance: Matrix3<f64>,
    /// What the features were taken to be.
    pub associations: Vec<Association>,
    /// ln ∏ N(ν; 0, H_x P H_xᵀ + Q_j), times p₀ for each new landmark \[nats\].
    pub log_evidence: f64,
    /// Whether any feature was of a landmark in the map.
    pub informed: bool,
}

impl<D: Motion> FromMeasurement<D> {
    /// Folds every feature of a mapped landmark into N(x̂, R_t), each from where the one before left it: with
    /// L = H_x P H_xᵀ + H_m Σ_j H_mᵀ + Q and K = P H_xᵀ L⁻¹, μ ← μ + K ν, and P by Joseph's form. The sequence is that of
    /// [`Correspondence::associate`](crate::map::landmarks::Correspondence::associate), in whatever order the features are listed.
    pub fn fold<Z: LandmarkSensor, S: Store>(
        &self,
        map: &Landmarks<Z, S>,
        from: &Pose2,
        control: &D::Control,
        features: &[Feature],
    ) -> Measured {
        let drive = self.motion.drive(control);
        let mut fold = Fold { map, mean: drive.apply(from), p: drive.covariance(from) };
        let Associated { associations, log_likelihood, informed } = map.correspondence().associate(features, &mut fold);
        Measured { mean: fold.mean, covariance: fold.p, associations, log_evidence: log_likelihood, informed }
    }

    /// A pose drawn from the Gaussian of the proposal, or if no landmark was matched, from the motion.
    pub(super) fn draw(&self, from: &Pose2, control: &D::Control, measured: &Measured, stream: &mut Stream) -> Pose2 {
        if measured.informed {
            sample_semidefinite(&measured.mean, &measured.covariance, stream)
        } else {
            self.motion.drive(control).sample(from, stream)
        }
    }
}

impl Measured {
    /// What is told of a pose that is drawn from it.
    pub(super) fn trace(&self) -> ProposalTrace {
        ProposalTrace::Matched { mode: self.mean, covariance: self.covariance, log_integral: self.log_evidence }
    }
}

/// N(μ, P), which learns from each feature of a landmark of this map.
struct Fold<'a, Z, S> {
    map: &'a Landmarks<Z, S>,
    mean: Pose2,
    p: Matrix3<f64>,
}

impl<Z: LandmarkSensor, S: Store> Belief for Fold<'_, Z, S> {
    fn learns(&self) -> bool {
        true
    }

    fn can_measure(&self, z: &Vector2<f64>) -> bool {
        self.map.sensor().can_measure(z)
    }

    fn index_bound(&self) -> u32 {
        self.map.len()
    }

    fn innovation(&self, feature: &Feature, index: u32, gate: Option<f64>) -> Option<Innovation> {
        self.map.innovation(&self.mean, &self.p, feature, index, gate)
    }

    /// K = P H_xᵀ L⁻¹, μ ← μ + K ν, P ← (I − K H_x) P (I − K H_x)ᵀ + K Q_j Kᵀ.
    fn learn(&mut self, _: u32, innovation: &Innovation) {
        let (h_x, p) = (innovation.prediction.h_x, self.p);
        let gain = p * h_x.transpose() * innovation.inverse;
        let keep = Matrix3::identity() - gain * h_x;
        self.mean = self.mean.plus(&(gain * innovation.residual));
        let p = keep * p * keep.transpose() + gain * innovation.given_pose * gain.transpose();
        self.p = (p + p.transpose()) * 0.5;
    }
}

impl<Z: LandmarkSensor, S: Store, D: Motion> Proposal<Landmarks<Z, S>> for FromMeasurement<D> {
    type Control = D::Control;

    /// The weight does not contain the pose that was drawn: particles of one history weigh the same.
    fn propose(
        &self,
        particle: &Particle<Landmarks<Z, S>>,
        control: &D::Control,
        features: &[Feature],
        stream: &mut Stream,
    ) -> Proposed<Vec<Association>> {
        let from = &particle.world_from_robot;
        let measured = self.fold(&particle.map, from, control, features);
        let world_from_robot = self.draw(from, control, &measured, stream);
        let trace = if measured.informed { measured.trace() } else { ProposalTrace::Motion };
        Proposed { world_from_robot, association: measured.associations, log_increment: measured.log_evidence, trace }
    }

    fn can_drive(&self, control: &D::Control) -> bool {
        self.motion.can_drive(control)
    }

    fn validate(&self) -> Result<(), SettingError> {
        self.motion.validate()
    }
}
