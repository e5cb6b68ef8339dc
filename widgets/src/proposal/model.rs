//! The step as a deterministic state: what was set, what both proposals drew, and the reader's guess.

use super::{contour, recipe::Recipe};
use crate::ghost::Curves;
use crate::model::{Change, Declared, FigureError, Model, Tells};
use crate::prediction::{Outcome, State};
use crate::told::in_range;
use crate::words::proposal;
use fastslam_lab::experiment::proposal::{Cloud, Proposals, ProposalsSetup};

/// In the first version a guess was there before the reader placed one.
const GUESSED: Change = Change::Default { name: "guess", was: "2" };

/// Figure w17.3.
pub struct ProposalModel {
    pub(super) recipe: Recipe,
    /// The recipe of what is shown.
    pub(super) computed: Recipe,
    pub(super) shown: Proposals,
    /// Outline of the region of highest density \[m\].
    pub(super) outline: Vec<Vec<[f64; 2]>>,
    /// What it was made of.
    pub(super) setup: ProposalsSetup,
    /// The ratio at what was set.
    pub(super) ratio: f64,
    /// Of the step that is pinned (`ghost`).
    pub(super) pinned: Curves,
}

impl Default for ProposalModel {
    fn default() -> Self {
        let recipe = Recipe::default();
        let shown = propose(&recipe.setup);
        let outline = contour::outline(&shown.exact);
        let (setup, ratio) = (recipe.setup.clone(), shown.ratio());
        Self { computed: recipe.clone(), recipe, shown, outline, setup, ratio, pinned: Curves::new() }
    }
}

fn propose(setup: &ProposalsSetup) -> Proposals {
    in_range(Proposals::new(setup))
}

impl ProposalModel {
    /// Both clouds, and what they should be like.
    pub fn proposals(&self) -> &Proposals {
        &self.shown
    }

    /// Outline of the posterior's 90 % region \[m\].
    pub fn outline(&self) -> &[Vec<[f64; 2]>] {
        &self.outline
    }

    /// What is shown: what was set, or once a prediction is judged, that at half the range noise.
    pub fn setup(&self) -> &ProposalsSetup {
        &self.setup
    }

    /// Curves of the step that is pinned.
    pub(super) fn pinned(&self) -> &Curves {
        &self.pinned
    }

    /// How far the reader's prediction is.
    pub fn state(&self) -> State {
        self.computed.prediction.state()
    }

    /// The ratio at what was set.
    pub fn ratio(&self) -> f64 {
        self.ratio
    }

    /// The ratio at half the range noise, once that may be seen.
    pub fn at_half(&self) -> Option<f64> {
        self.computed.prediction.is_shown().then(|| self.shown.ratio())
    }

    /// The landmark, of two, that the posterior has not ruled out and none of the measurement-aware samples speaks for.
    pub fn lost(&self) -> Option<usize> {
        let Proposals { exact, aware, .. } = &self.shown;
        let lost = |k: &usize| exact.candidates[*k] > 0.01 && !aware.candidates.contains(&(*k as u32));
        (0..exact.candidates.len()).find(lost)
    }

    /// Puts the landmark to a place \[m\], or as near as it can be.
    pub fn put_landmark(&mut self, place: [f64; 2]) {
        self.change(|recipe| recipe.setup.landmark = place);
    }

    /// Guesses a ratio, or the nearest that can be guessed. Another guess is another try.
    pub fn guess_at(&mut self, ratio: f64) {
        self.change(|recipe| recipe.guess_at(ratio));
    }
}

impl Declared for ProposalModel {
    type Recipe = Recipe;
    const TITLE: &'static str = proposal::TITLE;
    const CHANGES: &'static [Change] = &[
        Change::Switched { name: "predict", changes: &[GUESSED] },
        Change::Switched {
            name: "run",
            changes: &[
                Change::Default { name: "predict", was: "on" },
                GUESSED,
                Change::Told("Once a prediction is run, samples and numbers are those at half the range noise."),
            ],
        },
    ];
    const UNSAID: usize = 3;

    fn recipe(&self) -> &Recipe {
        &self.recipe
    }

    fn adopt(&mut self, recipe: Recipe) -> Result<(), FigureError> {
        self.recipe = recipe;
        Ok(())
    }
}

impl Model for ProposalModel {
    fn pending(&self) -> u32 {
        u32::from(self.recipe != self.computed)
    }

    fn work(&mut self) {
        let (recipe, wanted) = (self.recipe.clone(), self.recipe.shown());
        let before = (recipe.setup == self.computed.setup).then_some(self.ratio);
        if wanted != self.setup {
            self.shown = propose(&wanted);
            self.outline = contour::outline(&self.shown.exact);
            self.setup = wanted;
        }
        let now = || if self.setup == recipe.setup { self.shown.ratio() } else { propose(&recipe.setup).ratio() };
        self.ratio = before.unwrap_or_else(now);
        self.computed = recipe;
    }

    fn prediction(&self) -> Option<Outcome> {
        self.computed.prediction.outcome("ratio_half", self.at_half())
    }

    fn instead(&self) -> Option<(&'static str, String)> {
        self.computed.prediction.is_shown().then(|| ("range-std", self.half()))
    }

    fn compared(&self) -> Vec<&'static str> {
        vec!["ratio", "inside_motion", "inside_aware"]
    }

    fn curves(&self) -> Curves {
        let told = self.readouts().into_iter().find(|readout| readout.name == "ratio");
        curves(&self.shown, told.and_then(|ratio| ratio.value), &self.outline)
    }

    fn haunt(&mut self, pinned: Curves) {
        self.pinned = pinned;
    }
}

/// The curves of a step. A ratio that readers are not told yet is none.
fn curves(found: &Proposals, ratio: Option<f64>, outline: &[Vec<[f64; 2]>]) -> Curves {
    let places = |cloud: &Cloud| cloud.poses.iter().flat_map(|pose| [pose.x, pose.y]).collect();
    let (mean, covariance) = (found.gaussian.mean, found.gaussian.covariance);
    let at = |row, column| covariance[(row, column)];
    let gaussian = vec![mean.x, mean.y, at(0, 0), at(0, 1), at(1, 0), at(1, 1)];
    let mut curves = vec![places(&found.motion), places(&found.aware), gaussian, ratio.into_iter().collect()];
    curves.extend(outline.iter().map(|line| line.as_flattened().to_vec()));
    curves
}
