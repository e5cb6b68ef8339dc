//! States of the example that are worth trying.

use super::{model::WorkedExampleModel, recipe::plain};
use crate::{
    challenge::{Challenge, Verdict},
    words::worked_example as words,
};

/// How many times as much particle 1 is to weigh.
const TIMES: f64 = 10.0;

pub(super) fn challenges() -> Vec<Challenge<WorkedExampleModel>> {
    vec![
        Challenge::new("bearing", words::chip_bearing(), "bearing-std=0.025"),
        Challenge::new("ten", words::chip_ten(), "r2=4.1&phi2=0.05").with(words::goal_ten(), "r2 phi2", ten_to_one),
        Challenge::new("resample", words::chip_resample(), "threshold=0.6").with(
            words::goal_resample(),
            "threshold r1 phi1 r2 phi2",
            resamples,
        ),
    ]
}

fn ten_to_one(model: &WorkedExampleModel) -> Verdict {
    let [one, two] = [0, 1].map(|slot| model.example().weights.as_slice()[slot]);
    let said = words::ChipTimes { times: &plain(one / two, 3) }.say();
    Verdict::new(one >= TIMES * two, &[one / (TIMES * two)], said)
}

fn resamples(model: &WorkedExampleModel) -> Verdict {
    let said = model.verdict();
    Verdict::new(model.example().resamples, &[model.example().limit / model.example().ess], said)
}
