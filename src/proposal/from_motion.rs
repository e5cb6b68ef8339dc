//! The motion prior as proposal: move first, judge afterwards.

use super::{Proposal, ProposalTrace, Proposed};
use crate::error::SettingError;
use crate::geometry::Pose2;
use crate::map::ConditionalMap;
use crate::map::landmarks::{Association, Landmarks, Store};
use crate::matching::Likelihood;
use crate::motion::Motion;
use crate::particle::Particle;
use crate::random::Stream;
use crate::sensor::{Feature, LandmarkSensor};
use nalgebra::Matrix3;

/// The likelihood that a map of landmarks has by itself: ln ∏ ∫ p(z | x, m_j) p(m_j | path) dm_j.
#[derive(Clone, Copy, Debug)]
pub struct Marginal;

impl<Z: LandmarkSensor, S: Store> Likelihood<Landmarks<Z, S>> for Marginal {
    fn log_likelihood(
        &self,
        map: &Landmarks<Z, S>,
        world_from_robot: &Pose2,
        features: &[Feature],
    ) -> (f64, Vec<Association>) {
        let associated = map.associate(world_from_robot, &Matrix3::zeros(), features);
        (associated.log_likelihood, associated.associations)
    }
}

/// x_t ~ p(x_t | x_{t−1}, u_t), with ln w += ln p(z_t | x_t, m): prior and proposal cancel. With landmarks, FastSLAM 1.0
/// (PR table 13.1).
#[derive(Clone, Debug)]
pub struct FromMotion<D, L> {
    /// Noise of the odometry.
    pub motion: D,
    /// Likelihood of an observation.
    pub likelihood: L,
}

impl<M: ConditionalMap, D: Motion, L: Likelihood<M>> Proposal<M> for FromMotion<D, L> {
    type Control = D::Control;

    fn propose(
        &self,
        particle: &Particle<M>,
        control: &D::Control,
        observation: &M::Observation,
        stream: &mut Stream,
    ) -> Proposed<M::Association> {
        let world_from_robot = self.motion.drive(control).sample(&particle.world_from_robot, stream);
        let (log_increment, association) =
            self.likelihood.log_likelihood(&particle.map, &world_from_robot, observation);
        Proposed { world_from_robot, association, log_increment, trace: ProposalTrace::Motion }
    }

    fn can_drive(&self, control: &D::Control) -> bool {
        self.motion.can_drive(control)
    }

    fn validate(&self) -> Result<(), SettingError> {
        self.motion.validate()?;
        self.likelihood.validate()
    }
}
