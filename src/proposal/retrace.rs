//! What a pose costs that was not drawn.

use super::{FromMeasurement, FromMotion, Measured, Proposal, ProposalTrace, Proposed};
use crate::execute::Executor;
use crate::geometry::{Gaussian3, Pose2};
use crate::map::landmarks::{Association, Landmarks, Store};
use crate::map::{ConditionalMap, Observed};
use crate::matching::Likelihood;
use crate::motion::GaussianMotion;
use crate::particle::Particle;
use crate::random::Stream;
use crate::sensor::{Feature, LandmarkSensor};
use core::borrow::Borrow;

/// A proposal whose three densities are known at any pose, so that a path can be weighed that others have drawn: what a
/// [`Smoother`](crate::smoothing::Smoother) needs.
pub trait Retrace<M: ConditionalMap>: Proposal<M> {
    /// ln p(x_t | x_{t−1}, u_t) \[nats\]; −∞ where the motion has no density, or none there.
    fn log_motion(&self, from: &Pose2, control: &Self::Control, to: &Pose2) -> f64;

    /// ln p(z_t | x_t, m) \[nats\] by a map, and what it takes the observation for from that very pose.
    fn log_likelihood(&self, map: &M, world_from_robot: &Pose2, observation: &M::Observation) -> (f64, M::Association);

    /// What this particle would pay for this pose: ln p(z | x, m) + ln p(x | x′, u) − ln q(x) at the pose itself, and not, as
    /// [`Proposal::propose`] may, on average over q.
    fn retrace(
        &self,
        particle: &Particle<M>,
        control: &Self::Control,
        observation: &M::Observation,
        to: &Pose2,
    ) -> Proposed<M::Association>;

    /// A pose drawn as by [`Proposal::propose`], with the incremental weight of [`Self::retrace`] at that pose.
    fn draw_and_retrace(
        &self,
        particle: &Particle<M>,
        control: &Self::Control,
        observation: &M::Observation,
        stream: &mut Stream,
    ) -> Proposed<M::Association> {
        let pose = self.propose(particle, control, observation, stream).world_from_robot;
        self.retrace(particle, control, observation, &pose)
    }

    /// ln p(z_t | x_t, m) \[nats\] of each observation from its pose, for each map, which is updated with every observation before the next.
    fn log_likelihoods_along(
        &self,
        maps: &[&M],
        path: &[Pose2],
        observations: &[Observed<M>],
        executor: &Executor,
    ) -> Vec<Vec<f64>> {
        one_by_one(self, maps, path, observations, executor)
    }
}

/// [`Retrace::log_likelihoods_along`] without anything shared between maps.
fn one_by_one<M: ConditionalMap, P: Retrace<M> + ?Sized>(
    proposal: &P,
    maps: &[&M],
    path: &[Pose2],
    observations: &[Observed<M>],
    executor: &Executor,
) -> Vec<Vec<f64>> {
    let mut maps: Vec<M> = maps.iter().map(|map| (*map).clone()).collect();
    executor.map(&mut maps, |_, map| {
        let say = |(pose, observation): (&Pose2, &Observed<M>)| {
            let (log_likelihood, association) = proposal.log_likelihood(map, pose, observation.borrow());
            map.assimilate(pose, observation.borrow(), &association);
            log_likelihood
        };
        path.iter().zip(observations).map(say).collect()
    })
}

impl<M: ConditionalMap, D: GaussianMotion, L: Likelihood<M>> Retrace<M> for FromMotion<D, L> {
    fn log_motion(&self, from: &Pose2, control: &D::Control, to: &Pose2) -> f64 {
        log_density(self.motion.drive(control).gaussian(from, [0.0; 3]), to)
    }

    fn log_likelihood(&self, map: &M, world_from_robot: &Pose2, observation: &M::Observation) -> (f64, M::Association) {
        self.likelihood.log_likelihood(map, world_from_robot, observation)
    }

    /// q is the motion: both cancel.
    fn retrace(
        &self,
        particle: &Particle<M>,
        _control: &D::Control,
        observation: &M::Observation,
        to: &Pose2,
    ) -> Proposed<M::Association> {
        let (log_increment, association) = self.likelihood.log_likelihood(&particle.map, to, observation);
        Proposed { world_from_robot: *to, association, log_increment, trace: ProposalTrace::Motion }
    }

    /// The incremental weight of a proposal from the motion is that of its pose already.
    fn draw_and_retrace(
        &self,
        particle: &Particle<M>,
        control: &D::Control,
        observation: &M::Observation,
        stream: &mut Stream,
    ) -> Proposed<M::Association> {
        self.propose(particle, control, observation, stream)
    }
}

impl<Z: LandmarkSensor, S: Store, D: GaussianMotion> Retrace<Landmarks<Z, S>> for FromMeasurement<D> {
    fn log_motion(&self, from: &Pose2, control: &D::Control, to: &Pose2) -> f64 {
        log_density(self.motion.drive(control).gaussian(from, [0.0; 3]), to)
    }

    fn log_likelihood(
        &self,
        map: &Landmarks<Z, S>,
        world_from_robot: &Pose2,
        features: &<Landmarks<Z, S> as ConditionalMap>::Observation,
    ) -> (f64, <Landmarks<Z, S> as ConditionalMap>::Association) {
        super::Marginal.log_likelihood(map, world_from_robot, features)
    }

    /// Where all is linear this is ln ∫ p(z | x, m) p(x | x′, u) dx whatever the pose is, as FastSLAM 2.0 has it.
    fn retrace(
        &self,
        particle: &Particle<Landmarks<Z, S>>,
        control: &D::Control,
        features: &<Landmarks<Z, S> as ConditionalMap>::Observation,
        to: &Pose2,
    ) -> Proposed<<Landmarks<Z, S> as ConditionalMap>::Association> {
        let measured = self.fold(&particle.map, &particle.world_from_robot, control, features);
        self.paid(particle, control, features, to, &measured)
    }

    fn draw_and_retrace(
        &self,
        particle: &Particle<Landmarks<Z, S>>,
        control: &D::Control,
        features: &<Landmarks<Z, S> as ConditionalMap>::Observation,
        stream: &mut Stream,
    ) -> Proposed<<Landmarks<Z, S> as ConditionalMap>::Association> {
        let measured = self.fold(&particle.map, &particle.world_from_robot, control, features);
        let to = self.draw(&particle.world_from_robot, control, &measured, stream);
        self.paid(particle, control, features, &to, &measured)
    }

    fn log_likelihoods_along(
        &self,
        maps: &[&Landmarks<Z, S>],
        path: &[Pose2],
        observations: &[Observed<Landmarks<Z, S>>],
        executor: &Executor,
    ) -> Vec<Vec<f64>> {
        Landmarks::log_likelihoods_along(maps, path, observations, executor)
            .unwrap_or_else(|| one_by_one(self, maps, path, observations, executor))
    }
}

impl<D: GaussianMotion> FromMeasurement<D> {
    /// [`Retrace::retrace`], with the Gaussian of the proposal.
    fn paid<Z: LandmarkSensor, S: Store>(
        &self,
        particle: &Particle<Landmarks<Z, S>>,
        control: &D::Control,
        features: &[Feature],
        to: &Pose2,
        measured: &Measured,
    ) -> Proposed<Vec<Association>> {
        let from = &particle.world_from_robot;
        let (log_likelihood, association) = self.log_likelihood(&particle.map, to, features);
        let (paid, trace) = if measured.informed {
            let q = Gaussian3::new(measured.mean, measured.covariance);
            let paid = match q {
                Some(q) => log_density(self.motion.drive(control).gaussian(from, [0.0; 3]), to) - q.log_density(to),
                None => f64::NEG_INFINITY,
            };
            (paid, measured.trace())
        } else {
            (0.0, ProposalTrace::Motion)
        };
        Proposed { world_from_robot: *to, association, log_increment: log_likelihood + paid, trace }
    }
}

fn log_density(density: Option<Gaussian3>, at: &Pose2) -> f64 {
    density.map_or(f64::NEG_INFINITY, |density| density.log_density(at))
}
