//! Both filters as a deterministic state: the log, the first run's N_eff after every landmark, and the estimates of all repeats.

use super::{challenges, recipe::Recipe};
use crate::challenge::Challenge;
use crate::decimal::{fixed, write};
use crate::ghost::Curves;
use crate::kept::{Computes, Runs};
use crate::model::{Column, Declared, FigureError, Model, Readout, Series};
use crate::prediction::{Outcome, State, off_by};
use crate::told::refused;
use crate::words::{common, joint};
use fastslam_lab::experiment::joint::{COMPUTED, Joint, JointSetup, MOST, Population, SAMPLED};

/// The sampled map against the computed one.
pub struct JointModel {
    recipe: Recipe,
    runs: Runs<Self>,
    /// Of the run that is pinned: N_eff of both filters, by landmarks from none on.
    pinned: Curves,
}

impl Default for JointModel {
    fn default() -> Self {
        let recipe = Recipe::default();
        Self { runs: Runs::new(begin(&recipe.setup)), recipe, pinned: Curves::new() }
    }
}

fn begin(setup: &JointSetup) -> Joint {
    Joint::new(setup).unwrap_or_else(|error| unreachable!("the parameters' ranges are within the core's: {error}"))
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

    /// What is said of the prediction, if one is asked for.
    fn judged(&self) -> Option<String> {
        let m = &self.particles();
        Some(match (self.state(), self.below_one()) {
            (State::Off, _) => return None,
            (State::Asked, _) => joint::Asks { m }.say(),
            (State::Placed(guess), _) => joint::Placed { m, guess: &write(guess) }.say(),
            (State::Guessed(guess), Some(result)) => {
                joint::Came { m, result: &result, guess: &write(guess), off: &off_by(guess, result.into()) }.say()
            }
            (State::Waived, Some(result)) => joint::CameAlone { m, result: &result }.say(),
            (State::Guessed(guess), None) => joint::NeverCame { m, all: &MOST, guess: &write(guess) }.say(),
            (State::Waived, None) => joint::NeverCameAlone { m, all: &MOST }.say(),
        })
    }

    /// N_eff of the pinned run's filters.
    pub(super) fn pinned(&self) -> &Curves {
        &self.pinned
    }

    /// How far the repeats are.
    pub fn repeats(&self) -> [u32; 2] {
        [self.filters().repeats().len() as u32, self.filters().setup().repeats()]
    }

    /// The share of the variance that computing removed, in words; nothing where there is none yet.
    pub fn removed(&self) -> Option<String> {
        if self.hides(SAMPLED) {
            return None;
        }
        let removed = self.filters().removed(self.landmarks());
        removed.is_finite().then(|| percent(removed))
    }
}

/// A share in percent, with as many decimals as tell it from all.
pub fn percent(share: f64) -> String {
    let digits = match 1.0 - share {
        0.0 => 0,
        left if left < 2e-4 => 3,
        left if left < 2e-3 => 2,
        _ => 1,
    };
    format!("{} %", fixed(100.0 * share, digits))
}

/// A length \[m\] with two digits or so.
pub fn metres(length: f64) -> String {
    fixed(length, if length < 0.01 { 4 } else { 2 })
}

/// A length \[m\] with its unit, in millimetres where it is short.
pub fn length(length: f64) -> String {
    if length < 0.01 { format!("{} mm", fixed(1e3 * length, 1)) } else { format!("{} m", fixed(length, 2)) }
}

/// A number of particles: one decimal where there are few.
pub fn count(particles: f64) -> String {
    match particles {
        few if few < 0.1 => format!("< {}", fixed(0.1, 1)),
        few if few < 100.0 => fixed(few, 1),
        many => fixed(many, 0),
    }
}

impl Declared for JointModel {
    type Recipe = Recipe;
    const TITLE: &'static str = joint::TITLE;

    fn challenges() -> Vec<Challenge<Self>> {
        challenges::challenges()
    }

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
        done.unwrap_or_else(|error| unreachable!("it has begun: {error}"));
        self.runs.show_if(Self::is_begun);
    }

    /// From the first run on: what comes then are more repeats.
    fn refines(&self) -> bool {
        self.runs.refines()
    }

    fn compared(&self) -> Vec<&'static str> {
        vec!["ess_sampled", "ess_computed", "removed"]
    }

    fn readouts(&self) -> Vec<Readout> {
        let m = self.particles();
        let of_all = |x: f64| common::Of { n: &count(x), all: &m }.say();
        let particles = |name, title, x: Option<f64>, help| {
            let x = x.unwrap_or(f64::NAN);
            Readout::new(name, title, x, of_all(x), "", help)
        };
        let hidden = self.hides(SAMPLED);
        let found = [SAMPLED, COMPUTED].map(|filter| self.population(filter).filter(|_| !self.hides(filter)));
        let ess = found.map(|found| found.map(|found| found.ess));
        let left = found.map(|found| found.map(|found| f64::from(found.left)));
        let predicted =
            [SAMPLED, COMPUTED].map(|filter| (!self.hides(filter)).then(|| self.predicted(filter, self.landmarks())));
        let spread = |name, title, filter, help| {
            let x = if self.hides(filter) { f64::NAN } else { self.spread(filter) };
            Readout::new(name, title, x, metres(x), "m", help).drawn()
        };
        let removed = if hidden { f64::NAN } else { 100.0 * self.filters().removed(self.landmarks()) };
        let text = self.removed().map(|text| text.trim_end_matches(" %").to_string()).unwrap_or_default();
        let (rho, [done, _]) = (if hidden { f64::NAN } else { self.filters().log().rho() }, self.repeats());
        vec![
            particles("ess_sampled", joint::ess_sampled(), ess[0], joint::ess_sampled_help()).drawn(),
            particles("ess_computed", joint::ess_computed(), ess[1], joint::ess_computed_help()).drawn(),
            particles("predicted_sampled", joint::predicted_sampled(), predicted[0], joint::predicted_sampled_help()),
            particles(
                "predicted_computed",
                joint::predicted_computed(),
                predicted[1],
                joint::predicted_computed_help(),
            ),
            Readout::new("rho", joint::rho(), rho, fixed(rho, 3), "", joint::rho_help()),
            particles("left_sampled", joint::left_sampled(), left[0], joint::left_sampled_help()).drawn(),
            particles("left_computed", joint::left_computed(), left[1], joint::left_computed_help()).drawn(),
            spread("spread_sampled", joint::spread_sampled(), SAMPLED, joint::spread_sampled_help()),
            spread("spread_computed", joint::spread_computed(), COMPUTED, joint::spread_computed_help()),
            Readout::new("removed", joint::removed(), removed, text, "%", joint::removed_help()).drawn(),
            Readout::new("repeats", joint::repeats(), done.into(), done.to_string(), "", joint::repeats_help()),
        ]
    }

    fn series(&self) -> Series {
        const COLUMNS: &[Column] = &[
            Column::new("landmarks", "landmarks seen"),
            Column::new("ess_sampled", "N_eff of the sampled map, first run"),
            Column::new("ess_sampled_predicted", "what it is to be by the closed form"),
            Column::new("ess_computed", "N_eff of the computed map, first run"),
            Column::new("ess_computed_predicted", "what it is to be by the closed form"),
            Column::new("left_sampled", "particles of the sampled map that a resampling would continue"),
            Column::new("left_computed", "the same of the computed map"),
            Column::new("spread_sampled_m", "standard deviation over the repeats of the first landmark's estimate [m]"),
            Column::new("spread_computed_m", "the same of the computed map [m]"),
        ];
        let row = |landmarks: u32| {
            let of =
                |filter| self.filters().population(filter, landmarks).map(|found| (found.ess, f64::from(found.left)));
            let [drawn, computed] = [SAMPLED, COMPUTED].map(|filter| of(filter).unwrap_or((f64::NAN, f64::NAN)));
            let [a, b] = [SAMPLED, COMPUTED].map(|filter| self.predicted(filter, landmarks));
            let [c, d] = [SAMPLED, COMPUTED].map(|filter| self.filters().variance(filter, landmarks).sqrt());
            vec![landmarks.into(), drawn.0, a, computed.0, b, drawn.1, computed.1, c, d]
        };
        let count = if self.hides(SAMPLED) { 0 } else { MOST };
        Series { columns: COLUMNS.into(), rows: (1..=count).map(row).collect() }
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

    fn describe(&self) -> String {
        let judged = self.judged();
        if self.hides(SAMPLED) {
            return judged.unwrap_or_default();
        }
        let (n, m) = (self.landmarks(), self.particles());
        let [Some(sampled), Some(computed)] = [SAMPLED, COMPUTED].map(|filter| self.population(filter)) else {
            return joint::Beginning { m: &m }.say();
        };
        let [a, b] = [SAMPLED, COMPUTED].map(|filter| count(self.predicted(filter, n)));
        let told =
            joint::Told { n: &n, m: &m, sampled: &count(sampled.ess), computed: &count(computed.ess), a: &a, b: &b };
        let mut sentences: Vec<String> = judged.into_iter().chain([told.say()]).collect();
        if let Some(removed) = self.removed() {
            let [c, d] = [SAMPLED, COMPUTED].map(|filter| length(self.spread(filter)));
            let [repeats, _] = self.repeats();
            sentences.push(joint::Spread { repeats: &repeats, c: &c, d: &d, removed: &removed }.say());
        }
        sentences.join(" ")
    }

    fn narrate(&self) -> String {
        let [Some(sampled), Some(computed)] = [SAMPLED, COMPUTED].map(|filter| self.population(filter)) else {
            return self.describe();
        };
        let (n, m) = (&self.landmarks(), &self.particles());
        let told = || joint::NTold { n, m, sampled: &count(sampled.ess), computed: &count(computed.ess) }.say();
        self.judged().unwrap_or_else(told)
    }
}
