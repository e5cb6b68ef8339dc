//! The odometry motion model.
//!
//! A control is what the wheels reported between two poses, decomposed into a turn, a straight drive and a second turn.
//! Each part carries Gaussian noise whose variance grows with the motion itself.
//!
//! Reference: Thrun, Burgard, Fox, *Probabilistic Robotics* (2005), tables 5.5 and 5.6.

use super::Motion;
use crate::error::{Range, SettingError};
use crate::geometry::Pose2;
use crate::ops;
use crate::random::Stream;
use core::f64::consts::{FRAC_PI_2, PI};
use nalgebra::{Matrix3, Vector3};

/// u = (δ_rot1, δ_trans, δ_rot2): turn, drive, turn.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Odometry {
    /// First turn \[rad\].
    pub rot1: f64,
    /// Straight drive \[m\]; below 0 backwards.
    pub trans: f64,
    /// Second turn \[rad\].
    pub rot2: f64,
}

impl Odometry {
    /// Below this drive \[m\] a motion counts as a turn on the spot: the direction of so short a drive is noise.
    const SPOT: f64 = 1e-6;

    /// The control that leads from one pose to another.
    pub fn between(from: &Pose2, to: &Pose2) -> Self {
        let delta = from.between(to);
        let trans = ops::hypot(delta.x, delta.y);
        let rot1 = if trans < Self::SPOT { 0.0 } else { ops::atan2(delta.y, delta.x) };
        Self { rot1, trans, rot2: ops::wrap_angle(delta.theta - rot1) }
    }

    /// The control between two recorded poses, by the least turns: a drive shorter than `spot` \[m\] has no direction of its own,
    /// and one that leads back was driven backwards.
    ///
    /// By [`Self::between`] a turn on the spot in which the wheels counted a millimetre astern is two turns by about half a circle
    /// each, with the noise of both: a prior so wide that a scan is matched the wrong way round.
    pub fn recorded(from: &Pose2, to: &Pose2, spot: f64) -> Self {
        let delta = from.between(to);
        let Self { rot1, trans, .. } = Self::between(from, to);
        let (rot1, trans) = if trans < spot {
            (0.0, delta.x)
        } else if rot1.abs() > FRAC_PI_2 {
            (ops::wrap_angle(rot1 + PI), -trans)
        } else {
            (rot1, trans)
        };
        Self { rot1, trans, rot2: ops::wrap_angle(delta.theta - rot1) }
    }

    /// pose ⊕ u.
    pub fn apply(&self, pose: &Pose2) -> Pose2 {
        let (sin, cos) = ops::sin_cos(pose.theta + self.rot1);
        Pose2::new(pose.x + self.trans * cos, pose.y + self.trans * sin, pose.theta + self.rot1 + self.rot2)
    }
}

/// The four α of the noise: σ²_rot1 = α₁ δ_rot1² + α₂ δ_trans², σ²_trans = α₃ δ_trans² + α₄ (δ_rot1² + δ_rot2²),
/// σ²_rot2 = α₁ δ_rot2² + α₂ δ_trans².
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct OdometryModel {
    /// α₁ \[–\], α₂ \[rad²/m²\], α₃ \[–\], α₄ \[m²/rad²\].
    pub alphas: [f64; 4],
}

impl OdometryModel {
    /// The same model with every standard deviation multiplied by `scale`.
    pub fn scaled(&self, scale: f64) -> Self {
        Self { alphas: self.alphas.map(|alpha| alpha * scale * scale) }
    }

    /// Standard deviations of (rot1, trans, rot2) \[rad, m, rad\] for a control.
    pub fn stds(&self, u: &Odometry) -> [f64; 3] {
        let [a1, a2, a3, a4] = self.alphas;
        let (rot1, trans, rot2) = (u.rot1 * u.rot1, u.trans * u.trans, u.rot2 * u.rot2);
        [a1 * rot1 + a2 * trans, a3 * trans + a4 * (rot1 + rot2), a1 * rot2 + a2 * trans].map(f64::sqrt)
    }

    /// The control with its noise added: what wheels report of a true motion, or what may have been driven, given what they
    /// reported. Takes six `u64`s.
    pub fn perturb(&self, u: &Odometry, stream: &mut Stream) -> Odometry {
        let [rot1, trans, rot2] = stream.noise(self.stds(u));
        Odometry { rot1: u.rot1 + rot1, trans: u.trans + trans, rot2: u.rot2 + rot2 }
    }
}

impl Motion for OdometryModel {
    type Control = Odometry;

    fn apply(&self, from: &Pose2, u: &Odometry) -> Pose2 {
        u.apply(from)
    }

    /// x_t ~ p(x_t | x_{t−1}, u_t), table 5.6. Takes six `u64`s.
    fn sample(&self, from: &Pose2, u: &Odometry, stream: &mut Stream) -> Pose2 {
        self.perturb(u, stream).apply(from)
    }

    /// R_t = V M Vᵀ with V = ∂(x ⊕ u)/∂u.
    fn covariance(&self, from: &Pose2, u: &Odometry) -> Matrix3<f64> {
        let (sin, cos) = ops::sin_cos(from.theta + u.rot1);
        let v = Matrix3::new(-u.trans * sin, cos, 0.0, u.trans * cos, sin, 0.0, 1.0, 0.0, 1.0);
        let m = Matrix3::from_diagonal(&Vector3::from(self.stds(u).map(|std| std * std)));
        v * m * v.transpose()
    }

    fn travel(&self, u: &Odometry) -> f64 {
        u.trans.abs() + u.rot1.abs() + u.rot2.abs()
    }

    fn validate(&self) -> Result<(), SettingError> {
        self.alphas.iter().try_for_each(|alpha| Range::at_least(0.0, "").check("motion.alphas", *alpha).map(drop))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_control_between_two_poses_leads_from_one_to_the_other() {
        let (a, b) = (Pose2::new(0.0, 1.0, 2.0), Pose2::new(-0.5, 1.7, -2.2));
        assert!(Odometry::between(&a, &b).apply(&a).minus(&b).norm() < 1e-14);
        let spot = Odometry::between(&a, &Pose2::new(0.0, 1.0, 2.4));
        assert_eq!((spot.rot1, spot.trans), (0.0, 0.0));
    }

    #[test]
    fn recorded_wheels_turn_no_more_than_the_robot_did() {
        let (a, noise) = (Pose2::new(3.0, -1.0, 2.0), OdometryModel { alphas: [0.04, 0.01, 0.01, 0.01] });
        let to = |x: f64, y: f64, theta: f64| a.compose(&Pose2 { x, y, theta });
        // A turn on the spot, in which the wheels slip by millimetres; and a way back.
        let slipped = to(-0.002, -0.001, 0.5);
        let turn = Odometry::recorded(&a, &slipped, 0.02);
        assert!(turn.rot1 == 0.0 && (turn.rot2 - 0.5).abs() < 1e-12, "{turn:?}");
        assert!(turn.apply(&a).minus(&slipped).norm() < 0.0011);
        assert!(noise.stds(&Odometry::between(&a, &slipped))[2] > 5.0 * noise.stds(&turn)[2]);
        let back = Odometry::recorded(&a, &to(-0.5, 0.05, 0.1), 0.02);
        assert!(back.trans < -0.5 && back.rot1.abs() < 0.11 && back.rot2.abs() < 0.21, "{back:?}");
        for pose in [to(-0.5, 0.05, 0.1), to(0.5, -0.3, 1.0), to(0.0, 0.4, -3.0)] {
            assert!(Odometry::recorded(&a, &pose, 0.02).apply(&a).minus(&pose).norm() < 1e-14);
        }
    }

    /// Little noise, so that the covariance, which is of first order, is that of the samples.
    const MODEL: OdometryModel = OdometryModel { alphas: [0.01, 0.002, 0.008, 0.002] };

    /// Ahead, an arc, a turn on the spot, backwards, standing still.
    fn cases() -> [(Pose2, Odometry); 5] {
        let starts = [(0.0, 0.0, 0.0), (1.0, 2.0, 0.4), (-3.0, 1.0, 3.1), (2.0, -1.0, -1.7), (1.0, 2.0, 0.5)];
        let controls = [(0.0, 0.8, 0.0), (0.2, 1.0, 0.1), (0.0, 0.0, 0.9), (0.1, -0.7, -0.3), (0.0, 0.0, 0.0)];
        core::array::from_fn(|k| {
            let ((x, y, theta), (rot1, trans, rot2)) = (starts[k], controls[k]);
            (Pose2::new(x, y, theta), Odometry { rot1, trans, rot2 })
        })
    }

    crate::motion_laws!(laws, MODEL, cases());

    #[test]
    fn a_robot_that_stands_still_has_a_density_all_the_same() {
        let model = OdometryModel { alphas: [0.1, 0.02, 0.08, 0.02] };
        let still = Odometry { rot1: 0.0, trans: 0.0, rot2: 0.0 };
        let density = model.gaussian(&Pose2::default(), &still, [0.01, 0.01, 0.005]).unwrap();
        assert!(density.log_density(&Pose2::default()).is_finite());
    }
}
