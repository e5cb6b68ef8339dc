//! Laws of motion models.
//!
//! Each takes a model and cases: poses x to start from, and controls u. Let there be one of each kind: straight ahead, an arc, a turn
//! on the spot, standing still.

use super::{Estimate, STANDARD_ERRORS, TURNS, rounding, size, turn3};
use crate::geometry::Pose2;
use crate::motion::Motion;
use crate::ops;
use crate::random::{Purpose, Stream};
use nalgebra::{Matrix3, Vector3};

/// A `#[test]` of every law in [`laws::motion`](crate::laws::motion): `motion_laws!(name, model, cases)` makes a module `name`; `model` is a
/// [`Motion`](crate::motion::Motion) and `cases` an array or a vector of (pose, control).
///
/// For a motion that is given in the world's frame, and so knows where north is, write the tests without
/// [`turning_the_world_turns_the_motion`](crate::laws::motion::turning_the_world_turns_the_motion) yourself.
///
/// ```
/// use fastslam::geometry::Pose2;
/// use fastslam::motion::{Odometry, OdometryModel};
///
/// const MODEL: OdometryModel = OdometryModel { alphas: [0.01, 0.002, 0.008, 0.002] };
/// const CASE: (Pose2, Odometry) = (Pose2 { x: 1.0, y: 2.0, theta: 0.5 }, Odometry { rot1: 0.2, trans: 1.0, rot2: 0.1 });
///
/// fastslam::motion_laws!(odometry, MODEL, [CASE]);
/// ```
#[macro_export]
macro_rules! motion_laws {
    ($name:ident, $motion:expr, $cases:expr $(,)?) => {
        $crate::tests_of_laws!(
            $name,
            motion,
            [
                the_jacobian_is_the_derivative,
                the_covariance_is_symmetric_and_positive_semidefinite,
                samples_have_mean_and_covariance,
                the_gaussian_has_mean_covariance_and_floor,
                without_noise_a_sample_is_the_motion_itself,
                turning_the_world_turns_the_motion,
                a_robot_travels_at_least_as_far_as_it_gets,
            ],
            (&$motion, &$cases)
        );
    };
}

/// `jacobian` is ∂g/∂x: J e_k = (g(x + h e_k, u) − g(x − h e_k, u)) / 2h, with h = 10⁻⁵.
///
/// To 10⁻⁸ of the numbers’ size: rounding leaves 10⁻¹⁶ / h, the third derivative h² / 6, and both are a hundred times less.
///
/// ```
/// # use fastslam::{geometry::Pose2, laws, motion::{Odometry, OdometryModel}};
/// # let model = OdometryModel { alphas: [0.01, 0.002, 0.008, 0.002] };
/// # let u = Odometry { rot1: 0.2, trans: 1.0, rot2: 0.1 };
/// laws::motion::the_jacobian_is_the_derivative(&model, &[(Pose2::new(1.0, 2.0, 0.5), u)]);
/// ```
pub fn the_jacobian_is_the_derivative<D: Motion>(motion: &D, cases: &[(Pose2, D::Control)]) {
    let h = 1e-5;
    for (k, (from, u)) in cases.iter().enumerate() {
        let (jacobian, tolerance) =
            (motion.jacobian(from, u), 1e-8 * (1.0 + size(from) + size(&motion.apply(from, u))));
        for axis in 0..3 {
            let mut step = Vector3::zeros();
            step[axis] = h;
            let difference = motion.apply(&from.plus(&step), u).minus(&motion.apply(&from.plus(&-step), u)) / (2.0 * h);
            let error = (jacobian.column(axis) - difference).norm();
            assert!(error < tolerance, "case {k}: column {axis} of the Jacobian is off by {error}: {difference}");
        }
    }
}

/// `covariance` is finite, R = Rᵀ, and vᵀ R v ≥ 0 for every v, but for rounding.
///
/// ```
/// # use fastslam::{geometry::Pose2, laws, motion::{Odometry, OdometryModel}};
/// # let model = OdometryModel { alphas: [0.01, 0.002, 0.008, 0.002] };
/// # let u = Odometry { rot1: 0.2, trans: 1.0, rot2: 0.1 };
/// laws::motion::the_covariance_is_symmetric_and_positive_semidefinite(&model, &[(Pose2::default(), u)]);
/// ```
pub fn the_covariance_is_symmetric_and_positive_semidefinite<D: Motion>(motion: &D, cases: &[(Pose2, D::Control)]) {
    for (k, (from, u)) in cases.iter().enumerate() {
        let r = motion.covariance(from, u);
        let tolerance = rounding(0.0) * r.trace().abs();
        assert!(r.iter().all(|x| x.is_finite()), "case {k}: {r}");
        assert!((r - r.transpose()).amax() <= tolerance, "case {k}: not symmetric: {r}");
        let least = r.symmetric_eigenvalues().min();
        assert!(least >= -tolerance, "case {k}: not positive semidefinite, an eigenvalue is {least}: {r}");
    }
}

/// `sample` draws x_t with E x_t = g(x, u) and Cov x_t = R, to first order in the noise; and one stream gives one sample.
///
/// n = 10 000 draws of each case. Means are held to 4.5 standard errors √(R_ii / n) and tr R, covariances to 4.5 standard errors
/// √((R_ii R_jj + R_ij²) / n) and (tr R)²: what a motion that bends adds is of second order in the standard deviations, and of fourth.
///
/// # Panics
/// Also where tr R is 0.05 or more: with so much noise first order says little. Test the model with less.
///
/// ```
/// # use fastslam::{geometry::Pose2, laws, motion::{Odometry, OdometryModel}};
/// # let model = OdometryModel { alphas: [0.01, 0.002, 0.008, 0.002] };
/// # let u = Odometry { rot1: 0.2, trans: 1.0, rot2: 0.1 };
/// laws::motion::samples_have_mean_and_covariance(&model, &[(Pose2::new(1.0, 2.0, 0.5), u)]);
/// ```
pub fn samples_have_mean_and_covariance<D: Motion>(motion: &D, cases: &[(Pose2, D::Control)]) {
    const N: u32 = 10_000;
    for (k, (from, u)) in (0..).zip(cases) {
        let (mean, r) = (motion.apply(from, u), motion.covariance(from, u));
        let second_order = r.trace();
        assert!(second_order < 0.05, "case {k}: tr R = {second_order}: give a model of less noise");
        let stream = |slot| Stream::at(1, Purpose::TRIAL, k, slot);
        let draw = |slot| motion.sample(from, u, &mut stream(slot)).minus(&mean);
        assert_eq!(draw(0), draw(0), "case {k}: one stream gave two samples");
        let draws: Vec<Vector3<f64>> = (0..N).map(draw).collect();
        let mean_of = |value: &dyn Fn(&Vector3<f64>) -> f64| Estimate::of(draws.iter().map(|d| (value(d), 1.0))).mean;
        for i in 0..3 {
            let (mean, error) = (mean_of(&|d| d[i]), (r[(i, i)] / f64::from(N)).sqrt());
            let most = STANDARD_ERRORS * error + second_order + rounding(size(from));
            assert!(mean.abs() <= most, "case {k}: the mean of axis {i} is off by {mean}, and may be by {most}");
            for j in 0..=i {
                let squares = r[(i, i)] * r[(j, j)] + r[(i, j)] * r[(i, j)];
                let off = mean_of(&|d| d[i] * d[j]) - r[(i, j)];
                let most =
                    STANDARD_ERRORS * (squares / f64::from(N)).sqrt() + second_order * second_order + rounding(0.0);
                assert!(
                    off.abs() <= most,
                    "case {k}: covariance ({i}, {j}) is {} and that of the samples {off} more",
                    r[(i, j)]
                );
            }
        }
    }
}

/// `gaussian` is N(g(x, u), R + diag(floor²)).
///
/// To 10⁻⁹ of the covariance: it is kept as its Cholesky factor.
///
/// ```
/// # use fastslam::{geometry::Pose2, laws, motion::{Odometry, OdometryModel}};
/// # let model = OdometryModel { alphas: [0.01, 0.002, 0.008, 0.002] };
/// # let u = Odometry { rot1: 0.2, trans: 1.0, rot2: 0.1 };
/// laws::motion::the_gaussian_has_mean_covariance_and_floor(&model, &[(Pose2::new(1.0, 2.0, 0.5), u)]);
/// ```
pub fn the_gaussian_has_mean_covariance_and_floor<D: Motion>(motion: &D, cases: &[(Pose2, D::Control)]) {
    for (k, (from, u)) in cases.iter().enumerate() {
        for floor in [[0.01, 0.02, 0.005], [0.1, 0.1, 0.1]] {
            let Some(gaussian) = motion.gaussian(from, u, floor) else {
                panic!("case {k}: no Gaussian with the floor {floor:?}");
            };
            let off = gaussian.mean().minus(&motion.apply(from, u)).norm();
            assert!(off <= rounding(size(gaussian.mean())), "case {k}: the mean is {off} from where the motion leads");
            let floor = Matrix3::from_diagonal(&Vector3::from(floor.map(|std| std * std)));
            let expected = motion.covariance(from, u) + floor;
            let off = (gaussian.covariance() - expected).norm();
            assert!(off <= 1e-9 * expected.norm(), "case {k}: the covariance is off by {off}, of {expected}");
        }
    }
}

/// Where R = 0, a sample is g(x, u). Says nothing of cases with noise.
///
/// ```
/// # use fastslam::{geometry::Pose2, laws, motion::{Odometry, OdometryModel}};
/// # let model = OdometryModel { alphas: [0.01, 0.002, 0.008, 0.002] };
/// let still = Odometry { rot1: 0.0, trans: 0.0, rot2: 0.0 };
/// laws::motion::without_noise_a_sample_is_the_motion_itself(&model, &[(Pose2::new(1.0, 2.0, 0.5), still)]);
/// ```
pub fn without_noise_a_sample_is_the_motion_itself<D: Motion>(motion: &D, cases: &[(Pose2, D::Control)]) {
    for (k, (from, u)) in (0..).zip(cases).filter(|(_, (from, u))| motion.covariance(from, u) == Matrix3::zeros()) {
        let mean = motion.apply(from, u);
        for slot in 0..100 {
            let off = motion.sample(from, u, &mut Stream::at(1, Purpose::TRIAL, k, slot)).minus(&mean).norm();
            assert!(off <= rounding(size(&mean)), "case {k}: without noise a sample is {off} off");
        }
    }
}

/// g(T ⊕ x, u) = T ⊕ g(x, u) for rigid motions T of the world, and so for samples of one stream; covariance and Jacobian turn with
/// them.
///
/// ```
/// # use fastslam::{geometry::Pose2, laws, motion::{Odometry, OdometryModel}};
/// # let model = OdometryModel { alphas: [0.01, 0.002, 0.008, 0.002] };
/// # let u = Odometry { rot1: 0.2, trans: 1.0, rot2: 0.1 };
/// laws::motion::turning_the_world_turns_the_motion(&model, &[(Pose2::new(1.0, 2.0, 0.5), u)]);
/// ```
pub fn turning_the_world_turns_the_motion<D: Motion>(motion: &D, cases: &[(Pose2, D::Control)]) {
    for (k, (from, u)) in (0..).zip(cases) {
        for world in &TURNS {
            let (moved, turn) = (world.compose(from), turn3(world));
            let sample = |from| motion.sample(from, u, &mut Stream::at(1, Purpose::TRIAL, k, 0));
            let pairs = [(motion.apply(&moved, u), motion.apply(from, u)), (sample(&moved), sample(from))];
            for (name, (there, here)) in ["the motion", "a sample"].into_iter().zip(pairs) {
                let off = there.minus(&world.compose(&here)).norm();
                assert!(off <= rounding(size(world) + size(&here)), "case {k}: {name} does not turn: off by {off}");
            }
            let covariances = [motion.covariance(&moved, u), motion.covariance(from, u)];
            let jacobians = [motion.jacobian(&moved, u), motion.jacobian(from, u)];
            for (name, [there, here]) in [("the covariance", covariances), ("the Jacobian", jacobians)] {
                let off = (there - turn * here * turn.transpose()).norm();
                let most = rounding(size(world) + size(from) + here.norm());
                assert!(off <= most, "case {k}: {name} does not turn: off by {off}");
            }
        }
    }
}

/// `travel` ≥ ‖g(0, u)‖ + |θ(g(0, u))|: metres and radians added up along the way, which is never shorter than the straight one.
///
/// ```
/// # use fastslam::{geometry::Pose2, laws, motion::{Odometry, OdometryModel}};
/// # let model = OdometryModel { alphas: [0.01, 0.002, 0.008, 0.002] };
/// # let u = Odometry { rot1: 0.2, trans: 1.0, rot2: -0.1 };
/// laws::motion::a_robot_travels_at_least_as_far_as_it_gets(&model, &[(Pose2::default(), u)]);
/// ```
pub fn a_robot_travels_at_least_as_far_as_it_gets<D: Motion>(motion: &D, cases: &[(Pose2, D::Control)]) {
    for (k, (_, u)) in cases.iter().enumerate() {
        let to = motion.apply(&Pose2::default(), u);
        let (travel, least) = (motion.travel(u), ops::hypot(to.x, to.y) + to.theta.abs());
        assert!(
            travel.is_finite() && travel >= least - rounding(least),
            "case {k}: travels {travel} and gets {least} far"
        );
    }
}
