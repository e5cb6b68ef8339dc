//! Laws of the smoother: where all is linear and Gaussian, against the Rauch–Tung–Striebel smoother of pose and map.

use fastslam::execute::Executor;
use fastslam::geometry::Pose2;
use fastslam::laws::linear::{self, Drift, Offset, STEPS};
use fastslam::map::landmarks::{Correspondence, Landmarks};
use fastslam::motion::Motion;
use fastslam::proposal::{FromMeasurement, FromMotion, Marginal, Proposal, Retrace};
use fastslam::random::{Purpose, Stream};
use fastslam::rbpf::Rbpf;
use fastslam::resampling::ResamplePolicy;
use fastslam::sensor::LandmarkSensor;
use fastslam::smoothing::{Draw, Reconnect, Settings, Smoother, distinct, moments, traced};
use nalgebra::{Cholesky, DMatrix, DVector, Dyn, Matrix2, Matrix3, Vector3};

type Map = Landmarks<Offset>;

const FIRST: FromMotion<Drift, Marginal> = FromMotion { motion: Drift, likelihood: Marginal };
const SECOND: FromMeasurement<Drift> = FromMeasurement { motion: Drift };

fn smoother<P>(proposal: &P, landmarks: u32, settings: Settings) -> Smoother<Map, P>
where
    P: Retrace<Map> + Proposal<Map, Control = Vector3<f64>> + Clone,
{
    let (controls, observations): (Vec<_>, Vec<_>) = linear::drive(landmarks).into_iter().unzip();
    let map = Landmarks::new(Offset, Correspondence::Known);
    Smoother::new(settings, map, proposal.clone(), Pose2::default(), controls, observations).unwrap()
}

/// Settings of these tests: small sweeps, many of them.
fn few(particles: usize, seed: u64, reconnect: Reconnect) -> Settings {
    Settings { particles, seed, reconnect, executor: Executor::Serial }
}

/// p(x₁..T, m | z₁..T) by the normal equations of all poses and landmarks at once, to draw from: no recursion, no gain.
struct Posterior {
    mean: DVector<f64>,
    covariance: DMatrix<f64>,
    cholesky: Cholesky<f64, Dyn>,
}

impl Posterior {
    fn of(landmarks: u32) -> Self {
        let (r, q) = (Drift.covariance(&Pose2::default(), &Vector3::zeros()), Offset.noise());
        let poses = 3 * STEPS as usize;
        let n = poses + 2 * landmarks as usize;
        let (mut information, mut vector) = (DMatrix::<f64>::zeros(n, n), DVector::<f64>::zeros(n));
        let mut observe = |h: DMatrix<f64>, noise: DMatrix<f64>, z: DVector<f64>| {
            let weighted = h.transpose() * noise.try_inverse().unwrap();
            information += &weighted * h;
            vector += weighted * z;
        };
        for (k, (u, features)) in linear::drive(landmarks).iter().enumerate() {
            let mut h = DMatrix::zeros(3, n);
            h.view_mut((0, 3 * k), (3, 3)).fill_with_identity();
            if k > 0 {
                h.view_mut((0, 3 * k - 3), (3, 3)).copy_from(&-Matrix3::identity());
            }
            observe(h, DMatrix::from_iterator(3, 3, r.iter().copied()), DVector::from_iterator(3, u.iter().copied()));
            for (j, feature) in features.iter().enumerate() {
                let mut h = DMatrix::zeros(2, n);
                h.view_mut((0, 3 * k), (2, 2)).copy_from(&-Matrix2::identity());
                h.view_mut((0, poses + 2 * j), (2, 2)).fill_with_identity();
                let noise = DMatrix::from_iterator(2, 2, q.iter().copied());
                observe(h, noise, DVector::from_iterator(2, feature.z.iter().copied()));
            }
        }
        let covariance = information.try_inverse().unwrap();
        let mean = &covariance * vector;
        Self { mean, cholesky: Cholesky::new(covariance.clone()).unwrap(), covariance }
    }

    /// A path drawn from it.
    fn path(&self, trial: u32) -> Vec<Pose2> {
        let mut stream = Stream::at(11, Purpose::TRIAL, trial, 0);
        let epsilon = DVector::from_fn(self.mean.len(), |_, _| stream.normal());
        let x = &self.mean + self.cholesky.l() * epsilon;
        let pose = |k: usize| Pose2::new(x[3 * k], x[3 * k + 1], x[3 * k + 2]);
        core::iter::once(Pose2::default()).chain((0..STEPS as usize).map(pose)).collect()
    }

    /// Mean and variance of a number.
    fn at(&self, k: usize) -> [f64; 2] {
        [self.mean[k], self.covariance[(k, k)]]
    }
}

/// What is compared, of one draw, less what it is to be: the numbers of each pose with their squares and some products, and those of the
/// first landmark, whose map brings a mean and a covariance of its own.
fn deviations(exact: &Posterior, draw: &Draw<Map>) -> Vec<f64> {
    let numbers: Vec<f64> = draw.path[1..].iter().flat_map(|pose| [pose.x, pose.y, pose.theta]).collect();
    let d = |k: usize| numbers[k] - exact.mean[k];
    let n = numbers.len();
    let first = (0..n).map(d);
    let second = (0..n).map(|k| d(k) * d(k) - exact.covariance[(k, k)]);
    // Neighbouring numbers, and the same number a step apart.
    let products =
        (0..n - 3).flat_map(|k| [(k, k + 1), (k, k + 3)]).map(|(i, j)| d(i) * d(j) - exact.covariance[(i, j)]);
    let landmark = draw.map.get(0).unwrap();
    let of_landmark = (0..2).flat_map(|k| {
        let ([mean, variance], here) = (exact.at(n + k), landmark.mean[k]);
        let d = here - mean;
        [d, d * d + landmark.covariance[(k, k)] - variance]
    });
    first.chain(second).chain(products).chain(of_landmark).collect()
}

/// Largest |t| of the means of these rows.
fn largest_t(rows: &[Vec<f64>]) -> (f64, usize) {
    let n = rows.len() as f64;
    let t = |k: usize| {
        let mean = rows.iter().map(|row| row[k]).sum::<f64>() / n;
        let variance = rows.iter().map(|row| (row[k] - mean) * (row[k] - mean)).sum::<f64>() / (n - 1.0);
        mean / (variance / n).sqrt()
    };
    (0..rows[0].len()).map(|k| (t(k).abs(), k)).fold((0.0, 0), |top, t| if t.0 > top.0 { t } else { top })
}

/// To 1e-10, as the numbers of condition are below 1e3.
#[test]
fn the_smoother_of_rauch_tung_and_striebel_solves_the_normal_equations() {
    for landmarks in 1..=3 {
        let (steps, exact) = (linear::smoothed(landmarks), Posterior::of(landmarks));
        let poses = 3 * STEPS as usize;
        for (k, (mean, covariance)) in steps.iter().enumerate() {
            let place = |i: usize| if i < 3 { 3 * k + i } else { poses + i - 3 };
            for i in 0..mean.len() {
                assert!((mean[i] - exact.mean[place(i)]).abs() < 1e-10);
                for j in 0..mean.len() {
                    assert!((covariance[(i, j)] - exact.covariance[(place(i), place(j))]).abs() < 1e-10);
                }
            }
        }
    }
}

/// A path that was drawn from the posterior is, after a sweep, a path drawn from the posterior, with two particles as with five.
///
/// n = 20 000 paths, drawn exactly, one sweep each: 4.9 standard errors for each of 58 numbers are α = 6 · 10⁻⁵ for all together.
fn a_sweep_leaves_the_posterior_as_it_is<P>(proposal: &P, particles: usize, reconnect: Reconnect) -> f64
where
    P: Retrace<Map> + Proposal<Map, Control = Vector3<f64>> + Clone,
{
    const N: u32 = 20_000;
    let (exact, smoother) = (Posterior::of(1), smoother(proposal, 1, few(particles, 3, reconnect)));
    let mut moved = 0;
    let rows: Vec<Vec<f64>> = (0..N)
        .map(|trial| {
            let path = exact.path(trial);
            let draw = smoother.sweep(trial, &path).unwrap();
            moved += u32::from(draw.path[1] != path[1]);
            deviations(&exact, &draw)
        })
        .collect();
    let (t, number) = largest_t(&rows);
    println!("M = {particles}, {reconnect:?}: |t| ≤ {t:.2} (number {number}), {moved} of {N} moved at step 1");
    // Not vacuous: the paths are not those that were put in.
    assert!(moved > N / 10, "{moved}");
    t
}

#[test]
fn a_sweep_by_the_motion_leaves_the_posterior_as_it_is() {
    for particles in [2, 5] {
        assert!(a_sweep_leaves_the_posterior_as_it_is(&FIRST, particles, Reconnect::Whole) < 4.9);
    }
}

#[test]
fn a_sweep_by_the_measurement_leaves_the_posterior_as_it_is() {
    for particles in [2, 5] {
        assert!(a_sweep_leaves_the_posterior_as_it_is(&SECOND, particles, Reconnect::Whole) < 4.9);
    }
}

#[test]
fn particle_gibbs_without_new_ancestors_leaves_it_too() {
    assert!(a_sweep_leaves_the_posterior_as_it_is(&SECOND, 5, Reconnect::Never) < 4.9);
}

/// Means and covariances over the sweeps of a chain that begins at the filter's own path are those of the Rauch–Tung–Striebel smoother.
///
/// n = 24 chains of 400 sweeps, of which the first 20 are left out; the standard error is from the scatter over the chains. |t| < 6.5 is
/// α = 1.2 · 10⁻⁶ for each of 58 numbers (Student's t with 23 degrees of freedom), 7 · 10⁻⁵ for all together.
fn chains_have_the_moments_of_the_exact_smoother<P>(proposal: &P, landmarks: u32)
where
    P: Retrace<Map> + Proposal<Map, Control = Vector3<f64>> + Clone,
{
    const CHAINS: u64 = 24;
    const SWEEPS: u64 = 400;
    const BURNT: u64 = 20;
    let exact = Posterior::of(landmarks);
    let chain = |seed: u64| {
        let smoother = smoother(proposal, landmarks, few(6, seed, Reconnect::Whole));
        let mut path = filtered(proposal, landmarks, 6, seed).particles()[0].path.poses();
        let mut sum: Vec<f64> = Vec::new();
        for sweep in 0..SWEEPS {
            let draw = smoother.sweep(sweep as u32, &path).unwrap();
            if sweep >= BURNT {
                let of = deviations(&exact, &draw);
                sum.resize(of.len(), 0.0);
                sum.iter_mut().zip(of).for_each(|(sum, x)| *sum += x / (SWEEPS - BURNT) as f64);
            }
            path = draw.path;
        }
        sum
    };
    let rows: Vec<Vec<f64>> = (0..CHAINS).map(chain).collect();
    let (t, number) = largest_t(&rows);
    println!("{landmarks} landmarks: |t| ≤ {t:.2} (number {number})");
    assert!(t < 6.5, "number {number} is {t} standard errors off");
    // Not vacuous: chains agree to a third of a standard deviation.
    for k in 0..3 * STEPS as usize {
        let variance = rows.iter().map(|row| row[k] * row[k]).sum::<f64>() / CHAINS as f64;
        assert!(variance < 0.1 * exact.covariance[(k, k)], "number {k} scatters by {}", variance.sqrt());
    }
}

#[test]
fn chains_by_the_motion_have_the_moments_of_the_exact_smoother() {
    chains_have_the_moments_of_the_exact_smoother(&FIRST, 1);
}

#[test]
fn chains_by_the_measurement_have_the_moments_of_the_exact_smoother() {
    chains_have_the_moments_of_the_exact_smoother(&SECOND, 1);
    chains_have_the_moments_of_the_exact_smoother(&SECOND, 2);
}

fn filtered<P>(proposal: &P, landmarks: u32, particles: usize, seed: u64) -> Rbpf<Map, P>
where
    P: Proposal<Map, Control = Vector3<f64>> + Clone,
{
    let map = Landmarks::new(Offset, Correspondence::Known);
    let filter = Rbpf::builder(map, proposal.clone()).particles(particles).seed(seed).policy(ResamplePolicy::Always);
    let mut filter = filter.executor(Executor::Serial).build().unwrap();
    for (u, features) in linear::drive(landmarks) {
        filter.step(&u, &features);
    }
    filter
}

/// A population's paths are traced by its weights; what there is to trace is its descent.
#[test]
fn traced_paths_are_those_of_the_ancestry_by_their_weights() {
    const N: usize = 20_000;
    let filter = {
        let map: Map = Landmarks::new(Offset, Correspondence::Known);
        let filter = Rbpf::builder(map, FIRST).particles(6).seed(2).policy(ResamplePolicy::Never);
        let mut filter = filter.executor(Executor::Serial).build().unwrap();
        for (u, features) in &linear::drive(1)[..2] {
            filter.step(u, features);
        }
        filter
    };
    let paths = traced(&filter, N, &mut Stream::at(1, Purpose::TRIAL, 0, 0));
    for (particle, weight) in filter.particles().iter().zip(filter.weights().as_slice()) {
        let share = paths.iter().filter(|path| path.id() == particle.path.id()).count() as f64 / N as f64;
        // 4.5 standard errors of a share.
        assert!((share - weight).abs() <= 4.5 * (weight * (1.0 - weight) / N as f64).sqrt(), "{share} {weight}");
    }
    let traced: Vec<Vec<Pose2>> = paths.iter().map(|path| path.poses()).collect();
    assert!(distinct(&traced).iter().zip(filter.descent().widths()).all(|(traced, width)| *traced <= width));
    let (mean, _) = moments(&traced)[2];
    assert!(mean.minus(&filter.estimate().mean).norm() < 0.02);
}

/// 1 − 1/M of the sweeps change a pose when weights are even, whatever its step (Lindsten, Jordan, Schön 2014, figure 2): far from the end,
/// particle Gibbs without ancestor sampling changes it hardly ever.
#[test]
fn reconnected_paths_are_renewed_at_every_step_and_kept_ones_at_the_last_alone() {
    // Nothing is seen on the way: what is left is the arithmetic of ancestors.
    let controls: Vec<Vector3<f64>> = (0..12).flat_map(|_| linear::drive(1)).map(|(u, _)| u).collect();
    let observations = vec![Vec::new(); controls.len()];
    let rate = |reconnect| {
        let map: Map = Landmarks::new(Offset, Correspondence::Known);
        let (settings, start) = (few(5, 1, reconnect), Pose2::default());
        let smoother = Smoother::new(settings, map, FIRST, start, controls.clone(), observations.clone()).unwrap();
        let mut path = vec![start];
        controls.iter().for_each(|u| path.push(Drift.apply(&path[path.len() - 1], u)));
        let mut renewed = [0_u32; 2];
        for sweep in 0..500 {
            let next = smoother.sweep(sweep, &path).unwrap().path;
            renewed[0] += u32::from(next[1] != path[1]);
            renewed[1] += u32::from(next[controls.len()] != path[controls.len()]);
            path = next;
        }
        renewed.map(|renewed| f64::from(renewed) / 500.0)
    };
    let ([early, late], [kept, end]) = (rate(Reconnect::Whole), rate(Reconnect::Never));
    println!("reconnected: {early} at the first step, {late} at the last; kept: {kept} and {end}");
    // 500 sweeps: ± 0.08 is 4.5 standard errors of a share of 0.8.
    assert!((late - 0.8).abs() < 0.08 && (end - 0.8).abs() < 0.08);
    assert!(early > 0.6 && kept < 0.1, "{early} {kept}");
}

#[test]
fn sweeps_are_the_same_by_whomever_they_are_computed() {
    let path = filtered(&SECOND, 2, 9, 4).particles()[0].path.poses();
    let sweep = |executor| {
        let settings = Settings { executor, ..few(9, 4, Reconnect::Whole) };
        let draw = smoother(&SECOND, 2, settings).sweep(7, &path).unwrap();
        (draw.path, draw.updates, draw.reconnected)
    };
    assert_eq!(sweep(Executor::Serial), sweep(Executor::default()));
    let other = smoother(&SECOND, 2, few(9, 4, Reconnect::Whole)).sweep(8, &path).unwrap().path;
    assert_ne!(sweep(Executor::Serial).0, other, "another sweep has draws of its own");
}

/// M T of the filter, and M (T − t) more at each step but the first.
#[test]
fn a_sweep_counts_what_it_costs() {
    let path = filtered(&SECOND, 1, 6, 4).particles()[0].path.poses();
    let updates = |reconnect| smoother(&SECOND, 1, few(6, 0, reconnect)).sweep(0, &path).unwrap().updates;
    assert_eq!(updates(Reconnect::Never), 6 * 5);
    assert_eq!(updates(Reconnect::Within(2)), 6 * 5 + 6 * (2 + 2 + 2 + 1));
    assert_eq!(updates(Reconnect::Whole), 6 * 5 + 6 * (4 + 3 + 2 + 1));
    assert_eq!(updates(Reconnect::Within(9)), updates(Reconnect::Whole));
}

#[test]
fn what_cannot_be_smoothed_is_refused_by_name() {
    let refused = |settings: Settings| {
        let (controls, observations): (Vec<_>, Vec<_>) = linear::drive(1).into_iter().unzip();
        let map: Map = Landmarks::new(Offset, Correspondence::Known);
        let observations = if settings.seed == 9 { Vec::new() } else { observations };
        Smoother::new(settings, map, FIRST, Pose2::default(), controls, observations).unwrap_err().to_string()
    };
    assert_eq!(refused(few(1, 0, Reconnect::Whole)), "particles = 1: must be a whole number from 2 to 4294967295");
    assert!(refused(few(2, 0, Reconnect::Within(0))).starts_with("reconnect = 0: "));
    assert_eq!(refused(few(2, 9, Reconnect::Whole)), "observations: must be one for each control");
    let smoother = smoother(&FIRST, 1, few(2, 0, Reconnect::Whole));
    let far = vec![Pose2::new(f64::NAN, 0.0, 0.0); STEPS as usize + 1];
    assert!(smoother.sweep(0, &far).unwrap_err().to_string().starts_with("path: must be the start"));
    let mut path = far;
    path[0] = Pose2::default();
    assert!(smoother.sweep(0, &path).unwrap_err().to_string().starts_with("path: must be one that the motion can"));
}
