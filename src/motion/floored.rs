//! A motion model with a density: its Gaussian in pose space, widened so that it has an inverse.

use super::{GaussianMotion, Motion};
use crate::error::{Range, SettingError};
use crate::geometry::{Pose2, sample_semidefinite};
use crate::random::Stream;
use nalgebra::{Matrix3, Vector3};

/// x_t ~ N(g(x, u), R_t + diag(floor²)), the heading wrapped: [`Motion::gaussian`] of another model, to draw from as well as to evaluate.
///
/// The models of odometry and of velocities draw their noise over the controls. What they draw has no density where a control has
/// fewer numbers than a pose, or stands still; and where it has one, that is not the Gaussian by which it is approximated. Whoever
/// weighs poses by p(x_t | x_{t−1}, u_t), as a smoother does, needs draws and density to be of one distribution.
///
/// The floor is part of the model. It says how far beside the wheels' own account a pose may lie, and so from how many particles a given
/// pose can be reached: a smoother with a floor far below the distance of its particles cannot reconnect them.
///
/// ```
/// use fastslam::geometry::Pose2;
/// use fastslam::motion::{Floored, Motion, Velocity, VelocityModel};
///
/// let motion = VelocityModel { speed_std: 0.0, turn_rate_std: 0.0, alphas: [0.04, 0.0, 0.01, 0.04] };
/// let floored = Floored { motion, floor_stds: [0.02, 0.02, 0.01] };
/// let ahead = Velocity { speed: 1.0, turn_rate: 0.0, duration: 1.0 };
/// assert!(motion.gaussian(&Pose2::default(), &ahead, [0.0; 3]).is_none(), "two numbers of noise for three of a pose");
/// assert!(floored.gaussian(&Pose2::default(), &ahead, [0.0; 3]).is_some());
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Floored<D> {
    /// Where g and R_t are from.
    pub motion: D,
    /// Standard deviations \[m, m, rad\] that are added, each more than 0.
    pub floor_stds: [f64; 3],
}

impl<D: Motion> Motion for Floored<D> {
    type Control = D::Control;

    fn apply(&self, from: &Pose2, control: &D::Control) -> Pose2 {
        self.motion.apply(from, control)
    }

    /// Takes six `u64`s.
    fn sample(&self, from: &Pose2, control: &D::Control, stream: &mut Stream) -> Pose2 {
        sample_semidefinite(&self.apply(from, control), &self.covariance(from, control), stream)
    }

    fn covariance(&self, from: &Pose2, control: &D::Control) -> Matrix3<f64> {
        let floor = Matrix3::from_diagonal(&Vector3::from(self.floor_stds.map(|std| std * std)));
        self.motion.covariance(from, control) + floor
    }

    fn travel(&self, control: &D::Control) -> f64 {
        self.motion.travel(control)
    }

    fn jacobian(&self, from: &Pose2, control: &D::Control) -> Matrix3<f64> {
        self.motion.jacobian(from, control)
    }

    fn validate(&self) -> Result<(), SettingError> {
        // Below a micrometre rounding decides whether there is an inverse.
        const LEAST: f64 = 1e-6;
        let [x, y, theta] = self.floor_stds;
        Range::at_least(LEAST, "m").check("motion.floor_stds.x", x)?;
        Range::at_least(LEAST, "m").check("motion.floor_stds.y", y)?;
        Range::at_least(LEAST, "rad").check("motion.floor_stds.theta", theta)?;
        self.motion.validate()
    }
}

impl<D: Motion> GaussianMotion for Floored<D> {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::{Odometry, OdometryModel};

    const MODEL: Floored<OdometryModel> =
        Floored { motion: OdometryModel { alphas: [0.01, 0.002, 0.008, 0.002] }, floor_stds: [0.02, 0.03, 0.01] };

    fn cases() -> [(Pose2, Odometry); 3] {
        let control = |rot1, trans, rot2| Odometry { rot1, trans, rot2 };
        [
            (Pose2::new(1.0, 2.0, 0.4), control(0.2, 1.0, 0.1)),
            (Pose2::new(-3.0, 1.0, 3.1), control(0.0, 0.0, 0.9)),
            (Pose2::new(1.0, 2.0, 0.5), control(0.0, 0.0, 0.0)),
        ]
    }

    /// n = 20 000 draws each: the mean of d² = (x − g)ᵀ Σ⁻¹ (x − g) is 3 with a standard error of √(6 / n), and that of exp(−d² / 2) is
    /// 2^(−3/2); α = 7 · 10⁻⁶ for each. A density that is not that of the draws misses one of them.
    #[test]
    fn draws_are_of_the_density() {
        const N: u32 = 20_000;
        for (from, control) in cases() {
            let density = MODEL.gaussian(&from, &control, [0.0; 3]).unwrap();
            let peak = density.log_density(density.mean());
            let squares: Vec<f64> = (0..N)
                .map(|slot| {
                    let mut stream = Stream::at(3, crate::random::Purpose::TRIAL, 0, slot);
                    2.0 * (peak - density.log_density(&MODEL.sample(&from, &control, &mut stream)))
                })
                .collect();
            let n = f64::from(N);
            let mean = squares.iter().sum::<f64>() / n;
            assert!((mean - 3.0).abs() < 4.5 * (6.0 / n).sqrt(), "{mean}");
            let near = squares.iter().map(|square| crate::ops::exp(-0.5 * square)).sum::<f64>() / n;
            // E = 2^(−3/2) and E² of its square = 3^(−3/2).
            let [expected, second] = [2.0_f64, 3.0].map(|k| 1.0 / (k * k.sqrt()));
            assert!((near - expected).abs() < 4.5 * ((second - expected * expected) / n).sqrt(), "{near}");
        }
    }

    #[test]
    fn a_floor_of_nothing_is_refused_by_name() {
        let refused = Floored { floor_stds: [0.1, 0.0, 0.1], ..MODEL }.validate().unwrap_err();
        assert_eq!(refused.field(), "motion.floor_stds.y");
        assert!(MODEL.validate().is_ok());
    }
}
