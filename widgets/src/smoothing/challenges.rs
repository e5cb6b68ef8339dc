//! States of the record and the sweeps that are worth trying.

use super::model::SmoothingModel;
use crate::{
    challenge::{Challenge, Verdict},
    decimal::fixed,
    words::smoothing as words,
};
use fastslam_lab::experiment::smoothing::{MOST, STEPS};

/// So many of five sweeps are to have a pose of their own.
const FIVE: u32 = 5;

/// At most so many different poses, on average over the steps, are those of a smoother that sticks: a third of the sweeps.
const STUCK: f64 = 8.0;

pub(super) fn challenges() -> Vec<Challenge<SmoothingModel>> {
    vec![
        Challenge::new("one", words::chip_one(), "at=30&step=0").with(words::goal_one(), "at", at_coalescence),
        Challenge::new("five", words::chip_five(), "particles=4&step=5").with(
            words::goal_five(),
            "particles",
            all_differ,
        ),
        Challenge::new("stick", words::chip_stick(), "particles=10").with(words::goal_stick(), "particles", sticks),
        Challenge::new("keep", words::chip_keep(), "reconnect=off"),
    ]
}

/// Whether the last step is looked at that all particles share.
fn at_coalescence(model: &SmoothingModel) -> Verdict {
    let at = model.at();
    let distinct = |step: u32| model.before().and_then(|before| before.distinct.get(step as usize).copied());
    let said = words::ChipDistinct { n: &distinct(at).unwrap_or(0), at: &at }.say();
    let off = model.coalescence().map_or(f64::NAN, |last| f64::from(last.abs_diff(at)) / f64::from(STEPS));
    Verdict::new(off == 0.0, &[1.0 - off], said)
}

/// What the sweeps shown have at the step looked at.
fn drawn(model: &SmoothingModel) -> (u32, String) {
    let at = model.at();
    let n = model.after().map_or(0, |after| after.distinct[at as usize]);
    (n, words::ChipDistinct { n: &n, at: &at }.say())
}

/// Whether each of the five sweeps has a pose of its own.
fn all_differ(model: &SmoothingModel) -> Verdict {
    let (n, said) = drawn(model);
    let parts = [n, model.sweeps()].map(|count| f64::from(count) / f64::from(FIVE));
    Verdict::new(model.sweeps() == FIVE && n == FIVE, &parts, said)
}

/// Whether all the sweeps have but few, on average over the steps.
fn sticks(model: &SmoothingModel) -> Verdict {
    let mean = model.after().map_or(0.0, |after| {
        let steps = after.distinct.len() - 1; // the start is known
        f64::from(after.distinct[1..].iter().sum::<u32>()) / steps as f64
    });
    let said = words::ChipMean { n: &fixed(mean, 1) }.say();
    let swept = f64::from(model.sweeps()) / f64::from(MOST);
    Verdict::new(model.sweeps() == MOST && mean <= STUCK, &[swept, STUCK / mean], said)
}
