//! FastSLAM among landmarks: simulated courses and recorded logs, and how far from the truth a run ends.

use crate::baseline::EkfSlam;
use crate::digest::Digest;
use crate::experiment::ProposalKind;
use crate::world::Field;
use crate::{WORLD_ODOMETRY, WORLD_SENSOR};
use core::f64::consts::{PI, TAU};
use core::hash::Hasher as _;
use fastslam::error::{Range, SettingError};
use fastslam::execute::Executor;
use fastslam::geometry::{Pose2, align, rms};
use fastslam::map::landmarks::{Association, Correspondence, Gate, Landmarks};
use fastslam::map::{ConditionalMap, Footprint};
use fastslam::motion::{Displaced, Drift, Motion, Velocity, VelocityModel};
use fastslam::nalgebra::Vector2;
use fastslam::ops;
use fastslam::particle::Particle;
use fastslam::proposal::{
    Calibrated, Calibrating, DRIFT_STDS, Either, FromMeasurement, FromMotion, FromWindow, Learnt, Marginal, Proposal,
    Windowed,
};
use fastslam::random::Stream;
use fastslam::rbpf::Rbpf;
use fastslam::resampling::{ResamplePolicy, Scheme};
use fastslam::sensor::{Feature, LandmarkSensor, RangeBearing};
use std::sync::Arc;

/// How many particles a run may have.
pub const PARTICLES: Range = Range::whole(1, 100_000);

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

/// The simulated courses.
#[derive(
    Clone, Copy, PartialEq, Eq, Debug, strum::Display, strum::EnumString, strum::VariantNames, strum::VariantArray,
)]
#[strum(serialize_all = "lowercase", parse_err_ty = SettingError, parse_err_fn = unknown_course)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "lowercase"))]
pub enum Course {
    /// A figure of eight through twenty-four landmarks, with a sharp sensor and poor odometry.
    Eight,
    /// Eight tags around a circle: the setting of the FastSLAM examples of PythonRobotics, with its landmarks, ranges and
    /// noises.
    Tags,
    /// Two wings that look the same: see [`Field::two_wings`].
    Wings,
}

fn unknown_course(given: &str) -> SettingError {
    SettingError::unknown_word("course", given, <Course as strum::VariantNames>::VARIANTS)
}

impl Course {
    /// The noise of the world, which is also what its filter is told.
    pub fn tuning(self) -> Tuning {
        match self {
            Self::Eight => Tuning {
                motion: VelocityModel { speed_std: 0.0, turn_rate_std: 0.0, alphas: [0.04, 0.0, 0.01, 0.04] },
                sensor: RangeBearing { range_std: 0.05, bearing_std: 0.01, max_range: 6.0, field_of_view: PI },
                gate: Gate { removal: true, ..Gate::default() },
            },
            Self::Tags => Tuning {
                motion: VelocityModel { speed_std: 0.5, turn_rate_std: 10.0 * PI / 180.0, alphas: [0.0; 4] },
                sensor: RangeBearing {
                    range_std: 0.3,
                    bearing_std: 2.0 * PI / 180.0,
                    max_range: 20.0,
                    field_of_view: TAU,
                },
                gate: Gate::default(),
            },
            // A robot that drives well and turns badly: 0.3 % of the way, 5 % of a turn. Twenty turns leave 6 rad of doubt.
            // Were the way as bad, the two maps would fit the hall unequally well, and chance would decide for one of them.
            Self::Wings => Tuning {
                motion: VelocityModel { speed_std: 0.0, turn_rate_std: 0.0, alphas: [1e-5, 0.0, 1e-7, 0.0025] },
                sensor: RangeBearing {
                    range_std: 0.2,
                    bearing_std: 0.04,
                    max_range: 6.0,
                    field_of_view: 2.0 * PI / 3.0,
                },
                gate: Gate::default(),
            },
        }
    }

    /// What wheels report beyond the truth, on average \[m/s, rad/s\]. No filter is told.
    fn bias(self) -> [f64; 2] {
        match self {
            Self::Eight | Self::Wings => [0.0, 0.0],
            Self::Tags => [0.0, 0.01],
        }
    }

    /// The world's noise of the sensor as a share of what the filter is told.
    ///
    /// In the wings the filter is told five times the noise there is. Each wing was mapped in one drive; told the truth, a
    /// filter takes the twenty numbers by which the two maps happen to differ for evidence of several nats, and chance decides
    /// between the wings. Told five times as much, it takes them for a twenty-fifth of that: the explanations stay equal.
    fn sharper(self) -> f64 {
        match self {
            Self::Eight | Self::Tags => 1.0,
            Self::Wings => 0.2,
        }
    }

    /// The drive with the noise of a seed; the truth is always the same.
    pub fn simulate(self, seed: u64) -> LandmarkLog {
        self.simulate_with(&self.tuning(), seed)
    }

    /// The drive with another noise than the course's own.
    pub fn simulate_with(self, tuning: &Tuning, seed: u64) -> LandmarkLog {
        let field = match self {
            Self::Eight => Field::figure_of_eight(),
            Self::Tags => Field::eight_tags(),
            Self::Wings => Field::two_wings(),
        };
        field.simulate(tuning, &tuning.sensor.scaled(self.sharper()), self.bias(), seed)
    }
}

impl Field {
    /// The drive with the noise of a seed: what wheels report by the motion of this tuning and beyond it by a bias \[m/s, rad/s\], and what
    /// this sensor measures of all that is in view of the tuning's.
    pub fn simulate(
        self,
        tuning: &Tuning,
        sensor: &RangeBearing,
        [speed_bias, turn_rate_bias]: [f64; 2],
        seed: u64,
    ) -> LandmarkLog {
        let mut log = LandmarkLog {
            truth: vec![Pose2::default()],
            odometry: vec![Pose2::default()],
            landmarks: self.landmarks,
            ..LandmarkLog::default()
        };
        for (step, driven) in (1..).zip(&self.controls) {
            let truth = driven.apply(&log.truth[log.truth.len() - 1]);
            let mut reported = tuning.motion.perturb(driven, &mut Stream::at(seed, WORLD_ODOMETRY, step, 0));
            reported.speed += speed_bias;
            reported.turn_rate += turn_rate_bias;
            log.odometry.push(reported.apply(&log.odometry[log.odometry.len() - 1]));
            log.truth.push(truth);
            log.controls.push(reported);
            let visible = (0..).zip(&log.landmarks).filter(|(_, m)| tuning.sensor.sees(&truth, m, 0.0));
            let see = |(signature, landmark)| {
                let mut stream = Stream::at(seed, WORLD_SENSOR, step, signature);
                Feature { z: sensor.measure(&truth, landmark, &mut stream), signature: Some(signature) }
            };
            log.sightings.push(visible.map(see).collect());
        }
        log
    }
}

/// Whether a filter may read the signatures of what it sees.
#[derive(
    Clone, Copy, PartialEq, Eq, Debug, strum::Display, strum::EnumString, strum::VariantNames, strum::VariantArray,
)]
#[strum(serialize_all = "lowercase", parse_err_ty = SettingError, parse_err_fn = unknown_association)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "lowercase"))]
pub enum CorrespondenceKind {
    /// It may.
    Known,
    /// Every particle decides for itself.
    Unknown,
}

fn unknown_association(given: &str) -> SettingError {
    SettingError::unknown_word("association", given, <CorrespondenceKind as strum::VariantNames>::VARIANTS)
}

impl CorrespondenceKind {
    fn of<D>(self, tuning: &Tuning<D>) -> Correspondence {
        match self {
            Self::Known => Correspondence::Known,
            Self::Unknown => Correspondence::Unknown(tuning.gate),
        }
    }
}

/// What a reader can set.
#[derive(Clone, PartialEq, Debug)]
pub struct LandmarkSetup {
    /// Number of particles M, 1 to 100 000.
    pub particles: usize,
    /// Seed of the filter's draws.
    pub seed: u64,
    /// FastSLAM 1.0 is [`ProposalKind::Motion`], 2.0 is [`ProposalKind::Improved`].
    pub proposal: ProposalKind,
    /// Known or unknown correspondence.
    pub correspondence: CorrespondenceKind,
    /// When to resample.
    pub policy: ResamplePolicy,
    /// How to resample.
    pub scheme: Scheme,
}

impl Default for LandmarkSetup {
    fn default() -> Self {
        Self {
            particles: 100,
            seed: 1,
            proposal: ProposalKind::Improved,
            correspondence: CorrespondenceKind::Known,
            policy: ResamplePolicy::EssBelow(0.5),
            scheme: Scheme::Systematic,
        }
    }
}

impl LandmarkSetup {
    /// Before the log's first step, at its start, which is known.
    fn filter<M, P, C>(&self, map: M, proposal: P, log: &LandmarkLog<C>) -> Result<Rbpf<M, P>, SettingError>
    where
        M: ConditionalMap,
        P: Proposal<M>,
    {
        PARTICLES.check("particles", self.particles as f64)?;
        Rbpf::builder(map, proposal)
            .particles(self.particles)
            .seed(self.seed)
            .start(log.truth.first().copied().unwrap_or_default())
            .policy(self.policy)
            .scheme(self.scheme)
            .build()
    }
}

/// Distance of the weighted mean of all particles from the truth \[m\].
fn error_of_mean<M: ConditionalMap, P: Proposal<M>>(filter: &Rbpf<M, P>, truth: &Pose2) -> f64 {
    let weighted = filter.particles().iter().zip(filter.weights().as_slice());
    let (x, y) =
        weighted.fold((0.0, 0.0), |(x, y), (p, w)| (x + w * p.world_from_robot.x, y + w * p.world_from_robot.y));
    ops::hypot(x - truth.x, y - truth.y)
}

/// A particle's map.
pub type LandmarkMap = Landmarks<RangeBearing>;

/// FastSLAM 1.0 or 2.0, which takes odometry for what its motion model says.
pub type FastSlam<D> = Either<FromMotion<D, Marginal>, FromMeasurement<D>>;

impl ProposalKind {
    fn of<D>(self, motion: D) -> FastSlam<D> {
        match self {
            Self::Motion => Either::Left(FromMotion { motion, likelihood: Marginal }),
            Self::Improved => Either::Right(FromMeasurement { motion }),
        }
    }
}

/// FastSLAM 1.0 or 2.0 in which each particle learns the drift of the odometry along its path.
pub type Learning<D> = Calibrating<D, FastSlam<Displaced>>;

/// Standard deviations of the drift before a log is read: a metre turns the robot by as much as the noise that is told of a metre, and never by more than
/// [`DRIFT_STDS`]; a turn is off by the share that stands there.
///
/// A wider prior finds as large a drift, but costs where there is none: with 0.05 rad/m, where the noise is 0.002 rad/√m, the errors of a simulated car
/// without any drift (M = 50) are up to 45 times as large. As the noise is taken by the metre, the prior is the same however a drive is cut into steps.
fn drift_stds<D: Motion>(motion: &D, controls: &[D::Control]) -> [f64; 2] {
    let start = Pose2::default();
    let (mut variance, mut way) = (0.0, 0.0);
    for drive in controls.iter().map(|control| motion.drive(control)) {
        variance += drive.covariance(&start).m33;
        way += drive.apply(&start).x.abs();
    }
    let [a_metre, a_turn] = DRIFT_STDS;
    let after_a_metre = if way > 0.0 { (variance / way).sqrt() } else { a_metre };
    [after_a_metre.clamp(1e-6, a_metre), a_turn]
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

    /// Root mean square over the steps so far of the error of the weighted mean's position, each when it was made \[m\]: as the filter
    /// went, without hindsight. 0 before the first step.
    pub fn rms_online(&self) -> f64 {
        (self.squared_errors / f64::from(self.step.max(1))).sqrt()
    }

    /// Root mean square error of position of the best particle's path so far \[m\]: with hindsight, as that path is what is left of all
    /// that was tried.
    pub fn rms_best(&self) -> f64 {
        rms(&self.path(self.best()), &self.log.truth)
    }

    /// The same after the best rigid motion of that path onto the truth \[m\]: what is left when map and path may be moved as a
    /// whole.
    pub fn rms_best_aligned(&self) -> f64 {
        let path = self.path(self.best());
        let gauge = align(&path, &self.log.truth[..path.len()]);
        let aligned: Vec<Pose2> = path.iter().map(|pose| gauge.compose(pose)).collect();
        rms(&aligned, &self.log.truth)
    }

    /// Root mean square error of position of raw odometry so far \[m\].
    pub fn rms_odometry(&self) -> f64 {
        rms(&self.log.odometry[..=self.step as usize], &self.log.truth)
    }

    /// What [`Self::rms_online`] is at the end for an EKF-SLAM that is told the same of the same drive \[m\]. Its one Gaussian must commit
    /// to one association.
    pub fn rms_ekf(&self, setup: &LandmarkSetup, tuning: &Tuning<D>) -> f64 {
        let start = self.log.truth.first().copied().unwrap_or_default();
        let mut ekf = EkfSlam::new(tuning.motion.clone(), tuning.sensor, setup.correspondence.of(tuning), start);
        let mut path = Vec::with_capacity(self.log.controls.len());
        for (control, features) in self.log.controls.iter().zip(&self.log.sightings) {
            ekf.step(control, features);
            path.push(*ekf.pose());
        }
        rms(&path, self.log.truth.get(1..).unwrap_or_default())
    }

    /// What [`Self::rms_online`] is at the end for a filter that draws its poses late ([`FromWindow`]) on the same drive \[m\]: so many together,
    /// when so many steps after them are seen. Of the setup, `proposal` is not asked.
    ///
    /// # Errors
    /// Where a setting is out of its range.
    pub fn rms_late(
        &self,
        setup: &LandmarkSetup,
        tuning: &Tuning<D>,
        [drawn, ahead]: [u32; 2],
    ) -> Result<f64, SettingError>
    where
        D::Control: Clone + Send,
    {
        let map = <Windowed<_, _>>::new(<LandmarkMap>::new(tuning.sensor, setup.correspondence.of(tuning)));
        let proposal = FromWindow { motion: tuning.motion.clone(), drawn, ahead };
        let mut filter = setup.filter(map, proposal, &self.log)?;
        let mut squared_errors = 0.0;
        for ((control, features), truth) in
            self.log.controls.iter().zip(&self.log.sightings).zip(self.log.truth.iter().skip(1))
        {
            filter.step(control, features);
            let error = error_of_mean(&filter, truth);
            squared_errors += error * error;
        }
        Ok((squared_errors / self.log.controls.len().max(1) as f64).sqrt())
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The mean over the same steps: what is judged as it went is judged alike, whoever went.
    #[test]
    fn the_error_as_it_went_is_the_root_mean_square_of_the_reported_ones() {
        let (course, setup) = (Course::Tags, LandmarkSetup { particles: 5, ..LandmarkSetup::default() });
        let mut run = LandmarkRun::new(&setup, &course.tuning(), course.simulate(1).into()).unwrap();
        assert_eq!(run.rms_online(), 0.0);
        let mut squares = Vec::new();
        while let Some(report) = run.step() {
            squares.push(report.error_mean * report.error_mean);
        }
        let expected = (squares.iter().sum::<f64>() / squares.len() as f64).sqrt();
        assert_eq!((squares.len(), run.rms_online()), (run.log().controls.len(), expected));
    }

    /// One particle without any noise of the wheels, and a sensor too blunt to say anything: both go by the wheels alone.
    #[test]
    fn a_particle_and_the_joint_filter_are_judged_alike() {
        let course = Course::Eight;
        let tuning = course.tuning().scaled(0.0, 1e9);
        let setup = LandmarkSetup { particles: 1, ..LandmarkSetup::default() };
        let mut run = LandmarkRun::new(&setup, &tuning, course.simulate(2).into()).unwrap();
        while run.step().is_some() {}
        let [particle, joint] = [run.rms_online(), run.rms_ekf(&setup, &tuning)];
        // Of step 0, where nobody errs, both say nothing: the path's error has it in.
        let steps = run.log().controls.len() as f64;
        let wheels = run.rms_odometry() * ((steps + 1.0) / steps).sqrt();
        assert!(
            (particle - wheels).abs() < 1e-6 * wheels && (joint - wheels).abs() < 1e-6 * wheels,
            "{particle} {joint} {wheels}"
        );
    }
}
