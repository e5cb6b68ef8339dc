//! The measurement-aware proposal for landmarks, which draws late: FastSLAM 2.0 with a fixed lag.
//!
//! Where a robot turns by half a degree a step and a sighting tells its heading to three, one step's sightings say little of that step: a pose is
//! known when it has been seen from for a while. FastSLAM draws it at once, and lets the weights find out later. So it resamples every few
//! steps, a loop later all particles descend from one, and what is left of the posterior is a draw of it, whose error is √2 times that of
//! its mean. A pose that is drawn late needs no lottery.
//!
//! References: Beevers, Huang, *Fixed-lag sampling strategies for particle filtering SLAM* (ICRA 2007), the block proposal; Doucet, Briers,
//! Sénécal, *Efficient block sampling strategies for sequential Monte Carlo methods* (JCGS 2006).

use super::window::Window;
use super::{Proposal, ProposalTrace, Proposed};
use crate::error::{Range, SettingError};
use crate::genealogy::Path;
use crate::geometry::Pose2;
use crate::map::ConditionalMap;
use crate::map::landmarks::{Association, Blocks, Landmarks, Store};
use crate::motion::Motion;
use crate::particle::Particle;
use crate::random::Stream;
use crate::sensor::{Feature, LandmarkSensor};
use std::sync::Arc;

/// Most steps of a window: its work grows with their square.
const STEPS: Range = Range::whole(0, 1000);

/// x_{s+1} … x_{s+drawn} ~ p(· | x₁..s, z₁..t), where t = s + drawn + ahead: drawn together, by the sightings of them and of the steps `ahead`.
///
/// Until then a particle has the joint Gaussian of the poses that it has not drawn and of the landmarks in sight, linearised as an EKF is, and
/// its weight is multiplied by p(z_t | x₁..s, z₁..t₋₁), which no draw enters. A draw from the posterior itself changes no weight. With one step
/// drawn and none ahead this is [`FromMeasurement`](super::FromMeasurement); were nothing ever drawn, each particle would be an EKF-SLAM.
///
/// The map is a [`Windowed`] one. A particle's pose, `world_from_robot`, is the *mean* of x_t given what the particle has drawn, and so are
/// the poses of its path: their weighted mean is the estimate, and their scatter is less than its uncertainty. The poses that were drawn, on
/// which the map depends, are [`Windowed::path`].
///
/// A step costs O(n²) for each sighting, with n = 3 (drawn + ahead) + 2 × landmarks in sight.
///
/// ```
/// use fastslam::map::landmarks::{Correspondence, Landmarks};
/// use fastslam::motion::{Odometry, OdometryModel};
/// use fastslam::proposal::{FromWindow, Windowed};
/// use fastslam::rbpf::Rbpf;
/// use fastslam::sensor::{Feature, RangeBearing};
/// # use fastslam::nalgebra::Vector2;
///
/// // Half a metre ahead a step, past a landmark that is seen 2 m ahead and 1 m to the left of the start.
/// let sensor = RangeBearing { range_std: 0.1, bearing_std: 0.02, max_range: 8.0, field_of_view: 6.3 };
/// let proposal = FromWindow { motion: OdometryModel { alphas: [0.01, 0.001, 0.01, 0.001] }, drawn: 2, ahead: 2 };
/// let map = <Windowed<_, _>>::new(Landmarks::new(sensor, Correspondence::Known));
/// let mut filter = Rbpf::builder(map, proposal).particles(20).seed(1).build()?;
/// for step in 1..=5 {
///     let ahead: f64 = 2.0 - 0.5 * f64::from(step);
///     let seen = Feature { z: Vector2::new(ahead.hypot(1.0), 1.0_f64.atan2(ahead)), signature: Some(0) };
///     filter.step(&Odometry { rot1: 0.0, trans: 0.5, rot2: 0.0 }, &[seen]);
/// }
/// assert!((filter.estimate().mean.x - 2.5).abs() < 0.2);
/// let map = &filter.particles()[filter.best()].map;
/// assert_eq!((map.path().len(), map.undrawn()), (6, 3), "x₀ to x₅, of which three are means");
/// assert!((map.landmarks().get(0).unwrap().mean - Vector2::new(2.0, 1.0)).norm() < 0.2);
/// # Ok::<(), fastslam::error::SettingError>(())
/// ```
#[derive(Clone, Debug)]
pub struct FromWindow<D> {
    /// Noise of the odometry.
    pub motion: D,
    /// How many poses are drawn together, 1 to 1000.
    pub drawn: u32,
    /// How many steps must have been seen beyond them, 0 to 1000.
    pub ahead: u32,
}

/// A map of landmarks given the poses that were drawn, with the last poses that were not: what [`FromWindow`] needs. U is the motion's control.
///
/// `landmarks` knows what was seen from the drawn poses, and nothing of the window.
#[derive(Clone, Debug)]
pub struct Windowed<Z, U, S = Blocks> {
    landmarks: Landmarks<Z, S>,
    /// None before the first step.
    window: Option<Arc<Window<U>>>,
}

impl<Z: LandmarkSensor, U: Clone, S: Store> Windowed<Z, U, S> {
    /// This map, before the first step.
    pub fn new(landmarks: Landmarks<Z, S>) -> Self {
        Self { landmarks, window: None }
    }

    /// The landmarks by what was seen from the poses that were drawn.
    pub fn landmarks(&self) -> &Landmarks<Z, S> {
        &self.landmarks
    }

    /// How many of the last poses are not drawn.
    pub fn undrawn(&self) -> usize {
        self.window.as_ref().map_or(0, |window| window.steps.len())
    }

    /// The poses from step 0 on: those that were drawn, then the means of the others by all that was seen. Empty before the first step.
    pub fn path(&self) -> Vec<Pose2> {
        let poses = |window: &Arc<Window<U>>| window.drawn.poses().into_iter().chain(window.poses()).collect();
        self.window.as_ref().map(poses).unwrap_or_default()
    }
}

/// What a step's features were taken for, and the map afterwards.
#[derive(Clone, Debug)]
pub struct Followed<Z, U, S = Blocks> {
    /// One for each feature.
    pub associations: Vec<Association>,
    after: Windowed<Z, U, S>,
}

impl<Z: LandmarkSensor, U: Clone + Send + Sync, S: Store> ConditionalMap for Windowed<Z, U, S> {
    type Observation = [Feature];
    type Association = Followed<Z, U, S>;

    /// Becomes the map that the proposal has found: its poses and landmarks are of one Gaussian.
    fn assimilate(&mut self, _: &Pose2, _: &[Feature], followed: &Followed<Z, U, S>) {
        self.clone_from(&followed.after);
    }

    fn ignored(&self, features: &[Feature]) -> u32 {
        self.landmarks.ignored(features)
    }

    fn validate(&self) -> Result<(), SettingError> {
        self.landmarks.validate()
    }
}

impl<Z, U, S, D> Proposal<Windowed<Z, U, S>> for FromWindow<D>
where
    Z: LandmarkSensor,
    U: Clone + Send + Sync,
    S: Store,
    D: Motion<Control = U>,
{
    type Control = U;

    /// The pose is the mean before anything is drawn in this step.
    fn propose(
        &self,
        particle: &Particle<Windowed<Z, U, S>>,
        control: &U,
        features: &[Feature],
        stream: &mut Stream,
    ) -> Proposed<Followed<Z, U, S>> {
        let Windowed { mut landmarks, window } = particle.map.clone();
        let mut window =
            window.map_or_else(|| Window::after(Path::start(particle.world_from_robot)), Arc::unwrap_or_clone);
        let (log_increment, informed) = window.advance(&self.motion, &landmarks, control, features);
        let (pose, covariance) = (window.pose(), window.covariance());
        let associations = window.steps.last().map(|step| step.associations.clone()).unwrap_or_default();
        if window.steps.len() >= (self.drawn + self.ahead) as usize {
            window = self.settle(window, &mut landmarks, stream);
        }
        Proposed {
            world_from_robot: pose,
            association: Followed { associations, after: Windowed { landmarks, window: Some(Arc::new(window)) } },
            log_increment,
            trace: if informed {
                ProposalTrace::Matched { mode: pose, covariance, log_integral: log_increment }
            } else {
                ProposalTrace::Motion
            },
        }
    }

    fn can_drive(&self, control: &U) -> bool {
        self.motion.can_drive(control)
    }

    fn validate(&self) -> Result<(), SettingError> {
        Range::whole(1, 1000).check("drawn", f64::from(self.drawn))?;
        STEPS.check("ahead", f64::from(self.ahead))?;
        self.motion.validate()
    }
}

impl<D: Motion<Control: Clone>> FromWindow<D> {
    /// Draws the oldest poses, maps what was seen from them, and follows the steps after them anew: linearised where they are now.
    fn settle<Z: LandmarkSensor, S: Store>(
        &self,
        mut window: Window<D::Control>,
        landmarks: &mut Landmarks<Z, S>,
        stream: &mut Stream,
    ) -> Window<D::Control> {
        let count = self.drawn as usize;
        let poses = window.draw(count, stream);
        let left = window.steps.split_off(count);
        for (pose, step) in poses.iter().zip(&window.steps) {
            window.drawn.push(*pose);
            landmarks.assimilate(pose, &step.features, &step.associations);
        }
        let mut anew = Window::after(window.drawn);
        for step in &left {
            anew.advance(&self.motion, landmarks, &step.control, &step.features);
        }
        anew
    }
}
