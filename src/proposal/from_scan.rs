//! The measurement-aware proposal for grids: look first, then move.
//!
//! Reference: Grisetti, Stachniss, Burgard, *Improved techniques for grid mapping with Rao-Blackwellized particle filters*,
//! T-RO 2007, §IV and algorithm 1.

use super::{Fit, FitLimits, FromMotion, Proposal, ProposalTrace, Proposed};
use crate::geometry::{Gaussian3, Pose2};
use crate::map::grid::{Grid, LocalMap};
use crate::matching::{HillClimbSteps, ScanModel, ScoredPose, hill_climb};
use crate::motion::{Motion, Odometry, OdometryModel};
use crate::ops;
use crate::random::Stream;
use crate::rbpf::Particle;
use crate::sensor::Scan;

/// Where a climb begins. A type for each way: a program that searches in one only is without the other.
pub trait Search {
    /// Starts of the climb, and the mean log-likelihood that its end must beat \[nats\].
    fn starts<const CELLS_PER_NDT: usize>(&self, target: &Target<'_, CELLS_PER_NDT>) -> (Vec<ScoredPose>, f64);
}

/// At the best of the odometry's prediction and so many poses spread over the prior's heading: enough where a step's error is
/// about as wide as a square of the map.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct HeadingSeeds {
    /// Poses besides the prediction.
    pub seeds: u32,
    /// How many of the best are climbed from.
    pub climbs: usize,
}

/// At the best poses of a lattice over the whole prior, judged coarsely (after the correlative matching of Olson 2009): for
/// odometry that is off by several squares.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct CorrelativeSearch {
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
    pub climb: HillClimbSteps,
    /// The climb looks at every n-th beam.
    pub climb_stride: usize,
    /// How much better than the mean likelihood over the search the best must be for the matcher to be trusted \[nats\].
    pub minimum_improvement: f64,
    /// Motion \[m, or rad of turns\] from which on a scan weighs in full. After a shorter one it weighs in proportion: scans taken
    /// from nearly one place repeat each other's errors, and ten a second would choose between particles by them.
    pub full_weight: f64,
    /// Limits of the standard deviations of the fit.
    pub limits: FitLimits,
}

/// A search reaches this many standard deviations of the prior to each side. Heading is what a climb is lost
/// by: a few degrees more, and far end points fall on the wrong wall.
const SEARCH_STDS: f64 = 3.0;

/// Most steps of a lattice to each side, of position and of heading: an absurd motion must not hang a reader's page.
const MOST_STEPS: [f64; 2] = [8.0, 24.0];

/// How far from the prediction a match may lie \[m\] and be looked up fast.
const SLACK: f64 = 1.0;

/// The measurement-aware proposal of a grid: find the mode of ln p(z | x, m) + ln p(x | x′, u), fit a Gaussian there, draw from it; and
/// pay what the scan says of the path.
///
/// # What a scan says of the path
///
/// The paper's weight is the normaliser η = ∫ p(z | x, m) p(x | x′, u) dx of the map as it is. Split the map into what was seen for the
/// first time in the last L scans, and the rest. Where a scan meets the first part only, η depends on the last poses relative to each
/// other, and on nothing before: move the path with its map rigidly, and it stays what it is. There every particle whose last steps
/// fit has the same η in truth; what is computed differs by where the raster happens to lie, and resampling by it is a
/// lottery, which spends the diversity that the closing of a loop will need. So a scan is weighed against the other part alone,
///
/// ln w ← ln w + ln p(z | x, m of L scans ago), x the pose that was drawn,
///
/// whether it was drawn from the fit or, where the matcher is not trusted, from the motion. Ground that the old map does not know
/// says the same of all.
#[derive(Clone, Debug)]
pub struct FromScan<S> {
    /// The models, and what is drawn from where the matcher fails.
    pub fallback: FromMotion<OdometryModel, ScanModel>,
    /// Tuning.
    pub settings: FromScanSettings<S>,
}

impl<S: Search + Sync, const CELLS_PER_NDT: usize> Proposal<Grid<CELLS_PER_NDT>> for FromScan<S> {
    type Control = Odometry;

    // anchor: propose
    fn propose(
        &self,
        particle: &Particle<Grid<CELLS_PER_NDT>>,
        u: &Odometry,
        scan: &Scan,
        stream: &mut Stream,
    ) -> Proposed<()> {
        let Self { fallback: FromMotion { motion, likelihood }, settings } = self;
        // ANCHOR: predict
        let prior = motion.gaussian(&particle.world_from_robot, u, settings.motion_floor);
        // ANCHOR_END: predict
        let target = Target::new(&prior, likelihood, &particle.map, scan, settings);

        // ANCHOR: seeds
        // Starts of the climb, and the mean likelihood that its end must beat.
        let (starts, log_mean) = settings.search.starts(&target);
        // ANCHOR_END: seeds
        // ANCHOR: match
        let climbs = starts
            .into_iter()
            .map(|start| hill_climb(start, settings.climb, |pose, floor| target.log_posterior(pose, floor)));
        let top = climbs.reduce(|best, end| if end.value > best.value { end } else { best });
        // ANCHOR_END: match
        // ANCHOR: guard
        // On a flat score surface the optimum is noise, no better than what the motion model would draw anyway.
        let top = top.filter(|top| top.value - prior.log_density(&top.pose) - log_mean >= settings.minimum_improvement);
        // ANCHOR_END: guard

        // ANCHOR: fit
        let fit = top.and_then(|top| Fit::around(&top.pose, &settings.limits, |pose| target.log_value(pose)));
        // ANCHOR_END: fit
        let (world_from_robot, trace) = match (fit, top) {
            (Some(fit), Some(top)) => {
                // ANCHOR: draw
                let drawn = fit.gaussian.sample(stream);
                // ANCHOR_END: draw
                (drawn, ProposalTrace::Matched { mode: top.pose, log_integral: fit.log_integral })
            }
            // ANCHOR: fallback
            _ => (motion.sample(&particle.world_from_robot, u, stream), ProposalTrace::Motion),
            // ANCHOR_END: fallback
        };

        // ANCHOR: price
        let log_old = likelihood.log_score(&particle.map.past(), &world_from_robot, scan);
        let log_increment = settings.share(u) * log_old;
        // ANCHOR_END: price
        Proposed { world_from_robot, association: (), log_increment, trace }
    }
    // end: propose
}

impl<S> FromScanSettings<S> {
    /// The share in which a scan after this motion weighs, 0 to 1.
    fn share(&self, u: &Odometry) -> f64 {
        let motion = u.trans.abs() + u.rot1.abs() + u.rot2.abs();
        if motion < self.full_weight { motion / self.full_weight } else { 1.0 }
    }
}

/// What a search looks for: a pose that explains the scan and the motion.
pub struct Target<'a, const CELLS_PER_NDT: usize> {
    prior: &'a Gaussian3,
    likelihood: &'a ScanModel,
    view: LocalMap<'a, CELLS_PER_NDT>,
    scan: &'a Scan,
    /// A part of the scan, of which each beam counts for `share`.
    thin: Scan,
    share: f64,
    /// [`FromScanSettings::gain`].
    gain: f64,
}

impl<'a, const CELLS_PER_NDT: usize> Target<'a, CELLS_PER_NDT> {
    fn new<S>(
        prior: &'a Gaussian3,
        likelihood: &'a ScanModel,
        map: &'a Grid<CELLS_PER_NDT>,
        scan: &'a Scan,
        settings: &FromScanSettings<S>,
    ) -> Self {
        let reach = scan.hits.iter().map(|[x, y]| x * x + y * y).fold(0.0, f64::max).sqrt();
        let view = LocalMap::new(map, [prior.mean().x, prior.mean().y], reach + SLACK);
        // The search looks at a thinner scan, in which each beam counts for those left out.
        let (thin, share) = (scan.thinned(settings.climb_stride), settings.climb_stride as f64);
        Self { prior, likelihood, view, scan, thin, share, gain: settings.minimum_improvement }
    }

    /// ln p(z | x, m) + ln N(x), of the whole scan.
    fn log_value(&self, pose: &Pose2) -> f64 {
        self.likelihood.log_score_above(f64::NEG_INFINITY, &self.view, pose, self.scan) + self.prior.log_density(pose)
    }

    /// ln p(z | x, m) by the thinner scan; need not be exact at or below `floor`.
    fn log_thin(&self, pose: &Pose2, floor: f64) -> f64 {
        self.share * self.likelihood.log_score_above(floor / self.share, &self.view, pose, &self.thin)
    }

    /// The same with the prior.
    fn log_posterior(&self, pose: &Pose2, floor: f64) -> f64 {
        let log_prior = self.prior.log_density(pose);
        log_prior + self.log_thin(pose, floor - log_prior)
    }
}

impl Search for HeadingSeeds {
    /// The best poses looked at, and the mean over all of them.
    fn starts<const CELLS_PER_NDT: usize>(&self, target: &Target<'_, CELLS_PER_NDT>) -> (Vec<ScoredPose>, f64) {
        let prior = target.prior;
        // Evenly over the heading; over the position by the plastic number's sequence (Roberts 2018), in the share that a normal
        // distribution has of each place.
        let spread = (0..self.seeds).map(|k| {
            let share = |step: f64| (0.5 + f64::from(k) * step).fract();
            let heading = SEARCH_STDS * ((f64::from(k) + 0.5) / f64::from(self.seeds) * 2.0 - 1.0);
            let radius = (-2.0 * ops::ln(1.0 - share(0.754_877_666_246_693))).sqrt();
            let (sin, cos) = ops::sin_cos(core::f64::consts::TAU * share(0.569_840_290_998_053));
            prior.at([heading, radius * cos, radius * sin])
        });
        let (mut starts, mut log_seeds) = (Vec::new(), Vec::new());
        for pose in core::iter::once(*prior.mean()).chain(spread) {
            let log_seed = target.log_thin(&pose, f64::NEG_INFINITY);
            log_seeds.push(log_seed);
            starts.push(ScoredPose { pose, value: log_seed + prior.log_density(&pose) });
        }
        starts.sort_by(|a, b| b.value.total_cmp(&a.value));
        starts.truncate(self.climbs);
        (starts, ops::log_sum_exp(&log_seeds) - ops::ln(log_seeds.len() as f64))
    }
}

impl Search for CorrelativeSearch {
    /// Starts of which each is worth a climb.
    fn starts<const CELLS_PER_NDT: usize>(&self, target: &Target<'_, CELLS_PER_NDT>) -> (Vec<ScoredPose>, f64) {
        let start = |pose: Pose2| ScoredPose { pose, value: target.log_posterior(&pose, f64::NEG_INFINITY) };
        (self.poses(target).into_iter().map(start).collect(), f64::NEG_INFINITY)
    }
}

impl CorrelativeSearch {
    /// The best poses of the lattice, apart from each other; none where all of it looks alike.
    fn poses<const CELLS_PER_NDT: usize>(&self, target: &Target<'_, CELLS_PER_NDT>) -> Vec<Pose2> {
        let Self { linear, angular, stride, climbs } = *self;
        let Target { prior, likelihood, view, scan, .. } = target;
        // Each of the few beams counts for those left out.
        let few = scan.thinned(stride);
        let share = scan.hits.len() as f64 / few.hits.len().max(1) as f64;
        let mean = prior.mean();
        let steps =
            |variance: f64, step: f64, most: f64| (SEARCH_STDS * variance.sqrt() / step).ceil().min(most) as i32;
        let covariance = prior.covariance();
        let [columns, rows] = [covariance.m11, covariance.m22].map(|v| steps(v, linear, MOST_STEPS[0]));
        let turns = steps(covariance.m33, angular, MOST_STEPS[1]);
        let least = prior.log_density(mean) - 0.5 * SEARCH_STDS * SEARCH_STDS;
        let (mut found, mut log_likelihoods) = (Vec::new(), Vec::new());
        for turn in -turns..=turns {
            let theta = ops::wrap_angle(mean.theta + f64::from(turn) * angular);
            // Turned once for all shifts.
            let (sin, cos) = ops::sin_cos(theta);
            let k = view.per_ndt();
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
