//! When to resample: three filters on one log and one noise, which differ in that alone.
//!
//! Never, every step, and where N_eff < threshold · M. On the lap the three differ in what they waste; on the course of the two
//! wings ([`Field::two_wings`]) they differ in whether they still have the hypothesis that turns out to be right.
//!
//! Why the wings tell them apart. For some forty steps half the particles hold either explanation, and both predict every
//! sighting equally well. Each resampling is a lottery all the same: the number of particles in the right wing does a random
//! walk from generation to generation, and none and all are its traps. Who resamples every step walks forty steps of it. Equal
//! weights keep N_eff high: who waits for N_eff to fall resamples once or twice. Who never resamples keeps all explanations, and
//! pays elsewhere: hardly any particle has a weight.
//!
//! [`Field::two_wings`]: crate::world::Field::two_wings

pub mod counts;
mod run;
mod setup;
mod shared;

pub use setup::{PoliciesSetup, PolicyCourse};

use super::landmarks::{AssociationSummary, LandmarkLog};
use super::lap::LapWorld;
use crate::digest::Digest;
use crate::world::{WINGS_LOST, WINGS_SIGN};
use core::f64::consts::FRAC_PI_2;
use fastslam::error::SettingError;
use fastslam::execute::Executor;
use fastslam::genealogy::{Descent, Path};
use fastslam::geometry::{Pose2, rms};
use fastslam::ops;
use fastslam::proposal::Proposed;
use fastslam::sensor::Feature;
use run::{Run, Stepped, World};

/// The policies compared, by their index everywhere here.
pub const POLICIES: [&str; 3] = ["never", "always", "selective"];
const NEVER: usize = 0;
const ALWAYS: usize = 1;
const SELECTIVE: usize = 2;

/// What one filter did in one step, and how far from the truth it is.
#[derive(Clone, PartialEq, Debug)]
pub struct PolicyReport {
    /// The step; 0 is the start.
    pub step: u32,
    /// ln p̂(z_t | z₁..ₜ₋₁) by the filter \[nats\]; −∞ where the step explained nothing, 0 at the start.
    pub log_evidence: f64,
    /// N_eff before resampling.
    pub ess: f64,
    /// Slot each particle was copied from, where the step resampled.
    pub ancestors: Option<Vec<u32>>,
    /// What the population descends from: the lineage gauge at any distance, the size of the tree, the coalescence.
    pub descent: Descent,
    /// Distance of the best particle from the truth \[m\].
    pub error_best: f64,
    /// Distance of the weighted mean of all particles from the truth \[m\].
    pub error_mean: f64,
    /// Root mean square error of position over the best particle's path so far \[m\].
    pub rms_best: f64,
    /// Root mean square of `error_mean` so far, over steps 0 to now \[m\].
    pub rms_mean: f64,
    /// Particles that hold the right one of the two explanations: within [`RIGHT_WITHIN`] of the truth, and looking its way to
    /// a quarter turn. `None` on the lap, and on the wings' course before the robot is lost.
    pub right: Option<u32>,
    /// On the wings' course, what the best particle made of what was seen, and how many different answers the population gave.
    pub associations: Option<(AssociationSummary, u32)>,
}

impl PolicyReport {
    /// Whether the step resampled.
    pub fn resampled(&self) -> bool {
        self.ancestors.is_some()
    }

    /// Nodes of the ancestry tree that the population still needs.
    pub fn tree_nodes(&self) -> u32 {
        self.descent.size()
    }

    /// Nodes of M paths kept apart: M (t + 1).
    pub fn path_nodes(&self, particles: usize) -> u32 {
        particles as u32 * (self.step + 1)
    }
}

/// A particle so near the truth is in the right wing \[m\].
///
/// A particle in the right wing knows its place to decimetres; one in the wrong wing is on the other side of the hall, at twice
/// the robot's distance from its centre: 12 m and more at the court. Anything between serves.
pub const RIGHT_WITHIN: f64 = 2.0;

/// Whether a particle holds the right explanation.
fn is_right(pose: &Pose2, truth: &Pose2) -> bool {
    pose.distance(truth) < RIGHT_WITHIN && ops::wrap_angle(pose.theta - truth.theta).abs() < FRAC_PI_2
}

/// Three filters under way. Cloning is cheap: the world, the maps and the past are shared.
#[derive(Clone, Debug)]
pub struct Policies {
    setup: PoliciesSetup,
    world: World,
    /// Any of the filters before the first step.
    start: Run,
    never: Run,
    always: Run,
    /// `None` until it resamples for the first time: up to there it is the one that never does, and is computed once.
    selective: Option<Run>,
    reports: [PolicyReport; 3],
    /// Report of step 0.
    first: PolicyReport,
    /// Reports of the next step so far, and the state from which the selective filter branches off if it resamples in that step.
    next: Vec<PolicyReport>,
    before: Option<Run>,
}

impl Policies {
    /// All three at the start.
    ///
    /// # Errors
    /// Where a setting is out of its range.
    pub fn new(setup: &PoliciesSetup) -> Result<Self, SettingError> {
        setup.validate()?;
        let (world, never) = run::begin(setup)?;
        let (start, always) = (never.clone(), never.clone().with_policy(setup.policies()[ALWAYS]));
        let first = PolicyReport {
            step: 0,
            log_evidence: 0.0,
            ess: setup.particles as f64,
            ancestors: None,
            descent: never.descent(),
            error_best: 0.0,
            error_mean: 0.0,
            rms_best: 0.0,
            rms_mean: 0.0,
            right: None,
            associations: None,
        };
        let reports = [(); 3].map(|()| first.clone());
        let (selective, next, before) = (None, Vec::new(), None);
        Ok(Self { setup: setup.clone(), world, start, never, always, selective, reports, first, next, before })
    }

    /// A run with another threshold on the same log: only the selective filter starts again, and the two filters without a threshold keep their
    /// state. Until the selective filter has caught up, [`Self::advance`] is a step of that filter alone, and reports and particles of the other two
    /// are those of a later step. `None` if the setups differ in more than the threshold, or if a step is half done.
    ///
    /// # Errors
    /// Where the threshold is out of its range.
    pub fn asked(&self, setup: &PoliciesSetup) -> Result<Option<Self>, SettingError> {
        setup.validate()?;
        if *setup != (PoliciesSetup { threshold: setup.threshold, ..self.setup.clone() }) || !self.next.is_empty() {
            return Ok(None);
        }
        let mut asked = Self { setup: setup.clone(), before: None, ..self.clone() };
        asked.selective = Some(self.start.clone().with_policy(setup.policies()[SELECTIVE]));
        asked.reports[SELECTIVE] = self.first.clone();
        Ok(Some(asked))
    }

    /// Whether the selective filter is behind the others.
    pub fn catches_up(&self) -> bool {
        self.reports[SELECTIVE].step < self.reports[NEVER].step
    }

    /// The same, computed by another executor: the results are the same.
    pub fn with_executor(self, executor: Executor) -> Self {
        let by = |run: Run| run.with_executor(executor.clone());
        let [selective, before] = [self.selective, self.before].map(|run| run.map(by));
        let [start, never, always] = [self.start, self.never, self.always].map(by);
        Self { start, never, always, selective, before, ..self }
    }

    /// One step of all three; `None` after the last.
    pub fn step(&mut self) -> Option<&[PolicyReport; 3]> {
        while !self.advance()? {}
        Some(&self.reports)
    }

    /// A third of a step, so that a page is not blocked by all three: the next filter makes its step. Returns whether it was the last of the three,
    /// after which [`Self::reports`] are those of the new step; `None` after the last step.
    pub fn advance(&mut self) -> Option<bool> {
        self.advance_by(&mut [const { None }; 3])
    }

    /// The same with the draws of each filter, where they are there.
    fn advance_by(&mut self, proposed: &mut [Option<Vec<Proposed<()>>>; 3]) -> Option<bool> {
        if self.catches_up() {
            let stepped = self.selective.as_mut()?.step(None)?;
            self.reports[SELECTIVE] = self.judge(SELECTIVE, stepped);
            return Some(true);
        }
        let report = match self.next.len() {
            NEVER => {
                self.before = self.selective.is_none().then(|| self.never.clone());
                let stepped = self.never.step(proposed[NEVER].take())?;
                self.judge(NEVER, stepped)
            }
            ALWAYS => {
                let stepped = self.always.step(proposed[ALWAYS].take())?;
                self.judge(ALWAYS, stepped)
            }
            _ => {
                let (before, selective) = (self.before.take(), self.setup.policies()[SELECTIVE]);
                if selective.should_resample(self.next[NEVER].ess, self.setup.particles) {
                    self.selective = self.selective.take().or_else(|| before.map(|run| run.with_policy(selective)));
                }
                match &mut self.selective {
                    None => self.next[NEVER].clone(),
                    Some(run) => {
                        let stepped = run.step(proposed[SELECTIVE].take())?;
                        self.judge(SELECTIVE, stepped)
                    }
                }
            }
        };
        self.next.push(report);
        let Ok(reports) = <[PolicyReport; 3]>::try_from(core::mem::take(&mut self.next)).map_err(|few| self.next = few)
        else {
            return Some(false);
        };
        self.reports = reports;
        Some(true)
    }

    /// The filter of a policy.
    fn run(&self, policy: usize) -> &Run {
        match policy {
            ALWAYS => &self.always,
            SELECTIVE => self.selective.as_ref().unwrap_or(&self.never),
            _ => &self.never,
        }
    }

    /// Compares a filter's newest state with the truth.
    fn judge(&self, policy: usize, stepped: Stepped) -> PolicyReport {
        let before = &self.reports[policy];
        let step = before.step + 1;
        let (truth, poses, best) = (self.world.truth(), self.poses(policy), self.best(policy));
        let here = &truth[step as usize];
        let (x, y) =
            poses.iter().zip(self.weights(policy)).fold((0.0, 0.0), |(x, y), (p, w)| (x + w * p.x, y + w * p.y));
        let error_mean = ops::hypot(x - here.x, y - here.y);
        let squares = before.rms_mean * before.rms_mean * f64::from(step) + error_mean * error_mean;
        let lost = self.lost_from().is_some_and(|from| step >= from);
        let Stepped { log_evidence, ess, ancestors, associations } = stepped;
        PolicyReport {
            step,
            log_evidence,
            ess,
            ancestors,
            descent: self.run(policy).descent(),
            error_best: poses[best].distance(here),
            error_mean,
            rms_best: rms(&self.paths(policy)[best].poses(), &truth[..=step as usize]),
            rms_mean: (squares / f64::from(step + 1)).sqrt(),
            right: lost.then(|| poses.iter().filter(|pose| is_right(pose, here)).count() as u32),
            associations,
        }
    }

    /// What was set.
    pub fn setup(&self) -> &PoliciesSetup {
        &self.setup
    }

    /// Reports of the newest step, in the order of [`POLICIES`].
    pub fn reports(&self) -> &[PolicyReport; 3] {
        &self.reports
    }

    /// The newest step that all three have made.
    pub fn step_number(&self) -> u32 {
        self.reports[SELECTIVE].step
    }

    /// The last step.
    pub fn step_count(&self) -> u32 {
        self.truth().len() as u32 - 1
    }

    /// True poses of steps 0 to the last.
    pub fn truth(&self) -> &[Pose2] {
        self.world.truth()
    }

    /// Poses by raw odometry alone, of steps 0 to the last.
    pub fn odometry(&self) -> &[Pose2] {
        self.world.odometry()
    }

    /// The lap's world, on the lap.
    pub fn lap_world(&self) -> Option<&LapWorld> {
        match &self.world {
            World::Lap(world) => Some(world),
            World::Wings(_) => None,
        }
    }

    /// The drive among landmarks, on the wings' course.
    pub fn wings_log(&self) -> Option<&LandmarkLog> {
        match &self.world {
            World::Lap(_) => None,
            World::Wings(log) => Some(log),
        }
    }

    /// On the wings' course, the step from which the robot is lost: the first at which the wings can be confused.
    pub fn lost_from(&self) -> Option<u32> {
        self.wings_log().map(|_| WINGS_LOST as u32)
    }

    /// On the wings' course, the step at which the sign is in sight again: the first evidence of which wing it is.
    pub fn evidence_at(&self) -> Option<u32> {
        let is_sign = |feature: &Feature| feature.signature == Some(WINGS_SIGN);
        let seen = self.wings_log()?.sightings[WINGS_LOST..].iter().position(|seen| seen.iter().any(is_sign))?;
        Some((WINGS_LOST + seen) as u32 + 1)
    }

    /// Paths of one filter's particles, by slot.
    pub fn paths(&self, policy: usize) -> Vec<&Path> {
        self.run(policy).paths()
    }

    /// Poses of one filter's particles, by slot.
    pub fn poses(&self, policy: usize) -> Vec<Pose2> {
        self.run(policy).poses()
    }

    /// Normalised weights of one filter as they are now, by slot: uniform after a resampling.
    pub fn weights(&self, policy: usize) -> &[f64] {
        self.run(policy).weights()
    }

    /// Slot of one filter's best particle.
    pub fn best(&self, policy: usize) -> usize {
        self.run(policy).best()
    }

    /// Runs to the end. Returns a fingerprint of every report, pose and weight on the way, bit for bit.
    pub fn trace(mut self) -> Digest {
        let mut digest = Digest::new();
        while self.step().is_some() {
            for (policy, report) in self.reports.iter().enumerate() {
                let r = report;
                let (associations, answers) = r.associations.unwrap_or_default();
                let counts = [r.step, u32::from(r.resampled()), r.right.unwrap_or(u32::MAX)];
                counts.into_iter().chain([associations.again, associations.first, answers]).for_each(|x| digest.u32(x));
                let errors = [r.error_best, r.error_mean, r.rms_best, r.rms_mean];
                [r.ess, associations.log_increment].into_iter().chain(errors).for_each(|x| digest.f64(x));
                r.descent.widths().for_each(|width| digest.u32(width));
                for Pose2 { x, y, theta } in self.poses(policy) {
                    [x, y, theta].into_iter().for_each(|x| digest.f64(x));
                }
                self.weights(policy).iter().for_each(|weight| digest.f64(*weight));
            }
        }
        digest
    }
}

#[cfg(test)]
mod tests;
