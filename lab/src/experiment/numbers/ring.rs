//! The ring and the rooms: what a filter keeps until its loop closes, and what the closing leaves.

use super::{Group, Number, Recipe, Runs, SEEDS, VALID};
use crate::experiment::ErrorSummary;
use crate::experiment::ProposalKind;
use crate::experiment::lap::{LapSetup, ScanWeight};
use crate::experiment::ring::{AFTER, RingRun, RingSetup, closing};

/// All recipes of both: the run in the rooms that the chapter opens with; the ring's course, and both proposals on it.
pub fn recipes() -> Vec<Recipe> {
    // By the usual weight of each, and by that of the other.
    let filters = [
        (ProposalKind::Improved, ScanWeight::Usual),
        (ProposalKind::Improved, ScanWeight::Marginal),
        (ProposalKind::Motion, ScanWeight::Usual),
        (ProposalKind::Motion, ScanWeight::NewGroundFree),
    ];
    let filters = filters.map(|(proposal, weight)| {
        let name = match weight {
            ScanWeight::Usual => format!("ring.{proposal}"),
            other => format!("ring.{proposal}.{other}"),
        };
        let group = Group(name.clone());
        Recipe::new(name, SEEDS, move |runs| runs_of(&group, proposal, weight, runs).into())
    });
    [course(), opening()].into_iter().chain(filters).collect()
}

/// Of the very run that the lap's figure opens with.
fn opening() -> Recipe {
    Recipe::fixed("rooms", |group| {
        let lap = LapSetup::opening();
        let LapSetup { odometry_scale, seed, particles, course, .. } = lap;
        let route = course.route();
        let run = RingRun::on(&route, &lap).expect(VALID);
        let of = |what: &str| {
            format!(
                "{what}, in the run that the lap's figure opens with: fastslam-lab ring --rooms --odometry {odometry_scale} --particles {particles}, seed {seed}"
            )
        };
        vec![
            group.number("steps", route.steps as f64, "", of("steps after the start")),
            group.number("range", route.max_range, "m", of("the longest range of a beam")),
            group.number("odometry_scale", odometry_scale, "", of("the factor on the odometry's noise")),
            group.number("closing", f64::from(run.closing), "", of("the first step that sees the start again")),
            group.number("within", f64::from(AFTER), "", of("steps from there to the second look")),
            group.number(
                "before",
                run.deviation_before,
                "m",
                of("the standard deviation of position one step before the closing"),
            ),
            group.number(
                "after",
                run.deviation_after,
                "m",
                of("the standard deviation of position some steps after the closing"),
            ),
            group.number("deaths", (run.died * particles as f64).round(), "", of("universes that the closing ends")),
            group.number("best", run.end_best, "m", of("the best universe's error at the last step")),
            group.number("odometry", run.end_odometry, "m", of("raw odometry's error at the last step")),
        ]
    })
}

fn course() -> Recipe {
    Recipe::fixed("ring", |group| {
        let ring = "The ring (Route::ring in lab/src/experiment/lap/course.rs)";
        let route = RingSetup::default().route();
        let step = f64::from(closing(&route).expect("the ring comes back to where it began"));
        vec![
            group.number("steps", route.steps as f64, "", format!("{ring}: steps after the start")),
            group.number("range", route.max_range, "m", format!("{ring}: longest range of a beam")),
            group.number("closing", step, "", format!("{ring}: first step that sees the start again")),
            group.number("after", f64::from(AFTER), "", format!("{ring}: steps from there to the second look")),
        ]
    })
}

/// The medians over the seeds to be run.
fn runs_of(group: &Group, proposal: ProposalKind, weight: ScanWeight, runs: &Runs<'_>) -> Vec<Number> {
    let setup = |seed| RingSetup {
        lap: LapSetup { proposal, weight, seed, ..RingSetup::default().lap },
        ..RingSetup::default()
    };
    let particles = setup(1).lap.particles;
    let found = runs.over(|seed| RingRun::of(&setup(seed)).expect(VALID));
    let command = format!(
        "fastslam-lab ring --proposal {proposal} --weight {weight} --particles {particles} --seeds {}",
        runs.seeds
    );
    let median = |key: &str, unit, what: &str, of: fn(&RingRun) -> f64| {
        let values: Vec<f64> = found.iter().map(of).collect();
        let made = format!("Median over seeds 1 to {} of {what}: {command}", runs.seeds);
        group.number(key, ErrorSummary::of(&values).median, unit, made)
    };
    vec![
        median("resampled", "", "the steps that resample before the loop closes", |run| {
            f64::from(run.resampled_before)
        }),
        median("lineage", "", "the distinct ancestors at the start, one step before the closing", |run| {
            f64::from(run.lineage_before)
        }),
        median("before", "m", "the standard deviation of position one step before the closing", |run| {
            run.deviation_before
        }),
        median("after", "m", "the standard deviation of position some steps after the closing", |run| {
            run.deviation_after
        }),
        median("died", "", "the share of universes that the closing ends", |run| run.died),
        median("rms", "m", "the RMS position error over the best universe's path", |run| run.rms_best),
        median("end", "m", "the best universe's error at the last step", |run| run.end_best),
        median("odometry", "m", "raw odometry's error at the last step", |run| run.end_odometry),
    ]
}
