//! The loop of ambiguity over many seeds.

use super::recipe::Recipe;
use crate::told::refused;
use crate::{
    job::{self, Counted, Job, Rows, Setting},
    model::FigureError,
};
use core::ops::Range;
use fastslam_lab::experiment::resampling::{
    PolicyCourse,
    counts::{PolicyOutcome, outcomes},
};

/// Which policy keeps the right wing, and which ends in it.
pub static WINGS: Job = Job {
    name: "wings",
    columns: &[
        "seed",
        "never_alive",
        "never_settled",
        "always_alive",
        "always_settled",
        "selective_alive",
        "selective_settled",
    ],
    run,
    counted: Some(Counted {
        title: "count_title",
        settings: "particles threshold odometry range scheme",
        rows: &[
            ("never", "never_alive", None),
            ("every_step", "always_alive", None),
            ("selective", "selective_alive", None),
        ],
    }),
};

/// The setting is that of the figure's link; what it says about the seed and the view makes no difference.
fn run(setting: &Setting, seeds: Range<u64>) -> Result<Rows, FigureError> {
    let recipe: Recipe = job::recipe(setting)?;
    let row = |(seed, all): (u64, [PolicyOutcome; 3])| {
        let kept = all.into_iter().flat_map(|outcome| outcome.kept.map(|kept| [kept.alive, kept.settled]));
        core::iter::once(seed as f64).chain(kept.flatten().map(|yes| f64::from(u8::from(yes)))).collect()
    };
    Ok(seeds.clone().zip(outcomes(&recipe.on(PolicyCourse::Wings), seeds).map_err(refused)?).map(row).collect())
}
