//! Whether the numbers in www/data are those that this build makes. The same is what `tests/browser` asks of WebAssembly. Only as releases are
//! built, which takes a minute less: what the checks of a debug build see, the tests of the experiments show it.

use fastslam::execute::Executor;
use portability::{Entries, Extent, NUMBERS, Remade, assert_fresh, differences, read, remake};
use std::sync::LazyLock;

/// Run once for both tests.
static REMADE: LazyLock<Vec<Remade>> = LazyLock::new(|| remake(&Executor::Rayon, Extent::FirstSeeds));

#[test]
#[cfg_attr(debug_assertions, ignore = "as releases are built")]
fn the_chapter_s_numbers_are_made_again_to_the_bit() {
    assert_fresh(&REMADE);
}

#[test]
#[ignore = "breadth: all seeds"]
fn the_chapter_s_numbers_are_made_again_to_the_bit_by_all_their_seeds() {
    assert_fresh(&remake(&Executor::Rayon, Extent::AllSeeds));
}

/// What makes the other tests able to fail.
#[test]
#[cfg_attr(debug_assertions, ignore = "as releases are built")]
fn a_number_that_is_off_by_one_bit_left_over_or_told_otherwise_is_named() {
    let spoil = |change: &dyn Fn(&mut Entries)| {
        let mut entries = read(NUMBERS);
        change(&mut entries);
        differences(&entries, &REMADE)
    };
    let found = spoil(&|entries| {
        let ess = entries.get_mut("worked.ess").unwrap();
        ess.value = f64::from_bits(ess.value.to_bits() + 1);
        let median = entries.get_mut("lap.motion.cell.m4.median").unwrap();
        median.value = f64::from_bits(median.value.to_bits() - 1);
        entries.get_mut("worked.w1").unwrap().unit = "m".into();
        entries.remove("lap.aware.subcell.m40.worst");
        let old = entries["worked.w2"].clone();
        entries.insert("worked.w3".into(), old.clone());
        entries.insert("work".into(), old);
    });
    let keys: Vec<&str> = found.iter().map(|line| line.split_once(": ").unwrap().0).collect();
    assert_eq!(keys, ["work", "lap.motion.cell.m4.median", "worked.w1", "worked.ess", "worked.w3"], "{found:?}");
}
