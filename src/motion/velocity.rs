//! The velocity motion model: for robots that report how fast they drive and turn.
//!
//! Reference: Thrun, Burgard, Fox, *Probabilistic Robotics* (2005), table 5.3, without its last turn.

use super::{Motion, sinc};
use crate::error::{Range, SettingError};
use crate::geometry::Pose2;
use crate::ops;
use crate::random::Stream;
use nalgebra::{Matrix2, Matrix3, Matrix3x2, Vector2};

/// u = (v, ω) for a while: an arc.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Velocity {
    /// v \[m/s\], negative backwards.
    pub speed: f64,
    /// ω \[rad/s\].
    pub turn_rate: f64,
    /// How long \[s\].
    pub duration: f64,
}

impl Velocity {
    /// pose ⊕ u: the chord of the arc, v Δt sinc(½ ω Δt) long, in the direction half-way between both headings.
    pub fn apply(&self, pose: &Pose2) -> Pose2 {
        let turn = self.turn_rate * self.duration;
        let chord = self.speed * self.duration * sinc(0.5 * turn).0;
        let (sin, cos) = ops::sin_cos(pose.theta + 0.5 * turn);
        Pose2::new(pose.x + chord * cos, pose.y + chord * sin, pose.theta + turn)
    }
}

/// Gaussian noise of both velocities, drawn once a step: σ²_v = speed_std² + α₁ v² + α₂ ω²,
/// σ²_ω = turn_rate_std² + α₃ v² + α₄ ω².
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct VelocityModel {
    /// Standard deviation of v at rest \[m/s\].
    pub speed_std: f64,
    /// Standard deviation of ω at rest \[rad/s\].
    pub turn_rate_std: f64,
    /// α₁ \[–\], α₂ \[m²/rad²\], α₃ \[rad²/m²\], α₄ \[–\].
    pub alphas: [f64; 4],
}

impl VelocityModel {
    /// The same model with every standard deviation multiplied by `scale`.
    pub fn scaled(&self, scale: f64) -> Self {
        Self {
            speed_std: self.speed_std * scale,
            turn_rate_std: self.turn_rate_std * scale,
            alphas: self.alphas.map(|alpha| alpha * scale * scale),
        }
    }

    /// Standard deviations of (v, ω) \[m/s, rad/s\] for a control.
    pub fn stds(&self, u: &Velocity) -> [f64; 2] {
        let ([a1, a2, a3, a4], v2, w2) = (self.alphas, u.speed * u.speed, u.turn_rate * u.turn_rate);
        let speed = self.speed_std * self.speed_std + a1 * v2 + a2 * w2;
        let turn_rate = self.turn_rate_std * self.turn_rate_std + a3 * v2 + a4 * w2;
        [speed.sqrt(), turn_rate.sqrt()]
    }

    /// ∂(x ⊕ u)/∂v and ∂(x ⊕ u)/∂ω.
    pub(super) fn derivatives(from: &Pose2, u: &Velocity) -> [[f64; 3]; 2] {
        let (t, half) = (u.duration, 0.5 * u.turn_rate * u.duration);
        let ((s, ds), (sin, cos)) = (sinc(half), ops::sin_cos(from.theta + half));
        // The chord's length and direction both change with the turn.
        let (longer, turned) = (u.speed * t * ds * 0.5 * t, u.speed * t * s * 0.5 * t);
        [[t * s * cos, t * s * sin, 0.0], [longer * cos - turned * sin, longer * sin + turned * cos, t]]
    }

    /// The control with its noise added. Takes four `u64`s.
    pub fn perturb(&self, u: &Velocity, stream: &mut Stream) -> Velocity {
        let [speed, turn_rate] = stream.noise(self.stds(u));
        Velocity { speed: u.speed + speed, turn_rate: u.turn_rate + turn_rate, ..*u }
    }
}

impl Motion for VelocityModel {
    type Control = Velocity;

    fn apply(&self, from: &Pose2, u: &Velocity) -> Pose2 {
        u.apply(from)
    }

    fn sample(&self, from: &Pose2, u: &Velocity, stream: &mut Stream) -> Pose2 {
        self.perturb(u, stream).apply(from)
    }

    /// V M Vᵀ with V = ∂(x ⊕ u)/∂(v, ω).
    fn covariance(&self, from: &Pose2, u: &Velocity) -> Matrix3<f64> {
        let [[vx, vy, vt], [wx, wy, wt]] = Self::derivatives(from, u);
        let v = Matrix3x2::new(vx, wx, vy, wy, vt, wt);
        let m = Matrix2::from_diagonal(&Vector2::from(self.stds(u).map(|std| std * std)));
        v * m * v.transpose()
    }

    fn validate(&self) -> Result<(), SettingError> {
        Range::at_least(0.0, "m/s").check("motion.speed_std", self.speed_std)?;
        Range::at_least(0.0, "rad/s").check("motion.turn_rate_std", self.turn_rate_std)?;
        self.alphas.iter().try_for_each(|alpha| Range::at_least(0.0, "").check("motion.alphas", *alpha).map(drop))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_a_circle_ends_opposite_and_a_straight_line_is_its_limit() {
        let half = Velocity { speed: 1.0, turn_rate: 0.5, duration: 2.0 * core::f64::consts::PI };
        assert!(half.apply(&Pose2::default()).minus(&Pose2::new(0.0, 4.0, core::f64::consts::PI)).norm() < 1e-14);
        let straight = Velocity { speed: 2.0, turn_rate: 1e-12, duration: 3.0 };
        assert!(straight.apply(&Pose2::default()).minus(&Pose2::new(6.0, 0.0, 0.0)).norm() < 1e-10);
    }

    /// Little noise, so that the covariance, which is of first order, is that of the samples.
    const MODEL: VelocityModel =
        VelocityModel { speed_std: 0.05, turn_rate_std: 0.02, alphas: [0.002, 0.001, 0.003, 0.004] };

    /// Straight ahead, where the arc is a limit and near it, arcs to both sides, a turn on the spot, standing still.
    fn cases() -> [(Pose2, Velocity); 6] {
        [(1.3, 0.0), (1.3, 1e-5), (1.3, -0.7), (-0.9, 2.0), (0.0, 1.0), (0.0, 0.0)].map(|(speed, turn_rate)| {
            (Pose2::new(1.0, 2.0, 0.4 + 3.0 * turn_rate), Velocity { speed, turn_rate, duration: 0.8 })
        })
    }

    crate::motion_laws!(laws, MODEL, cases());

    #[test]
    fn a_robot_without_noise_goes_where_it_is_told() {
        let exact = VelocityModel { speed_std: 0.0, turn_rate_std: 0.0, alphas: [0.0; 4] };
        crate::laws::motion::without_noise_a_sample_is_the_motion_itself(&exact, &cases());
    }
}
