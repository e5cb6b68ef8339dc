//! Shares of laps that end well, from the errors that come with the figure, and the depletion of the one step.

use super::{
    challenges,
    recipe::{LAST, NOISES, Recipe},
    shipped::{self, LAPS},
};
use crate::told::WEIGHED_ANEW;
use crate::{
    challenge::Challenge,
    decimal::{fixed, write},
    model::{Change, Column, Declared, FigureError, Model, Readout, Series},
    prediction::{Outcome, State, off_by},
    words::universes as words,
};
use fastslam::{
    ops,
    random::{Purpose, Stream},
};
use fastslam_lab::experiment::{
    Fraction, ProposalKind,
    proposal::{Depletion, ProposalsSetup, depletion},
    universes::{ENOUGH, TRIED, saturated, sufficient},
};

/// Range noises at which the depletion is measured \[m\], beside the names of its axis.
pub const MEASURED: [f64; 7] = [0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5];

/// Places of the closed form's line.
const PLACES: u32 = 48;

/// Both proposals, in the order in which they are told.
pub const PROPOSALS: [ProposalKind; 2] = [ProposalKind::Motion, ProposalKind::Improved];

/// The figure *how many are enough*.
pub struct UniversesModel {
    recipe: Recipe,
    /// N_eff / M of the motion prior by the range noise \[m\].
    depletions: Vec<(f64, Depletion)>,
    /// Of each proposal and number of universes, the order in which its laps come: those that are shipped are sorted.
    orders: [[[u8; LAPS]; TRIED.len()]; 2],
}

/// The laps of one number of universes, shuffled (Fisher and Yates).
fn shuffled(proposal: usize, rank: usize) -> [u8; LAPS] {
    let mut stream = Stream::at(0, Purpose::TRIAL, proposal as u32, rank as u32);
    let mut order = core::array::from_fn(|lap| lap as u8);
    for rest in (1..LAPS).rev() {
        order.swap(rest, (stream.uniform() * (rest + 1) as f64) as usize);
    }
    order
}

impl Default for UniversesModel {
    fn default() -> Self {
        let recipe = Recipe::default();
        let orders = core::array::from_fn(|proposal| core::array::from_fn(|rank| shuffled(proposal, rank)));
        Self { depletions: depletions(&recipe.setup), orders, recipe }
    }
}

/// The line by the closed form, and the samples of those that are measured.
fn depletions(setup: &ProposalsSetup) -> Vec<(f64, Depletion)> {
    let [low, high] = NOISES.map(ops::ln);
    let line = (0..=PLACES).map(|k| ops::exp(low + (high - low) * f64::from(k) / f64::from(PLACES)));
    let line = line.map(|noise| (noise.clamp(NOISES[0], NOISES[1]), false));
    let at = |(range_std, measure): (f64, bool)| {
        let setup = ProposalsSetup { range_std, ..setup.clone() };
        let found = depletion(&setup, measure);
        (range_std, found.unwrap_or_else(|error| unreachable!("the parameters' ranges are within the core's: {error}")))
    };
    line.chain(MEASURED.map(|noise| (noise, true))).map(at).collect()
}

impl UniversesModel {
    /// How far the reader's prediction is.
    pub fn state(&self) -> State {
        self.recipe.prediction.state()
    }

    /// Whether nothing is to be seen yet.
    pub fn hides(&self) -> bool {
        self.recipe.prediction.hides()
    }

    /// How many laps have come of each number of universes.
    pub fn laps(&self) -> usize {
        self.recipe.step as usize + 1
    }

    /// Whether laps end well that have come, in the order in which they did, of the number of universes with this rank.
    pub fn ends(&self, proposal: ProposalKind, rank: usize) -> impl DoubleEndedIterator<Item = bool> {
        let (errors, orders) = match proposal {
            ProposalKind::Motion => (&shipped::MOTION, &self.orders[0]),
            ProposalKind::Improved => (&shipped::AWARE, &self.orders[1]),
        };
        // Whole millimetres rounded down are below whole millimetres where the error is.
        let limit = (1000.0 * self.recipe.threshold).round();
        let well = errors[rank].partition_point(|error| f64::from(*error) < limit) as u32;
        orders[rank][..self.laps()].iter().map(move |lap| u32::from(*lap) < well)
    }

    /// How many of the laps that have come end well, by the rank of the number of universes.
    pub fn fractions(&self, proposal: ProposalKind) -> [Fraction; TRIED.len()] {
        core::array::from_fn(|rank| Fraction::of(self.ends(proposal, rank)))
    }

    /// The smallest number of universes with which enough laps end well, if one of those tried is.
    pub fn sufficient(&self, proposal: ProposalKind) -> Option<usize> {
        sufficient(&self.fractions(proposal)).map(|rank| TRIED[rank])
    }

    /// The rank from which on more universes buy nothing, of a proposal that comes to enough.
    pub fn saturated(&self, proposal: ProposalKind) -> Option<usize> {
        let fractions = self.fractions(proposal);
        sufficient(&fractions).and_then(|_| saturated(&fractions)).filter(|rank| rank + 1 < TRIED.len())
    }

    /// The share of laps that end well at what is read, and how probably that passes the rule.
    pub fn read(&self, proposal: ProposalKind) -> (Fraction, f64) {
        let fraction = self.fractions(proposal)[self.recipe.rank()];
        (fraction, self.recipe.rule.passes(fraction.share()))
    }

    /// N_eff / M of the motion prior by the closed form, at noises from sharp to blunt \[m\].
    pub fn closed_form(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.depletions
            .iter()
            .filter(|(_, found)| found.measured.is_none())
            .map(|(noise, found)| [*noise, found.predicted])
    }

    /// The same of samples.
    pub fn measured(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.depletions.iter().filter_map(|(noise, found)| Some([*noise, found.measured?]))
    }

    /// How well the map knows the range \[m\].
    pub fn map_std(&self) -> f64 {
        self.depletions[0].1.map_std
    }

    /// N_eff / M \[%\] of the motion prior with the sharpest sensor.
    pub fn floor(&self) -> f64 {
        100.0 * self.depletions[0].1.predicted
    }

    /// What the two guesses about universes came to, in words; nothing before they are judged.
    pub fn judged(&self) -> Option<String> {
        let shown = self.recipe.prediction.is_shown();
        let guesses = [self.recipe.prediction.guess, self.recipe.guess_aware];
        let of = |proposal: ProposalKind, guess: Option<f64>| {
            let needs = &self.needs(proposal);
            let of = name(proposal);
            match (guess, self.sufficient(proposal)) {
                (Some(guess), Some(result)) => {
                    words::Guessed { of: &of, needs, guess: &write(guess), off: &off_by(guess, result as f64) }.say()
                }
                (Some(guess), None) => words::GuessedNone { of: &of, needs, guess: &write(guess) }.say(),
                (None, _) => words::Needs { of: &of, needs }.say(),
            }
        };
        shown.then(|| [0, 1].map(|k| of(PROPOSALS[k], guesses[k])).join(" "))
    }

    /// The smallest sufficient number in words.
    pub fn needs(&self, proposal: ProposalKind) -> String {
        let more = || words::MoreThan { most: &TRIED[TRIED.len() - 1] }.say();
        self.sufficient(proposal).map_or_else(more, |needs| needs.to_string())
    }
}

/// A proposal's name for readers.
pub fn name(proposal: ProposalKind) -> &'static str {
    match proposal {
        ProposalKind::Motion => words::motion(),
        ProposalKind::Improved => words::aware(),
    }
}

/// A share in percent.
pub fn percent(share: f64) -> String {
    fixed(100.0 * share, 0)
}

impl Declared for UniversesModel {
    type Recipe = Recipe;
    const TITLE: &'static str = words::TITLE;
    const CHANGES: &'static [Change] = &[WEIGHED_ANEW];
    const UNSAID: usize = 2;

    fn challenges() -> Vec<Challenge<Self>> {
        challenges::challenges()
    }

    fn recipe(&self) -> &Recipe {
        &self.recipe
    }

    fn adopt(&mut self, recipe: Recipe) -> Result<(), FigureError> {
        if recipe.setup != self.recipe.setup {
            self.depletions = depletions(&recipe.setup);
        }
        self.recipe = recipe;
        Ok(())
    }
}

impl Model for UniversesModel {
    fn seek(&mut self, step: u32) {
        self.recipe.step = step.min(LAST);
    }

    fn step_count(&self) -> u32 {
        if self.hides() { 0 } else { LAST }
    }

    fn step(&self) -> u32 {
        self.recipe.step.min(self.step_count())
    }

    fn telling(&self) -> u32 {
        LAST
    }

    fn watch(&self) -> Option<(u32, &'static str)> {
        Some((0, words::watch()))
    }

    /// Of the first laps each is seen by itself.
    fn pace(&self) -> f64 {
        if self.recipe.step < 20 { 0.5 } else { 2.0 }
    }

    fn prediction(&self) -> Option<Outcome> {
        let result = self.sufficient(ProposalKind::Motion).map(|needs| needs as f64);
        self.recipe.prediction.outcome("sufficient_motion", result)
    }

    fn compared(&self) -> Vec<&'static str> {
        vec!["share_motion", "share_aware", "passes_motion"]
    }

    fn readouts(&self) -> Vec<Readout> {
        let known = |x: f64| if self.hides() { f64::NAN } else { x };
        let needs = |proposal| known(self.sufficient(proposal).map_or(f64::NAN, |needs| needs as f64));
        let share = |proposal| known(100.0 * self.read(proposal).0.share());
        let passes = |proposal| known(100.0 * self.read(proposal).1);
        let interval = |proposal| {
            let [low, high] = self.read(proposal).0.wilson().map(percent);
            words::IntervalOf { share: &percent(self.read(proposal).0.share()), low: &low, high: &high }.say()
        };
        let [motion, aware] = PROPOSALS;
        let whole = |x: f64| fixed(x, 0);
        let (a, b, c) = (needs(motion), needs(aware), known(self.floor()));
        vec![
            Readout::new("sufficient_motion", words::sufficient_motion(), a, whole(a), "", words::sufficient_help())
                .drawn(),
            Readout::new("sufficient_aware", words::sufficient_aware(), b, whole(b), "", words::sufficient_help())
                .drawn(),
            Readout::new(
                "share_motion",
                words::share_motion(),
                share(motion),
                interval(motion),
                "%",
                words::share_help(),
            ),
            Readout::new("share_aware", words::share_aware(), share(aware), interval(aware), "%", words::share_help()),
            Readout::new(
                "passes_motion",
                words::passes_motion(),
                passes(motion),
                fixed(passes(motion), 1),
                "%",
                words::passes_help(),
            ),
            Readout::new(
                "passes_aware",
                words::passes_aware(),
                passes(aware),
                fixed(passes(aware), 1),
                "%",
                words::passes_help(),
            ),
            Readout::new("floor", words::floor(), c, fixed(c, 1), "%", words::floor_help()),
        ]
    }

    fn series(&self) -> Series {
        const COLUMNS: &[Column] = &[
            Column::new("universes", "number of universes M"),
            Column::new("motion_share", "share of laps that end well, motion prior"),
            Column::new("motion_low", "lower end of its 95 % interval (Wilson)"),
            Column::new("motion_high", "upper end of it"),
            Column::new("motion_passes", "probability that it passes the rule"),
            Column::new("aware_share", "share of laps that end well, measurement-aware proposal"),
            Column::new("aware_low", "lower end of its 95 % interval (Wilson)"),
            Column::new("aware_high", "upper end of it"),
            Column::new("aware_passes", "probability that it passes the rule"),
        ];
        let both = PROPOSALS.map(|proposal| self.fractions(proposal));
        let row = |rank: usize| {
            let of = |fractions: &[Fraction; TRIED.len()]| {
                let ([low, high], share) = (fractions[rank].wilson(), fractions[rank].share());
                [share, low, high, self.recipe.rule.passes(share)]
            };
            core::iter::once(TRIED[rank] as f64).chain(both.iter().flat_map(of)).collect()
        };
        let count = if self.hides() { 0 } else { TRIED.len() };
        Series { columns: COLUMNS.into(), rows: (0..count).map(row).collect() }
    }

    fn describe(&self) -> String {
        let threshold = &write(self.recipe.threshold);
        if self.hides() {
            return words::Asked { threshold, enough: &percent(ENOUGH) }.say();
        }
        let ([motion, aware], n) = (PROPOSALS, &self.laps());
        let mut sentences: Vec<String> = self.judged().into_iter().collect();
        let [needs_motion, needs_aware] = PROPOSALS.map(|proposal| self.needs(proposal));
        sentences.push(
            words::Told { threshold, n, enough: &percent(ENOUGH), motion: &needs_motion, aware: &needs_aware }.say(),
        );
        let buys = self.saturated(motion).map(|rank| words::BuysNothing { from: &TRIED[rank], n }.say());
        sentences.extend(buys);
        let [(share, passes), (other, also)] = [motion, aware].map(|proposal| self.read(proposal));
        let told = words::Reads {
            m: &TRIED[self.recipe.rank()],
            motion: &percent(share.share()),
            aware: &percent(other.share()),
            k: &self.recipe.rule.successes(),
            n: &self.recipe.rule.seeds,
            passes: &percent(passes),
            also: &percent(also),
        };
        sentences.push(told.say());
        let floor = &fixed(self.floor(), 0);
        sentences.push(words::Depletes { floor, map: &fixed(self.map_std(), 2) }.say());
        if let (true, Some(guess)) = (self.recipe.prediction.is_shown(), self.recipe.guess_floor) {
            sentences.push(words::FloorGuessed { guess: &write(guess), off: &off_by(guess, self.floor()) }.say());
        }
        sentences.join(" ")
    }

    fn narrate(&self) -> String {
        let threshold = &write(self.recipe.threshold);
        if self.hides() {
            return words::Asked { threshold, enough: &percent(ENOUGH) }.say();
        }
        let [motion, aware] = PROPOSALS.map(|proposal| self.needs(proposal));
        if self.recipe.step < LAST {
            let [(motion, _), (aware, _)] = PROPOSALS.map(|proposal| self.read(proposal));
            let m = &TRIED[self.recipe.rank()];
            return words::NSoFar { n: &self.laps(), m, motion: &motion.successes, aware: &aware.successes }.say();
        }
        let told = || words::NTold { threshold, motion: &motion, aware: &aware }.say();
        self.judged().unwrap_or_else(told)
    }
}

#[cfg(test)]
mod tests;
