//! Laws of sensors of landmarks.
//!
//! Each takes a sensor and views: poses x with landmarks m that it sees from there. Let there be some near and far, ahead and aside.

use super::{TURNS, rounding, size, turn2, turn3};
use crate::geometry::Pose2;
use crate::ops;
use crate::random::{Purpose, Stream};
use crate::sensor::{LandmarkSensor, Prediction};
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

/// A `#[test]` of every law in [`laws::sensor`](crate::laws::sensor): `sensor_laws!(name, sensor, views)` makes a module `name`; `sensor` is a
/// [`LandmarkSensor`](crate::sensor::LandmarkSensor) and `views` an array or a vector of (pose, landmark).
///
/// For a sensor that measures in the world’s frame, a compass for one, write the tests without
/// [`turning_the_world_changes_nothing`](crate::laws::sensor::turning_the_world_changes_nothing) yourself.
///
/// ```
/// use fastslam::geometry::Pose2;
/// use fastslam::nalgebra::Vector2;
/// use fastslam::sensor::RangeBearing;
///
/// const SENSOR: RangeBearing = RangeBearing { range_std: 0.1, bearing_std: 0.02, max_range: 9.0, field_of_view: 6.3 };
/// const VIEW: (Pose2, Vector2<f64>) = (Pose2 { x: 1.0, y: 2.0, theta: 0.5 }, Vector2::new(3.0, -1.0));
///
/// fastslam::sensor_laws!(range_bearing, SENSOR, [VIEW]);
/// ```
#[macro_export]
macro_rules! sensor_laws {
    ($name:ident, $sensor:expr, $views:expr $(,)?) => {
        $crate::tests_of_laws!(
            $name,
            sensor,
            [
                the_derivatives_are_those_of_the_prediction,
                locating_undoes_predicting,
                residuals_do_not_jump_where_angles_wrap,
                the_noise_is_symmetric_and_positive_definite,
                the_lower_bound_is_never_above_the_distance,
                what_is_in_view_with_a_margin_is_in_view,
                turning_the_world_changes_nothing,
            ],
            (&$sensor, &$views)
        );
    };
}

/// H_x = ∂h/∂x and H_m = ∂h/∂m, by central differences of [`predict`](LandmarkSensor::predict) taken with
/// [`residual`](LandmarkSensor::residual), h = 10⁻⁶; and H_m has an inverse.
///
/// To 10⁻⁸ (1 + |z| + ‖H‖³): rounding leaves 10⁻¹⁶ |z| / h, and the third derivative of what bends by angles is as the first one cubed,
/// times h².
///
/// ```
/// # use fastslam::{geometry::Pose2, laws, nalgebra::Vector2, sensor::RangeBearing};
/// # let sensor = RangeBearing { range_std: 0.1, bearing_std: 0.02, max_range: 9.0, field_of_view: 6.3 };
/// let view = (Pose2::new(1.0, 2.0, 0.5), Vector2::new(3.0, -1.0));
/// laws::sensor::the_derivatives_are_those_of_the_prediction(&sensor, &[view]);
/// ```
pub fn the_derivatives_are_those_of_the_prediction<Z: LandmarkSensor>(sensor: &Z, views: &[(Pose2, Vector2<f64>)]) {
    let h = 1e-6;
    for (k, (pose, landmark)) in views.iter().enumerate() {
        let Prediction { z, h_x, h_m } = sensor.predict(pose, landmark);
        let norm = h_x.norm();
        let tolerance = 1e-8 * (1.0 + z.norm() + norm * norm * norm);
        let at = |pose: Pose2, landmark: Vector2<f64>| sensor.predict(&pose, &landmark).z;
        for axis in 0..3 {
            let mut step = Vector3::zeros();
            step[axis] = h;
            let difference = sensor.residual(&at(pose.plus(&step), *landmark), &at(pose.plus(&-step), *landmark));
            let error = (h_x.column(axis) - difference / (2.0 * h)).norm();
            assert!(error < tolerance, "view {k}: column {axis} of H_x is off by {error}: {h_x}");
        }
        for axis in 0..2 {
            let mut step = Vector2::zeros();
            step[axis] = h;
            let difference = sensor.residual(&at(*pose, landmark + step), &at(*pose, landmark - step));
            let error = (h_m.column(axis) - difference / (2.0 * h)).norm();
            assert!(error < tolerance, "view {k}: column {axis} of H_m is off by {error}: {h_m}");
        }
        let determinant = h_m.determinant().abs();
        assert!(determinant > 1e-9 * h_m.norm_squared(), "view {k}: H_m has no inverse: {h_m}");
    }
}

/// h⁻¹(x, h(x, m)) = m, and h(x, h⁻¹(x, z)) = z.
///
/// To 10⁻⁹ of the numbers’ size, what inverse functions leave of 10⁻¹⁶ where they are steep.
///
/// ```
/// # use fastslam::{geometry::Pose2, laws, nalgebra::Vector2, sensor::RangeBearing};
/// # let sensor = RangeBearing { range_std: 0.1, bearing_std: 0.02, max_range: 9.0, field_of_view: 6.3 };
/// let view = (Pose2::new(1.0, 2.0, 0.5), Vector2::new(3.0, -1.0));
/// laws::sensor::locating_undoes_predicting(&sensor, &[view]);
/// ```
pub fn locating_undoes_predicting<Z: LandmarkSensor>(sensor: &Z, views: &[(Pose2, Vector2<f64>)]) {
    for (k, (pose, landmark)) in views.iter().enumerate() {
        let z = sensor.predict(pose, landmark).z;
        let located = sensor.locate(pose, &z);
        let off = (located - landmark).norm();
        assert!(off < 1e-9 * (1.0 + size(pose) + landmark.norm()), "view {k}: located {off} m from where it is");
        let off = sensor.residual(&sensor.predict(pose, &located).z, &z).norm();
        assert!(off < 1e-9 * (1.0 + z.norm()), "view {k}: what was located is seen {off} from what was measured");
    }
}

/// The residual of the views from two headings δ = 0.01 rad apart is H_x (0, 0, δ) to second order, wherever on the circle they are:
/// none jumps by a turn where an angle wraps. And z − z = 0.
///
/// Of headings from which the landmark is not in view nothing is said.
///
/// ```
/// # use fastslam::{geometry::Pose2, laws, nalgebra::Vector2, sensor::RangeBearing};
/// # let sensor = RangeBearing { range_std: 0.1, bearing_std: 0.02, max_range: 9.0, field_of_view: 6.3 };
/// let view = (Pose2::new(1.0, 2.0, 0.5), Vector2::new(3.0, -1.0));
/// laws::sensor::residuals_do_not_jump_where_angles_wrap(&sensor, &[view]);
/// ```
pub fn residuals_do_not_jump_where_angles_wrap<Z: LandmarkSensor>(sensor: &Z, views: &[(Pose2, Vector2<f64>)]) {
    let delta = 0.01;
    let steps = (core::f64::consts::TAU / delta) as u32 + 1;
    for (k, (pose, landmark)) in views.iter().enumerate() {
        for step in 0..steps {
            let before = Pose2::new(pose.x, pose.y, pose.theta + f64::from(step) * delta);
            let after = Pose2::new(pose.x, pose.y, before.theta + delta);
            if sensor.sees(&before, landmark, 0.0) && sensor.sees(&after, landmark, 0.0) {
                let [a, b] = [&before, &after].map(|pose| sensor.predict(pose, landmark));
                let off = sensor.residual(&b.z, &a.z) - a.h_x.column(2) * delta;
                // Of second order: δ² times what the derivatives are.
                let most = 2.0 * delta * delta * (1.0 + a.h_x.norm() + b.h_x.norm()) + rounding(a.z.norm());
                let theta = before.theta;
                assert!(off.norm() < most, "view {k}, heading {theta}: the residual jumps by {off}, and may by {most}");
                assert_eq!(sensor.residual(&a.z, &a.z), Vector2::zeros(), "view {k}: z − z");
            }
        }
    }
}

/// Q = Qᵀ, and vᵀ Q v > 0 for every v ≠ 0.
///
/// ```
/// # use fastslam::{laws, sensor::RangeBearing};
/// # let sensor = RangeBearing { range_std: 0.1, bearing_std: 0.02, max_range: 9.0, field_of_view: 6.3 };
/// laws::sensor::the_noise_is_symmetric_and_positive_definite(&sensor, &[]);
/// ```
pub fn the_noise_is_symmetric_and_positive_definite<Z: LandmarkSensor>(sensor: &Z, _views: &[(Pose2, Vector2<f64>)]) {
    let q = sensor.noise();
    assert!((q.m12 - q.m21).abs() <= rounding(0.0) * q.trace(), "the noise is not symmetric: {q}");
    // By its minors, since eigenvalues of a covariance of metres and radians lose the smaller one.
    let definite = q.m11 > 0.0 && q.m22 > 0.0 && q.determinant() > rounding(0.0) * q.m11 * q.m22;
    assert!(definite && q.iter().all(|x| x.is_finite()), "the noise is not positive definite: {q}");
}

/// [`least_mahalanobis_squared`](LandmarkSensor::least_mahalanobis_squared) ≤ νᵀ S⁻¹ ν with S = H_x P H_xᵀ + H_m Σ H_mᵀ + Q, for
/// `spread` = Σ + P_xy.
///
/// n = 200 covariances P and Σ of each view, and residuals ν of up to some standard deviations of the noise and of a metre. To 10⁻⁹ of it:
/// the inverse of S.
///
/// ```
/// # use fastslam::{geometry::Pose2, laws, nalgebra::Vector2, sensor::RangeBearing};
/// # let sensor = RangeBearing { range_std: 0.1, bearing_std: 0.02, max_range: 9.0, field_of_view: 6.3 };
/// let view = (Pose2::new(1.0, 2.0, 0.5), Vector2::new(3.0, -1.0));
/// laws::sensor::the_lower_bound_is_never_above_the_distance(&sensor, &[view]);
/// ```
pub fn the_lower_bound_is_never_above_the_distance<Z: LandmarkSensor>(sensor: &Z, views: &[(Pose2, Vector2<f64>)]) {
    for (k, (pose, landmark)) in (0..).zip(views) {
        let Prediction { z: predicted, h_x, h_m } = sensor.predict(pose, landmark);
        for slot in 0..200 {
            let mut stream = Stream::at(2, Purpose::TRIAL, k, slot);
            let (p, sigma) = (covariance3(&mut stream), covariance2(&mut stream));
            let s = h_x * p * h_x.transpose() + h_m * sigma * h_m.transpose() + sensor.noise();
            let Some(inverse) = s.try_inverse() else { continue };
            // Somewhere else than expected: by the sensor’s own units, and by metres.
            let step = Vector2::from(stream.normals::<2>()) * stream.uniform();
            let z = predicted + sensor.noise().map_diagonal(f64::sqrt).component_mul(&step) + h_m * step;
            let nu = sensor.residual(&z, &predicted);
            let (whole, spread) = (nu.dot(&(inverse * nu)), sigma + p.fixed_view::<2, 2>(0, 0));
            let least = sensor.least_mahalanobis_squared(pose, landmark, &spread, &z);
            assert!(least <= whole * (1.0 + 1e-9), "view {k}: the lower bound {least} of {whole} is above it");
        }
    }
}

/// Where [`sees`](LandmarkSensor::sees)(x, m, margin), all points within the margin around m are seen without one.
///
/// Margins of 1 cm to 1 m, points in 16 directions at 0.99 of them: not the edge itself.
///
/// ```
/// # use fastslam::{geometry::Pose2, laws, nalgebra::Vector2, sensor::RangeBearing};
/// # let sensor = RangeBearing { range_std: 0.1, bearing_std: 0.02, max_range: 9.0, field_of_view: 6.3 };
/// let view = (Pose2::new(1.0, 2.0, 0.5), Vector2::new(3.0, -1.0));
/// laws::sensor::what_is_in_view_with_a_margin_is_in_view(&sensor, &[view]);
/// ```
pub fn what_is_in_view_with_a_margin_is_in_view<Z: LandmarkSensor>(sensor: &Z, views: &[(Pose2, Vector2<f64>)]) {
    for (k, (pose, landmark)) in views.iter().enumerate() {
        for margin in [0.01, 0.1, 1.0].into_iter().filter(|margin| sensor.sees(pose, landmark, *margin)) {
            for direction in 0..16 {
                let (sin, cos) = ops::sin_cos(core::f64::consts::TAU * f64::from(direction) / 16.0);
                let point = landmark + Vector2::new(cos, sin) * (0.99 * margin);
                let seen = sensor.sees(pose, &point, 0.0);
                assert!(seen, "view {k}: in view with a margin of {margin} m, but {point} in it is not");
            }
        }
    }
}

/// h(T ⊕ x, T ⊕ m) = h(x, m) for rigid motions T of the world; the derivatives, h⁻¹ and the lower bound turn with it.
///
/// ```
/// # use fastslam::{geometry::Pose2, laws, nalgebra::Vector2, sensor::RangeBearing};
/// # let sensor = RangeBearing { range_std: 0.1, bearing_std: 0.02, max_range: 9.0, field_of_view: 6.3 };
/// let view = (Pose2::new(1.0, 2.0, 0.5), Vector2::new(3.0, -1.0));
/// laws::sensor::turning_the_world_changes_nothing(&sensor, &[view]);
/// ```
pub fn turning_the_world_changes_nothing<Z: LandmarkSensor>(sensor: &Z, views: &[(Pose2, Vector2<f64>)]) {
    for (k, (pose, landmark)) in (0..).zip(views) {
        let here = sensor.predict(pose, landmark);
        let step = Vector2::from(Stream::at(3, Purpose::TRIAL, k, 0).normals::<2>());
        let z = here.z + sensor.noise().map_diagonal(f64::sqrt).component_mul(&step);
        let spread = covariance2(&mut Stream::at(3, Purpose::TRIAL, k, 1));
        for world in &TURNS {
            let place = |m: &Vector2<f64>| Vector2::from(world.transform([m.x, m.y]));
            let (turn, moved) = (turn2(world), (world.compose(pose), place(landmark)));
            let there = sensor.predict(&moved.0, &moved.1);
            // Coordinates that lose some bits in a sum with the motion’s, through derivatives.
            let norm = 1.0 + here.h_x.norm();
            let tolerance = rounding(size(world) + size(pose) + landmark.norm()) * norm * norm * norm;
            let offs = [
                ("the prediction", sensor.residual(&there.z, &here.z).norm()),
                ("H_x", (there.h_x * turn3(world) - here.h_x).norm()),
                ("H_m", (there.h_m * turn - here.h_m).norm()),
                ("what is located", (sensor.locate(&moved.0, &here.z) - place(&sensor.locate(pose, &here.z))).norm()),
            ];
            for (name, off) in offs {
                assert!(off <= tolerance, "view {k}, world turned by {}: {name} is off by {off}", world.theta);
            }
            let least = sensor.least_mahalanobis_squared(pose, landmark, &spread, &z);
            let turned = turn * spread * turn.transpose();
            let off = (sensor.least_mahalanobis_squared(&moved.0, &moved.1, &turned, &z) - least).abs();
            // A quotient by variances, each as exact as a prediction.
            let most = 1e-9 * (1.0 + least);
            assert!(off <= most, "view {k}, world turned by {}: the lower bound is off by {off}", world.theta);
        }
    }
}

/// A covariance of a landmark with deviations of up to a metre.
fn covariance2(stream: &mut Stream) -> Matrix2<f64> {
    let [a, b, c] = [0, 1, 2].map(|_| 2.0 * stream.uniform() - 1.0);
    let l = Matrix2::new(a, 0.0, b, c);
    l * l.transpose()
}

/// A covariance of a pose with deviations of up to half a metre and half a radian.
fn covariance3(stream: &mut Stream) -> Matrix3<f64> {
    let [a, b, c, d, e, f] = [0; 6].map(|_| stream.uniform() - 0.5);
    let l = Matrix3::new(a, 0.0, 0.0, b, c, 0.0, d, e, f);
    l * l.transpose()
}
