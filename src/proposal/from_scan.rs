//! The measurement-aware proposal for grids: look first, then move.
//!
//! Reference: Grisetti, Stachniss, Burgard, *Improved techniques for grid mapping with Rao-Blackwellized particle filters*,
//! T-RO 2007, §IV and algorithm 1.

use super::{FromMotion, Proposal, ProposalTrace, Proposed};
use crate::geometry::{Gaussian3, Pose2};
use crate::map::grid::{Grid, View};
use crate::matching::{Climb, ClimbSteps, ScanModel, climb};
use crate::motion::{Odometry, OdometryModel};
use crate::ops;
use crate::random::Stream;
use crate::rbpf::Particle;
use crate::sensor::Scan;
use nalgebra::{Matrix3, Vector3};

/// Where a climb begins. A type for each way: a program that searches in one only is without the other.
pub trait Search {
    /// Starts of the climb, and the mean log-likelihood that its end must beat \[nats\].
    fn starts<const FINE: usize>(&self, target: &Target<'_, FINE>, stream: &mut Stream) -> (Vec<Climb>, f64);
}

/// At the best of the odometry's prediction and so many poses spread over the prior's heading: enough where a step's error is
/// about as wide as a square of the map.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Spread {
    /// Poses besides the prediction.
    pub seeds: u32,
}

/// At the best poses of a lattice over the whole prior, judged coarsely (after the correlative matching of Olson 2009): for
/// odometry that is off by several squares.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Lattice {
    /// Step along each axis \[m\].
    pub linear: f64,
    /// Step of the heading \[rad\].
    pub angular: f64,
    /// The lattice looks at every n-th beam.
    pub stride: usize,
    /// How many of the best poses, a step or more apart, are climbed from.
    pub climbs: usize,
}

/// Settings of [`FromScan`].
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct FromScanSettings<S> {
    /// Floor of the motion Gaussian's standard deviations \[m, m, rad\].
    pub motion_floor: [f64; 3],
    /// Where the climb begins.
    pub search: S,
    /// Step sizes of the hill climb.
    pub climb: ClimbSteps,
    /// The climb looks at every n-th beam.
    pub climb_stride: usize,
    /// How much better than the mean likelihood over the search the best must be for the matcher to be trusted \[nats\].
    pub gain: f64,
    /// Motion \[m, or rad of turns\] from which on a scan weighs in full. After a shorter one it weighs in proportion: scans taken
    /// from nearly one place repeat each other's errors, and ten a second would choose between particles by them.
    pub full_weight: f64,
    /// Number of probes K.
    pub probes: u32,
    /// Limits of the standard deviations of the probes along each axis \[m, m, rad\]: least and most.
    pub probe_stds: [[f64; 3]; 2],
}

/// A search reaches this many standard deviations of the prior to each side. Heading is what a climb is lost
/// by: a few degrees more, and far end points fall on the wrong wall.
const SPREAD: f64 = 3.0;

/// Most steps of a lattice to each side, of position and of heading: an absurd motion must not hang a reader's page.
const MOST_STEPS: [f64; 2] = [8.0, 24.0];

/// How far from the prediction a match may lie \[m\] and be looked up fast.
const SLACK: f64 = 1.0;

/// The gmapping recipe: find the mode, probe around it, fit a Gaussian, sample it, pay the normaliser η.
#[derive(Clone, Debug)]
pub struct FromScan<S> {
    /// The models, and what is done where the matcher fails.
    pub fallback: FromMotion<OdometryModel, ScanModel>,
    /// Tuning.
    pub settings: FromScanSettings<S>,
}

impl<S: Search + Sync, const FINE: usize> Proposal<Grid<FINE>> for FromScan<S> {
    type Control = Odometry;

    // anchor: propose
    fn propose(&self, particle: &Particle<Grid<FINE>>, u: &Odometry, scan: &Scan, stream: &mut Stream) -> Proposed<()> {
        let settings = &self.settings;
        // ANCHOR: predict
        let prior = self.fallback.motion.gaussian(&particle.world_from_robot, u, settings.motion_floor);
        // ANCHOR_END: predict
        let reach = scan.hits.iter().map(|[x, y]| x * x + y * y).fold(0.0, f64::max).sqrt();
        let view = View::new(&particle.map, [prior.mean().x, prior.mean().y], reach + SLACK);
        // The search looks at a thinner scan, in which each beam counts for those left out.
        let thin = scan.thinned(settings.climb_stride);
        let (likelihood, share) = (&self.fallback.likelihood, settings.climb_stride as f64);
        let target = Target { prior: &prior, likelihood, view, scan, thin, share, gain: settings.gain };

        // ANCHOR: seeds
        // Starts of the climb, and the mean likelihood that its end must beat.
        let (starts, log_mean) = settings.search.starts(&target, stream);
        // ANCHOR_END: seeds
        // ANCHOR: match
        let climbs = starts
            .into_iter()
            .map(|start| climb(start, settings.climb, |pose, floor| target.log_posterior(pose, floor)));
        let top = climbs.reduce(|best, end| if end.value > best.value { end } else { best });
        // ANCHOR_END: match

        // ANCHOR: guard
        // The guard: on a flat score surface the optimum is noise, no better than what the motion model would draw anyway.
        let Some(top) = top.filter(|top| top.value - prior.log_density(&top.pose) - log_mean >= settings.gain) else {
            return self.fallback.propose(particle, u, scan, stream);
        };
        // ANCHOR_END: guard
        let mode = Climb { pose: top.pose, value: target.log_value(&top.pose) };

        // Probes around the mode, as wide as the target is there; each weighs τ_k = target / density of the probes.
        // ANCHOR: probe
        let around = self.probe_gaussian(&mode, &target);
        let probes: Vec<(Pose2, f64)> = (0..settings.probes)
            .map(|_| around.sample(stream))
            .map(|pose| (pose, target.log_value(&pose) - around.log_density(&pose)))
            .collect();
        let log_taus: Vec<f64> = probes.iter().map(|(_, log_tau)| *log_tau).collect();
        let log_sum = ops::log_sum_exp(&log_taus);
        // ANCHOR_END: probe

        // μ and Σ of the weighted probes, as differences from the mode (angles wrapped).
        // ANCHOR: fit
        let (mut mu, mut second) = (Vector3::zeros(), Matrix3::zeros());
        for (pose, log_tau) in &probes {
            let (d, tau) = (pose.minus(&mode.pose), ops::exp(log_tau - log_sum));
            mu += d * tau;
            second += d * d.transpose() * tau;
        }
        let floor = Matrix3::from_diagonal(&Vector3::from(settings.probe_stds[0].map(|std| 0.25 * std * std)));
        let sigma = second - mu * mu.transpose() + floor;
        let Some(fitted) = Gaussian3::new(mode.pose.plus(&mu), sigma) else {
            return self.fallback.propose(particle, u, scan, stream);
        };
        // ANCHOR_END: fit
        // ANCHOR: eta
        let log_eta = log_sum - ops::ln(f64::from(settings.probes));
        let motion = u.trans.abs() + u.rot1.abs() + u.rot2.abs();
        let share = if motion < settings.full_weight { motion / settings.full_weight } else { 1.0 };
        // ANCHOR_END: eta
        Proposed {
            // ANCHOR: draw
            world_from_robot: fitted.sample(stream),
            // ANCHOR_END: draw
            association: (),
            log_increment: share * log_eta,
            trace: ProposalTrace::Matched { mode: mode.pose },
        }
    }
    // end: propose
}

/// What a search looks for: a pose that explains the scan and the motion.
pub struct Target<'a, const FINE: usize> {
    prior: &'a Gaussian3,
    likelihood: &'a ScanModel,
    view: View<'a, FINE>,
    scan: &'a Scan,
    /// A part of the scan, of which each beam counts for `share`.
    thin: Scan,
    share: f64,
    /// [`FromScanSettings::gain`].
    gain: f64,
}

impl<const FINE: usize> Target<'_, FINE> {
    /// ln p(z | x, m) + ln N(x), of the whole scan.
    fn log_value(&self, pose: &Pose2) -> f64 {
        self.likelihood.log_likelihood_above(f64::NEG_INFINITY, &self.view, pose, self.scan)
            + self.prior.log_density(pose)
    }

    /// ln p(z | x, m) by the thinner scan; need not be exact at or below `floor`.
    fn log_thin(&self, pose: &Pose2, floor: f64) -> f64 {
        self.share * self.likelihood.log_likelihood_above(floor / self.share, &self.view, pose, &self.thin)
    }

    /// The same with the prior.
    fn log_posterior(&self, pose: &Pose2, floor: f64) -> f64 {
        let log_prior = self.prior.log_density(pose);
        log_prior + self.log_thin(pose, floor - log_prior)
    }
}

impl Search for Spread {
    /// One start on the right slope, and the mean over all poses looked at.
    fn starts<const FINE: usize>(&self, target: &Target<'_, FINE>, stream: &mut Stream) -> (Vec<Climb>, f64) {
        let prior = target.prior;
        let mut log_seeds = vec![target.log_thin(prior.mean(), f64::NEG_INFINITY)];
        let mut best = Climb { pose: *prior.mean(), value: log_seeds[0] + prior.log_density(prior.mean()) };
        for k in 0..self.seeds {
            let heading = SPREAD * ((f64::from(k) + 0.5) / f64::from(self.seeds) * 2.0 - 1.0);
            let [a, b] = stream.normals();
            let pose = prior.at([heading, a, b]);
            let log_seed = target.log_thin(&pose, f64::NEG_INFINITY);
            log_seeds.push(log_seed);
            let value = log_seed + prior.log_density(&pose);
            if value > best.value {
                best = Climb { pose, value };
            }
        }
        (vec![best], ops::log_sum_exp(&log_seeds) - ops::ln(log_seeds.len() as f64))
    }
}

impl Search for Lattice {
    /// Starts of which each is worth a climb.
    fn starts<const FINE: usize>(&self, target: &Target<'_, FINE>, _: &mut Stream) -> (Vec<Climb>, f64) {
        let start = |pose: Pose2| Climb { pose, value: target.log_posterior(&pose, f64::NEG_INFINITY) };
        (self.poses(target).into_iter().map(start).collect(), f64::NEG_INFINITY)
    }
}

impl Lattice {
    /// The best poses of the lattice, apart from each other; none where all of it looks alike.
    fn poses<const FINE: usize>(&self, target: &Target<'_, FINE>) -> Vec<Pose2> {
        let Self { linear, angular, stride, climbs } = *self;
        let Target { prior, likelihood, view, scan, .. } = target;
        // Each of the few beams counts for those left out.
        let few = scan.thinned(stride);
        let share = scan.hits.len() as f64 / few.hits.len().max(1) as f64;
        let mean = prior.mean();
        let steps = |variance: f64, step: f64, most: f64| (SPREAD * variance.sqrt() / step).ceil().min(most) as i32;
        let covariance = prior.covariance();
        let [columns, rows] = [covariance.m11, covariance.m22].map(|v| steps(v, linear, MOST_STEPS[0]));
        let turns = steps(covariance.m33, angular, MOST_STEPS[1]);
        let least = prior.log_density(mean) - 0.5 * SPREAD * SPREAD;
        let (mut found, mut log_likelihoods) = (Vec::new(), Vec::new());
        for turn in -turns..=turns {
            let theta = ops::wrap_angle(mean.theta + f64::from(turn) * angular);
            // Turned once for all shifts.
            let (sin, cos) = ops::sin_cos(theta);
            let k = view.per_square();
            let turn = |[x, y]: &[f64; 2]| [k * (cos * x - sin * y), k * (sin * x + cos * y)];
            let turned: Vec<[f64; 2]> = few.hits.iter().map(turn).collect();
            for (row, column) in (-rows..=rows).flat_map(|row| (-columns..=columns).map(move |column| (row, column))) {
                let [x, y] = [mean.x + f64::from(column) * linear, mean.y + f64::from(row) * linear];
                let pose = Pose2 { x, y, theta };
                let log_prior = prior.log_density(&pose);
                if log_prior >= least {
                    let log_likelihood = share * likelihood.coarse(view, &turned, [x, y]);
                    found.push((log_prior + log_likelihood, pose));
                    log_likelihoods.push(log_likelihood);
                }
            }
        }
        let best = log_likelihoods.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let log_mean = ops::log_sum_exp(&log_likelihoods) - ops::ln(log_likelihoods.len() as f64);
        let gain = best - log_mean;
        if gain.is_nan() || gain < target.gain {
            return Vec::new();
        }
        let mut picked: Vec<Pose2> = Vec::new();
        while picked.len() < climbs {
            let apart = |pose: &Pose2| {
                picked.iter().all(|other| {
                    let d = other.minus(pose);
                    d.x.abs().max(d.y.abs()) > 1.5 * linear || d.z.abs() > 1.5 * angular
                })
            };
            // Of equal ones the first of the lattice.
            let left = found.iter().filter(|(_, pose)| apart(pose));
            let Some((_, best)) = left.reduce(|best, next| if next.0.total_cmp(&best.0).is_gt() { next } else { best })
            else {
                break;
            };
            picked.push(*best);
        }
        picked
    }
}

impl<S> FromScan<S> {
    /// A Gaussian at the mode, with standard deviations from the curvature of the target along each axis (Laplace), kept within
    /// the limits.
    fn probe_gaussian<const FINE: usize>(&self, mode: &Climb, target: &Target<'_, FINE>) -> Gaussian3 {
        let [least, most] = self.settings.probe_stds;
        let mut variances = Vector3::zeros();
        for axis in 0..3 {
            let mut step = Vector3::zeros();
            step[axis] = least[axis].max(0.25 * most[axis]);
            let drop =
                2.0 * mode.value - target.log_value(&mode.pose.plus(&step)) - target.log_value(&mode.pose.plus(&-step));
            // −f″ ≈ drop / h²; σ² = h² / drop, and a plateau takes the most.
            let std = if drop > 0.0 { (step[axis] * step[axis] / drop).sqrt() } else { most[axis] };
            let std = std.max(least[axis]).min(most[axis]);
            variances[axis] = std * std;
        }
        Gaussian3::new(mode.pose, Matrix3::from_diagonal(&variances)).expect("limits of probe_stds are positive")
    }
}
