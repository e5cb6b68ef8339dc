//! A Gaussian through a hill of which only single values can be had, and the hill's integral.

use crate::geometry::{Gaussian3, Pose2};
use crate::ops;
use nalgebra::{Matrix3, SymmetricEigen, Vector3};

/// Half of the twelve corners of an icosahedron, at distance 1 from its centre; the others lie opposite.
///
/// Their directions are a spherical design of strength five: mean and covariance, and all moments up to the fifth, of these
/// corners are those of the sphere. So no direction is preferred, whichever way the hill runs.
const CORNERS: [[f64; 3]; 6] = [
    [0.0, SHORT, LONG],
    [0.0, -SHORT, LONG],
    [LONG, 0.0, SHORT],
    [LONG, 0.0, -SHORT],
    [SHORT, LONG, 0.0],
    [-SHORT, LONG, 0.0],
];
/// 1 / √(1 + φ²) with the golden ratio φ.
const SHORT: f64 = 0.525_731_112_119_133_6;
/// φ / √(1 + φ²).
const LONG: f64 = 0.850_650_808_352_039_9;

/// How far from the mode the second differences look, in units of the most that a standard deviation may be.
const STEP: f64 = 0.5;
/// How far from the mode, in standard deviations, the corners of the quadrature stand: √5.
const REACH: f64 = 2.236_067_977_499_79;
/// Weights of the mode and of each corner: with [`REACH`], moments up to the fifth order of a Gaussian are exact (Stroud 1971,
/// formula E₃^{r²} 5-1).
const WEIGHTS: [f64; 2] = [0.4, 0.05];

/// Limits of the standard deviations of a fit: least and most, of position and of heading \[m, rad\]. Between axes of position and
/// heading they form ellipsoids, alike along every direction of the plane.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct FitLimits {
    /// Least \[m, rad\].
    pub least: [f64; 2],
    /// Most \[m, rad\].
    pub most: [f64; 2],
}

/// What a fit found.
#[derive(Clone, Debug)]
pub struct Fit {
    /// The Gaussian with mean and covariance of the hill.
    pub gaussian: Gaussian3,
    /// ln ∫ exp(log_target) dx \[nats\].
    pub log_integral: f64,
    /// The thirteen poses of the quadrature: the centre, and twelve around it.
    pub points: [Pose2; 13],
}

impl Fit {
    /// Fits exp(`log_target`) \[density over m² rad\] around its mode: 26 values are asked for.
    ///
    /// First the mode and twelve points around it give gradient and 3 × 3 matrix of second
    /// derivatives: Newton's step to the top, and the principal axes of the hill (Laplace). The top and twelve points √5
    /// standard deviations from it correct for what is no parabola: importance weights τ = target / Gaussian in a quadrature of
    /// degree five give the integral, the mean and the covariance. For a Gaussian target within the limits all three are exact,
    /// however it is turned.
    ///
    /// `None` where the values are not finite enough for a definite covariance.
    pub fn around(mode: &Pose2, limits: &FitLimits, log_target: impl Fn(&Pose2) -> f64) -> Option<Self> {
        let (shift, axes) = curvature(mode, limits, &log_target);
        let center = mode.plus(&shift);
        let probes = probes(&center, &axes, &log_target)?;
        Self::through(&center, &probes, limits)
    }

    /// The Gaussian with the moments of these probes, and their sum.
    fn through(center: &Pose2, probes: &[Probe], limits: &FitLimits) -> Option<Self> {
        let log_integral = ops::log_sum_exp(&probes.iter().map(|probe| probe.log_tau).collect::<Vec<_>>());
        let (mut mu, mut second) = (Vector3::zeros(), Matrix3::zeros());
        for Probe { offset, log_tau } in probes {
            let tau = ops::exp(log_tau - log_integral);
            mu += offset * tau;
            second += offset * offset.transpose() * tau;
        }
        let [least, turn] = limits.least;
        let floor = Matrix3::from_diagonal(&Vector3::new(least, least, turn).map(|std| 0.25 * std * std));
        let gaussian = Gaussian3::new(center.plus(&mu), second - mu * mu.transpose() + floor)?;
        let points = core::array::from_fn(|k| probes.get(k).map_or(*center, |probe| center.plus(&probe.offset)));
        Some(Self { gaussian, log_integral, points })
    }
}

/// A point of the quadrature.
struct Probe {
    /// From the centre \[m, m, rad\].
    offset: Vector3<f64>,
    /// ln of τ = target / Gaussian, times the weight of the quadrature.
    log_tau: f64,
}

/// The target at the centre and at twelve corners around it, against the Gaussian with these principal axes. `None` where they span
/// nothing.
fn probes(center: &Pose2, axes: &Matrix3<f64>, log_target: &impl Fn(&Pose2) -> f64) -> Option<Vec<Probe>> {
    let laplace = Gaussian3::new(*center, axes * axes.transpose())?;
    let corners = CORNERS.iter().flat_map(|corner| [REACH, -REACH].map(|side| axes * Vector3::from(*corner) * side));
    let points = core::iter::once((Vector3::zeros(), WEIGHTS[0])).chain(corners.map(|offset| (offset, WEIGHTS[1])));
    let probe = |(offset, weight): (Vector3<f64>, f64)| {
        let pose = center.plus(&offset);
        Probe { offset, log_tau: ops::ln(weight) + log_target(&pose) - laplace.log_density(&pose) }
    };
    Some(points.map(probe).collect())
}

/// Gradient, and negative second derivatives (3 × 3), of a parabola of which these are the values: at the centre, and `step` × `side` × u from it
/// for the six diagonals u of an icosahedron and sides 1 and −1.
pub(super) fn differences(
    center: f64,
    step: f64,
    value: impl Fn(&Vector3<f64>, f64) -> f64,
) -> (Vector3<f64>, Matrix3<f64>) {
    // Over the six diagonals u: Σ (uᵀg) u = 2 g, Σ (uᵀHu) u uᵀ = ⅖ tr(H) I + ⅘ H and Σ uᵀHu = 2 tr H.
    let (mut gradient, mut outer, mut sum) = (Vector3::zeros(), Matrix3::zeros(), 0.0);
    for corner in CORNERS {
        let u = Vector3::from(corner);
        let (ahead, behind) = (value(&u, 1.0), value(&u, -1.0));
        gradient += u * ((ahead - behind) / (4.0 * step));
        let curvature = (2.0 * center - ahead - behind) / (step * step);
        outer += u * u.transpose() * curvature;
        sum += curvature;
    }
    (gradient, outer * 1.25 - Matrix3::identity() * (0.25 * sum))
}

/// From the differences of `log_target` along the six diagonals of an icosahedron: Newton's step to the top of the parabola, and the
/// principal axes of the hill as columns, each as long as the standard deviation along it \[m, m, rad\].
///
/// Lengths are in units of `limits.most`, in the robot's frame: what is found turns with the world. The step is no longer than
/// the differences reach.
fn curvature(mode: &Pose2, limits: &FitLimits, log_target: &impl Fn(&Pose2) -> f64) -> (Vector3<f64>, Matrix3<f64>) {
    let [most, turn] = limits.most;
    let (sin, cos) = ops::sin_cos(mode.theta);
    let frame = Matrix3::new(most * cos, -most * sin, 0.0, most * sin, most * cos, 0.0, 0.0, 0.0, turn);
    let ratio = |k: usize| limits.least[k] / limits.most[k];
    let step = ratio(0).max(ratio(1)).max(STEP);
    let (gradient, information) =
        differences(log_target(mode), step, |u, side| log_target(&mode.plus(&(frame * u * step * side))));
    let SymmetricEigen { eigenvalues, eigenvectors } = SymmetricEigen::new(information);
    let least = Vector3::new(ratio(0), ratio(0), ratio(1));
    let mut axes = eigenvectors;
    for (k, mut axis) in axes.column_iter_mut().enumerate() {
        // A plateau, or a valley, takes the most.
        let std = if eigenvalues[k] > 1.0 { 1.0 / eigenvalues[k].sqrt() } else { 1.0 };
        let least = axis.component_mul(&least).norm();
        axis *= std.max(least);
    }
    let mut shift = axes * axes.transpose() * gradient;
    let length = shift.norm();
    if length > step {
        shift *= step / length;
    }
    (frame * shift, frame * axes)
}
