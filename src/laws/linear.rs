//! A world in which everything is linear and Gaussian, and the Kalman filter that is exact there: the limit of every filter with landmarks.
//!
//! A proposal that takes any motion and any sensor of landmarks is tested with [`Drift`] and [`Offset`] in their places.

use super::STANDARD_ERRORS;
use super::proposal::Step;
use crate::execute::Executor;
use crate::geometry::{Pose2, sample_semidefinite};
use crate::map::landmarks::{Correspondence, Landmark, Landmarks};
use crate::motion::{GaussianMotion, Motion};
use crate::ops;
use crate::particle::Particle;
use crate::proposal::Proposal;
use crate::random::{Purpose, Stream};
use crate::rbpf::Rbpf;
use crate::resampling::ResamplePolicy;
use crate::sensor::{Feature, LandmarkSensor, Prediction};
use nalgebra::{DMatrix, DVector, Matrix2, Matrix2x3, Matrix3, Vector2, Vector3};

/// A `#[test]` of every law in [`laws::linear`](crate::laws::linear): `kalman_laws!(name, proposal)` makes a module `name`. `proposal` is a
/// [`Proposal`](crate::proposal::Proposal) for maps of type `Landmarks<Offset>` that moves by [`Drift`](crate::laws::linear::Drift).
///
/// ```
/// use fastslam::laws::linear::Drift;
/// use fastslam::proposal::{FromMeasurement, FromMotion, Marginal};
///
/// fastslam::kalman_laws!(first, FromMotion { motion: Drift, likelihood: Marginal });
/// fastslam::kalman_laws!(second, FromMeasurement { motion: Drift });
/// ```
#[macro_export]
macro_rules! kalman_laws {
    ($name:ident, $proposal:expr $(,)?) => {
        $crate::tests_of_laws!(
            $name,
            linear,
            [
                with_many_particles_it_is_the_kalman_filter,
                the_evidence_has_no_bias,
                the_error_shrinks_with_the_root_of_the_number_of_particles,
            ],
            (&$proposal)
        );
    };
}

/// x′ = x + u + noise, all in the world’s frame.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Drift;

/// R of [`Drift`] \[m, m, rad\].
const R: Matrix3<f64> = Matrix3::new(0.04, 0.01, 0.005, 0.01, 0.03, -0.004, 0.005, -0.004, 0.01);

impl Motion for Drift {
    type Control = Vector3<f64>;

    fn apply(&self, from: &Pose2, u: &Vector3<f64>) -> Pose2 {
        from.plus(u)
    }

    fn sample(&self, from: &Pose2, u: &Vector3<f64>, stream: &mut Stream) -> Pose2 {
        sample_semidefinite(&self.apply(from, u), &R, stream)
    }

    fn covariance(&self, _: &Pose2, _: &Vector3<f64>) -> Matrix3<f64> {
        R
    }

    fn jacobian(&self, _: &Pose2, _: &Vector3<f64>) -> Matrix3<f64> {
        Matrix3::identity()
    }
}

impl GaussianMotion for Drift {}

/// z = m − (x, y) + noise \[m, m\], in the world’s frame.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Offset;

/// Q of [`Offset`] \[m²\].
const Q: Matrix2<f64> = Matrix2::new(0.05, 0.01, 0.01, 0.04);

impl LandmarkSensor for Offset {
    fn predict(&self, at: &Pose2, landmark: &Vector2<f64>) -> Prediction {
        Prediction {
            z: landmark - Vector2::new(at.x, at.y),
            h_x: Matrix2x3::new(-1.0, 0.0, 0.0, 0.0, -1.0, 0.0),
            h_m: Matrix2::identity(),
        }
    }

    fn residual(&self, z: &Vector2<f64>, predicted: &Vector2<f64>) -> Vector2<f64> {
        z - predicted
    }

    fn locate(&self, at: &Pose2, z: &Vector2<f64>) -> Vector2<f64> {
        z + Vector2::new(at.x, at.y)
    }

    fn noise(&self) -> Matrix2<f64> {
        Q
    }

    fn sees(&self, _: &Pose2, _: &Vector2<f64>, _: f64) -> bool {
        true
    }
}

/// Steps of a [`drive`].
pub const STEPS: u32 = 5;

/// What happened in that world: every step’s control and sightings of the first `landmarks` landmarks, always the same.
pub fn drive(landmarks: u32) -> Vec<(Vector3<f64>, Vec<Feature>)> {
    let mut pose = Pose2::default();
    let mut step = |k| {
        let mut stream = Stream::at(5, Purpose::TRIAL, k, 0);
        let u = Vector3::new(0.5, 0.1 * f64::from(k), 0.05);
        pose = Drift.sample(&pose, &u, &mut stream);
        let see = |j| {
            let landmark = Vector2::new(2.0 + f64::from(j), 1.0 - f64::from(j * j));
            let z = sample_semidefinite(&Pose2::default(), &Q.fixed_resize(0.0), &mut stream);
            Feature { z: Offset.predict(&pose, &landmark).z + Vector2::new(z.x, z.y), signature: Some(j) }
        };
        (u, (0..landmarks).map(see).collect())
    };
    (0..STEPS).map(&mut step).collect()
}

/// The first step of that drive, by a robot that knows two landmarks. This world has a north: it does not turn, it only moves.
pub fn one_step(world: &Pose2) -> Step<Landmarks<Offset>, Vector3<f64>> {
    let covariance = Matrix2::new(0.02, 0.005, 0.005, 0.03);
    let known = [(2.0, 1.0), (3.0, 0.0)].map(|(x, y)| Vector2::new(world.x + x, world.y + y));
    let known = known.map(|mean| Landmark { mean, covariance, existence_count: 1, apart: 0 });
    let (control, observation) = drive(2).remove(0);
    let start = Pose2::new(world.x, world.y, 0.0);
    Step { particle: Particle::start(start, empty().with(known)), control, observation }
}

/// What the Kalman filter knows.
///
/// ```
/// let exact = fastslam::laws::linear::Exact::after(2);
/// assert_eq!(exact.mean.len(), 3 + 2 * 2);
/// assert!((exact.mean[3] - 2.0).abs() < 1.0, "the first landmark is at (2, 1)");
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct Exact {
    /// Pose (x, y, θ) and the landmarks, two numbers each \[m, m, rad, m, …\].
    pub mean: DVector<f64>,
    /// Its covariance.
    pub covariance: DMatrix<f64>,
    /// ln p(z₁..T) \[nats\]; a first sighting, of a place of which nothing was known, adds nothing.
    pub log_evidence: f64,
}

impl Exact {
    /// The Kalman filter of pose and landmarks after a [`drive`] past so many landmarks.
    pub fn after(landmarks: u32) -> Self {
        Self::of(&drive(landmarks))
    }

    /// The same after these steps.
    fn of(drive: &[(Vector3<f64>, Vec<Feature>)]) -> Self {
        let mut exact = Self { mean: DVector::zeros(3), covariance: DMatrix::zeros(3, 3), log_evidence: 0.0 };
        for (u, features) in drive {
            exact.moved(u);
            for (index, feature) in features.iter().enumerate() {
                if 3 + 2 * index < exact.mean.len() { exact.seen(index, &feature.z) } else { exact.found(&feature.z) }
            }
        }
        exact
    }

    /// x ← x + u, P ← P + R.
    fn moved(&mut self, u: &Vector3<f64>) {
        let mut pose = self.mean.fixed_rows_mut::<3>(0);
        pose += u;
        let mut p = self.covariance.fixed_view_mut::<3, 3>(0, 0);
        p += R;
    }

    /// A landmark at m = (x, y) + z, which errs with the pose, and by Q.
    fn found(&mut self, z: &Vector2<f64>) {
        let n = self.mean.len();
        let mut g = DMatrix::identity(n + 2, n);
        g.fixed_view_mut::<2, 2>(n, 0).copy_from(&Matrix2::identity());
        self.mean = &g * &self.mean;
        self.covariance = &g * &self.covariance * g.transpose();
        let mut landmark = self.mean.fixed_rows_mut::<2>(n);
        landmark += z;
        let mut p = self.covariance.fixed_view_mut::<2, 2>(n, n);
        p += Q;
    }

    /// The update by z = m − (x, y) + noise.
    fn seen(&mut self, index: usize, z: &Vector2<f64>) {
        let mut h = DMatrix::zeros(2, self.mean.len());
        h.fixed_view_mut::<2, 2>(0, 0).copy_from(&-Matrix2::identity());
        h.fixed_view_mut::<2, 2>(0, 3 + 2 * index).copy_from(&Matrix2::identity());
        let residual = z - &h * &self.mean;
        let p_h = &self.covariance * h.transpose();
        let s = Matrix2::from_iterator((&h * &p_h).iter().copied()) + Q;
        let inverse = s.try_inverse().expect("Q is positive definite");
        let quadratic = residual.dot(&(inverse * residual));
        self.log_evidence -= 0.5 * (quadratic + ops::ln(s.determinant())) + ops::ln(core::f64::consts::TAU);
        let gain = p_h * inverse;
        self.mean += &gain * residual;
        self.covariance = &self.covariance - gain * h * &self.covariance;
    }

    /// Mean and covariance of the pose and of the first landmark, and the log of the evidence: 15 numbers.
    fn moments(&self) -> [f64; 15] {
        let (x, p) = (&self.mean, &self.covariance);
        let first = |k: usize| Vector2::new(x[k], x[k + 1]);
        let pose = Vector3::new(x[0], x[1], x[2]);
        let (p, s) = (p.fixed_view::<3, 3>(0, 0).into_owned(), p.fixed_view::<2, 2>(3, 3).into_owned());
        moments(&pose, &p, &first(3), &s, self.log_evidence)
    }
}

/// What the Rauch–Tung–Striebel smoother knows after a [`drive`] past so many landmarks, 1 or more: mean and covariance of the pose of every
/// step from 1 on together with the landmarks, as [`Exact`] has them, given everything that was ever seen.
///
/// With F = 1: G = P_t P⁻_{t+1}⁻¹, x̂_t = x_t + G (x̂_{t+1} − x⁻_{t+1}), P̂_t = P_t + G (P̂_{t+1} − P⁻_{t+1}) Gᵀ.
///
/// ```
/// use fastslam::laws::linear::{Exact, STEPS, smoothed};
/// let steps = smoothed(1);
/// let (last, exact) = (&steps[STEPS as usize - 1], Exact::after(1));
/// assert_eq!((&last.0, &last.1), (&exact.mean, &exact.covariance), "nothing is seen after the last step");
/// ```
pub fn smoothed(landmarks: u32) -> Vec<(DVector<f64>, DMatrix<f64>)> {
    let drive = drive(landmarks);
    let filtered: Vec<Exact> = (1..=drive.len()).map(|steps| Exact::of(&drive[..steps])).collect();
    let last = &filtered[filtered.len() - 1];
    let mut smoothed = vec![(last.mean.clone(), last.covariance.clone())];
    for (now, (u, _)) in filtered.iter().zip(&drive[1..]).rev() {
        let mut predicted = now.clone();
        predicted.moved(u);
        let inverse = predicted.covariance.clone().try_inverse().expect("R and Q are positive definite");
        let gain = &now.covariance * inverse;
        let (mean, covariance) = &smoothed[smoothed.len() - 1];
        let mean = &now.mean + &gain * (mean - predicted.mean);
        let covariance = &now.covariance + &gain * (covariance - predicted.covariance) * gain.transpose();
        smoothed.push((mean, covariance));
    }
    smoothed.reverse();
    smoothed
}

fn moments(pose: &Vector3<f64>, p: &Matrix3<f64>, m: &Vector2<f64>, s: &Matrix2<f64>, log_evidence: f64) -> [f64; 15] {
    [pose.x, pose.y, pose.z, p.m11, p.m12, p.m13, p.m22, p.m23, p.m33, m.x, m.y, s.m11, s.m12, s.m22, log_evidence]
}

fn empty() -> Landmarks<Offset> {
    Landmarks::new(Offset, Correspondence::Known)
}

fn filter<P>(proposal: &P, policy: ResamplePolicy, seed: u64, count: usize) -> Rbpf<Landmarks<Offset>, P>
where
    P: Proposal<Landmarks<Offset>, Control = Vector3<f64>> + Clone,
{
    let filter = Rbpf::builder(empty(), proposal.clone()).particles(count).seed(seed).policy(policy);
    filter.executor(Executor::Serial).build().expect("all settings are in range")
}

/// The same numbers of a population after the drive past one landmark, less those of the Kalman filter; of the evidence the ratio less
/// one, which has no bias.
fn errors<P>(proposal: &P, policy: ResamplePolicy, seed: u64, count: usize) -> [f64; 15]
where
    P: Proposal<Landmarks<Offset>, Control = Vector3<f64>> + Clone,
{
    let mut filter = filter(proposal, policy, seed, count);
    let log_evidence = drive(1).iter().map(|(u, features)| filter.step(u, features).log_evidence).sum();
    let weighted = || {
        let parts = filter.particles().iter().zip(filter.weights().as_slice());
        parts.map(|(p, w)| (p.world_from_robot.minus(&Pose2::default()), *p.map.get(0).expect("it was seen"), *w))
    };
    let pose: Vector3<f64> = weighted().map(|(x, _, w)| x * w).sum();
    let p: Matrix3<f64> = weighted().map(|(x, _, w)| (x - pose) * (x - pose).transpose() * w).sum();
    let mean: Vector2<f64> = weighted().map(|(_, landmark, w)| landmark.mean * w).sum();
    let spread = |landmark: Landmark| landmark.covariance + (landmark.mean - mean) * (landmark.mean - mean).transpose();
    let s: Matrix2<f64> = weighted().map(|(_, landmark, w)| spread(landmark) * w).sum();
    let (exact, of) = (Exact::after(1).moments(), moments(&pose, &p, &mean, &s, log_evidence));
    let mut errors: [f64; 15] = core::array::from_fn(|k| of[k] - exact[k]);
    errors[14] = ops::exp(errors[14]) - 1.0;
    errors
}

/// The population of a filter is p(x_t, m | z₁..ₜ, u₁..ₜ): means and covariances of pose and landmark, and the evidence, are those of the
/// Kalman filter, whether it resamples or not.
///
/// n = 20 filters of 10 000 particles. The standard error of a mean over filters comes from their scatter; |t| < 6.1 is α = 7 · 10⁻⁶ for each
/// of 30 numbers (Student’s t with 19 degrees of freedom). The bias of a weighted mean is 1/M_eff of a deviation, a tenth of the standard
/// error.
///
/// ```no_run
/// // A million steps: in a test, with `opt-level = 2` in its profile.
/// # use fastslam::{laws::linear, proposal::FromMeasurement};
/// linear::with_many_particles_it_is_the_kalman_filter(&FromMeasurement { motion: linear::Drift });
/// ```
pub fn with_many_particles_it_is_the_kalman_filter<P>(proposal: &P)
where
    P: Proposal<Landmarks<Offset>, Control = Vector3<f64>> + Clone,
{
    for policy in [ResamplePolicy::Never, ResamplePolicy::EssBelow(0.9)] {
        let errors: Vec<[f64; 15]> = (0..20).map(|seed| errors(proposal, policy, seed, 10_000)).collect();
        for k in 0..15 {
            let mean = errors.iter().map(|e| e[k]).sum::<f64>() / 20.0;
            let variance = errors.iter().map(|e| (e[k] - mean) * (e[k] - mean)).sum::<f64>() / 19.0;
            let t = mean / (variance / 20.0).sqrt();
            assert!(t.abs() < 6.1, "{policy}, number {k}: {mean} is {t} standard errors");
            // Not vacuous: filters of 10 000 agree.
            assert!(variance < 0.05 * 0.05, "{policy}, number {k}: scatters by {}", variance.sqrt());
        }
    }
}

/// E ∏ p̂(z_t | z₁..ₜ₋₁) = p(z₁..T), however few the particles are and whenever they resample.
///
/// Few, because whatever is biased is so by 1/M: n = 10 000 filters of 8 particles, 4.5 standard errors for each of three policies.
///
/// # Panics
/// Also where the mean of the logarithms, which has a bias, is not told from that: then nothing has been shown.
///
/// ```no_run
/// // A million steps: in a test, with `opt-level = 2` in its profile.
/// # use fastslam::{laws::linear, proposal::{FromMotion, Marginal}};
/// linear::the_evidence_has_no_bias(&FromMotion { motion: linear::Drift, likelihood: Marginal });
/// ```
pub fn the_evidence_has_no_bias<P>(proposal: &P)
where
    P: Proposal<Landmarks<Offset>, Control = Vector3<f64>> + Clone,
{
    const N: u32 = 10_000;
    let (log, exact) = (drive(2), Exact::after(2).log_evidence);
    for policy in [ResamplePolicy::Never, ResamplePolicy::Always, ResamplePolicy::EssBelow(0.9)] {
        let mut resampled = 0;
        let mut ratio = |seed| {
            let mut filter = filter(proposal, policy, seed, 8);
            let mut log_evidence = -exact;
            for (u, features) in &log {
                let report = filter.step(u, features);
                log_evidence += report.log_evidence;
                resampled += u32::from(report.ancestors.is_some());
            }
            ops::exp(log_evidence)
        };
        let ratios: Vec<f64> = (0..N.into()).map(&mut ratio).collect();
        let mean_of = |of: &dyn Fn(f64) -> f64| ratios.iter().map(|r| of(*r)).sum::<f64>() / f64::from(N);
        let mean = mean_of(&|r| r);
        let error = (mean_of(&|r| (r - mean) * (r - mean)) / f64::from(N)).sqrt();
        let of = format!("{policy}, {resampled} steps resampled: {mean} ± {error} of the evidence");
        assert!((mean - 1.0).abs() < STANDARD_ERRORS * error, "{of}");
        assert!(mean_of(&ops::ln) < -STANDARD_ERRORS * error, "{of}: the mean of logarithms is no lower");
        let expected = match policy {
            ResamplePolicy::Never => 0..=0,
            ResamplePolicy::Always => N * STEPS..=N * STEPS,
            ResamplePolicy::EssBelow(_) => N * STEPS / 20..=N * STEPS * 19 / 20,
        };
        assert!(expected.contains(&resampled), "{of}");
    }
}

/// Errors are as 1 / √M.
///
/// n = 40 filters of 400 and of 10 000 particles: √25 = 5. The root mean square of four independent numbers over 40 filters has a relative
/// standard error of 1/√320, the quotient of two of √2 as much, 0.08: from 3.6 to 6.9 is ± 4 of it in logarithms.
///
/// ```no_run
/// // A million steps: in a test, with `opt-level = 2` in its profile.
/// # use fastslam::{laws::linear, proposal::FromMeasurement};
/// linear::the_error_shrinks_with_the_root_of_the_number_of_particles(&FromMeasurement { motion: linear::Drift });
/// ```
pub fn the_error_shrinks_with_the_root_of_the_number_of_particles<P>(proposal: &P)
where
    P: Proposal<Landmarks<Offset>, Control = Vector3<f64>> + Clone,
{
    let exact = Exact::after(1).moments();
    let rms = |count| {
        // x and y of the pose and of the landmark, each in its own deviations.
        let square = |e: [f64; 15]| [(0, 3), (1, 6), (9, 11), (10, 13)].map(|(k, s)| e[k] * e[k] / exact[s]);
        let squares = (0..40).flat_map(|seed| square(errors(proposal, ResamplePolicy::EssBelow(0.9), seed, count)));
        (squares.sum::<f64>() / 160.0).sqrt()
    };
    let ratio = rms(400) / rms(10_000);
    assert!((3.6..6.9).contains(&ratio), "errors of 400 particles are {ratio} times those of 10 000");
}
