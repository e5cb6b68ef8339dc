//! What is told of the universes in numbers and in words.

use super::recipe::LAST;
use super::{
    challenges,
    model::{PROPOSALS, UniversesModel},
};
use crate::{
    challenge::Challenge,
    decimal::{fixed, write},
    model::{Column, Readout, Series, Tells},
    prediction::off_by,
    words::universes as words,
};
use fastslam_lab::experiment::{
    Fraction, ProposalKind,
    universes::{ENOUGH, TRIED},
};

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

impl Tells for UniversesModel {
    fn challenges() -> Vec<Challenge<Self>> {
        challenges::challenges()
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

impl UniversesModel {
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

/// What is asked before, and what both proposals need after.
pub fn asked(model: &UniversesModel) -> [String; 2] {
    if model.hides() {
        return [words::question().into(), words::question_short().into()];
    }
    let [motion, aware] = PROPOSALS.map(|proposal| model.needs(proposal));
    let short = words::NeedsBoth { motion: &motion, aware: &aware }.say();
    [model.judged().unwrap_or_default(), short]
}
