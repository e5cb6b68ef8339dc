//! Both filters as a deterministic state: the log, the first run's N_eff after every landmark, and the estimates of all repeats.

use super::recipe::Recipe;
use crate::ghost::Curves;
use crate::kept::{Computes, Runs};
use crate::model::{Declared, FigureError, Model};
use crate::prediction::{Outcome, State};
use crate::told::{in_range, refused};
use crate::words::joint;
use fastslam_lab::experiment::joint::{COMPUTED, Joint, JointSetup, MOST, Population, SAMPLED};

/// The sampled map against the computed one.
pub struct JointModel {
    pub(super) recipe: Recipe,
    pub(super) runs: Runs<Self>,
    /// Of the run that is pinned: N_eff of both filters, by landmarks from none on.
    pub(super) pinned: Curves,
}

impl Default for JointModel {
    fn default() -> Self {
        let recipe = Recipe::default();
        Self { runs: Runs::new(begin(&recipe.setup)), recipe, pinned: Curves::new() }
    }
}

fn begin(setup: &JointSetup) -> Joint {
    in_range(Joint::new(setup))
}

impl Computes for JointModel {
    type Run = Joint;
    type Setup = JointSetup;

    fn setup(run: &Joint) -> &JointSetup {
        run.setup()
    }

    /// Its first repeat is there.
    fn is_begun(run: &Joint) -> bool {
        !run.repeats().is_empty()
    }

    fn put_aside(run: &mut Joint) {
        run.forget_draws();
    }
}

impl JointModel {
    /// Both filters, as far as they are.
    pub fn filters(&self) -> &Joint {
        self.runs.shown()
    }

    /// Number of particles of what is shown.
    pub fn particles(&self) -> u32 {
        self.filters().setup().particles
    }

    /// After how many landmarks is looked.
    pub fn landmarks(&self) -> u32 {
        self.recipe.landmarks
    }

    /// Looks after so many landmarks, or the nearest number that there is.
    pub fn look_after(&mut self, landmarks: f64) {
        self.change(|recipe| recipe.landmarks = landmarks.round().clamp(1.0, f64::from(MOST)) as u32);
    }

    /// What the first run of a filter has come to.
    pub fn population(&self, filter: usize) -> Option<&Population> {
        self.filters().population(filter, self.landmarks())
    }

    /// N_eff of a filter by landmarks, from none on; nothing before its first run.
    pub fn ess(&self, filter: usize) -> Vec<f64> {
        let found = self.filters().repeats().first();
        let start = found.map(|_| f64::from(self.particles()));
        start.into_iter().chain(found.into_iter().flat_map(|run| run[filter].iter().map(|found| found.ess))).collect()
    }

    /// Where a filter has the first landmark, in each repeat \[m\].
    pub fn estimates(&self, filter: usize) -> Vec<[f64; 2]> {
        self.filters().estimates(filter, self.landmarks())
    }

    /// What N_eff of a filter is to be after so many landmarks.
    pub fn predicted(&self, filter: usize, landmarks: u32) -> f64 {
        f64::from(self.particles()) * self.filters().log().predicted_share(filter, landmarks)
    }

    /// Standard deviation of the estimate of the first landmark over the repeats \[m\].
    pub fn spread(&self, filter: usize) -> f64 {
        self.filters().variance(filter, self.landmarks()).sqrt()
    }

    /// How far the reader's prediction is.
    pub fn state(&self) -> State {
        self.recipe.prediction.state()
    }

    /// Whether nothing of a filter is to be seen yet: what the sampled map comes to is what is asked for.
    pub fn hides(&self, filter: usize) -> bool {
        filter == SAMPLED && self.recipe.prediction.hides()
    }

    /// The first number of landmarks after which the sampled map's particles are worth less than one, by the closed form; `None` where
    /// that takes more than there are.
    pub fn below_one(&self) -> Option<u32> {
        (1..=MOST).find(|landmarks| self.predicted(SAMPLED, *landmarks) < 1.0)
    }

    /// Places a guess at a number of landmarks, or at the nearest that there is.
    pub fn guess_at(&mut self, landmarks: f64) {
        let landmarks = landmarks.round().clamp(1.0, f64::from(MOST));
        self.change(|recipe| recipe.prediction.place(Some(landmarks)));
    }

    /// N_eff of the pinned run's filters.
    pub(super) fn pinned(&self) -> &Curves {
        &self.pinned
    }

    /// How far the repeats are.
    pub fn repeats(&self) -> [u32; 2] {
        [self.filters().repeats().len() as u32, self.filters().setup().repeats()]
    }
}

impl Declared for JointModel {
    type Recipe = Recipe;
    const TITLE: &'static str = joint::TITLE;

    fn recipe(&self) -> &Recipe {
        &self.recipe
    }

    fn adopt(&mut self, recipe: Recipe) -> Result<(), FigureError> {
        let draws = |run: &Joint| run.draws_for(&recipe.setup);
        self.runs.ask(&recipe.setup, draws, |nearest| nearest.asked(&recipe.setup).map_err(refused))?;
        self.recipe = recipe;
        Ok(())
    }
}

impl Model for JointModel {
    fn pending(&self) -> u32 {
        self.runs.asked().pending()
    }

    fn work(&mut self) {
        let done = self.runs.asked_mut().advance();
        in_range(done);
        self.runs.show_if(Self::is_begun);
    }

    /// From the first run on: what comes then are more repeats.
    fn answer(&self) -> u32 {
        self.runs.refines().into()
    }

    fn compared(&self) -> Vec<&'static str> {
        vec!["ess_sampled", "ess_computed", "removed"]
    }

    fn curves(&self) -> Curves {
        vec![self.ess(SAMPLED), self.ess(COMPUTED)]
    }

    fn haunt(&mut self, pinned: Curves) {
        self.pinned = pinned;
    }

    fn prediction(&self) -> Option<Outcome> {
        self.recipe.prediction.outcome("below_one", self.below_one().map(f64::from))
    }
}
