//! States of EM mapping that are worth trying.

use super::model::EmModel;
use crate::{
    challenge::{Challenge, Verdict},
    decimal::fixed,
    words::em as words,
};

pub(super) fn challenges() -> Vec<Challenge<EmModel>> {
    const MARKS: &str = "mark-1 mark-2 mark-3";
    vec![
        Challenge::new("first", words::chip_first(), "iterations=10&step=0"),
        Challenge::new("fold", words::chip_fold(), "mark-3=5.2").with(words::goal_fold(), MARKS, unfolds),
        Challenge::new("yourself", words::chip_yourself(), "iterations=30").with(words::goal_yourself(), MARKS, folds),
        Challenge::new("blank", words::chip_blank(), "trust=0"),
        Challenge::new("wheels", words::chip_wheels(), "odometry=0.1"),
    ]
}

/// What the map at the end comes to, in words.
fn said(model: &EmModel) -> String {
    words::ChipEnds { doors: &model.doors().len(), value: &fixed(model.shown().log_posterior, 1) }.say()
}

/// Whether the second ride's doors are new at the end, as they are.
fn unfolds(model: &EmModel) -> Verdict {
    let again = model.put_down().map_or(f64::NAN, |(_, again)| again);
    Verdict::new(model.at_end() && again < 0.5, &[2.0 * (1.0 - again)], said(model))
}

/// Whether it has converged with the first two doors come again.
fn folds(model: &EmModel) -> Verdict {
    let again = model.put_down().map_or(f64::NAN, |(_, again)| again);
    Verdict::new(model.at_end() && again > 0.5 && model.is_still(), &[2.0 * again], said(model))
}
