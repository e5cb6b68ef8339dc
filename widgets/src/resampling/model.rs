//! Three filters as a deterministic state: what was set, how far they ran, and which step of that is shown.

use super::recipe::{Recipe, SELECTIVE};
use crate::ghost::{self, Curves};
use crate::kept::Kept;
use crate::model::{Change, Declared, FigureError, Model};
use crate::prediction::{Outcome, State};
use crate::shared;
use crate::told::{WEIGHED_ANEW, in_range, refused};
use crate::words::resampling;
use core::mem::replace;
use fastslam::geometry::Pose2;
use fastslam_lab::experiment::resampling::{POLICIES, Policies, PoliciesSetup, PolicyCourse, PolicyReport};
use std::sync::Arc;

/// Figure w17.2.
pub struct ResamplingModel {
    recipe: Recipe,
    /// All three, as far as they ran.
    run: Policies,
    /// Of every step simulated so far, from 0 on, one for each policy: any of them can be shown, and whoever died out since,
    /// whom the filters forget.
    moments: Vec<[Moment; 3]>,
    /// Moments of the previous run, while the selective filter catches up with the two that do not depend on the threshold.
    known: Arc<Vec<[Moment; 3]>>,
    kept: Kept<Begun>,
    /// Of the run that is pinned: N_eff, ancestors at the start \[shares of its particles\] and errors of the best \[m\] of each policy in turn.
    pinned: Curves,
}

/// A run, its moments, and those known from the previous run.
type Begun = (Policies, Vec<[Moment; 3]>, Arc<Vec<[Moment; 3]>>);

/// One filter at one step.
#[derive(Clone, PartialEq, Debug)]
pub struct Moment {
    /// What the step did.
    pub report: PolicyReport,
    /// Pose of each particle, by slot.
    pub poses: Vec<Pose2>,
    /// Slot of the best particle.
    pub best: usize,
    /// Steps that resampled, up to this one.
    pub resampled: u32,
}

impl Default for ResamplingModel {
    fn default() -> Self {
        let recipe = Recipe::default();
        let run = in_range(Policies::new(&recipe.setup()));
        let moments = vec![moments(&run, None, None)];
        let (known, kept) = Default::default();
        Self { recipe, run, moments, known, kept, pinned: Curves::new() }
    }
}

/// The newest step of all three; of the two filters without a threshold as it is known, if it is.
fn moments(run: &Policies, before: Option<&[Moment; 3]>, known: Option<&[Moment; 3]>) -> [Moment; 3] {
    [0, 1, 2].map(|policy| {
        if let Some(known) = known.filter(|_| policy < SELECTIVE) {
            return known[policy].clone();
        }
        let report = run.reports()[policy].clone();
        let resampled = before.map_or(0, |b| b[policy].resampled) + u32::from(report.resampled());
        Moment { report, poses: run.poses(policy), best: run.best(policy), resampled }
    })
}

impl Moment {
    /// The slot that a particle was copied from in this step: its own, where nothing was resampled.
    pub fn copied_from(&self, slot: usize) -> usize {
        self.report.ancestors.as_ref().map_or(slot, |ancestors| ancestors[slot] as usize)
    }
}

impl ResamplingModel {
    /// A run with another setup, its first moment, and the moments that are known already.
    fn begun(&self, setup: &PoliciesSetup) -> Result<Begun, FigureError> {
        let (run, known) = match self.run.asked(setup).map_err(refused)? {
            Some(run) if self.run.catches_up() => (run, self.known.clone()),
            Some(run) => (run, self.moments.clone().into()),
            None => (Policies::new(setup).map_err(refused)?, Arc::default()),
        };
        let first = vec![moments(&run, None, known.first())];
        Ok((run, first, known))
    }

    /// The setup of the filters.
    pub fn setup(&self) -> &PoliciesSetup {
        self.run.setup()
    }

    /// The filters, as far as they ran: at the step shown, or beyond.
    pub fn run(&self) -> &Policies {
        &self.run
    }

    /// All three at every step simulated so far that may be seen.
    pub(super) fn moments(&self) -> &[[Moment; 3]] {
        &self.moments[..self.moments.len().min(self.step_count() as usize + 1)]
    }

    /// One filter at steps 0 to the one shown.
    pub fn history(&self, policy: usize) -> impl DoubleEndedIterator<Item = &Moment> + ExactSizeIterator {
        self.moments[..=self.step() as usize].iter().map(move |all| &all[policy])
    }

    /// One filter at the step shown.
    pub fn now(&self, policy: usize) -> &Moment {
        &self.moments[self.step() as usize][policy]
    }

    /// Of steps 0 to the one shown, and of each slot as it was before the step resampled, whether a particle of the step shown
    /// descends from it.
    pub fn alive(&self, policy: usize) -> Vec<Vec<bool>> {
        let mut alive = vec![true; self.setup().particles];
        let back = self.history(policy).rev().map(|moment| {
            let mut before = vec![false; alive.len()];
            let slots = alive.iter().enumerate().filter(|(_, alive)| **alive);
            slots.for_each(|(slot, _)| before[moment.copied_from(slot)] = true);
            alive.clone_from(&before);
            before
        });
        let mut steps: Vec<_> = back.collect();
        steps.reverse();
        steps
    }

    /// One filter at the step that is read.
    pub fn read(&self, policy: usize) -> &Moment {
        &self.moments[self.cursor() as usize][policy]
    }

    /// The step that is read.
    pub fn cursor(&self) -> u32 {
        self.recipe.cursor.unwrap_or(u32::MAX).min(self.step())
    }

    /// Whether the step that is read is not the newest.
    pub fn looks_back(&self) -> bool {
        self.cursor() < self.step()
    }

    /// The policy whose tree is shown, by its index among [`POLICIES`].
    pub fn chosen(&self) -> usize {
        self.recipe.policy
    }

    /// Shows the tree of another policy.
    pub fn choose(&mut self, policy: usize) {
        self.change(|recipe| recipe.policy = policy.min(POLICIES.len() - 1));
    }

    /// Where N_eff calls for resampling in the selective filter, or as near to it as it can \[share of M\].
    pub fn put_threshold(&mut self, threshold: f64) {
        self.change(|recipe| recipe.put_threshold(threshold));
    }

    /// The last step of the course, whether it may be seen or not.
    pub fn course_steps(&self) -> u32 {
        self.run.step_count()
    }

    /// How far the reader's prediction is.
    pub fn state(&self) -> State {
        self.recipe.prediction.state()
    }

    /// The first step at which all particles of the policy that is chosen descend from one, if it has come and may be seen.
    pub fn one_left(&self) -> Option<u32> {
        let one = |moment: &Moment| moment.report.descent.lineage(u32::MAX) == 1;
        let seen = self.recipe.prediction.is_shown() && self.setup().particles > 1;
        seen.then(|| self.moments.iter().find(|all| one(&all[self.chosen()])))?.map(|all| all[0].report.step)
    }

    /// Places a guess at a step, or at the nearest that there can be.
    pub fn guess_at(&mut self, step: f64) {
        let last = f64::from(self.course_steps());
        self.change(|recipe| recipe.prediction.place(Some(step.round().min(last).max(1.0))));
    }

    /// Keeps the newest step.
    fn remember(&mut self) {
        let known = self.known.get(self.moments.len());
        self.moments.push(moments(&self.run, self.moments.last(), known));
        if !self.run.catches_up() {
            self.known = Arc::default();
        }
    }

    /// Steps of the simulation that are needed: to the one that is shown, or where a prediction is judged, until it can be.
    fn needed(&self) -> u32 {
        let judged = self.recipe.prediction.is_shown() && self.one_left().is_none();
        if judged { self.course_steps() } else { self.recipe.step }
    }

    /// Steps back of the second lineage gauge.
    pub fn back(&self) -> u32 {
        self.recipe.back
    }

    /// A curve of the run that is pinned, of the policy that is shown: N_eff, ancestors or errors.
    pub fn pinned(&self, rank: usize) -> &[f64] {
        ghost::curve(&self.pinned, PINNED * self.chosen() + rank)
    }

    /// Largest position error of any filter up to the step shown, or of the curve that is drawn of the run that is pinned \[m\].
    pub fn largest_error(&self) -> f64 {
        let errors =
            (0..3).flat_map(|policy| self.history(policy)).flat_map(|m| [m.report.error_best, m.report.error_mean]);
        errors.chain(self.pinned(PINNED - 1).iter().copied()).fold(0.0, f64::max)
    }

    /// Reads a step, as near to it as there is one. The newest is followed.
    pub fn look(&mut self, step: f64) {
        let step = step.min(f64::from(self.step())).max(0.0) as u32;
        self.recipe.cursor = (step < self.step()).then_some(step);
    }
}

impl Declared for ResamplingModel {
    type Recipe = Recipe;
    const TITLE: &'static str = resampling::TITLE;
    const CHANGES: &'static [Change] = &[
        WEIGHED_ANEW,
        Change::Switched {
            name: "wings",
            changes: &[Change::Told("What is seen in a step is told apart all together: paths and weights differ.")],
        },
        Change::Opens,
    ];
    const UNSAID: usize = 3;

    fn recipe(&self) -> &Recipe {
        &self.recipe
    }

    fn adopt(&mut self, recipe: Recipe) -> Result<(), FigureError> {
        let setup = recipe.setup();
        if setup != *self.setup() {
            let finished = self.pending() == 0 && self.run.step_number() > 0;
            let (run, moments, known) = match self.kept.take(|(run, ..)| *run.setup() == setup) {
                Some(kept) => kept,
                None => self.begun(&setup)?,
            };
            let before =
                (replace(&mut self.run, run), replace(&mut self.moments, moments), replace(&mut self.known, known));
            if finished {
                self.kept.put(before);
            }
        }
        self.recipe = recipe;
        Ok(())
    }
}

impl Model for ResamplingModel {
    /// Time moves: the cursor goes along.
    fn seek(&mut self, step: u32) {
        self.recipe.step = step.min(self.step_count());
        self.recipe.cursor = None;
    }

    fn step_count(&self) -> u32 {
        self.recipe.horizon()
    }

    fn step(&self) -> u32 {
        self.recipe.step.min(self.run.step_number())
    }

    /// Few ancestors are left, and the last one that all have in common is not long ago; or the sign has said who was right.
    fn telling(&self) -> u32 {
        if self.setup().course == PolicyCourse::Wings { self.step_count() } else { TELLING.min(self.step_count()) }
    }

    fn watch(&self) -> Option<(u32, &'static str)> {
        Some((0, resampling::watch()))
    }

    fn pending(&self) -> u32 {
        self.needed().saturating_sub(self.run.step_number())
    }

    fn work(&mut self) {
        if self.pending() > 0 && self.run.advance() == Some(true) {
            self.remember();
        }
    }

    /// Two filters draw, and later the third. Not of the landmarks, whose draws are the lesser part of a step, nor where one filter catches up with the others.
    fn shares(&self) -> bool {
        let lap = self.setup().course == PolicyCourse::Lap;
        let begins = self.run.step_number() == 0 && !self.run.catches_up();
        lap && begins && shared::is_worth_while(2 * self.setup().particles, self.pending())
    }

    fn part(&self, part: usize) -> Vec<f64> {
        shared::after(self.run.step_number(), self.run.propose(part))
    }

    fn work_with(&mut self, parts: [&[f64]; 2]) {
        if self.pending() > 0 {
            self.run.step_by(shared::draws(parts, self.run.step_number()).unwrap_or_default());
            self.remember();
        }
    }

    /// Of the policy that is shown; in the loop of ambiguity it matters who still has the right wing.
    fn compared(&self) -> Vec<&'static str> {
        const OF: [[&str; 4]; 3] = [
            ["never_error_best", "never_right", "never_ess", "never_lineage"],
            ["always_error_best", "always_right", "always_ess", "always_lineage"],
            ["selective_error_best", "selective_right", "selective_ess", "selective_lineage"],
        ];
        let [error, right, ess, lineage] = OF[self.chosen()];
        vec![if self.setup().course == PolicyCourse::Wings { right } else { error }, ess, lineage]
    }

    fn prediction(&self) -> Option<Outcome> {
        self.recipe.prediction.outcome("one_left", self.one_left().map(f64::from))
    }

    fn curves(&self) -> Curves {
        let m = self.setup().particles as f64;
        let curve = |policy: usize, of: &dyn Fn(&PolicyReport) -> f64| {
            self.moments.iter().map(|all| of(&all[policy].report)).collect()
        };
        let lineage = |report: &PolicyReport| f64::from(report.descent.lineage(u32::MAX)) / m;
        let all = |policy| {
            [curve(policy, &|r| r.ess / m), curve(policy, &lineage), curve(policy, &|report| report.error_best)]
        };
        [0, 1, 2].into_iter().flat_map(all).collect()
    }

    fn haunt(&mut self, pinned: Curves) {
        self.pinned = pinned;
    }
}

/// The step of the lap shown at rest.
const TELLING: u32 = 70;

/// Curves that are pinned of each policy.
const PINNED: usize = 3;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Parameters as _, Tells as _};

    #[test]
    fn the_sentence_says_which_filter_does_not_explain_what_is_seen() {
        let mut model = ResamplingModel::default();
        model.seek(1);
        model.settle();
        assert!(!model.describe().contains("explains"));
        model.moments[1][2].report.log_evidence = f64::NEG_INFINITY;
        let told = model.describe();
        assert!(told.contains("resamples selectively no particle explains what is seen"), "{told}");
        assert!(!told.contains("never resamples"), "{told}");
    }

    fn set(model: &mut ResamplingModel, threshold: &str) {
        assert_eq!(model.configure(&[("threshold".into(), threshold.into())]), []);
    }

    /// However far the previous run had come: also at a threshold whose run was kept, and at later steps.
    #[test]
    fn dragging_the_threshold_shows_what_a_new_figure_shows() {
        let mut dragged = ResamplingModel::default();
        dragged.seek(30);
        dragged.settle();
        for (threshold, slices, step) in
            [("0.8", 7, 30), ("0.3", 200, 30), ("0.8", 12, 40), ("0.3", 200, 45), ("0.9", 400, 45)]
        {
            set(&mut dragged, threshold);
            dragged.seek(step);
            (0..slices).for_each(|_| dragged.work());
            let mut alone = ResamplingModel::default();
            set(&mut alone, threshold);
            alone.seek(dragged.run.step_number());
            alone.settle();
            assert!(dragged.moments == alone.moments, "{threshold} up to step {}", dragged.step());
        }
        assert_eq!(dragged.pending(), 0);
    }
}
