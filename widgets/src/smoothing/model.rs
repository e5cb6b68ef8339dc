//! The filter's record and the sweeps as a deterministic state: what was set, how many sweeps are done, and how many of them are shown.

use super::recipe::Recipe;
use crate::{
    ghost::Curves,
    kept::{Computes, Runs},
    model::{Change, Declared, FigureError, Model},
    prediction::{Outcome, State},
    told::in_range,
    words::smoothing as words,
};
use core::convert::Infallible;
use fastslam::{geometry::Pose2, nalgebra::Matrix3};
use fastslam_lab::experiment::smoothing::{MOST, STEPS, Smoothing, SmoothingSetup};

/// What the record says of every step, or the draws do.
pub struct Account {
    /// How many different poses there are.
    pub distinct: Vec<u32>,
    /// Their mean and covariance.
    pub moments: Vec<(Pose2, Matrix3<f64>)>,
    /// Distance of the mean from the truth \[m\].
    pub errors: Vec<f64>,
    /// Root mean square of that over the first half of the drive \[m\].
    pub early: f64,
}

/// The figure of the smoother.
pub struct SmoothingModel {
    recipe: Recipe,
    runs: Runs<Self>,
    /// Of the run that is pinned: different poses and errors of record and draws, step by step.
    pinned: Curves,
}

impl Default for SmoothingModel {
    fn default() -> Self {
        let recipe = Recipe::default();
        Self { runs: Runs::new(begin(&recipe.setup)), recipe, pinned: Curves::new() }
    }
}

fn begin(setup: &SmoothingSetup) -> Smoothing {
    in_range(Smoothing::new(setup))
}

impl Computes for SmoothingModel {
    type Run = Smoothing;
    type Setup = SmoothingSetup;

    fn setup(run: &Smoothing) -> &SmoothingSetup {
        run.setup()
    }

    /// Its first sweep is there.
    fn is_begun(run: &Smoothing) -> bool {
        !run.draws().is_empty()
    }
}

impl SmoothingModel {
    /// Filter and sweeps, as far as they are.
    pub fn run(&self) -> &Smoothing {
        self.runs.shown()
    }

    /// Number of particles of what is shown.
    pub fn particles(&self) -> u32 {
        self.run().setup().particles
    }

    /// How many sweeps are shown: none while the reader is asked what comes of them.
    pub fn sweeps(&self) -> u32 {
        if self.hides() { 0 } else { self.recipe.step.min(self.run().draws().len() as u32) }
    }

    /// How many sweeps are needed: those that are looked at, or where a prediction is judged, all.
    fn wanted(&self) -> u32 {
        if self.recipe.prediction.predict { MOST } else { self.recipe.step }
    }

    /// How far the reader's prediction is.
    pub fn state(&self) -> State {
        self.recipe.prediction.state()
    }

    /// Whether nothing of the sweeps is to be seen yet.
    pub fn hides(&self) -> bool {
        self.recipe.prediction.hides()
    }

    /// How many different poses all sweeps have at step 1; nothing before the last of them.
    pub fn first_of_all(&self) -> Option<u32> {
        let sweeps = MOST as usize;
        (self.run().draws().len() >= sweeps).then(|| self.run().distinct(sweeps)[1])
    }

    /// Places a guess at a number of poses, or at the nearest that there can be.
    pub fn guess_at(&mut self, poses: f64) {
        if poses.is_finite() {
            let poses = poses.round().clamp(1.0, f64::from(MOST));
            self.change(|recipe| recipe.prediction.place(Some(poses)));
        }
    }

    /// The step of the drive that is looked at.
    pub fn at(&self) -> u32 {
        self.recipe.at
    }

    /// Looks at this step of the drive, or at the nearest.
    pub fn look_at(&mut self, step: f64) {
        self.change(|recipe| recipe.at = step.round().clamp(1.0, f64::from(STEPS)) as u32);
    }

    /// What the filter's record says; nothing before it has come to the end.
    pub fn before(&self) -> Option<Account> {
        let record = self.run().record()?;
        let errors = self.run().errors(&record.moments);
        let early = self.run().early_rms(&errors);
        Some(Account { distinct: record.distinct.clone(), moments: record.moments.clone(), errors, early })
    }

    /// What the draws of the sweeps that are shown say; nothing before the first.
    pub fn after(&self) -> Option<Account> {
        let sweeps = self.sweeps() as usize;
        let (distinct, moments) = (self.run().distinct(sweeps), self.run().moments(sweeps));
        let errors = self.run().errors(&moments);
        let early = self.run().early_rms(&errors);
        (sweeps > 0).then_some(Account { distinct, moments, errors, early })
    }

    /// The last step at which all particles have one ancestor.
    pub fn coalescence(&self) -> Option<u32> {
        self.run().record().map(|record| record.coalescence)
    }

    /// See [`Model::curves`].
    pub(super) fn pinned(&self) -> &Curves {
        &self.pinned
    }
}

impl Declared for SmoothingModel {
    type Recipe = Recipe;
    const TITLE: &'static str = words::TITLE;
    const CHANGES: &'static [Change] = &[
        Change::Default { name: "seed", was: "1" },
        Change::Told(
            "What is seen in a step is taken in by its range, the nearest first: paths and their errors differ.",
        ),
    ];
    const UNSAID: usize = 3;

    fn recipe(&self) -> &Recipe {
        &self.recipe
    }

    fn adopt(&mut self, recipe: Recipe) -> Result<(), FigureError> {
        let Ok(_) = self.runs.ask(&recipe.setup, |_| false, |_| Ok::<_, Infallible>(begin(&recipe.setup)));
        self.recipe = recipe;
        Ok(())
    }
}

impl Model for SmoothingModel {
    fn seek(&mut self, step: u32) {
        if !self.hides() {
            self.recipe.step = step.min(MOST);
        }
    }

    fn step_count(&self) -> u32 {
        if self.hides() { 0 } else { MOST }
    }

    fn step(&self) -> u32 {
        self.sweeps()
    }

    fn telling(&self) -> u32 {
        MOST
    }

    fn pending(&self) -> u32 {
        self.runs.asked().pending(self.wanted())
    }

    fn work(&mut self) {
        self.runs.asked_mut().advance();
        let asked = self.wanted().min(1) as usize;
        self.runs.show_if(|next| next.record().is_some() && next.draws().len() >= asked);
    }

    /// From the first sweep on: what comes then are more of them.
    fn answer(&self) -> u32 {
        self.runs.refines().into()
    }

    fn prediction(&self) -> Option<Outcome> {
        self.recipe.prediction.outcome("first_after", self.first_of_all().map(f64::from))
    }

    fn compared(&self) -> Vec<&'static str> {
        vec!["early_after", "early_before", "distinct_after"]
    }

    fn curves(&self) -> Curves {
        let of = |account: Option<Account>| {
            let distinct = account.iter().flat_map(|account| account.distinct.iter().map(|n| f64::from(*n))).collect();
            [distinct, account.map(|account| account.errors).unwrap_or_default()]
        };
        of(self.before()).into_iter().chain(of(self.after())).collect()
    }

    fn haunt(&mut self, pinned: Curves) {
        self.pinned = pinned;
    }
}
