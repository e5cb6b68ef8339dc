//! States of the step that are worth trying.

use super::model::ProposalModel;
use crate::{
    challenge::{Challenge, Verdict},
    decimal::fixed,
    words::proposal as words,
};

/// Samples of 1.0 that one of 2.0 is to be worth.
const WORTH: f64 = 10.0;
/// Share of the samples of 2.0 inside the posterior's region, at most, and their share of N_eff, at least, for a failure that nobody sees.
const INSIDE: f64 = 0.8;
const ESS: f64 = 0.9;

pub(super) fn challenges() -> Vec<Challenge<ProposalModel>> {
    vec![
        Challenge::new("sharp", words::chip_sharp(), "range-std=0.005").with(
            words::goal_sharp(),
            "bearing-std samples landmark-x landmark-y",
            worth_ten,
        ),
        Challenge::new("blunt", words::chip_blunt(), "range-std=0.5&bearing-std=0.3"),
        Challenge::new("bend", words::chip_bend(), "odometry=2&landmark-x=1.5&landmark-y=0.3").with(
            words::goal_bend(),
            "range-std bearing-std odometry samples landmark-x landmark-y",
            misses_unseen,
        ),
        Challenge::new("pair", words::chip_pair(), "landmarks=pair"),
    ]
}

fn worth_ten(model: &ProposalModel) -> Verdict {
    let ratio = model.proposals().ratio();
    let said = words::ChipRatio { ratio: &fixed(ratio, 1) }.say();
    Verdict::new(ratio >= WORTH, &[ratio / WORTH], said)
}

/// Whether the measurement-aware samples miss the posterior, and their weights do not tell.
fn misses_unseen(model: &ProposalModel) -> Verdict {
    let aware = &model.proposals().aware;
    let (inside, ess) = (aware.share_inside(None), aware.ess() / model.setup().samples as f64);
    let [inside_text, ess_text] = [inside, ess].map(|share| fixed(100.0 * share, 0));
    let said = words::ChipMisses { inside: &inside_text, ess: &ess_text }.say();
    Verdict::new(inside < INSIDE && ess > ESS, &[INSIDE / inside, ess / ESS], said)
}
