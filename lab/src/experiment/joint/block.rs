//! A block of particles of both filters, and what a population of blocks comes to.

use super::{COMPUTED, DRIVE, JointSetup, Log, MOST, Population, SAMPLED};
use crate::baseline::sampled_map::Factor;
use core::f64::consts::TAU;
use fastslam::geometry::Pose2;
use fastslam::map::landmarks::Landmark;
use fastslam::motion::Motion;
use fastslam::nalgebra::{Matrix2, Vector2};
use fastslam::ops;
use fastslam::random::{Purpose, Stream};
use fastslam::resampling::Scheme;
use fastslam::sensor::{LandmarkSensor, RangeBearing};
use fastslam::weights::Weights;

/// Particles of a block: the most for which a step is computed in one slice of work. Without resampling a population is the union of its
/// blocks.
pub(super) const BLOCK: u32 = 1000;

/// Samples of the particles of a block, up to some landmark. They do not depend on the noise of the sensor.
///
/// Without resampling particles are independent, and each landmark is observed once: all that is needed of a particle is its pose, and the one
/// landmark that it observes. Draws, predictions and weights are those of the two filters
/// ([`Rbpf`](fastslam::rbpf::Rbpf) with a [`SampledMap`](crate::baseline::sampled_map::SampledMap) and with
/// [`Landmarks`](fastslam::map::landmarks::Landmarks)); a test runs these beside it and compares bit for bit.
#[derive(Clone, Debug)]
pub(super) struct Block {
    pub(super) seed: u64,
    world_from_robot: Vec<Pose2>,
    /// First landmark of each particle's sampled map \[m\].
    first: Vec<Vector2<f64>>,
    /// Residual of the measurement against each particle's sampled landmark, by landmark (range \[m\], bearing \[rad\]).
    pub(super) residuals: Vec<Vec<Vector2<f64>>>,
}

impl Block {
    pub(super) fn new(setup: &JointSetup, repeat: u32, block: u32) -> Self {
        let seed = setup.seed + (u64::from(repeat) << 32) + (u64::from(block) << 40);
        let count = (setup.particles - block * BLOCK).min(BLOCK) as usize;
        Self { seed, world_from_robot: vec![Pose2::default(); count], first: Vec::new(), residuals: Vec::new() }
    }

    /// Draws the next landmark of each particle, and before the first one, the particle's pose.
    pub(super) fn draw(&mut self, log: &Log, look: &Look) {
        let seen = self.residuals.len();
        let motion = log.setup.motion();
        let mut residuals = Vec::with_capacity(self.world_from_robot.len());
        for (slot, pose) in (0..).zip(&mut self.world_from_robot) {
            let mut stream = Stream::at(self.seed, Purpose::PROPOSAL, seen as u32 + 1, slot);
            if seen == 0 {
                *pose = motion.sample(pose, &DRIVE, &mut stream);
            } else {
                // The robot stands: its odometry has no noise, but takes its numbers from the stream.
                stream.noise([0.0; 3]);
            }
            let point = look.draw(&mut stream);
            residuals.push(look.residual(pose, &point));
            if seen == 0 {
                self.first.push(point);
            }
        }
        self.residuals.push(residuals);
    }

    /// Weighs the particles of both filters by the measurement of a landmark.
    pub(super) fn weigh(&self, look: &Look, seen: usize, found: &mut [Weighed; 2]) {
        let sampled: Vec<f64> = self.residuals[seen].iter().map(|residual| look.weigh_point(residual)).collect();
        let computed: Vec<f64> = self.world_from_robot.iter().map(|pose| look.weigh(pose)).collect();
        found[SAMPLED].weigh(seen, &sampled);
        found[COMPUTED].weigh(seen, &computed);
        if seen == 0 {
            found[SAMPLED].first.extend(&self.first);
            found[COMPUTED].first.extend(self.world_from_robot.iter().map(|pose| look.seen_from(pose)));
        }
    }
}

/// An observation of one landmark: the part of its weights that all particles have in common.
pub(super) struct Look {
    sensor: RangeBearing,
    known: Landmark,
    z: Vector2<f64>,
    /// L with L Lᵀ = Σ, the prior covariance of the landmark.
    factor: Factor,
    /// Q⁻¹ and ln |Q|: the innovation of a point has the covariance of the sensor.
    inverse: Matrix2<f64>,
    log_determinant: f64,
    log_turn: f64,
}

impl Look {
    pub(super) fn new(log: &Log, seen: usize) -> Self {
        let (sensor, known, z) = (log.setup.sensor(), log.known[seen], log.features[seen].z);
        let point = Landmark { covariance: Matrix2::zeros(), ..known }.innovation(&sensor, &log.robot, &z);
        let (inverse, log_determinant) = (point.inverse, ops::ln(point.determinant()));
        let factor = Factor::of(&known.covariance);
        Self { sensor, known, z, factor, inverse, log_determinant, log_turn: ops::ln(TAU) }
    }

    /// A sample of the landmark \[m\].
    fn draw(&self, stream: &mut Stream) -> Vector2<f64> {
        self.factor.draw(&self.known.mean, stream)
    }

    /// Residual of the measurement against the prediction for a point.
    fn residual(&self, pose: &Pose2, point: &Vector2<f64>) -> Vector2<f64> {
        self.sensor.residual(&self.z, &self.sensor.predict(pose, point).z)
    }

    /// ln p(z | x, m) of a point \[nats\].
    fn weigh_point(&self, residual: &Vector2<f64>) -> f64 {
        -0.5 * (residual.dot(&(self.inverse * residual)) + self.log_determinant) - self.log_turn
    }

    /// ln ∫ p(z | x, m) p(m) dm \[nats\].
    fn weigh(&self, pose: &Pose2) -> f64 {
        let innovation = self.known.innovation(&self.sensor, pose, &self.z);
        if innovation.is_regular() { innovation.log_likelihood() } else { 0.0 }
    }

    /// Mean of the landmark after the update \[m\].
    fn seen_from(&self, pose: &Pose2) -> Vector2<f64> {
        let mut landmark = self.known;
        landmark.update(&self.sensor, pose, &self.z);
        landmark.mean
    }
}

/// What the particles of a population have come to, as far as its blocks have been run.
#[derive(Clone, Debug, Default)]
pub(super) struct Weighed {
    /// Log weights of all particles \[nats\], after 1, 2, … landmarks.
    pub(super) log_weights: Vec<Vec<f64>>,
    /// Where each has the first landmark \[m\]. It is seen once.
    pub(super) first: Vec<Vector2<f64>>,
}

impl Weighed {
    fn weigh(&mut self, seen: usize, increments: &[f64]) {
        self.log_weights.resize(MOST as usize, Vec::new());
        let before = seen.checked_sub(1).map(|before| &self.log_weights[before]);
        // The last so many are of this block.
        let old = before.map(|all| all[all.len() - increments.len()..].to_vec());
        let old = old.unwrap_or_else(|| vec![0.0; increments.len()]);
        self.log_weights[seen].extend(old.iter().zip(increments).map(|(old, increment)| old + increment));
    }

    /// The whole population after so many landmarks, from 0 for one on.
    pub(super) fn population(&self, seen: usize, seed: u64) -> Population {
        let log_weights = &self.log_weights[seen];
        let (weights, _) = Weights::uniform(log_weights.len()).reweighted(log_weights);
        let mean: Vector2<f64> = self.first.iter().zip(weights.as_slice()).map(|(place, w)| place * *w).sum();
        // What a resampling here would keep; systematic ancestors are in the order of slots.
        let mut stream = Stream::at(seed, Purpose::RESAMPLING, seen as u32 + 1, 0);
        let mut ancestors = Scheme::Systematic.ancestors(&weights, log_weights.len(), &mut stream);
        ancestors.dedup();
        Population { ess: weights.ess(), left: ancestors.len() as u32, first: mean.into() }
    }
}
