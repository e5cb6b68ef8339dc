//! The Rao–Blackwellized particle filter.

mod builder;
mod conditioned;
mod estimate;
#[cfg(feature = "serde")]
mod saved;

pub use builder::{Builder, Start};
pub use estimate::Estimate;
pub(crate) use estimate::moments;
#[cfg(feature = "serde")]
pub use saved::Saved;

use crate::execute::Executor;
use crate::genealogy::{Descent, Path};
use crate::map::ConditionalMap;
use crate::particle::Particle;
use crate::proposal::{Proposal, ProposalTrace, Proposed};
use crate::random::{Purpose, Stream};
use crate::resampling::{ResamplePolicy, Scheme};
use crate::weights::Weights;
use core::ops::Range;

/// What one step did. `A` is what a map takes an observation for: [`ConditionalMap::Association`].
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Report<A> {
    /// The step, from 1 on.
    pub step: u32,
    /// Log weight increment of each slot \[nats\].
    pub log_increments: Vec<f64>,
    /// Normalised weights before resampling.
    pub weights: Vec<f64>,
    /// ln p̂(z_t | z₁..ₜ₋₁) \[nats\], the log of the weighted mean of the increments' exponentials. The product of the p̂ of all steps has no
    /// bias, whatever the policy, the scheme and the temper of selection, where each increment is that of a model: exp(increment) has
    /// the mean p(z | x′, u, m). That of a tempered score, or of a scan that weighs by the way driven, is none: there this is a mean increment and no
    /// evidence. −∞ where the step explained nothing, +∞ where an increment is.
    pub log_evidence: f64,
    /// N_eff of the weights before resampling.
    pub ess: f64,
    /// N_eff of the scores w^τ that select ([`Builder::selection_temper`]) before resampling: what the policy goes by. With τ = 1, N_eff of
    /// the weights.
    pub selection_ess: f64,
    /// The path of each slot before resampling: nobody else holds those that the step let die.
    #[cfg_attr(feature = "serde", serde(serialize_with = "newest_poses"))]
    pub paths: Vec<Path>,
    /// Slot each particle was copied from, where the step resampled.
    pub ancestors: Option<Vec<u32>>,
    /// How many parts of the observation cannot have been measured, such as a range that is not a number: every particle ignores them.
    pub ignored: u32,
    /// Whether the control cannot be driven, as one that is not a number cannot: the step is taken for standing still.
    pub refused_control: bool,
    /// How each slot came by its pose.
    pub traces: Vec<ProposalTrace>,
    /// What each slot took the observation for.
    pub associations: Vec<A>,
}

/// Of a report that is written the newest pose of each path: the poses before it are those of the reports before.
#[cfg(feature = "serde")]
fn newest_poses<S: serde::Serializer>(paths: &[Path], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(paths.iter().map(Path::pose))
}

impl<A> Report<A> {
    /// Whether any particle of weight explains the observation. Where none does, the weights stay as they were.
    pub fn explained(&self) -> bool {
        self.log_evidence > f64::NEG_INFINITY
    }

    /// Whether the step resampled.
    pub fn resampled(&self) -> bool {
        self.ancestors.is_some()
    }

    /// How many particles came by their pose by looking first, and not by the motion alone.
    pub fn matched(&self) -> usize {
        self.traces.iter().filter(|trace| matches!(trace, ProposalTrace::Matched { .. })).count()
    }

    /// Paths of the slots that nobody was copied from, where the step resampled.
    pub fn extinct(&self) -> impl Iterator<Item = &Path> {
        let mut extinct = vec![self.ancestors.is_some(); self.paths.len()];
        self.ancestors.iter().flatten().for_each(|slot| extinct[*slot as usize] = false);
        self.paths.iter().zip(extinct).filter_map(|(path, extinct)| extinct.then_some(path))
    }
}

/// A population of particles with one proposal and one policy of resampling.
///
/// ```
/// use fastslam::map::landmarks::{Correspondence, Landmarks};
/// use fastslam::motion::{Odometry, OdometryModel};
/// use fastslam::proposal::FromMeasurement;
/// use fastslam::rbpf::Rbpf;
/// use fastslam::sensor::{Feature, RangeBearing};
/// # use fastslam::nalgebra::Vector2;
///
/// // FastSLAM 2.0 with landmarks that are told apart by their signatures.
/// let sensor = RangeBearing { range_std: 0.1, bearing_std: 0.02, max_range: 8.0, field_of_view: 6.3 };
/// let motion = OdometryModel { alphas: [0.01, 0.001, 0.01, 0.001] };
/// let map = <Landmarks<_>>::new(sensor, Correspondence::Known);
/// let mut filter = Rbpf::builder(map, FromMeasurement { motion }).particles(50).seed(1).build()?;
///
/// // Half a metre ahead a step, past a landmark that is seen 2 m ahead and 1 m to the left of the start.
/// for step in 1..=3 {
///     let ahead: f64 = 2.0 - 0.5 * f64::from(step);
///     let seen = Feature { z: Vector2::new(ahead.hypot(1.0), 1.0_f64.atan2(ahead)), signature: Some(0) };
///     let report = filter.step(&Odometry { rot1: 0.0, trans: 0.5, rot2: 0.0 }, &[seen]);
///     assert!(report.explained());
/// }
/// let estimate = filter.estimate();
/// assert!((estimate.mean.x - 1.5).abs() < 0.2);
/// let best = &filter.particles()[estimate.best];
/// assert!((best.map.get(0).unwrap().mean - Vector2::new(2.0, 1.0)).norm() < 0.2);
/// # Ok::<(), fastslam::error::SettingError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Rbpf<M, P> {
    proposal: P,
    policy: ResamplePolicy,
    scheme: Scheme,
    seed: u64,
    /// τ of [`Builder::selection_temper`].
    selection_temper: f64,
    executor: Executor,
    step: u32,
    /// Resamplings in this step.
    resamplings: u32,
    particles: Vec<Particle<M>>,
    weights: Weights,
    /// ln of the sum that the weights had after the last selection, before they were normalised \[nats\]: part of the next step's evidence.
    log_selected: f64,
    /// The product of all that a path has paid, in full and as if no step had resampled: copies keep the weight of their original.
    path_weights: Weights,
    /// Slot that each particle was copied from, while the copies are still equal to the bit; empty otherwise.
    copied: Vec<u32>,
}

impl<M: ConditionalMap, P: Proposal<M>> Rbpf<M, P> {
    /// A filter that is still to be set up: particles that map by copies of `map`, and move by `proposal`.
    pub fn builder(map: M, proposal: P) -> Builder<M, P> {
        Builder::new(map, proposal)
    }

    /// The same filter, resampled by another policy from here on. Below a fraction beyond 1 of the particles N_eff always is, below
    /// one beyond 0 it never is.
    pub fn with_policy(self, policy: ResamplePolicy) -> Self {
        Self { policy, ..self }
    }

    /// The same filter, computed by another executor: the results are the same.
    pub fn with_executor(self, executor: Executor) -> Self {
        Self { executor, ..self }
    }

    /// One step of the filter: propose, map, weigh, and select if the policy calls for it.
    pub fn step(&mut self, control: &P::Control, observation: &M::Observation) -> Report<M::Association> {
        self.step_proposed(control, observation, self.propose(control, observation, 0..self.particles.len()))
    }

    /// [`Self::step`], where the draws of all slots are there, in their order, as [`Self::propose`] has them.
    ///
    /// # Panics
    /// Where there are not as many as slots.
    pub fn step_proposed(
        &mut self,
        control: &P::Control,
        observation: &M::Observation,
        proposed: Vec<Proposed<M::Association>>,
    ) -> Report<M::Association> {
        let mut report = self.weigh_proposed(control, observation, proposed);
        report.ancestors = self.select(report.selection_ess);
        report
    }

    /// The first half of a step: every particle draws its new pose, pays for it, and maps what it sees from there.
    pub fn weigh(&mut self, control: &P::Control, observation: &M::Observation) -> Report<M::Association> {
        let proposed = self.propose(control, observation, 0..self.particles.len());
        self.weigh_proposed(control, observation, proposed)
    }

    /// What the particles in these slots draw in the next step, which nothing of the filter is changed by. A slot draws the same whichever others
    /// are asked for, so that several programs that hold the same filter can each work out a part.
    ///
    /// # Panics
    /// Where there are not so many slots.
    pub fn propose(
        &self,
        control: &P::Control,
        observation: &M::Observation,
        slots: Range<usize>,
    ) -> Vec<Proposed<M::Association>> {
        self.propose_by(slots, |proposal, _, particle, streams| {
            proposal.propose_copies(particle, control, observation, streams)
        })
    }

    /// [`Self::weigh`], where the draws of all slots are there.
    fn weigh_proposed(
        &mut self,
        control: &P::Control,
        observation: &M::Observation,
        mut proposed: Vec<Proposed<M::Association>>,
    ) -> Report<M::Association> {
        assert_eq!(proposed.len(), self.particles.len(), "a draw for each slot");
        (self.step, self.resamplings) = (self.step + 1, 0);
        let ignored = self.particles[0].map.ignored(observation);
        self.assimilate(observation, &mut proposed);
        self.extend_paths();
        let log_increments: Vec<f64> = proposed.iter().map(|p| p.log_increment).collect();
        let log_evidence = self.reweigh(&log_increments);
        let refused_control = !self.proposal.can_drive(control);
        Report { ignored, refused_control, ..self.report(proposed, log_increments, log_evidence) }
    }

    /// Draws a pose for the particle of each of these slots: `propose` for equal particles in the slots from a first one on, from the stream of each.
    /// A slot depends on no other, except that neighbouring copies of one particle are proposed together, so that it does not matter who computes
    /// which.
    fn propose_by(
        &self,
        slots: Range<usize>,
        propose: impl Fn(&P, usize, &Particle<M>, &mut [Stream]) -> Vec<Proposed<M::Association>> + Sync + Send,
    ) -> Vec<Proposed<M::Association>> {
        let step = self.step + 1;
        let particle = |slot: usize| self.copied.get(slot).map_or(slot, |slot| *slot as usize);
        let all: Vec<usize> = slots.collect();
        let mut alike: Vec<&[usize]> = all.chunk_by(|a, b| particle(*a) == particle(*b)).collect();
        let proposed = self.executor.map(&mut alike, |_, slots| {
            let stream = |slot: &usize| Stream::at(self.seed, Purpose::PROPOSAL, step, *slot as u32);
            let mut streams: Vec<_> = slots.iter().map(stream).collect();
            propose(&self.proposal, slots[0], &self.particles[slots[0]], &mut streams)
        });
        proposed.into_iter().flatten().collect()
    }

    /// Moves each particle to the pose it drew, and updates its map from there.
    fn assimilate(&mut self, observation: &M::Observation, proposed: &mut [Proposed<M::Association>]) {
        self.copied = Vec::new();
        let mut drawn: Vec<_> = self.particles.iter_mut().zip(proposed).collect();
        self.executor.map(&mut drawn, |_, (particle, Proposed { world_from_robot, association, .. })| {
            particle.world_from_robot = *world_from_robot;
            particle.map.assimilate(world_from_robot, observation, association);
        });
    }

    /// Appends the new poses to the paths.
    fn extend_paths(&mut self) {
        for particle in &mut self.particles {
            particle.path.push(particle.world_from_robot);
        }
    }

    /// Multiplies the weights by what the particles have paid, and divides them by their sum. Returns the log of that sum, and of what the last
    /// selection left it at \[nats\].
    fn reweigh(&mut self, log_increments: &[f64]) -> f64 {
        let log_sum;
        (self.weights, log_sum) = self.weights.reweighted(log_increments);
        (self.path_weights, _) = self.path_weights.reweighted(log_increments);
        core::mem::take(&mut self.log_selected) + log_sum
    }

    /// The scores that select, w^τ.
    fn scores(&self) -> Weights {
        self.weights.tempered(self.selection_temper)
    }

    /// What there is to tell of the step so far.
    fn report(
        &self,
        proposed: Vec<Proposed<M::Association>>,
        log_increments: Vec<f64>,
        log_evidence: f64,
    ) -> Report<M::Association> {
        Report {
            step: self.step,
            log_increments,
            log_evidence,
            weights: self.weights.as_slice().to_vec(),
            ess: self.weights.ess(),
            selection_ess: self.scores().ess(),
            paths: self.particles.iter().map(|p| p.path.clone()).collect(),
            ancestors: None,
            ignored: 0,
            refused_control: false,
            traces: proposed.iter().map(|p| p.trace).collect(),
            associations: proposed.into_iter().map(|p| p.association).collect(),
        }
    }

    /// Resamples where the policy calls for it, at this N_eff of the scores.
    fn select(&mut self, ess: f64) -> Option<Vec<u32>> {
        self.policy.should_resample(ess, self.particles.len()).then(|| self.resample())
    }

    /// The second half of a step: particles are drawn by their scores w^τ, and what is not drawn is extinct. A survivor keeps the weight
    /// w / w^τ, so that what is estimated has the same mean before and after (Liu 2001, *Monte Carlo strategies in scientific computing*, §3.4.4:
    /// resampling by priority scores). With τ = 1 all survivors weigh the same. Returns the slot that each particle was copied from.
    ///
    /// The n-th resampling of a step, from 0 on, draws from the stream (seed, [`Purpose::RESAMPLING`], step, n).
    pub fn resample(&mut self) -> Vec<u32> {
        let count = self.particles.len();
        let mut stream = Stream::at(self.seed, Purpose::RESAMPLING, self.step, self.resamplings);
        self.resamplings += 1;
        let scores = self.scores();
        let ancestors = self.scheme.ancestors(&scores, count, &mut stream);
        let (weights, log_sum) = self.weights.selected(&scores, &ancestors);
        self.copy(&ancestors);
        self.weights = weights;
        self.log_selected += log_sum;
        ancestors
    }

    /// Particles become copies of those in these slots, all of one weight.
    pub(crate) fn copy(&mut self, ancestors: &[u32]) {
        self.particles = ancestors.iter().map(|slot| self.particles[*slot as usize].clone()).collect();
        self.weights = Weights::uniform(ancestors.len());
        self.path_weights = self.path_weights.copied(ancestors);
        self.copied = ancestors.to_vec();
    }

    /// Puts what is made of a particle in its place, slot by slot, and returns what else was found. Weights stay as they are: that is exact where the
    /// move leaves the posterior unchanged (Gilks and Berzuini 2001, *resample-move*), and for any other an approximation that the caller answers for.
    pub(crate) fn revise<R: Send>(
        &mut self,
        revise: impl Fn(usize, &Particle<M>) -> (Option<Particle<M>>, R) + Sync + Send,
    ) -> Vec<R> {
        self.copied = Vec::new();
        self.executor.map(&mut self.particles, |slot, particle| {
            let (revised, found) = revise(slot, particle);
            if let Some(revised) = revised {
                *particle = revised;
            }
            found
        })
    }

    /// The particles' maps, by slot: see [`Self::revise`] for what a change of them is.
    pub(crate) fn maps_mut(&mut self) -> impl Iterator<Item = &mut M> {
        self.particles.iter_mut().map(|particle| &mut particle.map)
    }

    /// Where the particles' next poses are drawn from.
    pub fn proposal(&self) -> &P {
        &self.proposal
    }

    /// The population, by slot.
    pub fn particles(&self) -> &[Particle<M>] {
        &self.particles
    }

    /// Weights as they are now: after a resampling, uniform with τ = 1.
    pub fn weights(&self) -> &Weights {
        &self.weights
    }

    /// Weights accumulated along the paths in full, as if no step had resampled, normalised: an account that tells which path is best, and nothing else.
    pub fn path_weights(&self) -> &Weights {
        &self.path_weights
    }

    /// Slot of the best particle: that whose path has accumulated the largest weight, the lowest of equals, as in gmapping
    /// (Grisetti, Stachniss, Burgard 2007).
    pub fn best(&self) -> usize {
        self.path_weights.heaviest()
    }

    /// Distinct ancestors at step 0 of the present population.
    pub fn lineage(&self) -> usize {
        self.descent().lineage(self.step) as usize
    }

    /// What the present population descends from.
    pub fn descent(&self) -> Descent {
        Descent::of(self.particles.iter().map(|p| &p.path))
    }
}
