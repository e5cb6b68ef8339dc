//! What the code of elements repeats of the figures, as it is needed before or without their programs.

use fastslam_lab::experiment::universes::TRIED;
use fastslam_widgets::{lap::Layout, universes::LAPS, view::Layout as _};

/// Holds a file of `elements` to a line that has to be in it.
fn assert_says(source: &str, line: &str) {
    assert!(source.contains(line), "there is no line {line:?}");
}

#[test]
fn the_laps_that_can_be_run_again_are_those_that_were_run() {
    let source = include_str!("../../elements/universes-again.ts");
    assert_says(source, &format!("\nconst TRIED = {TRIED:?}\n"));
    assert_says(source, &format!("\nconst SEEDS = {LAPS}\n"));
}

#[test]
fn drawing_takes_the_map_alone_where_it_stands_above_the_universes() {
    let beside = |width: &u32| {
        let layout = Layout::new(f64::from(*width));
        layout.mosaic.x > layout.large.right()
    };
    let least = (300..1000).find(beside).expect("on a laptop they stand side by side");
    assert_says(include_str!("../../elements/drive.ts"), &format!("\nconst BELOW = {least} "));
}
