//! The command line as its users see it.

use assert_cmd::Command;
use fastslam::geometry::Pose2;
use serde_json::Value;
use tempfile::{TempDir, tempdir};

#[path = "command_line/buildings.rs"]
mod buildings;
#[path = "command_line/exports.rs"]
mod exports;
#[path = "command_line/faulty.rs"]
mod faulty;
#[path = "command_line/landmarks.rs"]
mod landmarks;
#[path = "command_line/log.rs"]
mod log;
#[path = "command_line/recordings.rs"]
mod recordings;
#[path = "command_line/sessions.rs"]
mod sessions;

fn fastslam(arguments: &str) -> assert_cmd::assert::Assert {
    Command::new(env!("CARGO_BIN_EXE_fastslam")).args(arguments.split_whitespace()).assert()
}

/// What a command says besides its results, without how far it is, which a busy machine makes it tell.
fn noted(run: &assert_cmd::assert::Assert) -> String {
    let said = String::from_utf8_lossy(&run.get_output().stderr).into_owned();
    said.lines().filter(|line| !line.ends_with(" to go")).map(|line| format!("{line}\n")).collect()
}

fn json(arguments: &str) -> Value {
    serde_json::from_slice(&fastslam(arguments).success().get_output().stdout).unwrap()
}

/// What is said in one line about arguments that are refused.
fn refusal(arguments: &str) -> String {
    let refused = fastslam(arguments).code(2);
    let message = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert_eq!(message.trim_end().lines().count(), 1, "{message}");
    message
}

/// Where a log of shared/data is, which may not be shipped. Where one of its files is absent `npm test` counts the test as skipped, by
/// the line that this prints.
fn recorded<const N: usize>(name: &str, files: [&str; N]) -> Option<String> {
    shared("data", name, files)
}

/// The same of one of the folders of shared.
fn shared<const N: usize>(of: &str, name: &str, files: [&str; N]) -> Option<String> {
    let prefix = format!("{}/../../../../shared/{of}/{name}", env!("CARGO_MANIFEST_DIR"));
    match files.iter().find(|file| !std::path::Path::new(&format!("{prefix}{file}")).exists()) {
        Some(file) => println!("skipped: {name}{file} is not in ../shared/{of}"),
        None => return Some(prefix),
    }
    None
}

/// The first scans of the example log.
fn short_log(folder: &TempDir, scans: usize) -> String {
    let [log, relations] =
        ["example.clf", "example.relations"].map(|name| folder.path().join(name).display().to_string());
    fastslam(&format!("example-log {log} --relations {relations}")).success();
    let text = std::fs::read_to_string(&log).unwrap();
    std::fs::write(&log, text.lines().take(scans + 1).map(|line| format!("{line}\n")).collect::<String>()).unwrap();
    log
}

/// A path in the format of TUM or of a reference: a time \[s\] and a pose a line, whose heading is found in its numbers by `heading`.
fn poses(text: &str, heading: fn(&[f64]) -> f64) -> Vec<(f64, Pose2)> {
    let numbers = text.lines().map(|line| line.split_whitespace().map(|word| word.parse().unwrap()).collect());
    numbers.map(|n: Vec<f64>| (n[0], Pose2::new(n[1], n[2], heading(&n)))).collect()
}

/// A file of tests/bags.
fn bag(name: &str) -> String {
    format!("{}/../../../tests/bags/{name}", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn bad_arguments_are_refused_in_one_line_with_status_2() {
    for (arguments, said) in [
        ("", "a command is missing: log, example-log or landmarks (fastslam --help explains)"),
        ("logs", "logs"),
        ("landmarks --particles -1", "must be a whole number from 1 to 100000"),
        ("log x.clf --particles -1", "must be a whole number from 1 to 4096"),
        ("landmarks --proposal 3.0", "1.0 or 2.0"),
        ("landmarks --association guessed", "known or unknown"),
        ("landmarks --particles 0", "from 1 to 100000"),
        ("landmarks --particles 0 --seeds 2", "from 1 to 100000"),
        ("landmarks --course moon", "eight, tags or wings"),
        ("landmarks --seeds 0", "--seeds"),
        ("landmarks --drift maybe", "must be learnt or none"),
        ("landmarks --late 0,4", "the first from 1 to 1000"),
        ("landmarks --late 4", "two whole numbers"),
        ("log", "FILE"),
        ("log x.clf --particles many", "--particles"),
    ] {
        let refused = fastslam(arguments).code(2).stdout("");
        let message = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
        assert!(message.contains(said) && message.trim_end().lines().count() == 1, "{arguments}: {message}");
    }
}

#[test]
fn the_example_that_the_page_ships_is_the_one_that_is_written() {
    let folder = tempdir().unwrap();
    let log = folder.path().join("example.clf").display().to_string();
    fastslam(&format!("example-log {log}")).success();
    let shipped = include_bytes!("../../../../www/public/example.clf.gz");
    let mut text = String::new();
    std::io::Read::read_to_string(&mut flate2::read::GzDecoder::new(&shipped[..]), &mut text).unwrap();
    assert!(text == std::fs::read_to_string(&log).unwrap(), "write it again: fastslam example-log, gzip -9n");
}
