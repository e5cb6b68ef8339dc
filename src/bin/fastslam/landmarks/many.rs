//! Many runs: the distributions of their errors over seeds.

use super::{Arguments, Others, drift_row, innovation_row, say};
use crate::remarks::Outcome;
use crate::{print, print_json};
use anyhow::Result;
use fastslam_lab::experiment::ErrorSummary;
use serde::Serialize;

/// What `--json` prints of many: errors of position \[m\].
#[derive(Serialize)]
struct Summary {
    seeds: usize,
    /// Where the noises that the filters are told come from.
    noises: String,
    /// RMS over the steps of the errors of the weighted mean, each when it was made.
    online: ErrorSummary,
    /// The same of EKF-SLAM on the same drives.
    ekf: ErrorSummary,
    /// The same of FastSLAM 2.0 that draws late.
    #[serde(skip_serializing_if = "Option::is_none")]
    late: Option<ErrorSummary>,
    /// RMS of the best particle's path at the end.
    best: ErrorSummary,
    /// The same after the best rigid alignment.
    best_aligned: ErrorSummary,
    /// RMS of raw odometry.
    odometry: ErrorSummary,
    /// How many landmarks the best particle's map has at the end.
    landmarks: ErrorSummary,
    /// Medians of what the robot turns to the left beyond its odometry, per metre ahead \[rad/m\] and per radian turned \[–\], where that is learnt.
    drift: Option<[f64; 2]>,
    /// Median of the mean normalised innovations squared; 2 is expected.
    innovation: Option<f64>,
    /// What speaks against the median result, with what to change.
    remarks: Vec<String>,
}

/// What is kept of one of many runs \[m\].
pub(super) struct Errors {
    pub online: f64,
    pub others: Others,
    /// Of the best particle's path at the end, of the same aligned, and of raw odometry.
    pub path: [f64; 3],
    pub outcome: Outcome,
}

/// The distribution of a number over runs.
fn spread(errors: &[Errors], of: impl Fn(&Errors) -> f64) -> ErrorSummary {
    ErrorSummary::of(&errors.iter().map(of).collect::<Vec<f64>>())
}

/// The medians of runs.
fn median_outcome(errors: &[Errors]) -> Outcome {
    let median = |of: &dyn Fn(&Outcome) -> f64| spread(errors, |errors| of(&errors.outcome)).median;
    let innovation = median(&|outcome| outcome.innovations.1.unwrap_or(f64::NAN));
    let of_first = errors[0].outcome;
    Outcome {
        innovations: (
            median(&|outcome| f64::from(outcome.innovations.0)) as u32,
            Some(innovation).filter(|innovation| !innovation.is_nan()),
            median(&|outcome| outcome.innovations.2),
        ),
        left: median(&|outcome| outcome.left),
        founded: median(&|outcome| outcome.founded),
        there: median(&|outcome| outcome.there),
        contradicting: median(&|outcome| outcome.contradicting),
        gone: median(&|outcome| outcome.gone),
        founded_again: median(&|outcome| outcome.founded_again),
        named: median(&|outcome| outcome.named),
        ekf: median(&|outcome| outcome.ekf),
        excess: median(&|outcome| outcome.excess),
        blind: median(&|outcome| outcome.blind),
        errors: [0, 1].map(|k| median(&|outcome| outcome.errors[k])),
        drift: of_first
            .drift
            .map(|_| [0, 1].map(|k| median(&|outcome| outcome.drift.map_or(f64::NAN, |drift| drift[k])))),
        ..of_first
    }
}

/// Prints how far off so many runs were.
pub(super) fn many(
    arguments: &Arguments,
    errors: &[Errors],
    (noises, of_log): (&str, &[String]),
    options: &[&str],
) -> Result<()> {
    let spread = |of: &dyn Fn(&Errors) -> f64| spread(errors, of);
    let median = median_outcome(errors);
    let summary = Summary {
        seeds: errors.len(),
        noises: noises.into(),
        online: spread(&|errors| errors.online),
        ekf: spread(&|errors| errors.others.ekf),
        late: arguments.late.map(|_| spread(&|errors| errors.others.late.unwrap_or(f64::NAN))),
        best: spread(&|errors| errors.path[0]),
        best_aligned: spread(&|errors| errors.path[1]),
        odometry: spread(&|errors| errors.path[2]),
        landmarks: spread(&|errors| errors.outcome.left),
        drift: median.drift,
        innovation: median.innovations.1,
        remarks: [of_log, &median.remarks(options)].concat(),
    };
    say(&summary.remarks);
    if arguments.json {
        return print_json(&summary);
    }
    let row = |name: &str, ErrorSummary { median, p90, worst, .. }: &ErrorSummary| {
        format!("{name:34}{median:8.3} m median, {p90:.3} m p90, {worst:.3} m worst\n")
    };
    print(
        &[
            format!("{} seeds, {} particles; noises {noises}\n", summary.seeds, arguments.particles),
            row("RMS error as it went, of the mean", &summary.online),
            summary.late.as_ref().map(|late| row("of the mean, poses drawn late", late)).unwrap_or_default(),
            row("of EKF-SLAM as it went", &summary.ekf),
            row("the best path at the end", &summary.best),
            row("the same after rigid alignment", &summary.best_aligned),
            row("raw odometry", &summary.odometry),
            format!(
                "{:34}{:8.0} median, {:.0} p90, {:.0} worst\n",
                "landmarks in the best map", summary.landmarks.median, summary.landmarks.p90, summary.landmarks.worst,
            ),
            drift_row(summary.drift),
            innovation_row(summary.innovation),
        ]
        .concat(),
    )
}
