//! What the title of a chip claims is a number that its figure tells: one claim at least for each chip of each figure.
//!
//! This has caught a chip of sixteen guesses that showed one building, as pictures of all universes went by weights that chose among them.

use crate::common::figure;
use fastslam_widgets::{
    figure::Figure,
    registry::{self, FIGURES},
};
use std::{
    collections::{BTreeMap, BTreeSet},
    ops::RangeInclusive,
    thread,
};

/// A log that the figure of logs is about here.
const LOG: &[u8] = include_bytes!("../../../tests/figures/golden/tiny.clf");

const MANY: f64 = f64::INFINITY;

/// Where the number is to be read.
#[derive(Clone, Copy)]
enum In {
    /// In the state of the chip.
    Chip,
    /// Where its goal is reached: the chip's state with these values.
    Reached(&'static str),
}
use In::{Chip, Reached};

/// Of a figure and a chip: where, a number by its name (a readout, else a parameter, else the last row of a column of its data; `a/b`, a
/// share of two of them; `a/usual`, of what it is by default), and between which bounds it has to be.
type Claim = (&'static str, &'static str, In, &'static str, RangeInclusive<f64>);

const CLAIMS: &[Claim] = &[
    ("lap", "closing", Chip, "step", 79.0..=79.0),
    ("lap", "closing", Chip, "spread", 0.5..=MANY),
    ("lap", "no-measurements", Chip, "lineage", 16.0..=16.0),
    ("lap", "no-measurements", Chip, "spread", 1.0..=MANY),
    ("lap", "measurements", Chip, "lineage", 1.0..=4.0),
    ("lap", "measurements", Chip, "spread", 0.0..=0.5),
    ("lap", "four", Chip, "universes", 4.0..=4.0),
    ("lap", "four", Reached("proposal=aware"), "rms_best", 0.0..=0.5),
    ("lap", "blurred", Chip, "range-std", 0.3..=0.3),
    ("lap", "blurred", Chip, "rms_odometry", 5.0..=MANY),
    ("conditioning", "path", Chip, "off_block", 0.0..=0.0),
    ("conditioning", "last-pose", Chip, "off_block", 100.0..=MANY),
    ("conditioning", "pairs", Chip, "largest", 0.8..=1.0),
    ("conditioning", "apart", Reached("row=9&column=13"), "rho", 0.8..=1.0),
    ("conditioning", "wheels", Chip, "odometry", 0.0..=0.05),
    ("conditioning", "wheels", Reached("odometry=0"), "off_block", 0.0..=0.0),
    ("proposal", "sharp", Chip, "range-std", 0.005..=0.005),
    ("proposal", "sharp", Reached("bearing-std=0.01"), "ratio", 10.0..=MANY),
    ("proposal", "blunt", Chip, "ratio", 1.0..=1.2),
    ("proposal", "bend", Reached("range-std=0.02&landmark-x=1.1&landmark-y=0"), "inside_aware", 0.0..=80.0),
    ("proposal", "pair", Chip, "a_posterior", 20.0..=80.0),
    ("proposal", "pair", Chip, "a_aware", 0.0..=0.0),
    ("worked-example", "bearing", Chip, "bearing-std/usual", 0.5..=0.5),
    ("worked-example", "ten", Reached("phi2=0.3"), "w1/w2", 10.0..=MANY),
    ("worked-example", "resample", Reached("threshold=0.8"), "verdict", 1.0..=1.0),
    ("log", "odometry", Chip, "apart", 0.5..=MANY),
    ("log", "one", Chip, "universes", 1.0..=1.0),
    ("log", "never", Chip, "resampled", 0.0..=0.0),
    ("log", "coarse", Chip, "cell", 0.2..=0.2),
    ("resampling", "never", Chip, "selective_resampled", 0.0..=0.0),
    ("resampling", "always", Chip, "selective_resampled", 89.0..=90.0),
    ("resampling", "more", Chip, "particles/usual", 2.0..=2.0),
    ("resampling", "more", Chip, "never_lineage", 32.0..=32.0),
    ("resampling", "lose", Chip, "always_right", 0.0..=0.0),
    ("resampling", "lose", Chip, "always_ess", 15.0..=MANY),
    ("joint", "exercise", Chip, "spread_computed", 0.0..=0.0),
    ("joint", "exercise", Reached("landmarks=7"), "predicted_sampled", 0.0..=1.0),
    ("joint", "many", Chip, "particles/usual", 20.0..=20.0),
    ("joint", "blunt", Reached("sensor=3.3"), "ess_sampled", 100.0..=MANY),
    ("universes", "rule", Chip, "passes_motion", 5.0..=95.0),
    ("universes", "strict", Chip, "threshold", 0.1..=0.1),
    ("universes", "strict", Chip, "share_motion", 0.0..=5.0),
    ("universes", "more", Chip, "universes/sufficient_motion", 2.0..=2.0),
    ("universes", "sharp", Chip, "floor/usual", 0.0..=0.7),
    ("doors", "few", Chip, "particles", 25.0..=25.0),
    ("doors", "few", Chip, "fastslam_right", 0.0..=0.0),
    ("doors", "short", Chip, "ekf_right", 0.0..=0.0),
    ("doors", "short", Reached("ride=1"), "ekf_right", 1.0..=1.0),
    ("doors", "uneven", Chip, "door-5/usual", 1.05..=MANY),
    ("doors", "fool", Reached("end=11.5"), "ekf_right", 0.0..=0.0),
    ("doors", "fool", Reached("end=11.5"), "ekf_std", 0.0..=0.2),
    ("doors", "fool", Reached("end=11.5"), "fastslam_right", 1.0..=1.0),
    ("em", "first", Chip, "iteration", 0.0..=0.0),
    ("em", "fold", Chip, "doors", 2.0..=2.0),
    ("em", "yourself", Reached("mark-3=5.2"), "doors", 2.0..=2.0),
    ("em", "blank", Chip, "trust", 0.0..=0.0),
    ("em", "blank", Chip, "doors", 3.0..=3.0),
    ("em", "wheels", Chip, "odometry/usual", 2.0..=2.0),
    ("smoothing", "one", Chip, "coalescence", 31.0..=62.0),
    ("smoothing", "one", Reached("at=47"), "distinct_before", 1.0..=1.0),
    ("smoothing", "one", Reached("at=48"), "distinct_before", 2.0..=MANY),
    ("smoothing", "five", Chip, "sweeps", 5.0..=5.0),
    ("smoothing", "five", Reached("particles=40"), "distinct_after", 2.0..=5.0),
    ("smoothing", "stick", Reached("particles=4"), "distinct_after", 0.0..=8.0),
    ("smoothing", "keep", Chip, "distinct_after", 1.0..=1.0),
    ("graph", "close", Reached("step=60"), "rms", 0.0..=0.15),
    ("graph", "fold", Chip, "rms/rms_matched", 10.0..=MANY),
    ("graph", "fold", Reached("wrong-from=32&wrong-to=86"), "rms", 4.0..=MANY),
    ("graph", "repair", Chip, "rms", 0.0..=0.1),
    ("graph", "repair", Chip, "wrong_weight", 0.0..=1.0),
    ("graph", "early", Reached("seed=9"), "rms/rms_matched", 2.0..=MANY),
];

fn simulated(tag: &str, query: &str) -> Figure {
    let mut figure = figure(tag, query);
    if tag == "fastslam-log" {
        figure.open(LOG).unwrap();
        figure.model_mut().seek(u32::MAX);
        figure.model_mut().settle();
    }
    figure
}

fn number(figure: &Figure, name: &str) -> f64 {
    if let Some(readout) = figure.readouts().into_iter().find(|readout| readout.name == name) {
        return readout.value.unwrap_or_else(|| panic!("there is no {name} now"));
    }
    if let Some(value) = figure.model().value(name) {
        return value.parse().unwrap_or_else(|_| panic!("{name} is {value}"));
    }
    let series = figure.model().series();
    let column = series.columns.iter().position(|column| column.name == name);
    series.rows[series.rows.len() - 1][column.unwrap_or_else(|| panic!("there is no {name}"))]
}

/// What is wrong with the claims of one figure.
fn wrong(claims: &[Claim]) -> Vec<String> {
    let tag = &format!("fastslam-{}", claims[0].0);
    let chips = registry::figure(tag).unwrap().chips();
    let mut states: BTreeMap<String, Figure> = BTreeMap::new();
    let mut read = |query: &str, name: &str| {
        let shown = states.entry(query.into()).or_insert_with(|| simulated(tag, query));
        number(shown, name)
    };
    let wrong = |(name, chip, place, what, bounds): &Claim| {
        let query = &chips.iter().find(|known| known.name == *chip)?.query;
        let query = &if let Reached(values) = place { format!("{query}&{values}") } else { query.clone() };
        let found = match what.split_once('/') {
            Some((what, "usual")) => read(query, what) / read("", what),
            Some((what, of)) => read(query, what) / read(query, of),
            None => read(query, what),
        };
        (!bounds.contains(&found)).then(|| format!("{name} {chip}: {what} is {found}, not in {bounds:?}"))
    };
    claims.iter().filter_map(wrong).collect()
}

#[test]
fn each_chip_claims_something_and_nothing_else_does() {
    let claimed: BTreeSet<(String, &str)> =
        CLAIMS.iter().map(|claim| (format!("fastslam-{}", claim.0), claim.1)).collect();
    let chips = |tag: &str| registry::figure(tag).unwrap().chips().into_iter().map(|chip| chip.name);
    let all = FIGURES.iter().flat_map(|entry| chips(entry.tag).map(|chip| (entry.tag.into(), chip))).collect();
    assert_eq!(claimed, all, "a chip without a claim, or a claim without a chip");
}

#[test]
fn what_the_title_of_a_chip_claims_is_a_number_of_its_figure() {
    let wrong: Vec<String> = thread::scope(|scope| {
        let shares = CLAIMS.chunk_by(|a, b| a.0 == b.0);
        let threads: Vec<_> = shares.map(|share| scope.spawn(|| wrong(share))).collect();
        threads.into_iter().flat_map(|thread| thread.join().unwrap()).collect()
    });
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
