//! States of the graph that are worth trying.

use super::model::GraphModel;
use crate::told::metres;
use crate::{
    challenge::{Challenge, Verdict},
    words::graph as words,
};

/// A path that ends with a smaller error is closed, and one that ends with a larger one left open \[m\].
const CLOSED: f64 = 0.15;
const OPEN: f64 = 0.2;

/// A false edge that folds the path by so much is worse than the one that the challenge begins with \[m\].
const WORSE: f64 = 4.0;

pub(super) fn challenges() -> Vec<Challenge<GraphModel>> {
    vec![
        Challenge::new("close", words::chip_close(), "odometry=1&start=matches").with(
            words::goal_close(),
            "odometry",
            closed,
        ),
        Challenge::new("fold", words::chip_fold(), "wrong=on&step=60").with(
            words::goal_fold(),
            "wrong-from wrong-to",
            folded,
        ),
        Challenge::new("repair", words::chip_repair(), "repair=switchable&wrong=on&step=60"),
        Challenge::new("early", words::chip_early(), "repair=mixture&step=60").with(
            words::goal_early(),
            "odometry seed",
            let_go,
        ),
    ]
}

/// What the end of the optimisation is off by, in words.
fn at_end(model: &GraphModel, near: fn(f64) -> f64) -> Verdict {
    let rms = model.frame().error.rms;
    let said = words::ChipOff { rms: &metres(rms) }.say();
    Verdict::new(model.at_end() && near(rms) > 1.0, &[near(rms)], said)
}

/// Whether the loop is closed.
fn closed(model: &GraphModel) -> Verdict {
    at_end(model, |rms| CLOSED / rms)
}

/// Whether the path is folded worse than it was.
fn folded(model: &GraphModel) -> Verdict {
    at_end(model, |rms| rms / WORSE)
}

/// Whether right edges were let go of, and the loop is open still.
fn let_go(model: &GraphModel) -> Verdict {
    at_end(model, |rms| rms / OPEN)
}
