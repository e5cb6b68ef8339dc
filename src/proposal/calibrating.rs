//! The drift of odometry, learnt by each particle along its own path.
//!
//! What a drift is worth to a filter shows at the first loop. Wheels that turn a robot by 0.06° a step more than they report, where a tenth of a degree of
//! noise is told, are off by seven standard deviations after two hundred steps: no particle is where the robot is, however many there are. An
//! EKF follows all the same, as its gain never asks how unlikely an innovation was. A particle must be able to draw what is true.
//!
//! Given its path a particle knows every error of its odometry, so that the drift has a posterior in closed form, as the landmarks have: it is
//! marginalised, not sampled. Each step is drawn with the mean and variance that the steps before it leave, and a particle that drifts as the robot does is
//! right again and again, and is selected.
//!
//! References: Storvik, *Particle filters for state-space models with the presence of unknown static parameters* (IEEE T-SP 2002), a static
//! parameter by its sufficient statistics; Eliazar, Parr, *Learning probabilistic motion models for mobile robots* (ICML 2004).

use super::{Proposal, Proposed};
use crate::error::SettingError;
use crate::geometry::Pose2;
use crate::map::ConditionalMap;
use crate::motion::{Displacement, Drift, Motion};
use crate::ops;
use crate::particle::Particle;
use crate::random::Stream;

/// Standard deviations of the drift of wheels of which nothing is known: 0.05 rad (3°) a metre ahead, as one log has, and 0.05 of each turn.
///
/// For a robot whose noise is told to be a tenth of that, this is too wide a prior for the drift a metre: few of the particles go the way
/// that it goes. The noise after a metre \[rad/√m\], taken as a drift \[rad/m\], is a prior that costs little where there is no drift.
pub const DRIFT_STDS: [f64; 2] = [0.05, 0.05];

/// Draws by another proposal, from odometry that is corrected by the drift that the particle has learnt.
///
/// The heading after a step errs by e = b₁ x + b₂ θ + ε, where odometry reports x metres ahead (negative astern) and a turn of θ, and ε has the
/// variance of the motion's own noise. b has the prior of [`Calibrated::new`] at the start, and then what the particle's path says ([`Drift`]). Where
/// the motion has no noise of the heading, odometry is taken at its word, and nothing is learnt.
///
/// The map is a [`Calibrated`] one; `then` draws for its inner map, by a [`Displacement`]. Its log weight increment is passed on as it is.
///
/// ```
/// use fastslam::map::landmarks::{Correspondence, Landmarks};
/// use fastslam::motion::{Displaced, Drift, Odometry, OdometryModel};
/// use fastslam::proposal::{Calibrated, Calibrating, DRIFT_STDS, FromMeasurement};
/// use fastslam::rbpf::Rbpf;
/// use fastslam::sensor::{Feature, RangeBearing};
/// # use fastslam::nalgebra::Vector2;
///
/// // Wheels say "straight on", and the robot goes round in a circle of 20 m: 0.05 rad a metre. Four posts stand around.
/// let sensor = RangeBearing { range_std: 0.1, bearing_std: 0.02, max_range: 99.0, field_of_view: 6.3 };
/// let motion = OdometryModel { alphas: [1e-3, 1e-4, 1e-3, 0.0] };
/// let map = Calibrated::new(<Landmarks<_>>::new(sensor, Correspondence::Known), Drift::new(DRIFT_STDS));
/// let then = FromMeasurement { motion: Displaced };
/// let mut filter = Rbpf::builder(map, Calibrating { motion, then }).particles(100).seed(1).build()?;
/// for step in 1..=200 {
///     let heading = 0.025 * f64::from(step);
///     let (x, y) = (20.0 * heading.sin(), 20.0 * (1.0 - heading.cos()));
///     let seen = [(9.0, 0.0), (30.0, 20.0), (-2.0, 30.0), (-20.0, 5.0)].map(|(to_x, to_y): (f64, f64)| {
///         let (dx, dy) = (to_x - x, to_y - y);
///         Vector2::new(dx.hypot(dy), fastslam::ops::wrap_angle(dy.atan2(dx) - heading))
///     });
///     let features: Vec<Feature> = (0..).zip(seen).map(|(signature, z)| Feature { z, signature: Some(signature) }).collect();
///     filter.step(&Odometry { rot1: 0.0, trans: 0.5, rot2: 0.0 }, &features);
/// }
/// let [a_metre, _] = filter.particles()[filter.best()].map.drift().coefficients();
/// assert!((a_metre - 0.05).abs() < 0.005, "{a_metre}");
/// # Ok::<(), fastslam::error::SettingError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Calibrating<D, P> {
    /// Noise of the odometry, its drift apart.
    pub motion: D,
    /// What draws the pose.
    pub then: P,
}

/// A map with the drift of the odometry along the path that it is of: what [`Calibrating`] needs.
#[derive(Clone, PartialEq, Debug)]
pub struct Calibrated<M> {
    map: M,
    drift: Drift<2>,
}

impl<M> Calibrated<M> {
    /// This map, with what is known of the drift: a prior before the first step, such as `Drift::new(`[`DRIFT_STDS`]`)`.
    pub fn new(map: M, drift: Drift<2>) -> Self {
        Self { map, drift }
    }

    /// The map.
    pub fn map(&self) -> &M {
        &self.map
    }

    /// What is known of the drift: how much the robot turns to the left beyond its odometry, per metre ahead \[rad/m\] and per radian turned \[–\].
    pub fn drift(&self) -> &Drift<2> {
        &self.drift
    }
}

/// What an observation was taken for, and what the step has taught of the drift.
#[derive(Clone, PartialEq, Debug)]
pub struct Learnt<A> {
    /// Association of the inner map.
    pub association: A,
    drift: Drift<2>,
}

impl<M: ConditionalMap> ConditionalMap for Calibrated<M> {
    type Observation = M::Observation;
    type Association = Learnt<M::Association>;

    fn assimilate(&mut self, world_from_robot: &Pose2, observation: &M::Observation, learnt: &Learnt<M::Association>) {
        self.map.assimilate(world_from_robot, observation, &learnt.association);
        self.drift = learnt.drift;
    }

    fn ignored(&self, observation: &M::Observation) -> u32 {
        self.map.ignored(observation)
    }

    fn validate(&self) -> Result<(), SettingError> {
        self.map.validate()
    }
}

impl<D: Motion, P> Calibrating<D, P> {
    /// Where the control leads by odometry alone, seen from where the robot was.
    fn reported(&self, control: &D::Control) -> Displacement {
        let (from, drive) = (Pose2::default(), self.motion.drive(control));
        Displacement { mean: drive.apply(&from), covariance: drive.covariance(&from) }
    }

    /// Where the control leads by odometry and what is known of its drift, seen from where the robot was: what `then` draws by.
    pub fn corrected(&self, drift: &Drift<2>, control: &D::Control) -> Displacement {
        without_drift(&self.reported(control), drift)
    }
}

/// A reported motion, corrected by what is known of the drift.
fn without_drift(reported: &Displacement, drift: &Drift<2>) -> Displacement {
    let causes = causes(reported);
    if learns(reported) { reported.turned(drift.mean(causes), drift.variance(causes)) } else { *reported }
}

/// What a drift of the heading grows with: metres ahead, and radians turned.
fn causes(reported: &Displacement) -> [f64; 2] {
    [reported.mean.x, reported.mean.theta]
}

/// Whether odometry is told to err in its heading at all.
fn learns(reported: &Displacement) -> bool {
    reported.covariance.m33 > 0.0
}

impl<M, D, P> Proposal<Calibrated<M>> for Calibrating<D, P>
where
    M: ConditionalMap,
    D: Motion,
    P: Proposal<M, Control = Displacement>,
{
    type Control = D::Control;

    fn propose(
        &self,
        particle: &Particle<Calibrated<M>>,
        control: &D::Control,
        observation: &M::Observation,
        stream: &mut Stream,
    ) -> Proposed<Learnt<M::Association>> {
        let Particle { world_from_robot, map: Calibrated { map, drift }, path } = particle;
        let reported = self.reported(control);
        let (corrected, mut drift) = (without_drift(&reported, drift), *drift);
        let inner = Particle { world_from_robot: *world_from_robot, map: map.clone(), path: path.clone() };
        let Proposed { world_from_robot: to, association, log_increment, trace } =
            self.then.propose(&inner, &corrected, observation, stream);
        if learns(&reported) {
            let error = ops::wrap_angle(world_from_robot.between(&to).theta - reported.mean.theta);
            drift.learn(causes(&reported), error, reported.covariance.m33);
        }
        Proposed { world_from_robot: to, association: Learnt { association, drift }, log_increment, trace }
    }

    fn can_drive(&self, control: &D::Control) -> bool {
        self.motion.can_drive(control)
    }

    fn validate(&self) -> Result<(), SettingError> {
        self.motion.validate()?;
        self.then.validate()
    }
}
