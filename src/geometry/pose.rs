//! SE(2): where a robot stands and which way it looks.

use crate::ops;
use nalgebra::Vector3;

/// A rigid motion of the plane: position \[m\] and heading \[rad\], wrapped to (−π, π].
///
/// `world_from_robot` carries points given in the robot's frame into the world's.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pose2 {
    /// \[m\]
    pub x: f64,
    /// \[m\]
    pub y: f64,
    /// \[rad\], in (−π, π]
    pub theta: f64,
}

impl Pose2 {
    /// The pose at (x, y) \[m\] with heading theta \[rad\], which is wrapped.
    pub fn new(x: f64, y: f64, theta: f64) -> Self {
        Self { x, y, theta: ops::wrap_angle(theta) }
    }

    /// self ⊕ other: `other`, given in this pose's frame, in the frame this pose is given in.
    pub fn compose(&self, other: &Self) -> Self {
        let [x, y] = self.transform([other.x, other.y]);
        Self::new(x, y, self.theta + other.theta)
    }

    /// ⊖self ⊕ other: `other` as seen from this pose.
    pub fn between(&self, other: &Self) -> Self {
        let (sin, cos) = ops::sin_cos(self.theta);
        let (dx, dy) = (other.x - self.x, other.y - self.y);
        Self::new(cos * dx + sin * dy, -sin * dx + cos * dy, other.theta - self.theta)
    }

    /// A point of the robot's frame \[m\] in the world's.
    pub fn transform(&self, point: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = ops::sin_cos(self.theta);
        [self.x + cos * point[0] - sin * point[1], self.y + sin * point[0] + cos * point[1]]
    }

    /// This pose plus (Δx, Δy, Δθ) of the world's frame.
    pub fn plus(&self, delta: &Vector3<f64>) -> Self {
        Self::new(self.x + delta.x, self.y + delta.y, self.theta + delta.z)
    }

    /// (Δx, Δy, Δθ) in the world's frame from `origin` to this pose, the angle wrapped.
    pub fn minus(&self, origin: &Self) -> Vector3<f64> {
        Vector3::new(self.x - origin.x, self.y - origin.y, ops::wrap_angle(self.theta - origin.theta))
    }

    /// Distance of the two positions \[m\].
    pub fn distance(&self, other: &Self) -> f64 {
        ops::hypot(self.x - other.x, self.y - other.y)
    }
}

/// How far a motion drives \[m\], and by how much it turns \[rad\], to whichever side.
pub(crate) fn driven(motion: &Pose2) -> [f64; 2] {
    [ops::hypot(motion.x, motion.y), motion.theta.abs()]
}

/// The rigid motion that carries `path` onto `reference` with the least sum of squared distances of positions.
///
/// The planar case without scale of Umeyama (1991): with both centred, the angle is atan2(Σ pᵢ × rᵢ, Σ pᵢ · rᵢ). Both paths
/// must be of one length; for none or one pose the answer is a translation.
pub fn align(path: &[Pose2], reference: &[Pose2]) -> Pose2 {
    assert_eq!(path.len(), reference.len(), "paths of different lengths");
    let n = path.len().max(1) as f64;
    let mean = |poses: &[Pose2]| {
        let (x, y) = poses.iter().fold((0.0, 0.0), |(x, y), p| (x + p.x, y + p.y));
        [x / n, y / n]
    };
    let (p0, r0) = (mean(path), mean(reference));
    let (mut cross, mut dot) = (0.0, 0.0);
    for (p, r) in path.iter().zip(reference) {
        let (px, py, rx, ry) = (p.x - p0[0], p.y - p0[1], r.x - r0[0], r.y - r0[1]);
        cross += px * ry - py * rx;
        dot += px * rx + py * ry;
    }
    let rotation = Pose2::new(0.0, 0.0, if cross == 0.0 && dot == 0.0 { 0.0 } else { ops::atan2(cross, dot) });
    let [x, y] = rotation.transform(p0);
    Pose2::new(r0[0] - x, r0[1] - y, rotation.theta)
}

/// Root mean square distance of two paths' positions \[m\].
pub fn rms(path: &[Pose2], truth: &[Pose2]) -> f64 {
    let sum: f64 = path.iter().zip(truth).map(|(a, b)| a.distance(b)).map(|d| d * d).sum();
    (sum / path.len().max(1) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_undoes_compose() {
        let (a, b) = (Pose2::new(1.0, -2.0, 2.5), Pose2::new(0.3, 0.7, 1.9));
        let back = a.between(&a.compose(&b));
        assert!(back.minus(&b).norm() < 1e-14);
    }

    #[test]
    fn alignment_undoes_a_rigid_motion() {
        let path: Vec<_> = (0..9).map(|k| Pose2::new(f64::from(k), f64::from(k * k) * 0.1, 0.0)).collect();
        let motion = Pose2::new(3.0, -1.0, 0.7);
        let reference: Vec<_> = path.iter().map(|p| motion.compose(p)).collect();
        assert!(align(&path, &reference).minus(&motion).norm() < 1e-12);
        assert_eq!(align(&[], &[]), Pose2::default());
    }
}
