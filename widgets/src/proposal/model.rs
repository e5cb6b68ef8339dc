//! The step as a deterministic state: what was set, what both proposals drew, and the reader's guess.

use super::{challenges, contour, ghost, recipe::Recipe};
use crate::challenge::Challenge;
use crate::decimal::{fixed, write};
use crate::ghost::Curves;
use crate::model::{Change, Column, Declared, FigureError, Model, Readout, Series};
use crate::prediction::{Outcome, State, off_by};
use crate::words::{common, proposal};
use fastslam_lab::experiment::proposal::{Cloud, Proposals, ProposalsSetup};

/// In the first version a guess was there before the reader placed one.
const GUESSED: Change = Change::Default { name: "guess", was: "2" };

/// Figure w17.3.
pub struct ProposalModel {
    recipe: Recipe,
    /// The recipe of what is shown.
    computed: Recipe,
    shown: Proposals,
    /// Outline of the region of highest density \[m\].
    outline: Vec<Vec<[f64; 2]>>,
    /// What it was made of.
    setup: ProposalsSetup,
    /// The ratio at what was set.
    ratio: f64,
    /// Of the step that is pinned (`ghost`).
    pinned: Curves,
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
    Proposals::new(setup).unwrap_or_else(|error| unreachable!("the parameters' ranges are within the core's: {error}"))
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

    /// Half the range noise \[m\].
    pub fn half(&self) -> String {
        write(self.computed.half().range_std)
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

    fn challenges() -> Vec<Challenge<Self>> {
        challenges::challenges()
    }

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

    fn readouts(&self) -> Vec<Readout> {
        let Proposals { motion, aware, exact, z, .. } = &self.shown;
        let m = self.setup().samples;
        let percent = |name, title, share: f64, help| {
            let x = 100.0 * share;
            Readout::new(name, title, x, fixed(x, 1), "%", help).drawn()
        };
        let ess = |name, title, cloud: &Cloud, help| {
            let x = cloud.ess();
            Readout::new(name, title, x, common::Of { n: &fixed(x, 1), all: &m }.say(), "", help).drawn()
        };
        let times = |name, title, x: f64, help| Readout::new(name, title, x, fixed(x, 2), "×", help);
        let first = |x: f64| if self.setup().twins { x } else { f64::NAN };
        vec![
            percent(
                "inside_motion",
                proposal::inside_motion(),
                motion.share_inside(None),
                proposal::inside_motion_help(),
            ),
            percent("inside_aware", proposal::inside_aware(), aware.share_inside(None), proposal::inside_aware_help()),
            ess("ess_motion", proposal::ess_motion(), motion, proposal::ess_motion_help()),
            ess("ess_aware", proposal::ess_aware(), aware, proposal::ess_aware_help()),
            times("ratio", proposal::ratio(), self.ratio, proposal::ratio_help()).drawn(),
            times(
                "ratio_half",
                proposal::ratio_half(),
                self.at_half().unwrap_or(f64::NAN),
                proposal::ratio_half_help(),
            )
            .drawn(),
            percent("a_posterior", proposal::a_posterior(), first(exact.candidates[0]), proposal::a_posterior_help()),
            percent("a_motion", proposal::a_motion(), first(motion.share_inside(Some(0))), proposal::a_motion_help()),
            percent("a_aware", proposal::a_aware(), first(aware.share_inside(Some(0))), proposal::a_aware_help()),
            Readout::new("range", proposal::range_seen(), z.x, fixed(z.x, 2), "m", proposal::range_seen_help()),
            Readout::new("bearing", proposal::bearing_seen(), z.y, fixed(z.y, 2), "rad", proposal::bearing_seen_help()),
            times("predicted", proposal::predicted(), self.shown.predicted_ratio(), proposal::predicted_help()),
        ]
    }

    fn series(&self) -> Series {
        const COLUMNS: &[Column] = &[
            Column::new("sample", "number of the sample"),
            Column::new("motion_x_m", "x of FastSLAM 1.0's sample [m]"),
            Column::new("motion_y_m", "y of it [m]"),
            Column::new("motion_theta_rad", "heading of it [rad]"),
            Column::new("motion_weight", "normalised weight of it"),
            Column::new("motion_inside", "1 where it is in the posterior's 90 % region"),
            Column::new("motion_landmark", "landmark that it takes the sighting to be of, from 0"),
            Column::new("aware_x_m", "x of FastSLAM 2.0's sample [m]"),
            Column::new("aware_y_m", "y of it [m]"),
            Column::new("aware_theta_rad", "heading of it [rad]"),
            Column::new("aware_weight", "normalised weight of it"),
            Column::new("aware_inside", "1 where it is in the posterior's 90 % region"),
            Column::new("aware_landmark", "landmark that it takes the sighting to be of, from 0"),
        ];
        let half = |cloud: &Cloud, k: usize| {
            let (pose, inside) = (cloud.poses[k], f64::from(u8::from(cloud.inside[k])));
            [pose.x, pose.y, pose.theta, cloud.weights.as_slice()[k], inside, f64::from(cloud.candidates[k])]
        };
        let Proposals { motion, aware, .. } = &self.shown;
        let row = |k| [k as f64].into_iter().chain(half(motion, k)).chain(half(aware, k)).collect();
        Series { columns: COLUMNS.into(), rows: (0..motion.poses.len()).map(row).collect() }
    }

    fn curves(&self) -> Curves {
        let told = self.readouts().into_iter().find(|readout| readout.name == "ratio");
        ghost::curves(&self.shown, told.and_then(|ratio| ratio.value), &self.outline)
    }

    fn haunt(&mut self, pinned: Curves) {
        self.pinned = pinned;
    }

    fn describe(&self) -> String {
        let Proposals { motion, aware, exact, .. } = &self.shown;
        let m = self.setup().samples;
        let percent = |share: f64| format!("{} %", fixed(100.0 * share, 0));
        let told = proposal::Told {
            m: &m,
            noise: &write(self.setup().range_std),
            motion: &percent(motion.share_inside(None)),
            motion_ess: &fixed(motion.ess(), 0),
            aware: &percent(aware.share_inside(None)),
            aware_ess: &fixed(aware.ess(), 0),
            ratio: &fixed(self.shown.ratio(), 1),
        };
        // What cannot be seen at a glance comes first.
        let mut sentences = self.news();
        sentences.push(told.say());
        if self.setup().twins {
            let shares = |cloud: &Cloud| [0, 1].map(|k| percent(cloud.share_inside(Some(k))));
            let ([a, b], [c, d]) = (shares(motion), shares(aware));
            let [p, q] = [0, 1].map(|k| percent(exact.candidates[k]));
            sentences.push(proposal::EitherLandmark { p: &p, q: &q, a: &a, b: &b, c: &c, d: &d }.say());
        }
        sentences.join(" ")
    }

    fn narrate(&self) -> String {
        let [motion, aware] = [&self.shown.motion, &self.shown.aware]
            .map(|cloud| format!("{} %", fixed(100.0 * cloud.share_inside(None), 0)));
        let told = || proposal::NTold { motion: &motion, aware: &aware }.say();
        self.news().into_iter().next().unwrap_or_else(told)
    }
}

impl ProposalModel {
    /// What cannot be seen at a glance: a prediction, and what has been lost.
    fn news(&self) -> Vec<String> {
        let mut sentences = Vec::new();
        let half = &self.half();
        match (self.state(), self.at_half()) {
            (State::Guessed(guess), Some(ratio)) => {
                let (off, ratio, guess) = (&off_by(guess, ratio), &fixed(ratio, 1), &write(guess));
                sentences.push(proposal::GuessWas { half, ratio, guess, off }.say());
            }
            (State::Waived, Some(ratio)) => {
                sentences.push(proposal::GuessWaived { half, ratio: &fixed(ratio, 1) }.say());
            }
            (State::Placed(guess), _) => sentences.push(proposal::GuessIs { guess: &write(guess) }.say()),
            (State::Asked, _) => sentences.push(proposal::NoGuess { half }.say()),
            _ => (),
        }
        sentences.extend(self.lost().map(|lost| proposal::IsLost { landmark: &["A", "B"][lost] }.say()));
        sentences
    }
}
