//! Whole runs against their golden fingerprints, in this build (debug or release), serial and on several threads. The same
//! file is what `tests/browser` holds WebAssembly against.
//!
//! A change that is meant to change numbers is written with `UPDATE_GOLDENS=1 cargo test -p portability`.

use fastslam::execute::Executor;
use fastslam_lab::experiment::golden;
use fastslam_lab::experiment::lap::{Lap, LapSetup};
use std::fmt::Write;

const GOLDEN: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/golden.txt");

/// Lines `name size digest`.
fn fingerprints(executor: &Executor) -> String {
    let mut lines = String::new();
    for (name, digest) in golden::traces(executor) {
        writeln!(lines, "{name} {} {:016x}", digest.size(), digest.value()).unwrap();
    }
    lines
}

#[test]
fn serial_runs_have_their_golden_fingerprints() {
    let found = fingerprints(&Executor::Serial);
    if std::env::var_os("UPDATE_GOLDENS").is_some() {
        std::fs::write(GOLDEN, &found).unwrap();
    }
    assert_eq!(found, std::fs::read_to_string(GOLDEN).unwrap());
}

fn runs_have_the_same_fingerprints_on(threads: &[usize]) {
    let golden = std::fs::read_to_string(GOLDEN).unwrap();
    for &threads in threads {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert_eq!(pool.install(|| fingerprints(&Executor::Rayon)), golden, "{threads} threads");
    }
}

#[test]
fn runs_on_any_number_of_threads_have_the_same_fingerprints() {
    runs_have_the_same_fingerprints_on(&[5]);
}

#[test]
#[ignore = "breadth: other numbers of threads"]
fn runs_on_other_numbers_of_threads_have_the_same_fingerprints() {
    runs_have_the_same_fingerprints_on(&[1, 2, 3]);
}

/// What makes the other tests able to fail: one bit of noise changes every fingerprint.
#[test]
fn another_seed_has_another_fingerprint() {
    let mut values: Vec<u64> = (0..4)
        .map(|seed| {
            let (_, setup) = golden::laps().swap_remove(0);
            Lap::new(&LapSetup { seed, ..setup }).unwrap().trace().value()
        })
        .collect();
    values.sort_unstable();
    values.dedup();
    assert_eq!(values.len(), 4);
}
