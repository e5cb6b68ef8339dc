//! Runs that are stopped, and go on.

use super::{fastslam, json, refusal, short_log};
use std::path::Path;
use tempfile::tempdir;

fn names(folder: &Path) -> Vec<String> {
    folder.read_dir().unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
}

/// Runs a command until a file is there whose name ends so, and sends it a signal then.
#[cfg(unix)]
fn interrupted(arguments: &str, folder: &Path, end: &str, signal: &str) -> std::process::Output {
    use std::process::{Command, Stdio};
    let mut command = Command::new(env!("CARGO_BIN_EXE_fastslam"));
    let command = command.args(arguments.split_whitespace()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let run = command.spawn().unwrap();
    while !names(folder).iter().any(|name| name.ends_with(end)) {
        std::thread::yield_now();
    }
    let id = run.id().to_string();
    assert!(Command::new("kill").args([signal, &id]).status().unwrap().success());
    run.wait_with_output().unwrap()
}

/// As long as the run is, maps of before are there; stopped by Ctrl-C, it writes what it has, and goes on from there to the map of one run.
#[cfg(unix)]
#[test]
fn a_run_that_is_stopped_leaves_whole_files_and_goes_on_to_the_map_of_one_run() {
    let folder = tempdir().unwrap();
    let log = short_log(&folder, 400);
    let file = |name: &str| folder.path().join(name).display().to_string();
    let (map, session) = (file("map"), file("session"));
    let options = format!("log {log} --particles 8 --map {map} --session {session} --json");
    std::fs::write(file("map.pgm"), "of before").unwrap();
    let killed = interrupted(&options, folder.path(), ".part", "-KILL");
    assert!(killed.stdout.is_empty());
    assert_eq!(std::fs::read_to_string(file("map.pgm")).unwrap(), "of before");
    // The next run removes what that one left.
    let left = || names(folder.path()).into_iter().filter(|name| name.ends_with(".part")).count();
    let removes = left();
    let few = tempdir().unwrap();
    let next = fastslam(&format!("log {} --map {map} --session {session}", short_log(&few, 3))).success();
    let said = String::from_utf8_lossy(&next.get_output().stderr).into_owned();
    assert!(removes > 0 && left() == 0, "{said}");
    std::fs::remove_file(&session).unwrap();
    assert_eq!(said.matches("removed, as the run that wrote it was killed").count(), removes, "{said}");
    let (stopped, said) = loop {
        let stopped = interrupted(&options, folder.path(), ".part", "-INT");
        let said = String::from_utf8_lossy(&stopped.stderr).into_owned();
        if !said.contains("stopped before the first scan") {
            break (stopped, said);
        }
    };
    assert_eq!(stopped.status.code(), Some(130), "{said}");
    assert!(said.contains(" of 400 scans; what was asked for is written up to there"), "{said}");
    assert!(std::fs::read(file("map.pgm")).unwrap().starts_with(b"P5\n"));
    assert!(!names(folder.path()).iter().any(|name| name.ends_with(".part")));
    let run = json(&options);
    assert_eq!(run["digest"], json(&format!("log {log} --particles 8 --json"))["digest"]);
}

/// Killed at any time after a checkpoint, perhaps while it writes the next: what was written last is whole.
#[cfg(unix)]
#[test]
fn a_run_that_is_killed_goes_on_from_its_last_checkpoint() {
    let folder = tempdir().unwrap();
    let log = short_log(&folder, 300);
    let file = |name: &str| folder.path().join(name).display().to_string();
    let options = format!("log {log} --particles 8 --json");
    let saved = format!("{options} --map {} --session {}", file("map"), file("the.session"));
    interrupted(&format!("{saved} --checkpoint 0.001"), folder.path(), "the.session", "-KILL");
    assert!(std::fs::read(file("map.pgm")).unwrap().starts_with(b"P5\n"));
    let again = fastslam(&saved).success();
    let said = String::from_utf8_lossy(&again.get_output().stderr).into_owned();
    assert!(said.contains("the session has "), "{said}");
    let run: serde_json::Value = serde_json::from_slice(&again.get_output().stdout).unwrap();
    assert_eq!(run["digest"], json(&options)["digest"]);
}

#[test]
fn a_session_goes_on_with_the_next_log_and_with_its_own_settings() {
    let folder = tempdir().unwrap();
    let log = short_log(&folder, 60);
    let text = std::fs::read_to_string(&log).unwrap();
    let next = folder.path().join("next.clf").display().to_string();
    let [session, path] = ["session", "path.tum"].map(|name| folder.path().join(name).display().to_string());
    std::fs::write(&next, text.lines().skip(21).map(|line| format!("{line}\n")).collect::<String>()).unwrap();
    std::fs::write(&log, text.lines().take(41).map(|line| format!("{line}\n")).collect::<String>()).unwrap();
    let first = json(&format!("log {log} --particles 2 --session {session} --json"));
    assert_eq!((&first["scans"], &first["scans_used"]), (&40.into(), &40.into()));
    let run = fastslam(&format!("log {next} --session {session} --trajectory {path}")).success();
    let said = String::from_utf8_lossy(&run.get_output().stderr).into_owned();
    assert!(said.contains("the session has 20 of 40 scans already"), "{said}");
    assert_eq!(std::fs::read_to_string(&path).unwrap().lines().count(), 60);
    let refused = refusal(&format!("log {next} --particles 3 --session {session}"));
    assert!(refused.contains("the session was begun with particles = 2, seed = 1, "), "{refused}");
    let good = std::fs::read(&session).unwrap();
    for (bytes, part) in
        [(&b"hello"[..], "it is not a session of this version"), (&good[..good.len() - 9], "the session is damaged: ")]
    {
        std::fs::write(&session, bytes).unwrap();
        let refused = refusal(&format!("log {next} --session {session}"));
        assert!(refused.contains(part), "{refused}");
    }
    assert!(
        refusal(&format!("log {log} --checkpoint 0"))
            .contains("checkpoint = 0: must be a number from 0.001 to 10000 [min]")
    );
}

#[test]
fn a_robot_is_found_in_the_map_of_a_session_which_stays_as_it_is() {
    let folder = tempdir().unwrap();
    let log = short_log(&folder, 150);
    let file = |name: &str| folder.path().join(name).display().to_string();
    let (session, next) = (file("session"), file("next.clf"));
    json(&format!("log {log} --particles 2 --session {session} --trajectory {} --json", file("mapped.tum")));
    let saved = std::fs::read(&session).unwrap();
    let text = std::fs::read_to_string(&log).unwrap();
    std::fs::write(&next, text.lines().skip(81).map(|line| format!("{line}\n")).collect::<String>()).unwrap();
    let rows = |name: &str| -> Vec<[f64; 4]> {
        let text = std::fs::read_to_string(file(name)).unwrap();
        let numbers = |line: &str| line.split(' ').map(|word| word.parse().unwrap()).collect::<Vec<f64>>();
        text.lines().map(numbers).map(|row| [row[1], row[2], row[6], row[7]]).collect()
    };
    let mapped = rows("mapped.tum")[80..].to_vec();
    let [x, y, z, w] = mapped[0];
    let heading = 2.0 * fastslam::ops::atan2(z, w).to_degrees();
    let options = format!("log {next} --localize --session {session} --trajectory {}", file("found.tum"));
    let found = json(&format!("{options} --json --start {},{},{}", x + 0.4, y - 0.3, heading + 10.0));
    assert_eq!((&found["scans"], &found["scans_used"]), (&70.into(), &70.into()));
    assert!(found["matched_fraction"].as_f64().unwrap() > 0.9, "{found}");
    let variance = |k: usize| found["covariance"][k][k].as_f64().unwrap();
    assert!((0..3).all(|k| variance(k) > 1e-8 && variance(k) < 0.0225), "{found}");
    for (found, mapped) in rows("found.tum").iter().zip(&mapped) {
        let off = fastslam::ops::hypot(found[0] - mapped[0], found[1] - mapped[1]);
        assert!(off < 0.1, "{found:?}, {mapped:?}");
    }
    assert!(std::fs::read(&session).unwrap() == saved);
    let lost = fastslam(&format!("{options} --start {},{},0", x + 200.0, y)).code(3);
    assert!(String::from_utf8_lossy(&lost.get_output().stderr).contains("little of what was seen is in the map"));
    assert!(
        refusal(&format!("log {next} --localize --session {session} --start 1,2")).contains("must be three numbers")
    );
    assert!(
        refusal(&format!("log {next} --localize --session {}", file("none")))
            .contains("there is no session to localize in")
    );
}

/// In the map that a session wrote for ROS, in place of the session itself.
#[test]
fn a_robot_is_found_in_a_map_of_ros_and_one_that_cannot_be_is_refused_by_what_is_wrong() {
    let folder = tempdir().unwrap();
    let log = short_log(&folder, 60);
    let file = |name: &str| folder.path().join(name).display().to_string();
    let (map, yaml) = (file("map"), file("map.yaml"));
    json(&format!("log {log} --particles 2 --map {map} --trajectory {} --json", file("mapped.tum")));
    let options = format!("log {log} --particles 2 --localize --in-map");
    let found = json(&format!("{options} {yaml} --trajectory {} --json", file("found.tum")));
    assert!(found["matched_fraction"].as_f64().unwrap() > 0.9, "{found}");
    let places = |name: &str| -> Vec<[f64; 2]> {
        let text = std::fs::read_to_string(file(name)).unwrap();
        let numbers = |line: &str| line.split(' ').map(|word| word.parse().unwrap()).collect::<Vec<f64>>();
        text.lines().map(numbers).map(|row| [row[1], row[2]]).collect()
    };
    let (found, mapped) = (places("found.tum"), places("mapped.tum"));
    assert_eq!(found.len(), mapped.len());
    // Two cells.
    let off = found.iter().zip(&mapped).map(|(a, b)| fastslam::ops::hypot(a[0] - b[0], a[1] - b[1]));
    assert!(off.clone().fold(0.0, f64::max) < 0.1, "{:?}", off.collect::<Vec<_>>());
    let good = std::fs::read_to_string(&yaml).unwrap();
    for (part, other, said) in [
        ("mode: trinary", "mode: raw", "mode = raw: must be trinary or scale"),
        ("resolution: 0.05", "resolution: 5", "resolution = 5: must be a number from 0.02 to 0.2 [m]"),
        ("negate: 0", "negate: 2", "negate = 2: must be 0 or 1"),
        ("free_thresh: 0.196", "free_thresh: 0.7", "free_thresh: must be at most occupied_thresh"),
        ("occupied_thresh: 0.65", "", "missing field `occupied_thresh`"),
        ("0.0]", "0.0, 1]", "expected sequence of 3 elements"),
        ("map.pgm", "map.png", "expected a picture in binary PGM"),
    ] {
        assert!(good.contains(part), "{part} in {good}");
        std::fs::write(&yaml, good.replace(part, other)).unwrap();
        let refused = refusal(&format!("{options} {yaml}"));
        assert!(refused.contains(said), "{said}: {refused}");
    }
    std::fs::write(&yaml, good.replace("mode: trinary\n", "").replace("negate: 0", "negate: false")).unwrap();
    fastslam(&format!("{options} {yaml}")).success();
    assert!(refusal(&format!("{options} {yaml} --cell 0.1")).contains("its cells are of 0.05 m, and no others"));
    assert!(refusal(&format!("log {log} --localize")).contains("--localize needs a map"));
}
