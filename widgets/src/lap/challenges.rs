//! States of the lap that are worth trying.

use super::model::LapModel;
use crate::{
    challenge::{Challenge, Verdict},
    decimal::fixed,
    model::Model,
    words::lap as words,
};

/// Most universes, and the error of the best at the end \[m\], of a lap that is well done with little.
const FEW: usize = 4;
const NEAR: f64 = 0.5;

pub(super) fn challenges() -> Vec<Challenge<LapModel>> {
    vec![
        Challenge::new("closing", words::chip_closing(), "step=79&truth=on"),
        Challenge::new(
            "no-measurements",
            words::chip_no_measurements(),
            "seed=3&odometry=1&proposal=motion&policy=never&course=apartment&step=80",
        ),
        Challenge::new(
            "measurements",
            words::chip_measurements(),
            "seed=3&odometry=1&proposal=motion&course=apartment&step=80",
        ),
        Challenge::new(
            "four",
            words::chip_four(),
            "universes=4&seed=3&odometry=1&proposal=motion&course=apartment&step=90",
        )
        .with(
            words::goal_four(),
            "universes proposal weight matcher policy threshold scheme temper guard",
            near_with_few,
        ),
        Challenge::new("blurred", words::chip_blurred(), "seed=3&odometry=2&range-std=0.3&course=apartment&step=90"),
    ]
}

/// Whether the best of a few universes ends near the truth.
fn near_with_few(model: &LapModel) -> Verdict {
    let (m, error) = (model.setup().particles, model.report().rms_best);
    let (step, last) = (model.step(), model.step_count());
    let said = words::ChipError { error: &fixed(error, 2), m: &m, step: &step, last: &last }.say();
    let far = f64::from(step) / f64::from(last);
    Verdict::new(m <= FEW && step == last && error < NEAR, &[FEW as f64 / m as f64, far, NEAR / error], said)
}
