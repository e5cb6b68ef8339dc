//! The lap as a deterministic state: what was set, which step is shown, and keyframes to go back by.

use super::{hand::Hand, recipe::Recipe};
use crate::ghost::{self, Curves};
use crate::kept::Kept;
use crate::model::{Change, Declared, FigureError, Model};
use crate::shared;
use crate::told::refused;
use crate::words::lap as words;
use core::mem::replace;
use fastslam::{genealogy::Path, geometry::Pose2, proposal::Proposed, resampling::ResamplePolicy};
use fastslam_lab::experiment::lap::{self, Lap, LapSetup, LapWorld, StepReport};
use fastslam_lab::experiment::ring::{AFTER, deviation, died};
use fastslam_lab::world::Edits;
use std::sync::Arc;

/// Most universes that keyframes keep, all steps together. Each holds the tiles that were written since the one before: about
/// 30 KB, and all of them 64 MB.
const KEPT: u32 = 2048;

/// Poses that are drawn again, at most, for a step that is gone back to: some 7 ms. Keyframes of every step would cost as much
/// whenever a slider moves, as each holds tiles of its own, which are made and thrown away.
const AGAIN: u32 = 128;

/// How fast the closing of the loop is played, of the usual speed.
const SLOW: f64 = 0.25;

/// Most universes that the keyframes of a run keep that is shown no more.
const KEPT_ASIDE: usize = 256;

/// A lap in a setting, as far as it was simulated.
struct Run {
    setup: LapSetup,
    /// The step shown.
    shown: Lap,
    keyframes: Vec<Lap>,
    reports: Vec<StepReport>,
    dead: Vec<Vec<Path>>,
}

impl Run {
    fn new(setup: &LapSetup) -> Result<Self, FigureError> {
        Ok(Self::of(setup, Lap::new(setup).map_err(refused)?))
    }

    /// The same where the world of another setup is there.
    fn like(setup: &LapSetup, other: &LapSetup, world: &Arc<LapWorld>) -> Result<Self, FigureError> {
        setup.validate().map_err(refused)?;
        Ok(Self::of(setup, Lap::in_world(setup, setup.world_like(other, world)).map_err(refused)?))
    }

    fn of(setup: &LapSetup, lap: Lap) -> Self {
        let (keyframes, reports, dead) = (vec![lap.clone()], vec![lap.report().clone()], vec![Vec::new()]);
        Self { setup: setup.clone(), shown: lap, keyframes, reports, dead }
    }

    /// With no more keyframes than are kept of a run that is put aside; the first is always.
    fn thinned(mut self) -> Self {
        let kept = (KEPT_ASIDE / self.setup.particles).max(1);
        let every = self.keyframes.len().div_ceil(kept);
        self.keyframes = self.keyframes.into_iter().step_by(every).collect();
        self
    }
}

/// Figure w17.1.
pub struct LapModel {
    pub(super) recipe: Recipe,
    /// What a reader at the wheel holds.
    pub(super) hand: Option<Hand>,
    /// The step shown.
    shown: Lap,
    /// Every [`Self::interval`]-th step, from 0 on.
    keyframes: Vec<Lap>,
    /// Of every step simulated so far, from 0 on.
    reports: Vec<StepReport>,
    /// The paths that each of these steps ended, up to the step before it.
    dead: Vec<Vec<Path>>,
    kept: Kept<Run>,
    /// The step at which the loop of the course closes.
    closing: Option<u32>,
    /// Whether all were shown at once before one was chosen.
    overlaid_before: bool,
    /// Of the run that is pinned.
    pinned: Curves,
}

impl Default for LapModel {
    fn default() -> Self {
        let recipe = Recipe::default();
        let run = Run::new(&recipe.setup).unwrap_or_else(|error| unreachable!("the default setup: {error}"));
        let Run { shown, keyframes, reports, dead, .. } = run;
        let (closing, kept, pinned) = (recipe.setup.course.closing(), Kept::default(), Curves::new());
        Self { recipe, hand: None, keyframes, reports, dead, kept, closing, shown, overlaid_before: true, pinned }
    }
}

impl LapModel {
    /// The lap at the step shown.
    pub fn lap(&self) -> &Lap {
        &self.shown
    }

    /// What the step shown did.
    pub fn report(&self) -> &StepReport {
        self.shown.report()
    }

    /// Reports of steps 0 to the one shown.
    pub fn history(&self) -> &[StepReport] {
        &self.reports[..=self.report().step as usize]
    }

    /// Reports of every step simulated so far.
    pub(super) fn simulated(&self) -> &[StepReport] {
        &self.reports
    }

    /// N_eff of the run that is pinned, by step \[share of its universes\].
    pub fn pinned_ess(&self) -> &[f64] {
        ghost::curve(&self.pinned, 0)
    }

    /// The paths of universes that died out: at the step shown, at the one before it, and so on back to the start.
    pub fn dead(&self) -> impl Iterator<Item = &[Path]> {
        self.dead[..=self.step() as usize].iter().rev().map(Vec::as_slice)
    }

    /// True if the large view shows all universes at once.
    pub fn overlaid(&self) -> bool {
        self.recipe.overlay && self.recipe.universe.is_none()
    }

    /// What each universe counts for in a picture and a number of all of them: its weight; where nothing resamples, as much as any
    /// other, as their weights choose among them then only on paper.
    pub fn shares(&self) -> Vec<f64> {
        let weights = self.shown.weights();
        match self.recipe.setup.policy {
            ResamplePolicy::Never => vec![1.0 / weights.len() as f64; weights.len()],
            _ => weights.to_vec(),
        }
    }

    /// How far the universes are apart: the standard deviation of the robot's position over them \[m\], each counting for its share.
    pub fn spread(&self) -> f64 {
        let poses: Vec<Pose2> = self.shown.particles().iter().map(|particle| particle.world_from_robot).collect();
        deviation(&poses, &self.shares())
    }

    /// Whether the loop closes about now: from one step before until [`AFTER`] steps after.
    pub fn closes(&self) -> bool {
        self.closing().is_some_and(|closing| (closing.saturating_sub(1)..=closing + AFTER).contains(&self.step()))
    }

    /// Whether it is still to close.
    pub fn drifts(&self) -> bool {
        self.closing().is_some_and(|closing| self.step() < closing)
    }

    /// Whether it has closed, and that is over.
    pub fn closed(&self) -> bool {
        self.closing().is_some_and(|closing| self.step() > closing + AFTER)
    }

    /// How many of the universes that lived one step before the loop closed have no descendant any more: as it is now while it
    /// closes, and as it was when it had.
    pub fn died_in_closing(&self) -> usize {
        let count = self.recipe.setup.particles;
        let since = self.closing().map_or(usize::MAX, |closing| closing as usize);
        let steps = self.history().iter().take(since.saturating_add(AFTER as usize + 1)).skip(since);
        let resamplings: Vec<Vec<u32>> = steps.filter_map(|report| report.ancestors.clone()).collect();
        (died(count, &resamplings) * count as f64).round() as usize
    }

    /// What was set.
    pub fn setup(&self) -> &LapSetup {
        &self.recipe.setup
    }

    /// Slot of the universe in the large view.
    pub fn selected(&self) -> u32 {
        self.recipe.universe.unwrap_or(self.report().best)
    }

    /// Whether the truth is drawn.
    pub fn shows_truth(&self) -> bool {
        self.recipe.truth || self.hand.is_some()
    }

    /// Whether raw odometry is drawn.
    pub fn shows_raw(&self) -> bool {
        self.recipe.raw
    }

    /// Chooses a slot for the large view, or lets go of it if it was chosen.
    pub fn pick(&mut self, target: u32) {
        if (target as usize) < self.recipe.setup.particles {
            let recipe = &mut self.recipe;
            (recipe.universe, recipe.overlay) = match recipe.universe {
                Some(chosen) if chosen == target => (None, self.overlaid_before),
                Some(_) => (Some(target), false),
                None => {
                    self.overlaid_before = recipe.overlay;
                    (Some(target), false)
                }
            };
        }
    }

    /// Slots whose universe died out at the step shown, in ascending order; none where it did not resample.
    pub fn extinct(&self) -> Vec<u32> {
        let Some(ancestors) = &self.report().ancestors else { return Vec::new() };
        (0..ancestors.len() as u32).filter(|slot| !ancestors.contains(slot)).collect()
    }

    /// Steps between keyframes.
    fn interval(&self) -> u32 {
        let particles = self.recipe.setup.particles as u32;
        (self.step_count() * particles).div_ceil(KEPT).max(AGAIN / particles).max(1)
    }

    /// The newest keyframe at a step, or before it.
    fn keyframe_at(&self, step: u32) -> usize {
        self.keyframes.partition_point(|lap| lap.report().step <= step).saturating_sub(1)
    }

    /// The step at which the loop closes, where the course is driven as it is.
    pub(super) fn closing(&self) -> Option<u32> {
        self.closing.filter(|_| self.recipe.setup.edits == Edits::default())
    }

    /// Goes on in a world in which another drive is driven: what both have in common stays.
    fn steer(&mut self, setup: &LapSetup) {
        let (before, route) = (&self.recipe.setup.edits.steering, setup.course.route());
        let kept = before.in_common(&setup.edits.steering, route.steps) as u32;
        let world = Arc::new(self.shown.world().driven(&route, before, &setup.edits.steering));
        self.keyframes.retain(|lap| lap.report().step <= kept);
        self.reports.truncate(kept as usize + 1);
        self.dead.truncate(kept as usize + 1);
        if self.step() > kept {
            self.shown = self.keyframes[self.keyframe_at(kept)].clone();
        }
        let all = self.keyframes.iter_mut().chain([&mut self.shown]);
        all.for_each(|lap| *lap = lap.clone().with_world(world.clone()));
    }
}

impl LapModel {
    /// Does a pending step, by these draws if they are there.
    fn work_by(&mut self, draws: Option<Vec<Proposed<()>>>) {
        if self.pending() == 0 {
            return;
        }
        let paths: Vec<Path> = self.shown.particles().iter().map(|particle| particle.path.clone()).collect();
        self.shown.step_by(draws);
        let (step, interval) = (self.step(), self.interval());
        if self.reports.len() == step as usize {
            self.reports.push(self.report().clone());
            self.dead.push(self.extinct().into_iter().map(|slot| paths[slot as usize].clone()).collect());
        }
        if self.keyframes.last().is_none_or(|lap| lap.report().step + interval <= step) {
            self.keyframes.push(self.shown.clone());
        }
    }
}

impl Declared for LapModel {
    type Recipe = Recipe;
    const TITLE: &'static str = words::TITLE;
    /// The figure opened in the apartment, with one universe shown large; then on the ring, with a share of the evidence of its own and, later,
    /// a worse laser.
    const CHANGES: &'static [Change] = &[
        Change::Default { name: "course", was: "apartment" },
        Change::Default { name: "temper", was: "0.85" },
        Change::Default { name: "overlay", was: "off" },
        Change::DefaultUnless { name: "weight", was: "old-map-at-draw", unless: ("proposal", "motion") },
        Change::Default { name: "temper", was: "0.3" },
        Change::Default { name: "range-std", was: "0.02" },
        Change::Default { name: "seed", was: "3" },
        Change::Opens,
        Change::Default { name: "course", was: "ring" },
        Change::Default { name: "seed", was: "9" },
        Change::Default { name: "odometry", was: "1" },
        Change::Default { name: "range-std", was: "0.1" },
    ];
    const UNSAID: usize = 8;

    fn recipe(&self) -> &Recipe {
        &self.recipe
    }

    fn adopt(&mut self, recipe: Recipe) -> Result<(), FigureError> {
        if recipe.setup.but_for_steering(&self.recipe.setup) {
            if recipe.setup != self.recipe.setup {
                recipe.setup.validate().map_err(refused)?;
                self.steer(&recipe.setup);
            }
        } else {
            let run = match self.kept.take(|run| run.setup == recipe.setup) {
                Some(kept) => kept,
                None => Run::like(&recipe.setup, &self.recipe.setup, self.shown.world())?,
            };
            let finished = self.pending() == 0 && self.step() > 0;
            let before = Run {
                setup: self.recipe.setup.clone(),
                shown: replace(&mut self.shown, run.shown),
                keyframes: replace(&mut self.keyframes, run.keyframes),
                reports: replace(&mut self.reports, run.reports),
                dead: replace(&mut self.dead, run.dead),
            };
            if finished {
                self.kept.put(before.thinned());
            }
            if recipe.setup.course != self.recipe.setup.course {
                self.closing = recipe.setup.course.closing();
            }
        }
        self.recipe = recipe;
        self.seek(self.recipe.step);
        Ok(())
    }
}

impl Model for LapModel {
    fn seek(&mut self, step: u32) {
        let asked = step.min(self.step_count());
        self.recipe.step = asked;
        let index = self.keyframe_at(asked);
        let (start, shown) = (self.keyframes[index].report().step, self.step());
        if asked < shown || start > shown {
            self.shown = self.keyframes[index].clone();
        }
    }

    fn step_count(&self) -> u32 {
        self.shown.step_count()
    }

    fn step(&self) -> u32 {
        self.report().step
    }

    /// The loop closes: universes that disagree die.
    fn telling(&self) -> u32 {
        self.closing().map_or(self.step_count(), |closing| closing + 2)
    }

    fn watch(&self) -> Option<(u32, &'static str)> {
        Some((self.closing()?.saturating_sub(1), words::watch()))
    }

    fn pending(&self) -> u32 {
        self.recipe.step - self.step()
    }

    fn work(&mut self) {
        self.work_by(None);
    }

    fn shares(&self) -> bool {
        self.step() == 0 && shared::is_worth_while(self.recipe.setup.particles, self.pending())
    }

    fn part(&self, part: usize) -> Vec<f64> {
        let slots = lap::shared::slots(part, self.recipe.setup.particles);
        shared::after(self.step(), lap::shared::to_numbers(&self.shown.propose(slots)))
    }

    fn work_with(&mut self, parts: [&[f64]; 2]) {
        let draws = shared::draws(parts, self.step()).map(|draws| lap::shared::from_numbers(&draws.concat()));
        self.work_by(draws.filter(|draws| draws.len() == self.recipe.setup.particles));
    }

    fn compared(&self) -> Vec<&'static str> {
        vec!["rms_best", "spread", "ess"]
    }

    fn curves(&self) -> Curves {
        let m = self.recipe.setup.particles as f64;
        vec![self.reports.iter().map(|report| report.ess / m).collect()]
    }

    fn haunt(&mut self, pinned: Curves) {
        self.pinned = pinned;
    }

    /// In slow motion while the loop closes.
    fn pace(&self) -> f64 {
        if self.closes() { SLOW } else { 1.0 }
    }
}
