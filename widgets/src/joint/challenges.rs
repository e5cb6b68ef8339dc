//! States of the two filters that are worth trying.

use super::model::JointModel;
use crate::told::count;
use crate::{
    challenge::{Challenge, Verdict},
    words::joint as words,
};
use fastslam_lab::experiment::joint::SAMPLED;

/// N_eff that the sampled map is to keep.
const KEPT: f64 = 100.0;

pub(super) fn challenges() -> Vec<Challenge<JointModel>> {
    vec![
        Challenge::new("exercise", words::chip_exercise(), "landmarks=5&odometry=0").with(
            words::goal_exercise(),
            "landmarks",
            first_below_one,
        ),
        Challenge::new("many", words::chip_many(), "landmarks=5&particles=20000").with(
            words::goal_many(),
            "landmarks",
            first_below_one,
        ),
        Challenge::new("blunt", words::chip_blunt(), "sensor=2").with(words::goal_blunt(), "sensor", keeps),
    ]
}

/// Whether the number of landmarks is the first for which less than one particle is predicted.
fn first_below_one(model: &JointModel) -> Verdict {
    let n = model.landmarks();
    let [now, before] = [n, n - 1].map(|n| model.predicted(SAMPLED, n));
    let said = words::ChipPredicted { ess: &count(now), n: &n }.say();
    Verdict::new(now < 1.0 && before >= 1.0, &[1.0 / now, before], said)
}

/// Whether the sampled map keeps enough.
fn keeps(model: &JointModel) -> Verdict {
    let ess = model.population(SAMPLED).map_or(0.0, |found| found.ess);
    let said = words::ChipKept { ess: &count(ess) }.say();
    Verdict::new(ess >= KEPT, &[ess / KEPT], said)
}
