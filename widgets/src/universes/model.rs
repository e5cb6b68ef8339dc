//! Shares of laps that end well, from the errors that come with the figure, and the depletion of the one step.

use super::{
    recipe::{LAST, NOISES, Recipe},
    shipped::{self, LAPS},
};
use crate::told::{WEIGHED_ANEW, in_range};
use crate::{
    model::{Change, Declared, FigureError, Model},
    prediction::{Outcome, State},
    words::universes as words,
};
use fastslam::{
    ops,
    random::{Purpose, Stream},
};
use fastslam_lab::experiment::{
    Fraction, ProposalKind,
    proposal::{Depletion, ProposalsSetup, depletion},
    universes::{TRIED, saturated, sufficient},
};

/// Range noises at which the depletion is measured \[m\], beside the names of its axis.
pub const MEASURED: [f64; 7] = [0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5];

/// Places of the closed form's line.
const PLACES: u32 = 48;

/// Both proposals, in the order in which they are told.
pub const PROPOSALS: [ProposalKind; 2] = [ProposalKind::Motion, ProposalKind::Improved];

/// The figure *how many are enough*.
pub struct UniversesModel {
    pub(super) recipe: Recipe,
    /// N_eff / M of the motion prior by the range noise \[m\].
    pub(super) depletions: Vec<(f64, Depletion)>,
    /// Of each proposal and number of universes, the order in which its laps come: those that are shipped are sorted.
    pub(super) orders: [[[u8; LAPS]; TRIED.len()]; 2],
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
        (range_std, in_range(found))
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
}

impl Declared for UniversesModel {
    type Recipe = Recipe;
    const TITLE: &'static str = words::TITLE;
    const CHANGES: &'static [Change] = &[WEIGHED_ANEW];
    const UNSAID: usize = 2;

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
}

#[cfg(test)]
mod tests;
