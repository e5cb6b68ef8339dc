use super::*;
use fastslam::geometry::Pose2;
use fastslam::map::landmarks::Landmark;
use fastslam::motion::{Motion, Odometry, OdometryModel};
use fastslam::nalgebra::Vector2;
use fastslam::sensor::{LandmarkSensor, RangeBearing};

const SENSOR: RangeBearing =
    RangeBearing { range_std: 0.1, bearing_std: 0.04, max_range: 9.0, field_of_view: core::f64::consts::TAU };
const MAP: [[f64; 2]; 4] = [[1.0, 1.5], [2.5, -1.0], [4.0, 1.0], [5.5, -0.5]];
/// Who is seen from where: landmarks 0 and 3 never together.
const SIGHTINGS: [(usize, usize); 8] = [(1, 0), (1, 1), (2, 0), (2, 1), (2, 2), (3, 1), (3, 2), (3, 3)];

fn path() -> Vec<Pose2> {
    [[0.0, 0.0, 0.1], [1.2, 0.2, 0.3], [2.6, 0.4, -0.2], [4.0, 0.1, 0.0]].map(|[x, y, a]| Pose2::new(x, y, a)).into()
}

/// F and R_t of the motion to pose `t`, for odometry of this scale.
fn motion(t: usize, scale: f64) -> (Matrix3<f64>, Matrix3<f64>) {
    let (from, u) = (path()[t - 1], Odometry::between(&path()[t - 1], &path()[t]));
    let model = OdometryModel { alphas: [0.1, 0.02, 0.08, 0.02] }.scaled(scale);
    let floor = Matrix3::identity() * 1e-10;
    (model.jacobian(&from, &u), model.covariance(&from, &u) + floor)
}

fn seen(t: usize, j: usize) -> Prediction {
    SENSOR.predict(&path()[t], &Vector2::from(MAP[j]))
}

fn information(scale: f64) -> InformationMatrix {
    let mut information = InformationMatrix::new(3, 4);
    for t in 1..=3 {
        let (jacobian, noise) = motion(t, scale);
        information.add_odometry(t, &jacobian, &noise);
    }
    for (t, j) in SIGHTINGS {
        information.add_observation(t, j, &seen(t, j), &SENSOR.noise());
    }
    information
}

fn pairs() -> impl Iterator<Item = (usize, usize)> {
    (0..4).flat_map(|i| (0..i).map(move |j| (i, j)))
}

/// Gauss and Jordan's elimination with the larger pivot: shares nothing with Cholesky's.
fn brute_inverse(m: &DMatrix<f64>) -> DMatrix<f64> {
    let n = m.nrows();
    let (mut a, mut b) = (m.clone(), DMatrix::<f64>::identity(n, n));
    for k in 0..n {
        let pivot = (k..n).max_by(|&i, &j| a[(i, k)].abs().total_cmp(&a[(j, k)].abs())).unwrap();
        a.swap_rows(k, pivot);
        b.swap_rows(k, pivot);
        let scale = a[(k, k)];
        for c in 0..n {
            a[(k, c)] /= scale;
            b[(k, c)] /= scale;
        }
        for r in (0..n).filter(|&r| r != k) {
            let factor = a[(r, k)];
            for c in 0..n {
                a[(r, c)] -= factor * a[(k, c)];
                b[(r, c)] -= factor * b[(k, c)];
            }
        }
    }
    b
}

#[test]
fn marginals_are_blocks_of_the_inverse_of_the_whole_matrix() {
    for scale in [0.3, 1.0, 3.0] {
        let information = information(scale);
        let whole = brute_inverse(information.matrix());
        let marginal = information.marginal().unwrap();
        assert!((marginal.matrix() - whole.view_range(9.., 9..)).norm() < 1e-9, "{scale}");
        for (t, covariance) in information.path(information.poses).unwrap().iter().enumerate() {
            assert!((covariance - whole.fixed_view::<3, 3>(3 * t, 3 * t)).norm() < 1e-9, "{scale}: pose {t}");
        }
    }
}

/// EKF-SLAM with the Jacobians held at the truth is the same linear case: it keeps the covariance of (x_t, m) and forgets
/// the poses before.
#[test]
fn the_marginal_is_the_map_covariance_of_a_kalman_filter_over_pose_and_map() {
    let (mut p, mut mapped) = (DMatrix::<f64>::zeros(11, 11), [false; 4]);
    for t in 1..=3 {
        let (jacobian, noise) = motion(t, 1.0);
        let mut f = DMatrix::<f64>::identity(11, 11);
        f.fixed_view_mut::<3, 3>(0, 0).copy_from(&jacobian);
        p = &f * p * f.transpose();
        let mut corner = p.fixed_view_mut::<3, 3>(0, 0);
        corner += noise;
        for (_, j) in SIGHTINGS.into_iter().filter(|s| s.0 == t) {
            let (Prediction { h_x, h_m, .. }, at) = (seen(t, j), 3 + 2 * j);
            let mut h = DMatrix::<f64>::zeros(2, 11);
            h.fixed_view_mut::<2, 3>(0, 0).copy_from(&h_x);
            if mapped[j] {
                h.fixed_view_mut::<2, 2>(0, at).copy_from(&h_m);
                let s = &h * &p * h.transpose() + SENSOR.noise();
                let gain = &p * h.transpose() * s.try_inverse().unwrap();
                p = (DMatrix::identity(11, 11) - gain * h) * p;
            } else {
                // m = H_m⁻¹ (z − H_x x − noise): a linear function of what is known already.
                mapped[j] = true;
                let back = h_m.try_inverse().unwrap();
                let mut g = DMatrix::<f64>::identity(11, 11);
                g.view_mut((at, 0), (2, 11)).copy_from(&(-back * &h));
                p = &g * p * g.transpose();
                let mut own = p.fixed_view_mut::<2, 2>(at, at);
                own += back * SENSOR.noise() * back.transpose();
            }
        }
    }
    assert!((information(1.0).marginal().unwrap().matrix() - p.view_range(3.., 3..)).norm() < 1e-12);
}

#[test]
fn given_the_path_every_landmark_is_a_filter_of_its_own() {
    let conditional = information(1.0).conditional().unwrap();
    for (j, at) in MAP.into_iter().enumerate() {
        let mut alone: Option<Landmark> = None;
        for (t, _) in SIGHTINGS.into_iter().filter(|s| s.1 == j) {
            let (pose, z) = (path()[t], SENSOR.predict(&path()[t], &Vector2::from(at)).z);
            match &mut alone {
                None => alone = Some(Landmark::first(&SENSOR, &pose, &z)),
                Some(landmark) => landmark.update(&SENSOR, &pose, &z),
            }
        }
        let difference = conditional.block(j, j) - alone.unwrap().covariance;
        assert!(difference.norm() < 1e-9 * conditional.block(j, j).norm(), "{j}: {difference}");
    }
}

#[test]
fn given_the_path_every_entry_outside_the_blocks_is_exactly_zero() {
    for scale in [0.0, 1.0, 3.0] {
        let (marginal, conditional) =
            (information(scale).marginal().unwrap(), information(scale).conditional().unwrap());
        assert_eq!((marginal.off_block_nonzeros(), conditional.off_block_nonzeros()), (4 * 3 * 4, 0));
        for (i, j) in pairs() {
            assert_eq!((conditional.block(i, j), conditional.coupling(i, j)), (Matrix2::zeros(), 0.0));
        }
    }
}

#[test]
fn landmarks_never_seen_together_are_correlated_all_the_same() {
    assert!(information(1.0).marginal().unwrap().coupling(0, 3) > 0.1);
}

#[test]
fn couplings_grow_with_the_noise_of_the_odometry_and_vanish_without() {
    let at = |scale| information(scale).marginal().unwrap();
    let maps = [0.0, 0.03, 0.1, 0.3, 1.0].map(at);
    for (i, j) in pairs() {
        assert!(maps[0].coupling(i, j) < 1e-6, "{}", maps[0].coupling(i, j));
        assert!(maps.windows(2).all(|w| w[0].coupling(i, j) < w[1].coupling(i, j)), "{i}, {j}");
    }
}

#[test]
fn the_coupling_is_the_largest_correlation_of_any_two_directions() {
    let map = information(1.0).marginal().unwrap();
    for (i, j) in pairs() {
        let direction = |k: u32| {
            let (sin, cos) = fastslam::ops::sin_cos(f64::from(k) * core::f64::consts::PI / 400.0);
            Vector2::new(cos, sin)
        };
        let variance = |k: usize, a: &Vector2<f64>| a.dot(&(map.block(k, k) * a));
        let mut largest = 0.0_f64;
        for (a, b) in (0..400).flat_map(|a| (0..400).map(move |b| (direction(a), direction(b)))) {
            let rho = a.dot(&(map.block(i, j) * b)) / (variance(i, &a) * variance(j, &b)).sqrt();
            largest = largest.max(rho.abs());
        }
        let coupling = map.coupling(i, j);
        // Directions half a degree apart miss the largest by a few in 10 000.
        assert!(largest <= coupling + 1e-12 && largest > coupling - 1e-3, "{i}, {j}: {largest}, {coupling}");
        assert!((map.coupling(j, i) - coupling).abs() < 1e-12);
        for (a, b) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            assert!(map.correlation(2 * i + a, 2 * j + b).abs() <= coupling + 1e-12);
        }
    }
}

#[test]
fn a_landmark_that_was_never_sighted_has_no_covariance() {
    let mut information = InformationMatrix::new(1, 1);
    let (jacobian, noise) = motion(1, 1.0);
    information.add_odometry(1, &jacobian, &noise);
    assert_eq!(
        (information.marginal(), information.conditional(), information.path(information.poses)),
        (None, None, None)
    );
}
