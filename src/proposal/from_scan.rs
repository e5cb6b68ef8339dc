//! The improved proposal, which the chapter calls measurement-aware: look first, then move.
//!
//! Reference: Grisetti, Stachniss, Burgard, *Improved techniques for grid mapping with Rao-Blackwellized particle filters*,
//! T-RO 2007, algorithm 1.

use super::incremental_weight::{IncrementalWeight, log_mean_inverse, log_mixture};
use super::{Fit, FitLimits, Proposal, ProposalTrace, Proposed, Search, Target};
use crate::error::{Range, SettingError};
use crate::geometry::{Gaussian3, Pose2};
use crate::map::ConditionalMap;
use crate::matching::{HillClimbSteps, Score, ScoreNear, ScoredPose, hill_climb};
use crate::motion::Motion;
use crate::ops;
use crate::order::sorted;
use crate::particle::Particle;
use crate::random::Stream;

/// Settings of [`FromScan`].
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct FromScanSettings<S> {
    /// Floor of the motion Gaussian's standard deviations \[m, m, rad\].
    pub motion_floor: [f64; 3],
    /// Where the climb begins.
    pub search: S,
    /// Step sizes of the hill climb.
    pub climb: HillClimbSteps,
    /// Most hills that are told apart, 1 to 16. With one, all particles take the highest top that they find, be another as good; with
    /// more, a hill is drawn by its integral, and the population keeps what it cannot yet decide.
    pub hills: u32,
    /// The climb looks at every n-th beam.
    pub climb_stride: usize,
    /// How much better than the mean likelihood over the search the best must be for the matcher to be trusted \[nats\].
    pub minimum_improvement: f64,
    /// Motion \[m, or rad of turns\] from which on a scan weighs in full. After a shorter one it weighs in proportion: scans taken
    /// from nearly one place repeat each other's errors, and ten a second would choose between particles by them.
    pub full_weight: f64,
    /// Limits of the standard deviations of the fit.
    pub limits: FitLimits,
    /// What a particle pays for a scan.
    pub weight: IncrementalWeight,
}

impl<S> FromScanSettings<S> {
    /// Whether all settings are in range.
    ///
    /// # Errors
    /// Where one is not.
    pub fn validate(&self) -> Result<(), SettingError> {
        /// Of a length or an angle that must not vanish.
        const POSITIVE: Range = Range::number(1e-9, 1e3, "m, rad");
        let Self { motion_floor, climb, hills, climb_stride, full_weight, limits, weight: _, .. } = self;
        motion_floor.iter().try_for_each(|std| POSITIVE.check("motion_floor", *std).map(drop))?;
        POSITIVE.check("climb.linear", climb.linear)?;
        POSITIVE.check("climb.angular", climb.angular)?;
        Range::whole(0, 20).check("climb.halvings", f64::from(climb.halvings))?;
        Range::whole(1, 16).check("hills", f64::from(*hills))?;
        Range::whole(1, 1_000_000).check("climb_stride", *climb_stride as f64)?;
        Range::number(0.0, 1e3, "m, rad").check("full_weight", *full_weight)?;
        for (least, most) in limits.least.into_iter().zip(limits.most) {
            POSITIVE.check("limits.most", most)?;
            Range::number(1e-9, most, "m, rad").check("limits.least", least)?;
        }
        Ok(())
    }
}

/// The improved proposal: find the mode of ln p(z | x, m) + ln p(x | x′, u), fit a Gaussian there, draw from it; and
/// pay what the scan says of the path.
///
/// Where there are several modes that are far apart and nearly as high, as where few beams return or along a corridor, the posterior is a
/// mixture Σᵢ η̂ᵢ N(μᵢ, Σᵢ) of one Gaussian a hill, with η̂ᵢ the hill's integral, and a draw is one of that: first the hill, then the
/// pose.
///
/// What a particle pays is a setting, [`IncrementalWeight`]: the integral of the fit, or what of it new ground has no say in. Where the matcher is
/// not trusted the pose is drawn from the motion, which pays ln p(z | x, m) at the pose that was drawn or, for the others, ln p_old.
///
/// No increment is evidence where the score is tempered (κ < 1) or [`FromScanSettings::full_weight`] is above 0.
#[derive(Clone, Debug)]
pub struct FromScan<D, L, S> {
    /// Noise of the odometry.
    pub motion: D,
    /// How well an observation fits a map.
    pub score: L,
    /// Tuning.
    pub settings: FromScanSettings<S>,
}

impl<M, D, L, S> Proposal<M> for FromScan<D, L, S>
where
    M: ConditionalMap<Association = ()>,
    D: Motion,
    L: Score<M>,
    S: Search,
{
    type Control = D::Control;

    fn propose(
        &self,
        particle: &Particle<M>,
        control: &D::Control,
        observation: &M::Observation,
        stream: &mut Stream,
    ) -> Proposed<()> {
        let copies = self.propose_copies(particle, control, observation, core::slice::from_mut(stream));
        copies.into_iter().next().expect("a draw for each stream")
    }

    fn propose_copies(
        &self,
        particle: &Particle<M>,
        control: &D::Control,
        observation: &M::Observation,
        streams: &mut [Stream],
    ) -> Vec<Proposed<()>> {
        let (from, map) = (&particle.world_from_robot, &particle.map);
        let drive = self.motion.drive(control);
        let prior = drive.gaussian(from, self.settings.motion_floor);
        let hills = prior.as_ref().map_or_else(Vec::new, |prior| self.find(prior, map, observation).hills);
        let trusted = prior.as_ref().filter(|_| !hills.is_empty());
        // The incremental weight, where it does not depend on the draw.
        let common = trusted.and_then(|prior| self.weigh(map, prior, &hills, observation));
        let draw = |stream: &mut Stream| {
            let (world_from_robot, trace) = match choose(&hills, stream) {
                Some((top, fit)) => draw(top, fit, stream),
                None => (drive.sample(from, stream), ProposalTrace::Motion),
            };
            let log_weight = common.unwrap_or_else(|| match trusted {
                Some(_) => self.score.log_old(map, &world_from_robot, observation),
                None => self.settings.weight.of_motion(&self.score, map, &world_from_robot, observation),
            });
            let log_increment = self.share(control) * log_weight;
            Proposed { world_from_robot, association: (), log_increment, trace }
        };
        streams.iter_mut().map(draw).collect()
    }

    fn can_drive(&self, control: &D::Control) -> bool {
        self.motion.can_drive(control)
    }

    fn validate(&self) -> Result<(), SettingError> {
        self.motion.validate()?;
        self.score.validate()?;
        self.settings.validate()
    }
}

/// What [`FromScan::find`] finds.
#[derive(Clone, Debug)]
pub struct Found {
    /// The highest tops, one of each hill, the highest first.
    pub tops: Vec<ScoredPose>,
    /// ln of the mean likelihood over what the search looked at \[nats\].
    pub log_mean: f64,
    /// Those tops that are trusted, with a Gaussian each.
    pub hills: Vec<(ScoredPose, Fit)>,
}

impl<D: Motion, L, S: Search> FromScan<D, L, S> {
    /// Looks without moving: all that [`Proposal::propose`] finds out before it draws.
    pub fn find<M: ConditionalMap<Association = ()>>(
        &self,
        prior: &Gaussian3,
        map: &M,
        observation: &M::Observation,
    ) -> Found
    where
        L: Score<M>,
    {
        let target = self.target(prior, map, observation);
        let (tops, log_mean) = self.search(&target);
        let trusted = tops.iter().filter_map(|top| self.guard(*top, log_mean, prior));
        let hills = trusted.filter_map(|top| Some((top, self.fit(&top, &target)?))).collect();
        Found { tops, log_mean, hills }
    }

    /// ln p(z | x, m) + ln p(x | x′, u) as a function of x.
    fn target<'a, M: ConditionalMap<Association = ()>>(
        &'a self,
        prior: &'a Gaussian3,
        map: &'a M,
        observation: &'a M::Observation,
    ) -> Target<'a, L::Near<'a>>
    where
        L: Score<M>,
    {
        let near = self.score.near(map, prior.mean(), observation, self.settings.climb_stride);
        Target::new(prior, near, self.settings.minimum_improvement)
    }

    /// The highest tops of the climbs from all starts, each of a hill of its own and the highest first, and ln of the mean likelihood over
    /// what the search looked at \[nats\].
    fn search<N: ScoreNear>(&self, target: &Target<'_, N>) -> (Vec<ScoredPose>, f64) {
        let starts = self.settings.search.starts(target);
        let climb = |start| hill_climb(start, self.settings.climb, |pose, floor| target.log_posterior(pose, floor));
        let tops = sorted(starts.poses.into_iter().map(climb).collect(), ScoredPose::highest_first);
        let mut hills: Vec<ScoredPose> = Vec::new();
        for top in tops {
            let room = hills.len() < self.settings.hills as usize;
            if room && hills.iter().all(|other| top.value > other.value - NEGLIGIBLE && self.are_apart(other, &top)) {
                hills.push(top);
            }
        }
        (hills, starts.log_mean)
    }

    /// Whether two tops are of two hills: more than two first steps of a climb from each other.
    fn are_apart(&self, a: &ScoredPose, b: &ScoredPose) -> bool {
        let HillClimbSteps { linear, angular, .. } = self.settings.climb;
        let d = a.pose.minus(&b.pose);
        d.x.abs().max(d.y.abs()) > 2.0 * linear || d.z.abs() > 2.0 * angular
    }

    /// The top, if it is clearly better than the average of the search: on a flat score surface the optimum is noise, no better than what
    /// the motion model would draw anyway.
    fn guard(&self, top: ScoredPose, log_mean: f64, prior: &Gaussian3) -> Option<ScoredPose> {
        let log_likelihood = top.value - prior.log_density(&top.pose);
        (log_likelihood - log_mean >= self.settings.minimum_improvement).then_some(top)
    }

    /// A Gaussian through the hill around its top: curvature, probes and fit are those of [`Fit::around`].
    fn fit<N: ScoreNear>(&self, top: &ScoredPose, target: &Target<'_, N>) -> Option<Fit> {
        Fit::around(&top.pose, &self.settings.limits, |pose| target.log_value(pose))
    }

    /// What the observation says of the path \[nats\], where poses are drawn from these hills; `None` where it depends on the pose that is drawn.
    fn weigh<M: ConditionalMap<Association = ()>>(
        &self,
        map: &M,
        prior: &Gaussian3,
        hills: &[(ScoredPose, Fit)],
        observation: &M::Observation,
    ) -> Option<f64>
    where
        L: Score<M>,
    {
        let integrals: Vec<f64> = hills.iter().map(|(_, fit)| fit.log_integral).collect();
        match self.settings.weight {
            IncrementalWeight::Marginal => Some(ops::log_sum_exp(&integrals)),
            IncrementalWeight::NewGroundFree => {
                let log_old = self.score.near_old(map, prior.mean(), observation);
                let inverse = |(_, fit): &(_, Fit)| log_mean_inverse(&fit.gaussian, prior, &log_old);
                Some(-log_mixture(&hills.iter().map(inverse).collect::<Vec<_>>(), &integrals))
            }
            IncrementalWeight::OldMapAtDraw => None,
        }
    }

    /// The share of a scan's weight that counts after this motion: see [`FromScanSettings::full_weight`].
    fn share(&self, control: &D::Control) -> f64 {
        let (travel, full) = (self.motion.drive(control).travel(), self.settings.full_weight);
        if travel < full { travel / full } else { 1.0 }
    }
}

/// A top that is lower by so much than another \[nats\] is of no account: one particle in some four hundred would take it.
const NEGLIGIBLE: f64 = 6.0;

/// One of these hills, drawn by their integrals; `None` of none.
fn choose<'a>(hills: &'a [(ScoredPose, Fit)], stream: &mut Stream) -> Option<&'a (ScoredPose, Fit)> {
    if hills.len() < 2 {
        return hills.first();
    }
    let log_integrals: Vec<f64> = hills.iter().map(|(_, fit)| fit.log_integral).collect();
    let log_sum = ops::log_sum_exp(&log_integrals);
    let mut left = stream.uniform();
    let chosen = log_integrals.iter().position(|log| {
        left -= ops::exp(log - log_sum);
        left < 0.0
    });
    hills.get(chosen.unwrap_or(0))
}

/// One draw from the fit.
fn draw(top: &ScoredPose, fit: &Fit, stream: &mut Stream) -> (Pose2, ProposalTrace) {
    let covariance = fit.gaussian.covariance();
    let trace = ProposalTrace::Matched { mode: top.pose, covariance, log_integral: fit.log_integral };
    (fit.gaussian.sample(stream), trace)
}
