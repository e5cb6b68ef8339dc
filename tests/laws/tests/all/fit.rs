//! The fit of a Gaussian through few values, which must not know north from east.

use fastslam::geometry::{Gaussian3, Pose2};
use fastslam::mapper::LaserMapperSettings;
use fastslam::ops;
use fastslam::proposal::{Fit, FitLimits};
use fastslam_lab::experiment::hill::Hill;
use fastslam_lab::experiment::lap::FROM_SCAN;
use nalgebra::{Matrix3, Vector3};

const LIMITS: FitLimits = FROM_SCAN.limits;

/// 0, 15 … 90°.
fn angles() -> impl Iterator<Item = f64> {
    (0..7).map(|k| (15.0 * f64::from(k)).to_radians())
}

/// Turns differences of poses (x, y, θ).
fn turn(angle: f64) -> Matrix3<f64> {
    let (sin, cos) = ops::sin_cos(angle);
    Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0)
}

fn fit(mode: &Pose2, limits: &FitLimits, log_target: impl Fn(&Pose2) -> f64) -> Fit {
    Fit::around(mode, limits, &log_target).unwrap()
}

/// What a fit adds to the covariance.
fn floor() -> Matrix3<f64> {
    let [least, heading] = LIMITS.least;
    Matrix3::from_diagonal(&Vector3::new(least, least, heading).map(|std| 0.25 * std * std))
}

/// A corridor: 8 cm along, 6 mm across, 0.01 rad; a robot that looks more to the left is further to the right.
fn corridor() -> Matrix3<f64> {
    let (along, across, heading) = (0.08, 0.006, 0.01);
    let correlated = |a: f64, b: f64, rho: f64| a * b * rho;
    let (ah, ch) = (correlated(along, heading, 0.3), correlated(across, heading, -0.5));
    Matrix3::new(along * along, 0.0, ah, 0.0, across * across, ch, ah, ch, heading * heading)
}

/// Where the robot stands in the corridor, which runs along x.
const THERE: Pose2 = Pose2 { x: 3.0, y: -2.0, theta: 0.4 };

/// The pose as it was before the world was turned about the origin.
fn back(angle: f64, pose: &Pose2) -> Pose2 {
    Pose2::new(0.0, 0.0, -angle).compose(pose)
}

/// Within the limits all is exact, by the quadrature's degree: 1e-9 is what rounding leaves of poses of some metres, and of logarithms.
/// The climb has ended a step away from the top.
#[test]
fn of_a_gaussian_hill_the_fit_has_integral_mean_and_covariance_whichever_way_it_is_turned() {
    let hill = Gaussian3::new(THERE, corridor()).unwrap();
    for angle in angles() {
        let turned = Pose2::new(0.0, 0.0, angle);
        let mode = turned.compose(&THERE.plus(&Vector3::new(0.01, -0.005, 0.004)));
        let fitted = fit(&mode, &LIMITS, |pose| hill.log_density(&back(angle, pose)) + 3.0);
        assert!((fitted.log_integral - 3.0).abs() < 1e-6, "{angle}: ln η̂ {}", fitted.log_integral - 3.0);
        let off = fitted.gaussian.mean().minus(&turned.compose(&THERE));
        assert!(off.norm() < 1e-9, "{angle}: {off}");
        let expected = turn(angle) * corridor() * turn(angle).transpose() + floor();
        let off = (fitted.gaussian.covariance() - expected).norm();
        assert!(off < 1e-9, "{angle}: {} for {expected}", fitted.gaussian.covariance());
    }
}

/// A hill wider than the limits, and one narrower: what the axes are cut to is cut alike along every direction. 1e-9: rounding.
#[test]
fn limits_know_no_direction() {
    for (scale, name) in [(25.0, "wide"), (0.01, "narrow")] {
        let hill = Gaussian3::new(THERE, corridor() * scale).unwrap();
        let fits: Vec<(f64, Matrix3<f64>)> = angles()
            .map(|angle| {
                let mode = Pose2::new(0.0, 0.0, angle).compose(&THERE);
                let fitted = fit(&mode, &LIMITS, |pose| hill.log_density(&back(angle, pose)));
                (fitted.log_integral, turn(-angle) * fitted.gaussian.covariance() * turn(angle))
            })
            .collect();
        for (log_integral, covariance) in &fits {
            assert!((log_integral - fits[0].0).abs() < 1e-6, "{name}: {log_integral} for {}", fits[0].0);
            assert!((covariance - fits[0].1).norm() < 1e-9, "{name}: {covariance} for {}", fits[0].1);
        }
    }
}

/// The corridor bent into an arc of 2 m radius: one standard deviation along leaves the tangent by 1.6 mm, two by the whole width.
fn bent(pose: &Pose2) -> f64 {
    let along = pose.x - THERE.x;
    let straight = pose.plus(&Vector3::new(0.0, -0.25 * along * along, 0.0));
    Gaussian3::new(THERE, corridor()).unwrap().log_density(&straight)
}

/// Two walls seen by 60 robust beams, each of a standard deviation of 5 cm, and odometry along the corridor: heavier tails than a
/// Gaussian's.
fn robust(pose: &Pose2) -> f64 {
    let d = pose.minus(&THERE);
    let beam = |reach: f64| {
        let d2 = (d.y + reach * d.z) * (d.y + reach * d.z) / (0.05 * 0.05);
        -d2 / (d2 + 2.0)
    };
    let beams: f64 = (0..60).map(|k| beam(0.1 * (f64::from(k) - 29.5))).sum();
    let odometry = Vector3::new(d.x / 0.08, d.y / 0.05, d.z / 0.1);
    0.85 * beams - 0.5 * odometry.norm_squared()
}

/// By how much ln η̂ is off what a dense lattice has \[nats\], at each angle.
fn errors(limits: &FitLimits, hill: fn(&Pose2) -> f64) -> Vec<f64> {
    let around = Gaussian3::new(THERE, corridor()).unwrap();
    let dense = Hill::summed(&around, 16, hill).unwrap();
    let error = |angle| {
        let mode = Pose2::new(0.0, 0.0, angle).compose(&THERE);
        fit(&mode, limits, |pose| hill(&back(angle, pose))).log_integral - dense.log_integral
    };
    angles().map(error).collect()
}

/// 0.1 nats: what such hills may leave to a quadrature of degree five.
#[test]
fn of_a_bent_hill_the_integral_is_near_at_every_angle() {
    let errors = errors(&LIMITS, bent);
    assert!(errors.iter().all(|error| error.abs() < 0.1), "{errors:?}");
}

/// Robust beams are those of logs. Their tails are not seen by thirteen points: the integral is 0.39 nats short, which is why it is
/// no weight. But it is short by as much at every angle; 1e-6 nats are what rounding leaves.
#[test]
fn a_hill_of_robust_beams_is_missed_by_as_much_at_every_angle() {
    let errors = errors(&LaserMapperSettings::default().proposal().settings.limits, robust);
    assert!(errors.iter().all(|error| (error - errors[0]).abs() < 1e-6), "{errors:?}");
}
