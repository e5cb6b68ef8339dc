//! States that are worth trying.

use super::model::UniversesModel;
use crate::{
    challenge::{Challenge, Verdict},
    decimal::fixed,
    model::Declared,
    words::universes as words,
};
use fastslam_lab::experiment::{ProposalKind, universes::TRIED};

/// A rule that passes eight universes of the motion prior more seldom tells them from enough.
const SELDOM: f64 = 0.05;

pub(super) fn challenges() -> Vec<Challenge<UniversesModel>> {
    vec![
        Challenge::new("rule", words::chip_rule(), "proposals=motion").with(words::goal_rule(), "seeds", seldom_passes),
        Challenge::new("strict", words::chip_strict(), "threshold=0.1").with(
            words::goal_strict(),
            "threshold",
            one_is_not_enough,
        ),
        Challenge::new("more", words::chip_more(), "universes=24&proposals=motion"),
        Challenge::new("sharp", words::chip_sharp(), "bearing-std=0.01"),
    ]
}

/// Whether the rule, at the eight universes that are read, seldom passes what is not enough.
fn seldom_passes(model: &UniversesModel) -> Verdict {
    let (_, passes) = model.read(ProposalKind::Motion);
    let m = TRIED[model.recipe().rank()];
    let said = words::ChipPasses { m: &m, passes: &fixed(100.0 * passes, 1) }.say();
    Verdict::new(passes < SELDOM && m == 8, &[SELDOM / passes], said)
}

/// Whether a single measurement-aware universe is too few, while some number of them is enough.
fn one_is_not_enough(model: &UniversesModel) -> Verdict {
    let needs = model.sufficient(ProposalKind::Improved);
    let said = words::ChipNeeds { needs: &model.needs(ProposalKind::Improved) }.say();
    Verdict::new(needs.is_some_and(|needs| needs > 1), &[needs.map_or(0.0, |needs| 0.5 * needs as f64)], said)
}
