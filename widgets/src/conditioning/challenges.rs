//! States of the graphical model that are worth trying.

use super::{model::ConditioningModel, recipe::Given};
use crate::{
    challenge::{Challenge, Verdict},
    decimal::fixed,
    words::conditioning as words,
};

/// How much two landmarks that no pose saw together can have to do with each other, and still be hard to find \[–\].
const STRONG: f64 = 0.8;

pub(super) fn challenges() -> Vec<Challenge<ConditioningModel>> {
    vec![
        Challenge::new("path", words::chip_path(), "condition=on"),
        Challenge::new("last-pose", words::chip_last_pose(), "last-pose=on"),
        Challenge::new("pairs", words::chip_pairs(), "condition=on&pairs=on"),
        Challenge::new("apart", words::chip_apart(), "row=1&column=14").with(
            words::goal_apart(),
            "row column",
            far_and_tied,
        ),
        Challenge::new("wheels", words::chip_wheels(), "odometry=0.05").with(
            words::goal_wheels(),
            "odometry range-std",
            untied,
        ),
    ]
}

/// Whether the entry that is named is of two landmarks that no pose saw both, and far from 0 all the same.
fn far_and_tied(model: &ConditioningModel) -> Verdict {
    let [a, b] = model.entry().map(|k| k / 2);
    let said = words::ChipPair { entry: &model.entry_text(), n: &model.seen_together(a, b) }.say();
    let strength = model.correlation().map_or(0.0, f64::abs) / STRONG;
    let never = a != b && model.seen_together(a, b) == 0;
    Verdict::new(never && strength > 1.0, &[if never { strength } else { 0.0 }], said)
}

/// Whether nothing ties a landmark to another, though nobody conditioned.
fn untied(model: &ConditioningModel) -> Verdict {
    let (n, odometry) = (model.map().off_block_nonzeros(), model.drive().setup().odometry_scale);
    let said = words::ChipEntries { n: &n, odometry: &fixed(odometry, 2) }.say();
    let all_seen = model.off_block() > 0 && model.given() != Given::LastPose;
    Verdict::new(n == 0 && all_seen, &[1.0 - n as f64 / model.off_block() as f64], said)
}
