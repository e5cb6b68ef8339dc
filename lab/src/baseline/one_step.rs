//! The posterior of one step from a pose that is known, on a dense grid: p(x_t | x_{t−1}, u_t, z_t) for one sighting of a mapped
//! landmark.
//!
//! Only the first turn and the drive need summing. The second turn has nothing to do with the place, and the heading enters the
//! bearing linearly, so its integral has a closed form. The landmark is integrated out as the filters do it, by
//! N(ν; 0, H_m Σ H_mᵀ + Q). This is what the weighted samples of [`fastslam::proposal::FromMotion`] tend to; nothing about the pose is
//! linearised.
//!
//! Moments are sums over a grid of (rot1, trans), where everything is smooth. To be looked at, places have a density: that of the
//! controls, over |trans|. It has a pole at the start, which holds no mass to speak of, and a place is reached in two ways: forwards,
//! or backwards after the opposite turn.

use core::f64::consts::{PI, TAU};
use fastslam::geometry::Pose2;
use fastslam::map::landmarks::{Innovation, Landmark};
use fastslam::motion::{Odometry, OdometryModel};
use fastslam::nalgebra::{Matrix3, Vector2, Vector3};
use fastslam::ops;
use fastslam::sensor::RangeBearing;

/// One step: where it began, what the wheels reported, and what was seen after it.
#[derive(Clone, PartialEq, Debug)]
pub struct OneStep {
    /// x_{t−1}.
    pub from: Pose2,
    /// u_t, a drive: without one there would be no density of places.
    pub control: Odometry,
    /// Noise of the odometry, not zero.
    pub motion: OdometryModel,
    /// What sees.
    pub sensor: RangeBearing,
    /// What the sighting may be of, one as likely as the other.
    pub candidates: Vec<Landmark>,
    /// The sighting (r, φ) \[m, rad\].
    pub z: Vector2<f64>,
}

/// A first turn and a drive, and what was seen after them.
struct Account {
    candidate: usize,
    /// ln p(rot1, trans, candidate, z), both in their deviations \[nats\].
    log_density: f64,
    /// Mean \[rad\] and variance \[rad²\] of the heading.
    heading: [f64; 2],
}

/// Deviations of the odometry beyond which nothing is expected.
const REACH: f64 = 6.0;

/// What is this much below the peak \[nats\] is not looked at: all of it together holds less than 10⁻⁵.
const FAINT: f64 = 16.0;

/// Steps from the middle of the grid of controls to its edge: one every fifth of a deviation. Smooth functions that are nothing at
/// the edges are summed to far more digits than that seems to promise.
const STEPS: i32 = 30;

impl OneStep {
    /// All candidates after a first turn and a drive, given in deviations from what the odometry reports.
    fn accounts(&self, [turn, drive]: [f64; 2], mut put: impl FnMut([f64; 2], Account)) {
        let [s1, st, s2] = self.motion.stds(&self.control);
        let Odometry { rot1, trans, rot2 } = self.control;
        let driven = Odometry { rot1: rot1 + turn * s1, trans: trans + drive * st, rot2 };
        let pose = driven.apply(&self.from);
        let log_prior = -0.5 * (turn * turn + drive * drive) - ops::ln(TAU * self.candidates.len() as f64);
        let free_heading = Matrix3::from_diagonal(&Vector3::new(0.0, 0.0, s2 * s2));
        for (candidate, landmark) in self.candidates.iter().enumerate() {
            let seen = landmark.innovation(&self.sensor, &pose, &self.z).with_pose(&free_heading);
            // The heading given the sighting: a Kalman update of one number by two.
            let h = seen.prediction.h_x.column(2);
            let gain = s2 * s2 * h.transpose() * seen.inverse;
            let heading = [pose.theta + (gain * seen.residual).x, s2 * s2 * (1.0 - (gain * h).x)];
            put([pose.x, pose.y], Account { candidate, log_density: log_prior + seen.log_likelihood(), heading });
        }
    }

    /// p(x, y, z | x_{t−1}, u_t) · exp(−`log_scale`) of a place.
    fn density(&self, [x, y]: [f64; 2], log_scale: f64) -> f64 {
        let [s1, st, _] = self.motion.stds(&self.control);
        let (dx, dy) = (x - self.from.x, y - self.from.y);
        let distance = ops::hypot(dx, dy).max(1e-9);
        let turn = ops::atan2(dy, dx) - self.from.theta - self.control.rot1;
        let mut sum = 0.0;
        for (turn, trans) in [(turn, distance), (turn + PI, -distance)] {
            let deviations = [ops::wrap_angle(turn) / s1, (trans - self.control.trans) / st];
            if deviations.iter().all(|d| d.abs() < REACH) {
                self.accounts(deviations, |_, account| sum += ops::exp(account.log_density - log_scale));
            }
        }
        sum / (s1 * st * distance)
    }

    /// The posterior, its densities on `side` × `side` cells around all of it that counts.
    pub fn posterior(&self, side: usize) -> Posterior {
        let spacing = REACH / f64::from(STEPS);
        let mut found: Vec<([f64; 2], Account)> = Vec::new();
        for (i, j) in (-STEPS..=STEPS).flat_map(|i| (-STEPS..=STEPS).map(move |j| (i, j))) {
            self.accounts([i, j].map(|k| f64::from(k) * spacing), |place, account| found.push((place, account)));
        }
        let peak = found.iter().map(|(_, account)| account.log_density).fold(f64::NEG_INFINITY, f64::max);
        let origin = self.control.apply(&self.from);
        let mut candidates = vec![0.0; self.candidates.len()];
        let (mut sum, mut first, mut second) = (0.0, Vector3::zeros(), Matrix3::zeros());
        for ([x, y], Account { candidate, log_density, heading: [theta, variance] }) in &found {
            let p = ops::exp(log_density - peak);
            let d = Pose2::new(*x, *y, *theta).minus(&origin);
            candidates[*candidate] += p;
            sum += p;
            first += p * d;
            second += p * (d * d.transpose());
            second.m33 += p * variance;
        }
        let mean = first / sum;
        let log_evidence = peak + ops::ln(sum * spacing * spacing);

        let [s1, st, _] = self.motion.stds(&self.control);
        let counts = found.iter().filter(|(_, account)| account.log_density > peak - FAINT);
        let area = Area::around(counts.flat_map(|([x, y], _)| {
            let margin = spacing * st.max(s1 * ops::hypot(x - self.from.x, y - self.from.y));
            [[x - margin, y - margin], [x + margin, y + margin]]
        }));
        let cells = Cells { area, side };
        let densities: Vec<f64> = (0..cells.count()).map(|k| self.density(cells.centre(k), log_evidence)).collect();
        Posterior {
            step: self.clone(),
            cells,
            level: level(&densities, side),
            densities,
            mean: origin.plus(&mean),
            covariance: second / sum - mean * mean.transpose(),
            log_evidence,
            candidates: candidates.into_iter().map(|p| p / sum).collect(),
        }
    }
}

/// N_eff / M of samples of a Gaussian motion that one sighting weighs, where all is linear and the sighting is the one expected:
/// 1 / ρ = √(|Q_j| |Q_j + 2 H_x R_t H_xᵀ|) / |L| with L = Q_j + H_x R_t H_xᵀ, for the innovation at the motion's mean and R_t
/// (3 × 3, \[m, m, rad\]).
///
/// It is E\[w\]² / E\[w²\] of the weight w = N(z; h(x), Q_j): a normal density squared is one of half the variance, so that
/// E\[w\] = N(0; 0, L) and E\[w²\] = |4π Q_j|^(−1/2) N(0; 0, Q_j / 2 + H_x R_t H_xᵀ).
pub fn predicted_ess(innovation: &Innovation, motion: &Matrix3<f64>) -> f64 {
    let Innovation { given_pose, prediction, .. } = innovation;
    let of_motion = prediction.h_x * motion * prediction.h_x.transpose();
    let [once, twice] = [1.0, 2.0].map(|times| (given_pose + of_motion * times).determinant());
    (given_pose.determinant() * twice).sqrt() / once
}

/// A rectangle of the world.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Area {
    /// Its corner of least x and y \[m\].
    pub low: [f64; 2],
    /// Its corner of largest x and y \[m\].
    pub high: [f64; 2],
}

impl Area {
    /// The smallest that holds these points.
    pub fn around(points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        let none = Self { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] };
        points.into_iter().fold(none, |Self { low, high }, [x, y]| Self {
            low: [low[0].min(x), low[1].min(y)],
            high: [high[0].max(x), high[1].max(y)],
        })
    }
}

/// `side` × `side` cells that divide an area, row by row from the least y.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Cells {
    /// All of them.
    pub area: Area,
    /// Cells in a row, and in a column.
    pub side: usize,
}

impl Cells {
    /// How many there are.
    pub fn count(&self) -> usize {
        self.side * self.side
    }

    /// Width and height of one \[m\].
    pub fn size(&self) -> [f64; 2] {
        let Area { low, high } = self.area;
        [0, 1].map(|axis| (high[axis] - low[axis]) / self.side as f64)
    }

    /// The middle of the k-th \[m\].
    pub fn centre(&self, k: usize) -> [f64; 2] {
        let (size, [i, j]) = (self.size(), [k % self.side, k / self.side]);
        [self.area.low[0] + size[0] * (i as f64 + 0.5), self.area.low[1] + size[1] * (j as f64 + 0.5)]
    }
}

/// p(x_t | x_{t−1}, u_t, z_t).
#[derive(Clone, PartialEq, Debug)]
pub struct Posterior {
    step: OneStep,
    /// Where the densities were taken.
    pub cells: Cells,
    /// Density of (x, y) in the middle of each cell \[1/m²\].
    pub densities: Vec<f64>,
    /// Mean; the heading's is that of differences from the pose that the odometry alone gives.
    pub mean: Pose2,
    /// Covariance (3 × 3, \[m, m, rad\]).
    pub covariance: Matrix3<f64>,
    /// ln p(z | x_{t−1}, u_t) \[nats\].
    pub log_evidence: f64,
    /// Probability that the sighting is of each candidate.
    pub candidates: Vec<f64>,
    /// Least density \[1/m²\] in the region of highest density of (x, y) that holds 90 %.
    pub level: f64,
}

impl Posterior {
    /// Share of the posterior in its region.
    pub const REGION: f64 = 0.9;

    /// Whether a place is in the region of highest density that holds 90 %.
    pub fn in_region(&self, place: [f64; 2]) -> bool {
        self.step.density(place, self.log_evidence) >= self.level
    }
}

/// The density above which there is [`Posterior::REGION`] of all.
///
/// Whole cells would be too coarse: which of those at the edge count is a matter of luck, worth half a percent. So densities are
/// taken to be spread evenly over a cell, as far up and down as its neighbours' differ.
fn level(densities: &[f64], side: usize) -> f64 {
    let half_range = |k: usize| {
        let at = |k: Option<usize>| k.and_then(|k| densities.get(k)).copied().unwrap_or(0.0);
        let across = |step: usize| at(k.checked_sub(step)) - at(Some(k + step));
        0.25 * ops::hypot(across(1), across(side))
    };
    let spread: Vec<[f64; 2]> =
        densities.iter().enumerate().map(|(k, d)| [d - half_range(k), d + half_range(k)]).collect();
    let above = |level: f64| -> f64 {
        let part = |[low, high]: &[f64; 2]| match level {
            _ if level <= *low => 0.5 * (low + high),
            _ if level >= *high => 0.0,
            _ => 0.5 * (high * high - level * level) / (high - low),
        };
        spread.iter().map(part).sum()
    };
    let wanted = Posterior::REGION * densities.iter().sum::<f64>();
    let (mut low, mut high) = (0.0, densities.iter().copied().fold(0.0, f64::max));
    for _ in 0..24 {
        let middle = 0.5 * (low + high);
        if above(middle) > wanted { low = middle } else { high = middle }
    }
    low
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastslam::nalgebra::Matrix2;

    fn step(scale: f64, candidates: &[[f64; 2]]) -> OneStep {
        let landmark = |[x, y]: &[f64; 2]| Landmark {
            mean: Vector2::new(*x, *y),
            covariance: Matrix2::identity() * 0.01,
            existence_count: 1,
            apart: 0,
        };
        OneStep {
            from: Pose2::new(0.3, -0.2, 0.4),
            control: Odometry { rot1: 0.2, trans: 1.0, rot2: 0.1 },
            motion: OdometryModel { alphas: [0.1, 0.02, 0.08, 0.02] }.scaled(scale),
            sensor: RangeBearing { range_std: 0.08, bearing_std: 0.05, max_range: 10.0, field_of_view: TAU },
            candidates: candidates.iter().map(landmark).collect(),
            z: Vector2::new(2.2, 0.1),
        }
    }

    /// What is held against sums over the three noises of the odometry themselves: no density of places, no closed form.
    /// What is left out beyond six deviations is 10⁻⁹, and what the sums miss between their points is less.
    #[test]
    fn the_grid_agrees_with_brute_force_over_the_controls() {
        for (scale, candidates) in [(1.0, &[[3.0, 1.2]][..]), (2.0, &[[3.0, 1.2]]), (1.5, &[[3.0, 1.2], [2.3, 1.0]])] {
            let step = step(scale, candidates);
            let [s1, st, s2] = step.motion.stds(&step.control);
            let (n, spacing) = (40, 0.15);
            let (mut sum, mut first, mut second) = (0.0, Vector3::zeros(), Matrix3::zeros());
            let mut shares = vec![0.0; candidates.len()];
            let origin = step.control.apply(&step.from);
            for (a, b, c) in (-n..=n).flat_map(|a| (-n..=n).flat_map(move |b| (-n..=n).map(move |c| (a, b, c)))) {
                let [a, b, c] = [a, b, c].map(|k| f64::from(k) * spacing);
                let Odometry { rot1, trans, rot2 } = step.control;
                let driven = Odometry { rot1: rot1 + a * s1, trans: trans + b * st, rot2: rot2 + c * s2 };
                let pose = driven.apply(&step.from);
                let prior = ops::exp(-0.5 * (a * a + b * b + c * c)) / (TAU * TAU.sqrt()) * spacing * spacing * spacing;
                for (share, landmark) in shares.iter_mut().zip(&step.candidates) {
                    let log_likelihood = landmark.innovation(&step.sensor, &pose, &step.z).log_likelihood();
                    let p = prior * ops::exp(log_likelihood) / candidates.len() as f64;
                    let d = pose.minus(&origin);
                    *share += p;
                    sum += p;
                    first += p * d;
                    second += p * d * d.transpose();
                }
            }
            let posterior = step.posterior(8);
            let (mean, near) = (first / sum, 1e-6);
            let covariance = second / sum - mean * mean.transpose();
            assert!(
                (posterior.log_evidence - ops::ln(sum)).abs() < near,
                "{} {}",
                posterior.log_evidence,
                ops::ln(sum)
            );
            for i in 0..3 {
                let deviation = covariance[(i, i)].sqrt();
                let off = posterior.mean.minus(&origin)[i] - mean[i];
                assert!(off.abs() < near * deviation, "mean {i}: {off}");
                for j in 0..3 {
                    let off = posterior.covariance[(i, j)] - covariance[(i, j)];
                    assert!(off.abs() < near * deviation * covariance[(j, j)].sqrt(), "{i}, {j}: {off}");
                }
            }
            for (share, p) in shares.iter().zip(&posterior.candidates) {
                assert!((share / sum - p).abs() < near, "{} {p}", share / sum);
            }
        }
    }

    /// One number that is moved and seen as it is: √(1 + 2 s) / (1 + s) for a motion of s times the sighting's variance.
    #[test]
    fn of_one_number_the_predicted_ess_is_the_textbook_s() {
        let sensor = RangeBearing { range_std: 0.2, bearing_std: 0.1, max_range: 10.0, field_of_view: TAU };
        let exactly_known =
            Landmark { mean: Vector2::new(2.0, 0.0), covariance: Matrix2::zeros(), existence_count: 1, apart: 0 };
        for s in [0.0, 0.5, 3.0, 100.0_f64] {
            // Of a landmark straight ahead, x moves the range only, and θ the bearing.
            let innovation = exactly_known.innovation(&sensor, &Pose2::default(), &Vector2::new(2.0, 0.0));
            let motion = |x, theta| Matrix3::from_diagonal(&Vector3::new(x, 0.0, theta));
            let expected = (1.0 + 2.0 * s).sqrt() / (1.0 + s);
            for (motion, factors) in
                [(motion(0.04 * s, 0.0), 1), (motion(0.0, 0.01 * s), 1), (motion(0.04 * s, 0.01 * s), 2)]
            {
                let expected = if factors == 2 { expected * expected } else { expected };
                assert!((predicted_ess(&innovation, &motion) / expected - 1.0).abs() < 1e-12, "{s}");
            }
        }
    }

    /// The densities are another sum, over places: 1 up to the pole at the start, which falls between cells.
    #[test]
    fn densities_of_places_sum_to_one() {
        for (scale, candidates) in [(0.5, &[[3.0, 1.2]][..]), (2.0, &[[3.0, 1.2]]), (1.5, &[[3.0, 1.2], [2.3, 1.0]])] {
            let Posterior { cells, densities, .. } = step(scale, candidates).posterior(96);
            let [w, h] = cells.size();
            let sum = densities.iter().sum::<f64>() * w * h;
            assert!((sum - 1.0).abs() < 0.01, "{sum}");
        }
    }

    /// Counted on a grid of 300 × 300, whose own luck at the edge is a fiftieth of a percent.
    #[test]
    fn the_region_holds_nine_tenths_whatever_the_grid() {
        for candidates in [&[[3.0, 1.2]][..], &[[3.0, 1.2], [2.3, 1.0]]] {
            let fine = step(1.0, candidates).posterior(300);
            let [w, h] = fine.cells.size();
            for side in [50, 64, 80, 96] {
                let posterior = step(1.0, candidates).posterior(side);
                let inside = (0..fine.cells.count()).filter(|&k| posterior.in_region(fine.cells.centre(k)));
                let held: f64 = inside.map(|k| fine.densities[k] * w * h).sum();

                assert!((held - Posterior::REGION).abs() < 0.0015, "{side}: {held}");
            }
        }
    }
}
