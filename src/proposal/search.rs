//! Where a hill climb begins: a scan matcher is lost by a bad start, seldom by its climb.

use crate::geometry::{Gaussian3, Pose2};
use crate::matching::{ScoreNear, ScoredPose};
use crate::ops;
use crate::order::sorted;

/// How the poses are found from which a climb is worth while.
pub trait Search: Sync {
    /// Starts of the climb towards the best pose of `target`.
    fn starts<N: ScoreNear>(&self, target: &Target<'_, N>) -> Starts;
}

/// What a search found.
#[derive(Clone, PartialEq, Debug)]
pub struct Starts {
    /// Starts with their log-posterior \[nats\] ([`Target::log_posterior`]); none where all that was looked at is alike.
    pub poses: Vec<ScoredPose>,
    /// ln of the mean likelihood over all that was looked at \[nats\]: what the end of the climb must beat. −∞ where the search has
    /// judged that itself.
    pub log_mean: f64,
}

/// What is searched: the hill ln p(z | x, m) + ln N(x; prior) over poses x.
pub struct Target<'a, N> {
    prior: &'a Gaussian3,
    score: N,
    minimum_improvement: f64,
}

impl<'a, N: ScoreNear> Target<'a, N> {
    /// The hill of an observation's score and the motion's Gaussian. `minimum_improvement` \[nats\] is how much better than the mean the
    /// best must be to be trusted.
    pub fn new(prior: &'a Gaussian3, score: N, minimum_improvement: f64) -> Self {
        Self { prior, score, minimum_improvement }
    }

    /// p(x | x′, u) as a Gaussian.
    pub fn prior(&self) -> &Gaussian3 {
        self.prior
    }

    /// ln p(z | x, m).
    pub fn score(&self) -> &N {
        &self.score
    }

    /// How much better than the mean likelihood over a search the best must be to be trusted \[nats\].
    pub fn minimum_improvement(&self) -> f64 {
        self.minimum_improvement
    }

    /// ln p(z | x, m) + ln N(x; prior) \[nats\].
    pub fn log_value(&self, pose: &Pose2) -> f64 {
        self.score.log_score(pose) + self.prior.log_density(pose)
    }

    /// The same by a part of the observation, for a climb: exact where it exceeds `floor` \[nats\].
    pub fn log_posterior(&self, pose: &Pose2, floor: f64) -> f64 {
        let log_prior = self.prior.log_density(pose);
        log_prior + self.score.log_score_above(pose, floor - log_prior)
    }
}

/// A search reaches this many standard deviations of the prior to each side. Heading is what a climb is lost
/// by: a few degrees more, and far end points fall on the wrong wall.
pub(crate) const SEARCH_STDS: f64 = 3.0;

/// Most steps of a lattice to each side, of the heading: an absurd motion must not take for ever.
const MOST_TURNS: f64 = 24.0;

/// At the best of the odometry's prediction and so many poses spread over the prior's heading: enough where a step's error is
/// about as wide as an NDT cell of the map.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct HeadingSeeds {
    /// Poses besides the prediction.
    pub seeds: u32,
    /// How many of the best are climbed from.
    pub climbs: usize,
}

impl Search for HeadingSeeds {
    /// The best poses looked at, and the mean over all of them.
    fn starts<N: ScoreNear>(&self, target: &Target<'_, N>) -> Starts {
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
        let (mut poses, mut log_seeds) = (Vec::new(), Vec::new());
        for pose in core::iter::once(*prior.mean()).chain(spread) {
            let log_seed = target.score.log_score_above(&pose, f64::NEG_INFINITY);
            log_seeds.push(log_seed);
            poses.push(ScoredPose { pose, value: log_seed + prior.log_density(&pose) });
        }
        let mut poses = sorted(poses, ScoredPose::highest_first);
        poses.truncate(self.climbs);
        Starts { poses, log_mean: ops::log_sum_exp(&log_seeds) - ops::ln(log_seeds.len() as f64) }
    }
}

/// At the best poses of a lattice over the whole prior, judged coarsely (after the correlative matching of Olson 2009): for
/// odometry that is off by several NDT cells.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct CorrelativeSearch {
    /// Step along each axis \[m\].
    pub linear: f64,
    /// Step of the heading \[rad\].
    pub angular: f64,
    /// Maximum number of position steps to either side, along x and along y.
    pub most_steps: u32,
    /// The lattice looks at every n-th beam.
    pub stride: usize,
    /// How many of the best poses, a step or more apart, are climbed from.
    pub climbs: usize,
}

impl Search for CorrelativeSearch {
    /// The best poses of the lattice, apart from each other; none where all of it looks alike. After a motion so short that the lattice has one
    /// position only, those of the closer look of [`HeadingSeeds`]: what is flat to the coarse score may be a hill to the finer one.
    fn starts<N: ScoreNear>(&self, target: &Target<'_, N>) -> Starts {
        let lattice = self.lattice(target);
        let log_scores: Vec<f64> = lattice.iter().map(|point| point.log_score).collect();
        let best = log_scores.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let log_mean = ops::log_sum_exp(&log_scores) - ops::ln(log_scores.len() as f64);
        let improves = best - log_mean >= target.minimum_improvement;
        let predicted = target.prior.mean();
        if !improves && lattice.iter().all(|LatticePoint { pose, .. }| [pose.x, pose.y] == [predicted.x, predicted.y]) {
            return CLOSER.starts(target);
        }
        let poses = if improves { self.best_apart(&lattice) } else { Vec::new() };
        let start = |pose: Pose2| ScoredPose { pose, value: target.log_posterior(&pose, f64::NEG_INFINITY) };
        Starts { poses: poses.into_iter().map(start).collect(), log_mean: f64::NEG_INFINITY }
    }
}

/// The search where a lattice has one position, and sees no difference.
const CLOSER: HeadingSeeds = HeadingSeeds { seeds: 8, climbs: 1 };

/// A pose of the lattice.
struct LatticePoint {
    pose: Pose2,
    /// Coarse score \[nats\].
    log_score: f64,
    /// The same with the prior \[nats\].
    log_posterior: f64,
}

impl CorrelativeSearch {
    /// The same search with a step of the heading that is wide enough to look at all headings of this prior.
    pub(crate) fn all_round(self, prior: &Gaussian3) -> Self {
        let reach = (SEARCH_STDS * prior.covariance().m33.sqrt()).min(core::f64::consts::PI);
        Self { angular: self.angular.max(reach / MOST_TURNS), ..self }
    }

    /// The lattice within [`SEARCH_STDS`] of the prior's mean, judged coarsely.
    fn lattice<N: ScoreNear>(&self, target: &Target<'_, N>) -> Vec<LatticePoint> {
        let Self { linear, angular, most_steps, stride, .. } = *self;
        let (prior, mean, covariance) = (target.prior, target.prior.mean(), target.prior.covariance());
        let steps =
            |variance: f64, step: f64, most: f64| (SEARCH_STDS * variance.sqrt() / step).ceil().min(most) as i32;
        let [columns, rows] = [covariance.m11, covariance.m22].map(|v| steps(v, linear, f64::from(most_steps)));
        let turns = steps(covariance.m33, angular, MOST_TURNS);
        let least = prior.log_density(mean) - 0.5 * SEARCH_STDS * SEARCH_STDS;
        let mut lattice = Vec::new();
        for turn in -turns..=turns {
            let theta = ops::wrap_angle(mean.theta + f64::from(turn) * angular);
            let coarse = target.score.coarse(theta, stride);
            for (row, column) in (-rows..=rows).flat_map(|row| (-columns..=columns).map(move |column| (row, column))) {
                let [x, y] = [mean.x + f64::from(column) * linear, mean.y + f64::from(row) * linear];
                let pose = Pose2 { x, y, theta };
                let log_prior = prior.log_density(&pose);
                if log_prior >= least {
                    let log_score = coarse([x, y]);
                    lattice.push(LatticePoint { pose, log_score, log_posterior: log_prior + log_score });
                }
            }
        }
        lattice
    }

    /// The best of these, each more than a step from those before it; of equal ones the first.
    fn best_apart(&self, lattice: &[LatticePoint]) -> Vec<Pose2> {
        let mut picked: Vec<Pose2> = Vec::new();
        while picked.len() < self.climbs {
            let apart = |point: &&LatticePoint| {
                picked.iter().all(|other| {
                    let d = other.minus(&point.pose);
                    d.x.abs().max(d.y.abs()) > 1.5 * self.linear || d.z.abs() > 1.5 * self.angular
                })
            };
            let better =
                |next: &LatticePoint, best: &LatticePoint| next.log_posterior.total_cmp(&best.log_posterior).is_gt();
            let left = lattice.iter().filter(apart);
            let Some(best) = left.reduce(|best, next| if better(next, best) { next } else { best }) else { break };
            picked.push(best.pose);
        }
        picked
    }
}
