//! Laws that every motion, sensor, map and proposal must obey, to test one’s own with. Feature `laws`, which belongs among the
//! `[dev-dependencies]`.
//!
//! A law is a function that panics where it is broken and says by how much. For each trait a macro makes a `#[test]` of every law:
//!
//! | to test | laws | macro |
//! |---|---|---|
//! | a [`Motion`](crate::motion::Motion) | [`motion`] | [`motion_laws!`](crate::motion_laws) |
//! | a [`LandmarkSensor`](crate::sensor::LandmarkSensor) | [`sensor`] | [`sensor_laws!`](crate::sensor_laws) |
//! | a [`ConditionalMap`](crate::map::ConditionalMap) and its [`Likelihood`](crate::matching::Likelihood) | [`map`] | [`map_laws!`](crate::map_laws) |
//! | a [`Proposal`](crate::proposal::Proposal) | [`proposal`], and [`linear`] for proposals with landmarks | [`proposal_laws!`](crate::proposal_laws), [`kalman_laws!`](crate::kalman_laws) |
//!
//! ```
//! use fastslam::geometry::Pose2;
//! use fastslam::motion::{Velocity, VelocityModel};
//!
//! const MODEL: VelocityModel = VelocityModel { speed_std: 0.05, turn_rate_std: 0.02, alphas: [0.0; 4] };
//!
//! // Where the robot starts, and what it is told to do: as many cases as there are kinds of them.
//! fn cases() -> [(Pose2, Velocity); 2] {
//!     let arc = Velocity { speed: 1.0, turn_rate: 0.5, duration: 0.8 };
//!     [(Pose2::default(), arc), (Pose2::new(3.0, -1.0, 2.5), Velocity { turn_rate: 0.0, ..arc })]
//! }
//!
//! fastslam::motion_laws!(velocity, MODEL, cases());
//! ```
//!
//! Laws about chance draw from [streams](crate::random::Stream) at fixed addresses: what passes once passes always. Their bounds are
//! 4.5 standard errors, which a normal number exceeds with a probability α of 7 · 10⁻⁶.

pub mod linear;
pub mod map;
pub mod motion;
pub mod proposal;
pub mod sensor;

use crate::geometry::Pose2;
use crate::ops;
use core::f64::consts::{FRAC_PI_2, PI};
use nalgebra::{Matrix2, Matrix3};

/// Rigid motions of the world, for laws that nothing may depend on where its origin lies and where its x axis points.
pub const TURNS: [Pose2; 4] = [
    Pose2 { x: 2.0, y: -1.0, theta: 0.0 },
    Pose2 { x: 0.0, y: 0.0, theta: 0.7 },
    Pose2 { x: -3.0, y: 1.5, theta: -2.5 },
    Pose2 { x: 1.0, y: 4.0, theta: PI },
];

/// Quarter turns about the origin: what a raster of squares does not notice.
pub const QUARTER_TURNS: [Pose2; 3] = [
    Pose2 { x: 0.0, y: 0.0, theta: FRAC_PI_2 },
    Pose2 { x: 0.0, y: 0.0, theta: PI },
    Pose2 { x: 0.0, y: 0.0, theta: -FRAC_PI_2 },
];

/// Standard errors that a mean of draws may be off: α = 7 · 10⁻⁶, two-sided.
const STANDARD_ERRORS: f64 = 4.5;

/// Rounding of a few operations on numbers of this size, and of a thousand of their last bits.
fn rounding(size: f64) -> f64 {
    1e-12 * (1.0 + size)
}

/// How large the numbers of a pose are.
fn size(pose: &Pose2) -> f64 {
    pose.x.abs() + pose.y.abs() + pose.theta.abs()
}

/// Turns directions of the plane with the world.
fn turn2(world: &Pose2) -> Matrix2<f64> {
    let (sin, cos) = ops::sin_cos(world.theta);
    Matrix2::new(cos, -sin, sin, cos)
}

/// Turns differences of poses with the world.
fn turn3(world: &Pose2) -> Matrix3<f64> {
    let (sin, cos) = ops::sin_cos(world.theta);
    Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0)
}

/// A weighted mean with its standard error.
#[derive(Clone, Copy, Debug)]
struct Estimate {
    mean: f64,
    error: f64,
}

impl Estimate {
    /// Σ w v / Σ w of independent draws (v, w), and √(Σ w² (v − mean)²) / Σ w.
    fn of(draws: impl Iterator<Item = (f64, f64)> + Clone) -> Self {
        let sum: f64 = draws.clone().map(|(_, w)| w).sum();
        let mean = draws.clone().map(|(v, w)| v * w).sum::<f64>() / sum;
        let variance: f64 = draws.map(|(v, w)| (v - mean) * (v - mean) * w * w).sum();
        Self { mean, error: variance.sqrt() / sum }
    }

    /// Whether two independent estimates may be of one number.
    fn agrees_with(&self, other: &Self) -> bool {
        // What has no scatter is as exact as its sum.
        let slack = rounding(self.mean.abs()) + STANDARD_ERRORS * ops::hypot(self.error, other.error);
        (self.mean - other.mean).abs() <= slack
    }

    /// A number that is known.
    fn exact(mean: f64) -> Self {
        Self { mean, error: 0.0 }
    }
}

/// A module with a test for each of these laws, all with the same arguments.
#[doc(hidden)]
#[macro_export]
macro_rules! tests_of_laws {
    ($name:ident, $module:ident, [$($law:ident),+ $(,)?], $arguments:tt) => {
        mod $name {
            #[allow(unused_imports)]
            use super::*;

            $(
                #[test]
                fn $law() {
                    $crate::laws::$module::$law $arguments
                }
            )+
        }
    };
}
