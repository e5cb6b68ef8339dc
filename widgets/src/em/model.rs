//! EM mapping as a deterministic state: the log, all maps up to the last iteration, and which part of which iteration is shown.

use super::recipe::{END, FILLS, MARK, Recipe, TICKS};
use crate::{
    ghost::{self, Curves},
    kept::Kept,
    model::{Declared, FigureError, Model},
    prediction::{Outcome, State},
    told::{in_range, refused},
    words::em,
};
use fastslam::error::SettingError;
use fastslam_lab::baseline::em_mapping::Expectation;
use fastslam_lab::experiment::em::{self as lab, CORRIDOR, Cloud, Iterate, Log, Others};

/// An iteration that gains less than this \[nats\] has converged.
pub const STILL: f64 = 0.01;

/// What is shown of an iteration.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Now {
    /// The iteration, from 0 on: its map is the one that is taken for true.
    pub iteration: u32,
    /// Steps of it that are done, of [`TICKS`].
    pub ticks: u32,
}

impl Now {
    fn at(step: u32) -> Self {
        match step.checked_sub(1) {
            None => Self { iteration: 0, ticks: 0 },
            Some(before) => Self { iteration: before / TICKS, ticks: before % TICKS + 1 },
        }
    }

    /// Columns of the forward pass that are done, and of the backward one, of so many.
    pub fn columns(self, all: usize) -> [usize; 2] {
        let done = [self.ticks, self.ticks.saturating_sub(FILLS)];
        done.map(|ticks| (all * ticks.min(FILLS) as usize).div_ceil(FILLS as usize))
    }

    /// Whether the two are multiplied.
    pub fn has_product(self) -> bool {
        self.ticks > 2 * FILLS
    }

    /// Whether its map is made of that.
    pub fn has_map(self) -> bool {
        self.ticks == TICKS
    }
}

/// EM mapping, and the particles.
pub struct EmModel {
    recipe: Recipe,
    log: Log,
    iterates: Vec<Iterate>,
    /// Both passes of the iteration that is shown.
    passes: Expectation,
    /// Entropy of the path by them \[nats\].
    entropy: f64,
    /// Where the last iteration has the robot put down \[m\], and the share that has the first two doors come again; while the reader is
    /// asked for that.
    end: Option<(f64, f64)>,
    cloud: Cloud,
    others: Others,
    kept: Kept<(Log, Cloud, Others)>,
    /// Of the run that is pinned: what never falls, by iterations.
    pinned: Curves,
}

impl Default for EmModel {
    fn default() -> Self {
        let recipe = Recipe::default();
        in_range(Self::new(recipe))
    }
}

fn climb(recipe: &Recipe, log: &Log) -> Result<Vec<Iterate>, SettingError> {
    lab::climb(log, recipe.guess().first_map()?, recipe.iterations)
}

/// Where both passes have the robot put down at a step \[m\], in the mean, and the share of that which has the first two doors come again.
fn answer(passes: &Expectation, carried: usize) -> Option<(f64, f64)> {
    let shares = passes.product(carried)?;
    let mean = shares.iter().enumerate().map(|(cell, share)| share * CORRIDOR.place(cell)).sum();
    Some((mean, lab::again(&shares)))
}

impl EmModel {
    fn new(recipe: Recipe) -> Result<Self, SettingError> {
        let log = Log::new(&recipe.log())?;
        let iterates = climb(&recipe, &log)?;
        let passes = Expectation::new(iterates[0].map.clone(), &log.ride)?;
        let (cloud, entropy) = (Cloud::new(&log)?, 0.0);
        let (others, kept, pinned, end) = Default::default();
        let mut model = Self { recipe, log, iterates, passes, entropy, end, cloud, others, kept, pinned };
        model.localise()?;
        Ok(model)
    }

    /// Runs both passes of the iteration that is shown.
    fn localise(&mut self) -> Result<(), SettingError> {
        let map = self.iterates[self.now().iteration as usize].map.clone();
        self.passes = Expectation::of(map, &self.log.ride)?;
        self.entropy = self.passes.path_entropy(&self.log.ride).unwrap_or(f64::NAN);
        self.end = None;
        if self.recipe.prediction.predict {
            let map = self.iterates[self.recipe.iterations as usize - 1].map.clone();
            self.end = answer(&Expectation::of(map, &self.log.ride)?, self.log.carried);
        }
        Ok(())
    }

    /// How far the reader's prediction is.
    pub fn state(&self) -> State {
        self.recipe.prediction.state()
    }

    /// Whether nothing of the iterations is to be seen yet.
    pub fn hides(&self) -> bool {
        self.recipe.prediction.hides()
    }

    /// Where the last iteration has the robot put down, as in [`Self::put_down`], where the reader was asked for it.
    pub fn end(&self) -> Option<(f64, f64)> {
        self.end
    }

    /// Places a guess \[m\], or the nearest that there can be.
    pub fn guess_at(&mut self, place: f64) {
        if place.is_finite() {
            // Tenths, as they are written.
            let place = (place / MARK.2).round().clamp(MARK.0 / MARK.2, MARK.1 / MARK.2) / 10.0;
            self.change(|recipe| recipe.prediction.place(Some(place)));
        }
    }

    /// What is shown of which iteration.
    pub fn now(&self) -> Now {
        Now::at(self.step())
    }

    /// What all read.
    pub fn log(&self) -> &Log {
        &self.log
    }

    /// The map shown, and what it is worth: the one that is taken for true, until there is the next.
    pub fn shown(&self) -> &Iterate {
        &self.iterates[self.rank() as usize]
    }

    /// How many iterations the map shown is from the first guess.
    pub fn rank(&self) -> u32 {
        self.now().iteration + u32::from(self.now().has_map())
    }

    /// Number of iterations that are made.
    pub fn iterations(&self) -> u32 {
        self.recipe.iterations
    }

    /// All maps, from the first guess on; that alone while the reader is asked what comes of it.
    pub fn iterates(&self) -> &[Iterate] {
        if self.hides() { &self.iterates[..1] } else { &self.iterates }
    }

    /// Both passes of the iteration shown, whole.
    pub fn passes(&self) -> &Expectation {
        &self.passes
    }

    /// How many readings after each step tell where the robot was then; `None` where all do.
    pub fn future(&self) -> Option<u32> {
        Some(self.recipe.future).filter(|future| *future < lab::STEPS)
    }

    /// Where the robot was at a step, as far as the passes are: by the readings up to then, and where the backward pass has been, by the ones
    /// after that are asked for.
    pub fn column(&self, step: usize) -> Option<Vec<f64>> {
        let steps = self.log.steps();
        let [forward, backward] = self.now().columns(steps + 1);
        match self.future() {
            _ if step >= forward => None,
            None if step + backward > steps => self.passes.product(step),
            Some(future) if step + backward > steps => self.passes.smoothed(&self.log.ride, step, future as usize),
            _ => self.passes.forward(step).map(<[f64]>::to_vec),
        }
    }

    /// Entropy of the path \[nats\], once the two passes are multiplied.
    pub fn entropy(&self) -> Option<f64> {
        self.now().has_product().then_some(self.entropy)
    }

    /// Where EM mapping believes the robot to have been put down \[m\], in the mean, and the share of that which has the first two doors
    /// come again; once the two passes are multiplied.
    pub fn put_down(&self) -> Option<(f64, f64)> {
        answer(&self.passes, self.log.carried).filter(|_| self.now().has_product())
    }

    /// Where doors are guessed to be \[m\].
    pub fn marks(&self) -> [f64; lab::DOORS] {
        self.recipe.guess().marks
    }

    /// The middles of the doors of the map shown \[m\].
    pub fn doors(&self) -> Vec<f64> {
        lab::doors(&self.shown().map)
    }

    /// Whether the iteration that led to the map shown gained next to nothing.
    pub fn is_still(&self) -> bool {
        let rank = self.rank() as usize;
        rank > 0 && self.iterates[rank].log_posterior - self.iterates[rank - 1].log_posterior < STILL
    }

    /// Whether the last map is shown.
    pub fn at_end(&self) -> bool {
        self.step() == self.step_count()
    }

    /// The filter with particles.
    pub fn cloud(&self) -> &Cloud {
        &self.cloud
    }

    /// The share of the particles' weight that has the first two doors come again; once they have made all steps.
    pub fn again(&self) -> Option<f64> {
        self.cloud.shares(self.log.carried).map(lab::again)
    }

    /// Where other guesses end.
    pub fn others(&self) -> &Others {
        &self.others
    }

    /// What never falls, of the run that is pinned.
    pub fn pinned(&self) -> &[f64] {
        if self.hides() { &[] } else { ghost::curve(&self.pinned, 0) }
    }

    /// Moves a mark \[m\].
    pub fn put(&mut self, rank: usize, place: f64) {
        if place.is_finite() {
            self.change(|recipe| recipe.put(rank, place));
        }
    }
}

impl Declared for EmModel {
    type Recipe = Recipe;
    const TITLE: &'static str = em::TITLE;

    fn recipe(&self) -> &Recipe {
        &self.recipe
    }

    fn adopt(&mut self, recipe: Recipe) -> Result<(), FigureError> {
        if recipe.log() != *self.log.setup() {
            let finished = self.pending() == 0;
            let (log, cloud, others) = match self.kept.take(|(log, ..)| *log.setup() == recipe.log()) {
                Some(kept) => kept,
                None => {
                    let log = Log::new(&recipe.log()).map_err(refused)?;
                    let cloud = Cloud::new(&log).map_err(refused)?;
                    (log, cloud, Others::default())
                }
            };
            self.iterates = climb(&recipe, &log).map_err(refused)?;
            let log = core::mem::replace(&mut self.log, log);
            let before =
                (log, core::mem::replace(&mut self.cloud, cloud), core::mem::replace(&mut self.others, others));
            if finished {
                self.kept.put(before);
            }
            self.recipe = recipe;
            return self.localise().map_err(refused);
        }
        let other = recipe.guess() != self.recipe.guess() || recipe.iterations != self.recipe.iterations;
        if other {
            self.iterates = climb(&recipe, &self.log).map_err(refused)?;
        }
        self.recipe = recipe;
        self.localise().map_err(refused)
    }
}

impl Model for EmModel {
    /// Who asks for the last step stays at the end when that moves.
    fn seek(&mut self, step: u32) {
        if !self.hides() {
            let step = if step >= self.step_count() { END } else { step };
            self.change(|recipe| recipe.step = step);
        }
    }

    fn step_count(&self) -> u32 {
        if self.hides() { 0 } else { self.recipe.iterations * TICKS }
    }

    fn step(&self) -> u32 {
        self.recipe.step.min(self.step_count())
    }

    fn telling(&self) -> u32 {
        END
    }

    fn pending(&self) -> u32 {
        self.cloud.pending(&self.log) + self.others.pending()
    }

    fn work(&mut self) {
        if self.cloud.pending(&self.log) > 0 {
            self.cloud.advance(&self.log);
        } else {
            let done = self.others.advance(&self.log);
            in_range(done);
        }
    }

    /// EM mapping is done at once; particles and other guesses come after it.
    fn answer(&self) -> u32 {
        1
    }

    /// After the first iterations little is to be seen of how the passes fill.
    fn pace(&self) -> f64 {
        if self.now().iteration < 2 { 1.0 } else { 3.0 }
    }

    fn prediction(&self) -> Option<Outcome> {
        self.recipe.prediction.outcome("put_down_end", self.end.map(|(place, _)| place))
    }

    fn compared(&self) -> Vec<&'static str> {
        vec!["log_posterior", "doors", "again"]
    }

    fn curves(&self) -> Curves {
        vec![self.iterates().iter().map(|iterate| iterate.log_posterior).collect()]
    }

    fn haunt(&mut self, pinned: Curves) {
        // No curve of a corridor of this length is anywhere near.
        self.pinned = pinned.into_iter().map(|curve| curve.into_iter().map(|x| x.clamp(-1e4, 1e4)).collect()).collect();
    }
}
