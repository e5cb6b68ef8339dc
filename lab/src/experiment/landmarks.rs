//! FastSLAM among landmarks: simulated courses and recorded logs, and how far from the truth a run ends.

mod course;
mod judged;
mod setup;

pub use course::Course;
pub use setup::{CorrespondenceKind, FastSlam, LandmarkMap, LandmarkSetup, Learning, PARTICLES};

use crate::digest::Digest;
use core::hash::Hasher as _;
use fastslam::error::SettingError;
use fastslam::execute::Executor;
use fastslam::geometry::Pose2;
use fastslam::map::landmarks::{Association, Gate, Landmarks};
use fastslam::map::{ConditionalMap, Footprint};
use fastslam::motion::{Displaced, Drift, Motion, Velocity, VelocityModel};
use fastslam::nalgebra::Vector2;
use fastslam::particle::Particle;
use fastslam::proposal::{Calibrated, Calibrating, Learnt, Proposal};
use fastslam::rbpf::Rbpf;
use fastslam::resampling::ResamplePolicy;
use fastslam::sensor::{Feature, RangeBearing};
use judged::error_of_mean;
use setup::drift_stds;
use std::sync::Arc;

/// A drive as its robot reported it, with the truth beside it for those who judge.
#[derive(Clone, PartialEq, Debug)]
pub struct LandmarkLog<U = Velocity> {
    /// True poses of steps 0 to T.
    pub truth: Vec<Pose2>,
    /// Poses by the reported controls alone, from the same start.
    pub odometry: Vec<Pose2>,
    /// Reported controls; the k-th leads from step k to k + 1.
    pub controls: Vec<U>,
    /// What was seen at steps 1 to T.
    pub sightings: Vec<Vec<Feature>>,
    /// Where the landmarks truly are \[m\], by signature.
    pub landmarks: Vec<Vector2<f64>>,
}

impl<U> Default for LandmarkLog<U> {
    fn default() -> Self {
        let (truth, odometry, landmarks) = (Vec::new(), Vec::new(), Vec::new());
        Self { truth, odometry, controls: Vec::new(), sightings: Vec::new(), landmarks }
    }
}

/// What a filter is told of the noise, and of how landmarks are to be told apart.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Tuning<D = VelocityModel> {
    /// How the robot drives, and the noise of what it reports of that.
    pub motion: D,
    /// The sensor.
    pub sensor: RangeBearing,
    /// Settings of the association, where signatures are not to be used.
    pub gate: Gate,
}

impl Tuning {
    /// The same with every standard deviation of the motion, and of the sensor, multiplied.
    pub fn scaled(&self, odometry_scale: f64, sensor_scale: f64) -> Self {
        Self { motion: self.motion.scaled(odometry_scale), sensor: self.sensor.scaled(sensor_scale), gate: self.gate }
    }
}

/// A particle's map of landmarks, with or without more that is known along its path.
pub trait WithLandmarks: ConditionalMap<Observation = [Feature]> {
    /// The landmarks.
    fn landmarks(&self) -> &LandmarkMap;

    /// What the features of a step were taken for.
    fn associations(of: &Self::Association) -> &Vec<Association>;

    /// What is known of the drift of the odometry, where that is learnt.
    fn drift(&self) -> Option<&Drift<2>> {
        None
    }
}

impl WithLandmarks for LandmarkMap {
    fn landmarks(&self) -> &LandmarkMap {
        self
    }

    fn associations(of: &Vec<Association>) -> &Vec<Association> {
        of
    }
}

impl WithLandmarks for Calibrated<LandmarkMap> {
    fn landmarks(&self) -> &LandmarkMap {
        self.map()
    }

    fn associations(of: &Learnt<Vec<Association>>) -> &Vec<Association> {
        &of.association
    }

    fn drift(&self) -> Option<&Drift<2>> {
        Some(self.drift())
    }
}

/// What one step did, and how far from the truth it led.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LandmarkReport {
    /// The step; 0 is the start.
    pub step: u32,
    /// Landmarks seen at this step.
    pub seen: u32,
    /// ln p̂(z_t | z₁..ₜ₋₁) by the filter \[nats\], of what is taken for known landmarks: each that is founded counts as p₀, or as 1
    /// where it has a name. −∞ where the step explained nothing (`null` in JSON).
    pub log_evidence: f64,
    /// N_eff before resampling.
    pub ess: f64,
    /// Slot each particle was copied from, where the step resampled.
    pub ancestors: Option<Vec<u32>>,
    /// Distance of the best particle from the truth \[m\].
    pub error_best: f64,
    /// Distance of the weighted mean of all particles from the truth \[m\].
    pub error_mean: f64,
    /// Distance of raw odometry from the truth \[m\].
    pub error_odometry: f64,
    /// Landmarks in the best particle's map.
    pub landmarks: u32,
    /// Distinct ancestors at step 0.
    pub lineage: u32,
    /// What the best particle made of what was seen.
    pub best: AssociationSummary,
    /// Different answers, in the population before resampling, to which landmarks were seen.
    pub answers: u32,
}

/// What one particle made of the features of a step.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct AssociationSummary {
    /// Features taken for landmarks of its map.
    pub again: u32,
    /// Features taken for landmarks never seen before.
    pub first: u32,
    /// Log weight increment \[nats\].
    pub log_increment: f64,
}

/// A run under way, of particles with maps M that are drawn by a proposal P.
#[derive(Clone, Debug)]
pub struct LandmarkRun<D: Motion = VelocityModel, M = LandmarkMap, P = FastSlam<D>> {
    log: Arc<LandmarkLog<D::Control>>,
    filter: Rbpf<M, P>,
    step: u32,
    /// Sum over the steps so far of the squared error of the weighted mean \[m²\].
    squared_errors: f64,
}

impl<D: Motion + Clone> LandmarkRun<D> {
    /// At the log's start, which is known.
    ///
    /// # Errors
    /// Where a setting is out of its range.
    pub fn new(
        setup: &LandmarkSetup,
        tuning: &Tuning<D>,
        log: Arc<LandmarkLog<D::Control>>,
    ) -> Result<Self, SettingError> {
        let map = Landmarks::new(tuning.sensor, setup.correspondence.of(tuning));
        let filter = setup.filter(map, setup.proposal.of(tuning.motion.clone()), &log)?;
        Ok(Self { log, filter, step: 0, squared_errors: 0.0 })
    }
}

impl<D: Motion + Clone> LandmarkRun<D, Calibrated<LandmarkMap>, Learning<D>> {
    /// At the log's start, which is known, where nothing is known of the drift of the odometry but its prior, which comes from the noise that is told.
    ///
    /// # Errors
    /// Where a setting is out of its range.
    pub fn learning(
        setup: &LandmarkSetup,
        tuning: &Tuning<D>,
        log: Arc<LandmarkLog<D::Control>>,
    ) -> Result<Self, SettingError> {
        let prior = Drift::new(drift_stds(&tuning.motion, &log.controls));
        let map = Calibrated::new(Landmarks::new(tuning.sensor, setup.correspondence.of(tuning)), prior);
        let proposal = Calibrating { motion: tuning.motion.clone(), then: setup.proposal.of(Displaced) };
        let filter = setup.filter(map, proposal, &log)?;
        Ok(Self { log, filter, step: 0, squared_errors: 0.0 })
    }
}

impl<D: Motion + Clone, M: WithLandmarks, P: Proposal<M, Control = D::Control>> LandmarkRun<D, M, P> {
    /// The same run, resampled by another policy from here on.
    pub fn with_policy(self, policy: ResamplePolicy) -> Self {
        Self { filter: self.filter.with_policy(policy), ..self }
    }

    /// The same run, computed by another executor: the results are the same.
    pub fn with_executor(self, executor: Executor) -> Self {
        Self { filter: self.filter.with_executor(executor), ..self }
    }

    /// The drift of the odometry, where it is learnt: how much the robot turns to the left beyond it, per metre ahead \[rad/m\] and per radian
    /// turned \[–\]. The weighted mean over the particles of their means.
    pub fn drift(&self) -> Option<[f64; 2]> {
        let mut weighted = self.filter.particles().iter().zip(self.filter.weights().as_slice());
        weighted.try_fold([0.0; 2], |[a, b], (particle, w)| {
            let [a_metre, a_turn] = particle.map.drift()?.coefficients();
            Some([a + w * a_metre, b + w * a_turn])
        })
    }

    /// One step of the filter; `None` after the last.
    pub fn step(&mut self) -> Option<LandmarkReport> {
        self.advance().map(|(report, _)| report)
    }

    /// [`Self::step`], with what each particle, before resampling, took the features for.
    pub(super) fn advance(&mut self) -> Option<(LandmarkReport, Vec<M::Association>)> {
        let k = self.step as usize;
        let (control, features) = (self.log.controls.get(k)?, self.log.sightings.get(k)?);
        let report = self.filter.step(control, features);
        self.step += 1;
        let (truth, odometry) = (&self.log.truth[k + 1], &self.log.odometry[k + 1]);
        let particles = self.filter.particles();
        let best = &particles[self.filter.best()];
        // The slot the best had before resampling.
        let slot = report.ancestors.as_ref().map_or(self.filter.best(), |from| from[self.filter.best()] as usize);
        let count = |of: fn(&Association) -> bool| {
            M::associations(&report.associations[slot]).iter().filter(|seen| of(seen)).count()
        };
        let mut answers: Vec<&Vec<Association>> = Vec::new();
        for association in report.associations.iter().map(M::associations) {
            if !answers.contains(&association) {
                answers.push(association);
            }
        }
        let error_mean = error_of_mean(&self.filter, truth);
        self.squared_errors += error_mean * error_mean;
        let told = LandmarkReport {
            step: self.step,
            seen: features.len() as u32,
            log_evidence: report.log_evidence,
            ess: report.ess,
            ancestors: report.ancestors,
            error_best: best.world_from_robot.distance(truth),
            error_mean,
            error_odometry: odometry.distance(truth),
            landmarks: best.map.landmarks().iter().count() as u32,
            lineage: self.filter.lineage() as u32,
            best: AssociationSummary {
                again: count(|sighted| matches!(sighted, Association::Matched(_))) as u32,
                first: count(|sighted| matches!(sighted, Association::New(_))) as u32,
                log_increment: report.log_increments[slot],
            },
            answers: answers.len() as u32,
        };
        Some((told, report.associations))
    }

    /// How many steps were taken.
    pub(super) fn steps_taken(&self) -> usize {
        self.step as usize
    }

    /// The drive.
    pub fn log(&self) -> &LandmarkLog<D::Control> {
        &self.log
    }

    /// The population, by slot.
    pub fn particles(&self) -> &[Particle<M>] {
        self.filter.particles()
    }

    /// The filter, for those who watch it.
    pub fn filter(&self) -> &Rbpf<M, P> {
        &self.filter
    }

    /// Slot of the best particle.
    pub fn best(&self) -> usize {
        self.filter.best()
    }

    /// Poses of one particle, step 0 to now.
    pub fn path(&self, slot: usize) -> Vec<Pose2> {
        self.particles()[slot].path.poses()
    }

    /// Runs to the end. Returns a fingerprint of every pose and weight on the way, and of all maps at the end, bit for bit.
    pub fn trace(mut self) -> Digest {
        let mut digest = Digest::new();
        while let Some(report) = self.step() {
            [report.ess, report.error_best, report.error_mean].into_iter().for_each(|x| digest.f64(x));
            for particle in self.particles() {
                let Pose2 { x, y, theta } = particle.world_from_robot;
                [x, y, theta].into_iter().for_each(|x| digest.f64(x));
            }
            self.filter.weights().as_slice().iter().for_each(|weight| digest.f64(*weight));
        }
        for (index, landmark) in self.particles().iter().flat_map(|particle| particle.map.landmarks().iter()) {
            digest.u32(index);
            landmark.mean.iter().chain(&landmark.covariance).for_each(|x| digest.f64(*x));
            digest.write(&landmark.existence_count.to_le_bytes());
        }
        digest
    }

    /// Memory of all maps.
    pub fn footprint(&self) -> Footprint {
        Landmarks::footprint(self.particles().iter().map(|p| p.map.landmarks()))
    }
}
