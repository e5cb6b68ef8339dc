//! The velocity motion model with noise that grows with time and not with the number of steps.

use super::{Motion, Velocity, VelocityModel};
use crate::error::{Range, SettingError};
use crate::geometry::Pose2;
use crate::random::Stream;
use nalgebra::Matrix3;

/// Velocities with white noise in continuous time: over Δt their means err by
/// σ²_v = (speed_std² + α₁ v² + α₂ ω²) / Δt and σ²_ω = (turn_rate_std² + α₃ v² + α₄ ω²) / Δt, so that distance and heading err by a variance that
/// grows as Δt.
///
/// [`VelocityModel`] draws its noise once a step, whatever the step's duration. Cut the same drive into four times as many steps, and it
/// claims half the deviation at the end. Where a step is as long as it takes until something is seen, as in recorded logs,
/// that understates how far the heading slips exactly where much is seen. Here the doubt is the same however a drive is cut.
///
/// ```
/// use fastslam::geometry::Pose2;
/// use fastslam::motion::{Motion, Velocity, VelocityDiffusion};
///
/// let motion = VelocityDiffusion { speed_std: 0.01, turn_rate_std: 0.03, alphas: [0.0; 4] };
/// let heading = |duration| motion.covariance(&Pose2::default(), &Velocity { speed: 0.0, turn_rate: 0.0, duration }).m33;
/// assert!((heading(1.0) - 4.0 * heading(0.25)).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct VelocityDiffusion {
    /// Deviation of the distance driven after a second at rest \[m/√s\].
    pub speed_std: f64,
    /// Deviation of the heading after a second at rest \[rad/√s\].
    pub turn_rate_std: f64,
    /// α₁ \[s\], α₂ \[m² s/rad²\], α₃ \[rad² s/m²\], α₄ \[s\].
    pub alphas: [f64; 4],
}

impl VelocityDiffusion {
    /// The noise of one step of this duration \[s\]; none in no time.
    fn over(&self, duration: f64) -> VelocityModel {
        let Self { speed_std, turn_rate_std, alphas } = *self;
        let scale = if duration > 0.0 { 1.0 / duration.sqrt() } else { 0.0 };
        VelocityModel { speed_std, turn_rate_std, alphas }.scaled(scale)
    }
}

impl Motion for VelocityDiffusion {
    type Control = Velocity;

    fn apply(&self, from: &Pose2, u: &Velocity) -> Pose2 {
        u.apply(from)
    }

    /// Takes four `u64`s.
    fn sample(&self, from: &Pose2, u: &Velocity, stream: &mut Stream) -> Pose2 {
        self.over(u.duration).sample(from, u, stream)
    }

    fn covariance(&self, from: &Pose2, u: &Velocity) -> Matrix3<f64> {
        self.over(u.duration).covariance(from, u)
    }

    fn validate(&self) -> Result<(), SettingError> {
        Range::at_least(0.0, "m/√s").check("motion.speed_std", self.speed_std)?;
        Range::at_least(0.0, "rad/√s").check("motion.turn_rate_std", self.turn_rate_std)?;
        self.alphas.iter().try_for_each(|alpha| Range::at_least(0.0, "").check("motion.alphas", *alpha).map(drop))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MODEL: VelocityDiffusion =
        VelocityDiffusion { speed_std: 0.05, turn_rate_std: 0.02, alphas: [0.002, 0.001, 0.003, 0.004] };

    fn cases() -> [(Pose2, Velocity); 5] {
        [(1.3, 0.0), (1.3, -0.7), (-0.9, 2.0), (0.0, 1.0), (0.0, 0.0)].map(|(speed, turn_rate)| {
            (Pose2::new(1.0, 2.0, 0.4 + 3.0 * turn_rate), Velocity { speed, turn_rate, duration: 0.8 })
        })
    }

    crate::motion_laws!(laws, MODEL, cases());

    /// Covariance after a drive in so many equal steps: P ← G P Gᵀ + R.
    fn after<D: Motion<Control = Velocity>>(motion: &D, drive: &Velocity, steps: u32) -> Matrix3<f64> {
        let u = Velocity { duration: drive.duration / f64::from(steps), ..*drive };
        let (mut pose, mut p) = (Pose2::new(1.0, 2.0, 0.4), Matrix3::zeros());
        for _ in 0..steps {
            let g = motion.jacobian(&pose, &u);
            p = g * p * g.transpose() + motion.covariance(&pose, &u);
            pose = motion.apply(&pose, &u);
        }
        p
    }

    /// The law of the model: heading to rounding; place to 0.5 %, by which forty chords differ from four. A step of [`VelocityModel`] is
    /// fourfold off.
    #[test]
    fn the_doubt_is_the_same_however_a_drive_is_cut() {
        let drive = Velocity { speed: 0.3, turn_rate: 0.2, duration: 2.0 };
        let [few, many] = [4, 40].map(|steps| after(&MODEL, &drive, steps));
        assert!((few.m33 - many.m33).abs() < 1e-12 * few.m33);
        assert!((few - many).norm() < 5e-3 * few.norm(), "{few} {many}");
        let VelocityDiffusion { speed_std, turn_rate_std, alphas } = MODEL;
        let each = VelocityModel { speed_std, turn_rate_std, alphas };
        let [few, many] = [4, 40].map(|steps| after(&each, &drive, steps));
        assert!((few.m33 / many.m33 - 10.0).abs() < 1e-9);
    }

    #[test]
    fn in_no_time_nothing_is_lost() {
        let none = Velocity { speed: 1.0, turn_rate: 1.0, duration: 0.0 };
        assert_eq!(MODEL.covariance(&Pose2::default(), &none), Matrix3::zeros());
    }
}
