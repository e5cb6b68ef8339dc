//! Motion models: where a robot may be, given where it was and what its wheels reported.

mod car;
mod diffusion;
mod displacement;
mod drift;
mod floored;
mod odometry;
mod velocity;

pub use car::Car;
pub use diffusion::VelocityDiffusion;
pub use displacement::{Displaced, Displacement};
pub use drift::Drift;
pub use floored::Floored;
pub use odometry::{Odometry, OdometryModel};
pub use velocity::{Velocity, VelocityModel};

use crate::error::SettingError;
use crate::geometry::{Gaussian3, Pose2};
use crate::ops;
use crate::random::Stream;
use nalgebra::{Matrix3, Vector3};

/// p(x_t | x_{t−1}, u_t): to draw from, and as a Gaussian.
pub trait Motion: Sync {
    /// What the robot was told, or reported, to do in a step.
    type Control: Sync;

    /// g(x, u): the motion without its noise.
    fn apply(&self, from: &Pose2, control: &Self::Control) -> Pose2;

    /// One draw of p(x_t | x_{t−1}, u_t).
    fn sample(&self, from: &Pose2, control: &Self::Control, stream: &mut Stream) -> Pose2;

    /// R_t (3 × 3, \[m, m, rad\]): the noise of the control carried into pose space. May be singular.
    fn covariance(&self, from: &Pose2, control: &Self::Control) -> Matrix3<f64>;

    /// p(x_t | x_{t−1}, u_t) as a Gaussian in pose space: mean g(x, u), covariance R_t + diag(floor²), where `floor_stds` are standard
    /// deviations \[m, m, rad\] that keep it invertible when the robot stands still. `None` where it is not positive definite all the same.
    ///
    /// In pose space, and not over the controls: the density of a turn, a drive and a turn (PR table 5.5) has a pole where a pose lies
    /// near a turn on the spot. The direction of a short drive is arbitrary, and a probe a centimetre aside is fined hundreds of nats.
    fn gaussian(&self, from: &Pose2, control: &Self::Control, floor_stds: [f64; 3]) -> Option<Gaussian3> {
        let floor = Matrix3::from_diagonal(&Vector3::from(floor_stds.map(|std| std * std)));
        Gaussian3::new(self.apply(from, control), self.covariance(from, control) + floor)
    }

    /// How far a control goes: metres driven and radians turned, added up.
    fn travel(&self, control: &Self::Control) -> f64 {
        let to = self.apply(&Pose2::default(), control);
        ops::hypot(to.x, to.y) + to.theta.abs()
    }

    /// ∂g/∂x (3 × 3). As given here for motions that are the same from wherever they start, seen from there.
    fn jacobian(&self, from: &Pose2, control: &Self::Control) -> Matrix3<f64> {
        let to = self.apply(from, control);
        Matrix3::new(1.0, 0.0, from.y - to.y, 0.0, 1.0, to.x - from.x, 0.0, 0.0, 1.0)
    }

    /// Whether a control can be driven: from the origin it leads to a finite place at most 10⁹ m away, with finite noise.
    ///
    /// A step with any other control is taken for standing still, and the report says so
    /// ([`Report::refused_control`](crate::rbpf::Report::refused_control)).
    fn can_drive(&self, control: &Self::Control) -> bool {
        const FARTHEST: f64 = 1e9;
        let (from, least) = (Pose2::default(), -FARTHEST..=FARTHEST);
        let to = self.apply(&from, control);
        let covariance = self.covariance(&from, control);
        least.contains(&to.x)
            && least.contains(&to.y)
            && to.theta.is_finite()
            && covariance.iter().all(|x| x.is_finite())
    }

    /// One step of this motion: the control, or standing still where it cannot be driven. What proposals move particles by.
    fn drive<'a>(&'a self, control: &'a Self::Control) -> Drive<'a, Self>
    where
        Self: Sized,
    {
        Drive { motion: self, control: Some(control).filter(|control| self.can_drive(control)) }
    }

    /// Whether all settings are in range: asked once, when a filter is built.
    ///
    /// # Errors
    /// Where one is not. As given here there are none.
    fn validate(&self) -> Result<(), SettingError> {
        Ok(())
    }
}

/// A step of a motion model D, from wherever it begins: a control, or standing still without any noise where the control cannot be driven
/// ([`Motion::can_drive`]).
#[derive(Debug)]
pub struct Drive<'a, D: Motion> {
    motion: &'a D,
    control: Option<&'a D::Control>,
}

impl<D: Motion> Drive<'_, D> {
    /// [`Motion::apply`].
    pub fn apply(&self, from: &Pose2) -> Pose2 {
        self.control.map_or(*from, |control| self.motion.apply(from, control))
    }

    /// [`Motion::sample`].
    pub fn sample(&self, from: &Pose2, stream: &mut Stream) -> Pose2 {
        self.control.map_or(*from, |control| self.motion.sample(from, control, stream))
    }

    /// [`Motion::covariance`] (3 × 3, \[m, m, rad\]).
    pub fn covariance(&self, from: &Pose2) -> Matrix3<f64> {
        self.control.map_or_else(Matrix3::zeros, |control| self.motion.covariance(from, control))
    }

    /// [`Motion::gaussian`] with this floor \[m, m, rad\].
    pub fn gaussian(&self, from: &Pose2, floor_stds: [f64; 3]) -> Option<Gaussian3> {
        let floor = || Matrix3::from_diagonal(&Vector3::from(floor_stds.map(|std| std * std)));
        match self.control {
            Some(control) => self.motion.gaussian(from, control, floor_stds),
            None => Gaussian3::new(*from, floor()),
        }
    }

    /// [`Motion::travel`].
    pub fn travel(&self) -> f64 {
        self.control.map_or(0.0, |control| self.motion.travel(control))
    }

    /// [`Motion::jacobian`] (3 × 3).
    pub fn jacobian(&self, from: &Pose2) -> Matrix3<f64> {
        self.control.map_or_else(Matrix3::identity, |control| self.motion.jacobian(from, control))
    }
}

/// A motion whose draws are of the density of its Gaussian: [`Motion::sample`] draws from [`Motion::gaussian`] without a floor. Any motion is one
/// inside of [`Floored`].
pub trait GaussianMotion: Motion {}

/// sin(x)/x and its derivative.
fn sinc(x: f64) -> (f64, f64) {
    if x.abs() < 1e-4 {
        return (1.0 - x * x / 6.0, -x / 3.0); // what is left out is below the last bit, and the quotients lose theirs
    }
    let (sin, cos) = ops::sin_cos(x);
    (sin / x, (x * cos - sin) / (x * x))
}
