//! The two proposals for one step from a known pose: where each puts its samples, and what they are worth.
//!
//! The robot starts at a known pose, its wheels report a drive, and then it sights one mapped landmark. FastSLAM 1.0 draws from the
//! motion and weighs by the sighting; FastSLAM 2.0 draws from the Gaussian that has the sighting in it. Both are the filters' own
//! proposals with the filters' own streams; what they ought to have drawn from is computed by [`crate::baseline::one_step`].
//!
//! The sighting is what a sensor without noise would report from the true pose, so that a reader who moves the landmark or the
//! noise sees what those do, and no other throw of the dice.

use crate::baseline::one_step::{OneStep, Posterior, predicted_ess};
use crate::digest::Digest;
use fastslam::error::{Range, SettingError};
use fastslam::geometry::Pose2;
use fastslam::map::landmarks::{Association, Correspondence, Gate, Innovation, Landmark, Landmarks};
use fastslam::motion::{Motion, Odometry, OdometryModel};
use fastslam::nalgebra::{Matrix2, Vector2};
use fastslam::particle::Particle;
use fastslam::proposal::{FromMeasurement, FromMotion, Marginal, Measured, Proposal, Proposed};
use fastslam::random::{Purpose, Stream};
use fastslam::sensor::{Feature, LandmarkSensor, RangeBearing};
use fastslam::weights::Weights;

/// Where the step begins.
pub const FROM: Pose2 = Pose2 { x: 0.0, y: 0.0, theta: 0.0 };

/// What the wheels report.
pub const CONTROL: Odometry = Odometry { rot1: 0.15, trans: 1.0, rot2: 0.35 };

/// What was truly driven where the landmark has a twin: so much farther that the twin fits the odometry better. Where it has none,
/// the wheels are right.
pub const DRIVEN: Odometry = Odometry { trans: 1.35, ..CONTROL };

/// Noise of the wheels at scale 1: α₁ \[–\], α₂ \[rad²/m²\], α₃ \[–\], α₄ \[m²/rad²\].
///
/// Fitted, with the sensor's noise and the landmark's, until the numbers were those that the literature reports of such a step: two
/// fifths of the motion's samples are any good, one sample of 2.0 does the work of five of 1.0, of six with a sensor twice as sharp,
/// and of less than two with a blunt one. So they are no finding, and the chapter says so; that the closed form gives them too is one
/// ([`Proposals::predicted_ratio`]).
pub const ALPHAS: [f64; 4] = [0.1, 0.015, 0.07, 0.02];

/// Σ of a landmark in the map (xx, xy, yy) \[m²\]: mapped from the side, better known in range than across.
pub const LANDMARK_COVARIANCE: [f64; 3] = [0.007, -0.016, 0.042];

/// From the landmark to its twin \[m\].
pub const TWIN: [f64; 2] = [-0.55, 0.0];

/// Cells in a row, and in a column, of the densities to be looked at.
pub const SIDE: usize = 64;

/// What a reader can set.
#[derive(Clone, PartialEq, Debug)]
pub struct ProposalsSetup {
    /// Number of samples of each proposal, 1 to 1 000 000.
    pub samples: u32,
    /// Seed of the proposals' draws.
    pub seed: u64,
    /// σ_r \[m\], 0.001 to 10.
    pub range_std: f64,
    /// σ_φ \[rad\], 0.001 to 10.
    pub bearing_std: f64,
    /// Factor on the standard deviations of the odometry's noise, 0.05 to 2.
    pub odometry_scale: f64,
    /// Where the map has the landmark \[m\], in (−100, 100)².
    pub landmark: [f64; 2],
    /// Whether it has a twin nearby, so that nobody knows which of the two was sighted.
    pub twins: bool,
}

impl Default for ProposalsSetup {
    fn default() -> Self {
        Self {
            samples: 1000,
            seed: 17, // one that shows what many samples tend to
            range_std: 0.05,
            bearing_std: 0.05,
            odometry_scale: 1.0,
            landmark: [2.7, -0.1],
            twins: false,
        }
    }
}

impl ProposalsSetup {
    fn validate(&self) -> Result<(), SettingError> {
        Range::whole(1, 1_000_000).check("samples", f64::from(self.samples))?;
        Range::number(1e-3, 10.0, "m").check("range_std", self.range_std)?;
        Range::number(1e-3, 10.0, "rad").check("bearing_std", self.bearing_std)?;
        Range::number(0.05, 2.0, "").check("odometry_scale", self.odometry_scale)?;
        self.landmark.iter().try_for_each(|x| Range::number(-100.0, 100.0, "m").check("landmark", *x).map(drop))
    }
}

/// What one proposal drew.
#[derive(Clone, PartialEq, Debug)]
pub struct Cloud {
    /// Poses, by slot.
    pub poses: Vec<Pose2>,
    /// Their normalised weights.
    pub weights: Weights,
    /// Which candidate each sample takes the sighting to be of.
    pub candidates: Vec<u32>,
    /// Whether each is in the region of highest posterior density that holds 90 %.
    pub inside: Vec<bool>,
}

impl Cloud {
    /// N_eff.
    pub fn ess(&self) -> f64 {
        self.weights.ess()
    }

    /// Share of the samples that are in the region, whatever they weigh; of those that take the sighting to be of one candidate
    /// where one is named.
    pub fn share_inside(&self, candidate: Option<u32>) -> f64 {
        let counted = |(inside, of): &(&bool, &u32)| **inside && candidate.is_none_or(|candidate| **of == candidate);
        self.inside.iter().zip(&self.candidates).filter(counted).count() as f64 / self.poses.len() as f64
    }
}

/// What is known before anything is drawn.
struct Drive {
    truth: Pose2,
    z: Vector2<f64>,
    sensor: RangeBearing,
    motion: OdometryModel,
    landmarks: Vec<Landmark>,
    particle: Particle<Landmarks<RangeBearing>>,
    features: Vec<Feature>,
}

impl Drive {
    fn new(setup: &ProposalsSetup) -> Result<Self, SettingError> {
        setup.validate()?;
        let ProposalsSetup { range_std, bearing_std, landmark: [x, y], .. } = *setup;
        let sensor = RangeBearing { range_std, bearing_std, max_range: 1000.0, field_of_view: core::f64::consts::TAU };
        let motion = OdometryModel { alphas: ALPHAS }.scaled(setup.odometry_scale);
        let [xx, xy, yy] = LANDMARK_COVARIANCE;
        let covariance = Matrix2::new(xx, xy, xy, yy);
        let landmark = |mean| Landmark { mean, covariance, existence_count: 1, apart: 0 };
        let mut landmarks = vec![landmark(Vector2::new(x, y))];
        if setup.twins {
            landmarks.push(landmark(Vector2::new(x + TWIN[0], y + TWIN[1])));
        }
        let truth = if setup.twins { DRIVEN } else { CONTROL }.apply(&FROM);
        let z = sensor.predict(&truth, &landmarks[0].mean).z;

        // Of one landmark the sensor knows the name. Of two it does not, only that it is one of them.
        let correspondence = if setup.twins {
            Correspondence::Unknown(Gate {
                mahalanobis_squared: f64::INFINITY,
                log_new: f64::NEG_INFINITY,
                ..Gate::default()
            })
        } else {
            Correspondence::Known
        };
        let map = Landmarks::<_>::new(sensor, correspondence).with(landmarks.iter().copied());
        let particle = Particle::start(FROM, map);
        let features = vec![Feature { z, signature: (!setup.twins).then_some(0) }];
        Ok(Self { truth, z, sensor, motion, landmarks, particle, features })
    }

    fn prior(&self) -> FromMotion<OdometryModel, Marginal> {
        FromMotion { motion: self.motion, likelihood: Marginal }
    }

    /// The sighting against the first landmark at the motion's mean.
    fn at_mean(&self) -> Innovation {
        self.landmarks[0].innovation(&self.sensor, &CONTROL.apply(&FROM), &self.z)
    }

    fn predicted_ess(&self) -> f64 {
        predicted_ess(&self.at_mean(), &self.motion.covariance(&FROM, &CONTROL))
    }

    /// What a proposal draws, one for each slot.
    fn drawn<'a>(
        &'a self,
        setup: &'a ProposalsSetup,
        proposal: &'a dyn Proposal<Landmarks<RangeBearing>, Control = Odometry>,
    ) -> impl Iterator<Item = Proposed<Vec<Association>>> + 'a {
        (0..setup.samples).map(move |slot| {
            let mut stream = Stream::at(setup.seed, Purpose::PROPOSAL, 1, slot);
            proposal.propose(&self.particle, &CONTROL, &self.features, &mut stream)
        })
    }
}

/// What FastSLAM 1.0 is left with after the one step.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Depletion {
    /// N_eff / M by the closed form ([`Proposals::predicted_ess`]).
    pub predicted: f64,
    /// N_eff / M of the samples, where some were to be drawn.
    pub measured: Option<f64>,
    /// How well the map knows the range at which the landmark is seen, as a standard deviation \[m\]: what a sharper sensor cannot get
    /// below.
    pub map_std: f64,
}

/// The depletion of a setup by the closed form and, if asked for, of its samples: those of [`Proposals::motion`], without the posterior.
///
/// # Errors
/// Where a setting is out of its range.
pub fn depletion(setup: &ProposalsSetup, measure: bool) -> Result<Depletion, SettingError> {
    let drive = Drive::new(setup)?;
    let measured = measure.then(|| {
        let log_increments: Vec<f64> = drive.drawn(setup, &drive.prior()).map(|one| one.log_increment).collect();
        Weights::uniform(log_increments.len()).reweighted(&log_increments).0.ess() / f64::from(setup.samples)
    });
    let of_map = drive.at_mean().given_pose[(0, 0)] - setup.range_std * setup.range_std;
    Ok(Depletion { predicted: drive.predicted_ess(), measured, map_std: of_map.max(0.0).sqrt() })
}

/// Both proposals, and the truth.
#[derive(Clone, Debug)]
pub struct Proposals {
    /// The pose of the robot that made the sighting.
    pub truth: Pose2,
    /// The sighting (r, φ) \[m, rad\].
    pub z: Vector2<f64>,
    /// What the sighting may be of; the first is what it is of.
    pub landmarks: Vec<Landmark>,
    /// The posterior.
    pub exact: Posterior,
    /// The Gaussian that FastSLAM 2.0 draws from.
    pub gaussian: Measured,
    /// FastSLAM 1.0.
    pub motion: Cloud,
    /// FastSLAM 2.0.
    pub aware: Cloud,
    /// N_eff / M of FastSLAM 1.0 by the closed form, which takes all for linear and the sighting for the expected one of the first
    /// landmark.
    pub predicted_ess: f64,
}

impl Proposals {
    /// Draws and weighs.
    ///
    /// # Errors
    /// Where a setting is out of its range.
    pub fn new(setup: &ProposalsSetup) -> Result<Self, SettingError> {
        let drive = Drive::new(setup)?;
        let Drive { truth, z, sensor, motion, landmarks, particle, features } = &drive;
        let candidates = landmarks.clone();
        let step = OneStep { from: FROM, control: CONTROL, motion: *motion, sensor: *sensor, candidates, z: *z };
        let exact = step.posterior(SIDE);
        let aware = FromMeasurement { motion: *motion };
        Ok(Self {
            truth: *truth,
            z: *z,
            gaussian: aware.fold(&particle.map, &FROM, &CONTROL, features),
            motion: Cloud::new(drive.drawn(setup, &drive.prior()), &exact),
            aware: Cloud::new(drive.drawn(setup, &aware), &exact),
            predicted_ess: drive.predicted_ess(),
            landmarks: drive.landmarks,
            exact,
        })
    }

    /// What [`Self::ratio`] tends to by the closed form: all samples of 2.0 weigh the same.
    pub fn predicted_ratio(&self) -> f64 {
        1.0 / self.predicted_ess
    }

    /// How many times the N_eff of the motion prior that of the measurement-aware proposal is.
    pub fn ratio(&self) -> f64 {
        self.aware.ess() / self.motion.ess()
    }

    /// A fingerprint of the posterior and of every sample, bit for bit.
    pub fn trace(&self) -> Digest {
        let mut digest = Digest::new();
        let Posterior { densities, mean, covariance, log_evidence, candidates, level, .. } = &self.exact;
        let Measured { mean: folded, covariance: narrowed, log_evidence: predicted, .. } = &self.gaussian;
        for pose in [mean, folded].into_iter().chain(&self.motion.poses).chain(&self.aware.poses) {
            [pose.x, pose.y, pose.theta].into_iter().for_each(|x| digest.f64(x));
        }
        let numbers = densities.iter().chain(covariance).chain(narrowed).chain(candidates);
        numbers.chain([log_evidence, predicted, level]).for_each(|x| digest.f64(*x));
        for cloud in [&self.motion, &self.aware] {
            cloud.weights.as_slice().iter().for_each(|x| digest.f64(*x));
            cloud.candidates.iter().for_each(|x| digest.u32(*x));
            cloud.inside.iter().for_each(|x| digest.u32(u32::from(*x)));
        }
        digest
    }
}

impl Cloud {
    fn new(proposed: impl Iterator<Item = Proposed<Vec<Association>>>, exact: &Posterior) -> Self {
        let (mut poses, mut log_increments, mut candidates) = (Vec::new(), Vec::new(), Vec::new());
        for Proposed { world_from_robot, association, log_increment, .. } in proposed {
            poses.push(world_from_robot);
            log_increments.push(log_increment);
            candidates.push(if let [Association::Matched(index)] = association[..] { index } else { 0 });
        }
        let (weights, _) = Weights::uniform(poses.len()).reweighted(&log_increments);
        let inside = poses.iter().map(|pose: &Pose2| exact.in_region([pose.x, pose.y])).collect();
        Self { poses, weights, candidates, inside }
    }
}

#[cfg(test)]
mod tests;
