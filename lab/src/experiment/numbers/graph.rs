//! The pose graph: of the very run that its figure opens with, and over many laps.

use super::{Group, Made, Recipe, Runs, SEEDS, VALID};
use crate::baseline::pose_graph::{EdgeKind, Repair};
use crate::experiment::ErrorSummary;
use crate::experiment::graph::{FALSE_EDGE, GraphLap, GraphRun, GraphSetup, PathError};
use crate::experiment::lap::{Course, LapSetup};

/// All recipes of the pose graph.
pub fn recipes() -> Vec<Recipe> {
    let courses = [(Course::Apartment, "lap.graph"), (Course::Ring, "ring.graph")].map(|(course, name)| {
        let group = Group(name.into());
        Recipe::new(name, SEEDS, move |runs| over_seeds(&group, course, runs))
    });
    [opening()].into_iter().chain(courses).collect()
}

fn solved(mut lap: GraphLap) -> GraphLap {
    while !lap.is_solved() {
        lap.advance().expect(VALID);
    }
    lap
}

fn opening() -> Recipe {
    Recipe::fixed("graph.opening", |group| {
        let setup = GraphSetup::opening();
        let of = |what: &str| format!("{what}, of the run that the figure of the pose graph opens with");
        let mut lap = solved(GraphLap::new(&setup).expect(VALID));
        let frames = lap.frames();
        let (first, last) = (&frames[0], &frames[frames.len() - 1]);
        let loops = lap.build().edges().iter().filter(|edge| edge.kind == EdgeKind::Loop).count();
        let matched = PathError::of(lap.build().chain(), &lap.world().truth).rms;
        let metres = |key: &str, x: f64, what: &str| group.number(key, x, "m", of(what));
        let mut numbers = vec![
            metres("start", first.error.rms, "RMS position error of the path before the first iteration"),
            metres("end", last.error.rms, "RMS position error of the path at the optimum"),
            metres("matched", matched, "RMS position error of the path by wheels and recent matches alone"),
            group.number("iterations", (frames.len() - 1) as f64, "", of("iterations to the optimum")),
            group.number("loops", loops as f64, "", of("edges that close the loop")),
            group.number("bytes", lap.build().bytes() as f64 / 1e3, "kB", of("poses and end points of scans")),
        ];
        for (key, repair) in [
            ("folded", Repair::LeastSquares),
            ("robust", Repair::CAUCHY),
            ("switchable", Repair::SWITCHABLE),
            ("mixture", Repair::MAX_MIXTURE),
        ] {
            let asked = GraphSetup { repair, wrong: Some(FALSE_EDGE), ..setup.clone() };
            let mended = solved(lap.asked(&asked).expect(VALID));
            let end = mended.frames().last().map_or(f64::NAN, |frame| frame.error.rms);
            numbers.push(metres(key, end, &format!("RMS position error with one false edge, {repair:?}")));
        }
        while lap.pending() > 0 {
            lap.advance().expect(VALID);
        }
        let report = lap.universes().report();
        let [unique, dense] = [report.map_bytes_unique, report.map_bytes_dense].map(|bytes| bytes as f64 / 1e3);
        numbers.push(metres("universe", report.rms_best, "RMS position error of the best universe on the same log"));
        numbers.push(group.number("maps", unique, "kB", of("all maps of the filter, shared tiles counted once")));
        numbers.push(group.number("dense", dense, "kB", of("as many dense maps")));
        numbers
    })
}

/// Errors over the seeds to be run. Those of the apartment are a cell of the lap table, which readers run again.
fn over_seeds(group: &Group, course: Course, runs: &Runs<'_>) -> Made {
    let setup = |seed| LapSetup { course, seed, ..LapSetup::default() };
    let found = runs.over(|seed| GraphRun::of(&setup(seed), Repair::LeastSquares).expect(VALID));
    let of = |f: fn(&GraphRun) -> f64| found.iter().map(f).collect::<Vec<f64>>();
    let command = format!("fastslam-lab lap --method graph --course {course} --seed N");
    let errors = of(|run| run.rms_after);
    let what = format!("the RMS position error of the path at the optimum: {command}");
    let mut numbers = group.spread(&errors, &what);
    let [low, high] = ErrorSummary::of(&errors).median_interval;
    let end = |which| {
        format!("{which} end of the 95 % confidence interval of the median over seeds 1 to {} of {what}", runs.seeds)
    };
    numbers.push(group.number("median_low", low, "m", end("Lower")));
    numbers.push(group.number("median_high", high, "m", end("Upper")));
    let median = |key: &str, values: &[f64], what: &str| {
        let made = format!("Median over seeds 1 to {} of {what}: {command}", runs.seeds);
        group.number(key, ErrorSummary::of(values).median, "m", made)
    };
    numbers.push(median("before", &of(|run| run.rms_before), "the RMS position error before any loop is closed"));
    numbers.push(median("aligned", &of(|run| run.rms_after_aligned), "what is left of the error after alignment"));
    let worst = of(|run| run.rms_before).into_iter().fold(0.0, f64::max);
    let made = format!("Largest RMS position error before any loop is closed, seeds 1 to {}: {command}", runs.seeds);
    numbers.push(group.number("before.worst", worst, "m", made));
    let errors = if course == Course::Apartment { errors } else { Vec::new() };
    Made { numbers, errors }
}
