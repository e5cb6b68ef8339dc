//! The smoother: how far back a filter's record has but one path, and what sweeps make of it.

use super::{Group, Number, Recipe, VALID};
use crate::experiment::ErrorSummary;
use crate::experiment::smoothing::{MOST, STEPS, Smoothing, SmoothingSetup};

/// Seeds of what is measured.
const SEEDS: u32 = 20;

/// One recipe.
pub fn recipes() -> Vec<Recipe> {
    vec![Recipe::new("smoothing", SEEDS, |runs| measured(&runs.over(run)).into())]
}

/// The last common ancestor; different poses up to there, on average over the steps; early errors of record and draws; and the cost of a
/// sweep in runs of the filter.
fn run(seed: u64) -> [f64; 5] {
    let mut smoothing = Smoothing::new(&SmoothingSetup { seed, ..SmoothingSetup::default() }).expect(VALID);
    smoothing.finish(MOST);
    let sweeps = MOST as usize;
    let Some(record) = smoothing.record() else { return [f64::NAN; 5] };
    let early = |moments| smoothing.early_rms(&smoothing.errors(moments));
    let distinct = smoothing.distinct(sweeps);
    // Of a record without a common ancestor, the first step.
    let shared = &distinct[1..=record.coalescence.max(1) as usize];
    let mean = f64::from(shared.iter().sum::<u32>()) / shared.len() as f64;
    [record.coalescence.into(), mean, early(&record.moments), early(&smoothing.moments(sweeps)), smoothing.cost()]
}

fn measured(found: &[[f64; 5]]) -> Vec<Number> {
    let group = Group("smoothing".into());
    let SmoothingSetup { particles, .. } = SmoothingSetup::default();
    let median = |k: usize, key, unit, what: String| {
        let values: Vec<f64> = found.iter().map(|run| run[k]).collect();
        group.number(
            key,
            ErrorSummary::of(&values).median,
            unit,
            format!("Median over seeds 1 to {} of {what}", found.len()),
        )
    };
    let nearer = found.iter().filter(|run| run[3] < run[2]).count() as f64;
    vec![
        group.number("runs", found.len() as f64, "", "Seeds of the smoother's drive, from 1 on"),
        median(
            0,
            "coalescence",
            "",
            format!("the last of {STEPS} steps at which all {particles} particles of the filter have one ancestor"),
        ),
        median(
            1,
            "distinct",
            "",
            format!("the mean number of different poses at the steps up to there, among the paths of {MOST} sweeps"),
        ),
        median(2, "early.filter", "m", "the RMS error of the filter's record over the first half of the drive".into()),
        median(3, "early.smoother", "m", format!("the same of the mean over {MOST} sweeps")),
        group.number("nearer", nearer, "", "Seeds at which that of the sweeps is the smaller one"),
        median(4, "cost", "", "updates of a map in a sweep, for each in a run of the filter".into()),
    ]
}
